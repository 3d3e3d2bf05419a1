//! Frames of small machines, beside the golden image.

use std::sync::atomic::Ordering::Relaxed;

use proptest::prelude::*;
use tilewright_scenes::golden::{Rule, render_polygons};
use tilewright_scenes::packet::FARTHEST_VERTEX;
use tilewright_scenes::sphere::Sphere;
use tilewright_scenes::{Camera, Mesh, Polygon, Scene, ScreenVertex, Size, compare, project_polygons, set_up};

use super::*;
use crate::pixel_planes::model::Model;
use crate::pixel_planes::report::{RegionReport, Unit};
use crate::pixel_planes::{Edges, SPHERE_LEAST, SPHERE_STRICT, allocate, scene_clocks};

/// A scene's frame and report, which is that of the golden rasterizer.
fn drawn(name: &str, size: (u32, u32), config: impl Fn(Config) -> Config) -> Report {
    let scene = Scene::builtin(name).expect("a built-in scene");
    let polygons = project_polygons(&scene, Size::new(size.0, size.1).expect("in range")).expect("in front");
    let usual = Config { quadratic: !scene.spheres.is_empty(), ..Config::new(polygons.size) };
    let (differing, report) = beside_golden(&polygons, config(usual));
    assert_eq!(differing, 0, "{name} {size:?}");
    report
}

/// The pixels that differ from the golden rasterizer's, and the report.
fn beside_golden(polygons: &Polygons, config: Config) -> (u64, Report) {
    const BACKGROUND: [u8; 3] = [24, 28, 44];
    let rule = if config.strict { Rule::Strict } else { Rule::Least };
    let golden = render_polygons(polygons, rule, BACKGROUND);
    let machine = Machine::new(config).expect("it can be built");
    let (frame, report) = machine.render(polygons, BACKGROUND, &mut Watch::default()).expect("nobody stops it");
    (compare(&frame, &golden).differing, report)
}

#[test]
fn frames_are_golden_for_all_numbers_of_renderers_and_sizes_of_regions() {
    for (renderers, side, size) in [(1, 32, (40, 30)), (3, 16, (40, 30)), (5, 8, (23, 17)), (2, 64, (40, 30))] {
        for strict in [false, true] {
            for side_by_side in [false, true] {
                drawn("teapot", size, |it| Config { renderers, side, strict, side_by_side, ..it });
            }
        }
    }
    drawn("wireframe", (40, 30), |it| Config { renderers: 2, side: 16, ..it });
}

#[test]
fn all_forms_of_edges_draw_the_same_and_the_least_is_the_fastest() {
    let [fixed, own, least] = Edges::ALL.map(|edges| {
        let report =
            drawn("teapot", (40, 30), |it| Config { renderers: 2, side: 16, edges, side_by_side: false, ..it });
        assert_eq!(report.machine.edges, edges.name());
        report.renderers.iter().map(|it| it.busy).sum::<u64>()
    });
    assert!(least < own && own < fixed, "{least}, {own}, {fixed}");
}

#[test]
fn spheres_are_golden_for_all_numbers_of_renderers_and_sizes_of_regions() {
    for (renderers, side, size) in
        [(1, 32, (40, 30)), (32, 16, (40, 30)), (5, 8, (40, 30)), (2, 64, (80, 60)), (2, 128, (80, 60))]
    {
        for (strict, program) in [(false, SPHERE_LEAST), (true, SPHERE_STRICT)] {
            for side_by_side in [false, true] {
                let report = drawn("molecule", size, |it| Config { renderers, side, strict, side_by_side, ..it });
                let spheres = report.programs.last().expect("there are some");
                assert_eq!(spheres.program, program);
                // Spheres are charged as polygons are.
                let (transform, set_up) = (report.geometry.transform, report.geometry.set_up);
                assert_eq!((transform, set_up), (631 * 1224, 500 * report.primitives));
                assert!(spheres.primitives >= 24 && report.machine.quadratic, "{spheres:?}");
            }
        }
    }
    // Programs without a sphere are the same on such a machine, but for the way to the pixels.
    let of = |quadratic| drawn("teapot", (40, 30), |it| Config { renderers: 2, side: 16, quadratic, ..it });
    let (linear, quadratic) = (of(false), of(true));
    assert_eq!(linear.programs, quadratic.programs);
    assert!(!linear.to_string().contains("quadratic") && quadratic.to_string().contains("pixels with quadratic trees"));
}

/// A scene of spheres alone, each with its middle at (w, right, up) of the eye.
fn spheres_alone(all: &[(f64, f64, f64, f64, [u8; 3])], size: Size) -> Polygons {
    let sphere = |&(w, y, z, radius, colour): &(f64, f64, f64, f64, [u8; 3])| Sphere {
        centre: [w, y, z].into(),
        radius,
        colour,
    };
    let camera = Camera { eye: [0.0; 3].into(), target: [1.0, 0.0, 0.0].into(), up: [0.0, 0.0, 1.0].into(), fov: 60.0 };
    let star = Scene::builtin("star").expect("a built-in scene");
    let scene = Scene { mesh: Mesh::none(), spheres: all.iter().map(sphere).collect(), camera, ..star };
    project_polygons(&scene, size).expect("in front")
}

/// Among triangles, all of random places, depths and colours.
fn spheres_and_triangles() -> impl Strategy<Value = Polygons> {
    let sphere = (2.0..20.0f64, -0.5..0.5f64, -0.4..0.4f64, 0.01..0.3f64, any::<[u8; 3]>());
    let sphere = sphere.prop_map(|(w, y, z, radius, colour)| (w, y * w, z * w, radius * w, colour));
    let corner = (-200..1200i32, -200..900i32, 1..1u32 << 24, any::<[u8; 3]>());
    let corner = corner.prop_map(|(x, y, z, rgb)| ScreenVertex { x, y, z: z.min(FARTHEST_VERTEX), rgb });
    let triangles = prop::collection::vec(prop::array::uniform3(corner), 0..8);
    (prop::collection::vec(sphere, 1..8), triangles).prop_map(|(spheres, triangles)| {
        let made = spheres_alone(&spheres, Size::new(64, 48).expect("in range"));
        let drawn = triangles.iter().filter_map(|corners| Some((set_up(corners, made.size)?.into(), corners.to_vec())));
        let (polygons, vertices): (Vec<Polygon>, Vec<_>) = drawn.unzip();
        Polygons { polygons, vertices, ..made }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_spheres_among_triangles_are_golden(
        polygons in spheres_and_triangles(),
        renderers in 1..4u32,
        side in prop::sample::select(vec![8, 16, 32]),
        (strict, side_by_side) in (any::<bool>(), any::<bool>()),
    ) {
        let config = Config { renderers, side, strict, side_by_side, quadratic: true, ..Config::new(polygons.size) };
        let (differing, _) = beside_golden(&polygons, config);
        prop_assert_eq!(differing, 0);
    }
}

/// The largest regions, and a sphere with the greatest values in them.
#[test]
fn a_small_sphere_in_a_large_region_is_golden() {
    let all = [(10.0, -2.0, 1.0, 0.03, [200, 250, 255]), (10.0, 0.3, -2.0, 0.5, [9, 99, 255])];
    let polygons = spheres_alone(&all, Size::new(270, 256).expect("in range"));
    for side in [128, 256] {
        let config = Config { renderers: 2, side, quadratic: true, ..Config::new(polygons.size) };
        let (differing, report) = beside_golden(&polygons, config);
        assert_eq!((differing, report.binned()), (0, if side == 128 { 3 } else { 2 }), "{report}");
    }
}

/// The clocks of primitives are those of the schedule; a region takes its own beside them, and waits for its save.
#[test]
fn the_clocks_of_programs_are_those_of_the_renderers() {
    let scene = Scene::builtin("teapot").expect("a built-in scene");
    let polygons = project_polygons(&scene, Size::new(40, 30).expect("in range")).expect("in front");
    for (strict, expected) in [(false, ["flat_least", "smooth_least"]), (true, ["flat_strict", "smooth_strict"])] {
        let config = Config { renderers: 4, side: 16, strict, side_by_side: false, ..Config::new(polygons.size) };
        let clocks = scene_clocks(&config, &polygons).expect("there are regions");
        let report = drawn("teapot", (40, 30), |_| config.clone());
        assert_eq!(report.programs, clocks.used().collect::<Vec<_>>());
        assert_eq!(report.programs.iter().map(|it| it.program).collect::<Vec<_>>(), expected);
        // One at a time a region takes its primitives, what any region takes, and the clocks in which it waits.
        let sum = |of: fn(&RegionReport) -> u64| report.regions.iter().map(of).sum::<u64>();
        let primitives: u64 = report.programs.iter().map(|it| it.clocks).sum();
        let regions = Model::REGION_OVERHEAD * report.regions.len() as u64;
        assert_eq!(sum(|it| it.clocks - it.starved - it.waited_for_store), primitives + regions);
        assert_eq!(report.programs.iter().map(|it| it.primitives).sum::<u64>(), sum(|it| it.drawn));
    }
}

#[test]
fn regions_are_given_as_the_plain_allocator_gives_them() {
    let report = drawn("star", (64, 48), |it| Config { renderers: 3, side: 16, ..it });
    let sizes: Vec<u64> = report.regions.iter().map(|it| it.primitives).collect();
    assert!(report.regions.windows(2).all(|pair| pair[0].primitives >= pair[1].primitives), "the fullest bins first");
    let mut free = [0; 3];
    for it in &report.regions {
        let first = (0..3).min_by_key(|&renderer| free[renderer]).expect("there are three");
        assert_eq!(it.renderer, first, "{it:?}");
        assert!(it.begun >= free[first]);
        free[first] = it.begun + it.clocks;
    }
    assert_eq!(report.drawn, free.into_iter().max().expect("there are three"));
    assert_eq!(report.worst_load(), report.renderers.iter().map(|it| it.primitives).max().expect("there are three"));
    let least = report.binned().div_ceil(3);
    assert!((least..=report.binned()).contains(&report.worst_load()));
    assert_eq!(allocate(&sizes, 1, |size| size).worst_load(), report.binned());
}

#[test]
fn a_ring_that_is_too_slow_makes_renderers_wait_and_changes_no_pixel() {
    for side_by_side in [false, true] {
        let of_ring =
            |ring| drawn("teapot", (40, 30), |it| Config { renderers: 3, side: 16, ring, side_by_side, ..it });
        let (ample, slow) = (of_ring(Config::AMPLE_RING), of_ring(400));
        assert_eq!(ample.first_starved, None);
        assert_eq!(ample.renderers.iter().map(|it| it.starved).sum::<u64>(), 0);
        let starved = slow.renderers.iter().map(|it| it.starved).sum::<u64>();
        assert!(slow.first_starved.is_some() && slow.drawn > ample.drawn && slow.ring.load > 0.9, "{slow}");
        assert_eq!(slow.regions.iter().map(|it| it.starved).sum::<u64>(), starved);
        assert_eq!(slow.ring.bits, ample.ring.bits);
        assert!(slow.to_string().contains(" was the first to wait for an instruction, in clock "), "{slow}");
        assert!(ample.to_string().contains("No renderer had to wait for an instruction."), "{ample}");
    }
}

#[test]
fn progress_goes_on_through_the_frame() {
    let scene = Scene::builtin("star").expect("a built-in scene");
    let polygons = project_polygons(&scene, Size::new(64, 48).expect("in range")).expect("in front");
    let machine =
        Machine::new(Config { renderers: 1, side: 16, ..Config::new(polygons.size) }).expect("it can be built");
    let mut seen = Vec::new();
    let mut progress = |it: crate::run::Progress| seen.push(it.fraction);
    let mut watch = Watch { progress: Some(&mut progress), cancel: None };
    machine.render(&polygons, scene.background, &mut watch).expect("nobody stops it");
    assert!(seen.len() > 10 && seen.is_sorted() && seen.last() == Some(&1.0), "{seen:?}");
    let steps = seen.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    assert!(steps < 0.2, "{seen:?}");
    let cancel = std::sync::atomic::AtomicBool::new(true);
    let stopped = machine.render(&polygons, scene.background, &mut Watch { progress: None, cancel: Some(&cancel) });
    assert!(matches!(stopped, Err(Error::Cancelled { phase: "drawing", time: 0 })));
    // Stopped on the way, it says at which picosecond. Early, as on a busy computer the frame may be far ahead of what is heard.
    cancel.store(false, Relaxed);
    let mut progress = |it: crate::run::Progress| cancel.store(it.fraction > 0.05, Relaxed);
    let stopped = machine.render(
        &polygons,
        scene.background,
        &mut Watch { progress: Some(&mut progress), cancel: Some(&cancel) },
    );
    let Err(Error::Cancelled { phase: "drawing", time }) = stopped else { panic!("it was cancelled") };
    assert!(time > PERIOD.picoseconds() && time % PERIOD.picoseconds() == 0, "{time}");
}

#[test]
fn a_machine_that_cannot_be_is_refused() {
    let refused = |config: Config| Machine::new(config).expect_err("it is refused").to_string();
    let usual = Config::new(Size::VGA);
    assert!(refused(Config { renderers: 33, ..usual.clone() }).contains("from 1 to 32"));
    assert!(refused(Config { side: 48, ..usual.clone() }).contains("power of two"));
    assert!(refused(Config { side: 4, ..usual.clone() }).contains("8 to 256"));
    assert!(refused(Config { queue: 0, ..usual.clone() }).contains("from 1 to 4096"));
    assert!(refused(Config { ring: 5001, ..usual }).contains("a multiple of 40 from 40 to 327680"));
    let scene = Scene::builtin("molecule").expect("a built-in scene");
    let polygons = project_polygons(&scene, scene.size).expect("in front");
    let linear = Machine::new(Config::new(scene.size)).expect("it can be built");
    let error = linear.render(&polygons, [0; 3], &mut Watch::default()).expect_err("it is refused").to_string();
    assert_eq!(error, "spheres on a machine whose renderers cannot evaluate quadratics: build one that can");
}

#[test]
fn what_works_longest_on_a_frame_limits_it() {
    let of = |geometry: u32, ring: u32| {
        let report = drawn("teapot", (40, 30), |it| Config { renderers: 1, side: 64, geometry, ring, ..it });
        (report.limit().unit, report)
    };
    let (unit, slow) = of(1, Config::AMPLE_RING);
    assert_eq!(unit, Unit::Geometry);
    assert!(slow.interval() == slow.geometry.clocks && slow.latency() == slow.geometry.clocks + slow.sent);
    let (unit, fast) = of(256, Config::AMPLE_RING);
    assert_eq!((unit, fast.interval()), (Unit::Renderers, fast.sent));
    assert_eq!((fast.geometry.total(), fast.sent), (slow.geometry.total(), slow.sent));
    assert_eq!(of(256, 400).0, Unit::Ring);
    // Each primitive drawn is tested in all of its region.
    assert_eq!(fast.tested(), fast.regions[0].drawn * 64 * 64);
}
