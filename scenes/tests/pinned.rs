//! The built-in scenes, exactly: meshes and 640x480 golden frames by checksum. So a disagreement between processors or
//! compilers is noticed.
//!
//! New values are printed by `cargo run --release -p tilewright-scenes --example measure`, which also leaves the pictures in the
//! folder for temporary files: look at them before you pin them.

use tilewright_scenes::golden::{Rule, render_polygons};
use tilewright_scenes::{Counts, Scene, golden, project_polygons};

struct Pinned {
    name: &'static str,
    mesh: u64,
    frame: u64,
    counts: Counts,
}

fn check(pinned: &Pinned) {
    let scene = Scene::builtin(pinned.name).expect("a built-in scene");
    let projection = scene.project().expect("a built-in scene projects");
    let frame = golden::render(scene.size, &projection.triangles, scene.background);
    // What clipping leaves of a triangle may have four corners, and then the planes of a triangle or those of a polygon.
    if pinned.counts.split == 0 {
        let polygons = project_polygons(&scene, scene.size).expect("as triangles do").polygons;
        let drawn = golden::render(scene.size, &polygons, scene.background);
        assert!(frame == drawn, "{}: as polygons", pinned.name);
    }
    assert_eq!(projection.counts, pinned.counts, "{}", pinned.name);
    assert_eq!(projection.corners.len(), pinned.counts.polygons as usize, "{}: vertices of each polygon", pinned.name);
    assert_eq!(scene.mesh.checksum(), pinned.mesh, "{}: the mesh", pinned.name);
    assert_eq!(frame.checksum(), pinned.frame, "{}: the frame", pinned.name);
}

#[test]
fn teapot() {
    check(&Pinned {
        name: "teapot",
        mesh: 0x8997_b1ae_854c_bbd1,
        frame: 0x0203_fe02_1359_3e75,
        counts: Counts { polygons: 4096, drawn: 4009, degenerate: 64, between_centres: 23, ..Counts::default() },
    });
}

#[test]
fn teapot16() {
    check(&Pinned {
        name: "teapot16",
        mesh: 0x1ceb_875e_9524_50b9,
        frame: 0xd296_0205_4bec_baef,
        counts: Counts { polygons: 65536, drawn: 59157, degenerate: 1139, between_centres: 5240, ..Counts::default() },
    });
}

#[test]
fn table() {
    check(&Pinned {
        name: "table",
        mesh: 0x3ff1_c9d4_99c4_7787,
        frame: 0x8f3e_8b33_c59e_fc2b,
        counts: Counts { polygons: 10224, drawn: 9842, degenerate: 67, between_centres: 315, ..Counts::default() },
    });
}

/// Facts D measured 58,867 pixels and 36 % with a table of their own.
#[test]
fn the_slab_of_the_table_has_the_only_very_large_polygons() {
    let scene = Scene::builtin("table").expect("a built-in scene");
    let projection = scene.project().expect("a built-in scene projects");
    let large = |limit: f64| projection.triangles.iter().filter(move |triangle| triangle.area() > limit);
    let slab: Vec<u32> = large(10_000.0).map(|triangle| triangle.polygon).collect();
    assert_eq!(slab, [0, 1, 2, 3], "its upper and its lower side");
    assert_eq!(large(58_859.0).count(), 1);
    assert_eq!(large(58_861.0).count(), 0);
    let covered = golden::ties(scene.size, &projection.triangles).covered as f64 / scene.size.pixels() as f64;
    assert!((0.364..0.366).contains(&covered), "{covered}");
}

#[test]
fn ter1k() {
    check(&Pinned {
        name: "ter1k",
        mesh: 0x2e62_89a1_6bdb_830b,
        frame: 0x6848_17bd_3580_d3c6,
        counts: Counts { polygons: 12482, drawn: 11380, off_screen: 1046, between_centres: 56, ..Counts::default() },
    });
}

#[test]
fn ter250() {
    check(&Pinned {
        name: "ter250",
        mesh: 0x5302_f009_049a_ed3d,
        frame: 0x9d3f_27d9_69d3_652f,
        counts: Counts {
            polygons: 203_522,
            drawn: 156_729,
            off_screen: 18_940,
            degenerate: 109,
            between_centres: 27_744,
            ..Counts::default()
        },
    });
}

#[test]
fn wireframe() {
    check(&Pinned {
        name: "wireframe",
        mesh: 0x82b7_6b7e_0835_1b9c,
        frame: 0x0369_ad85_7078_af60,
        counts: Counts { polygons: 1040, lines: 1040, drawn: 1040, ..Counts::default() },
    });
}

#[test]
fn star() {
    check(&Pinned {
        name: "star",
        mesh: 0xb302_9b56_5de4_47b1,
        frame: 0x76e2_904f_b35b_ec42,
        counts: Counts { polygons: 266, lines: 266, drawn: 266, ..Counts::default() },
    });
}

#[test]
fn textured() {
    check(&Pinned {
        name: "textured",
        mesh: 0x4b8c_30fb_7a02_a296,
        frame: 0x4065_2865_dd06_542b,
        counts: Counts {
            polygons: 6018,
            drawn: 5896,
            degenerate: 65,
            between_centres: 57,
            split: 1,
            ..Counts::default()
        },
    });
}

#[test]
fn molecule() {
    let scene = Scene::builtin("molecule").expect("a built-in scene");
    let polygons = project_polygons(&scene, scene.size).expect("a built-in scene projects");
    let frame = render_polygons(&polygons, Rule::Least, scene.background);
    let counts = Counts { polygons: 1224, spheres: 24, drawn: 1219, between_centres: 5, ..Counts::default() };
    assert_eq!(polygons.counts, counts);
    assert_eq!(scene.mesh.checksum(), 0x6b05_d643_8291_6038, "the mesh");
    assert_eq!(frame.checksum(), 0x1236_680a_65a7_593c, "the frame");
}
