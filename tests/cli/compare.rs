//! `compare`.

use crate::cli::harness::{Folder, PYRAMID};
use serde_json::{Value, json};
use tilewright_scenes::{Frame, compare_colours};

const SMALL: &str = "compare pyramid.obj --size 32x24";

/// A machine's line of the table.
fn row<'a>(table: &'a Value, machine: &str) -> &'a Value {
    let rows = table["machines"].as_array().unwrap();
    rows.iter().find(|row| row["machine"] == machine).unwrap_or_else(|| panic!("no {machine}: {table}"))
}

#[test]
fn the_table_has_the_numbers_of_each_machines_report() {
    let folder = Folder::with_pyramid();
    let table = folder.json(&format!("{SMALL} --json"));
    assert_eq!((&table["format"], &table["scene"], &table["size"]), (&json!(1), &json!("pyramid"), &json!([32, 24])));
    assert_eq!((&table["polygons"], &table["identical"]), (&json!(4), &json!(true)));
    let report = |machine: &str| {
        let report = folder.json(&format!("render pyramid.obj --size 32x24 --machine {machine} --json"));
        report["report"].clone()
    };

    let (vc1, its) = (row(&table, "vc1"), report("vc1"));
    let times = &its["frames"][0]["times"];
    let picoseconds = times["shown"].as_u64().unwrap() - times["command"].as_u64().unwrap();
    assert_eq!((&vc1["clocks"], &vc1["processors"]), (&json!(picoseconds / 25_000), &json!(16)));
    let processors = its["frames"][0]["processors"].as_array().unwrap();
    assert_eq!(vc1["drawn"], processors.iter().map(|it| it["pixels"].as_u64().unwrap()).sum::<u64>());
    assert_eq!(vc1["megahertz"].as_f64().unwrap().round(), 40.0);

    let (quadtree, its) = (row(&table, "quadtree"), report("quadtree"));
    assert_eq!((&quadtree["clocks"], &quadtree["drawn"]), (&its["phases"][0]["clocks"], &its["fragments"]));
    assert_eq!(quadtree["tested"], its["stages"].as_array().unwrap().last().unwrap()["tests"]["all"]);

    let (planes, its) = (row(&table, "pixel-planes-5"), report("pixel-planes-5"));
    let [sent, geometry] = [&its["sent"], &its["geometry"]["clocks"]].map(|it| it.as_u64().unwrap());
    assert_eq!(planes["clocks"], sent.max(geometry));
    assert_eq!(planes["tested"], its["renderers"][0]["drawn"].as_u64().unwrap() * 128 * 128);

    let (flow, its) = (row(&table, "pixelflow"), report("pixelflow --system non-texturing"));
    let loaded = its["turns"].as_array().unwrap().last().unwrap()["loaded"]["end"].as_u64().unwrap();
    let front = its["front"].as_u64().unwrap().saturating_sub(its["turns"][0]["rasterized"].as_u64().unwrap());
    assert_eq!(flow["clocks"], (loaded + front) / 2);
    assert_eq!(flow["tested"], its["drawn"].as_u64().unwrap() * 128 * 64);

    for row in table["machines"].as_array().unwrap() {
        assert_eq!((&row["drawn"], &row["golden"]["identical"]), (&vc1["drawn"], &json!(true)));
        // Two pictures of 48 bits a pixel, or one whose pixels are kept in regions, too.
        assert!(row["memory_bits"].as_u64() >= Some(2 * 48 * 32 * 24), "{row}");
        assert!(row["register_bits"].as_u64() > Some(1000), "{row}");
    }

    let text = folder.stdout(SMALL);
    assert!(text.starts_with("pyramid: 32x24 pixels, 4 polygons\n\nmachine "), "{text}");
    assert!(text.ends_with("\nall 4 frames are identical to the golden image\n"), "{text}");
    let line = text.lines().find(|line| line.starts_with("vc1 ")).unwrap();
    let bits = vc1["memory_bits"].to_string();
    assert!(line.split_whitespace().any(|word| word == bits) && line.contains("16 processing elements"), "{line}");
}

#[test]
fn machines_can_be_chosen_and_the_frame_is_theirs() {
    let folder = Folder::with_pyramid();
    let line = format!("{SMALL} --machine quadtree --machine vc1");
    let run = folder.run(&format!("{line} -o frame.png"));
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), "wrote frame.png\n"));
    assert!(run.stdout.ends_with("\nall 2 frames are identical to the golden image\n"), "{}", run.stdout);
    assert!(!run.stdout.contains("pixel-planes-5"), "{}", run.stdout);
    folder.stdout("golden pyramid.obj --size 32x24 -o golden.png");
    let [frame, golden] = ["frame.png", "golden.png"].map(|name| Frame::read_png(folder.path(name)).unwrap());
    assert!(compare_colours(&frame, &golden).is_equal());
}

/// As one polygon it has other depths than as two triangles, by a unit.
#[test]
fn a_face_that_is_not_quite_flat_is_the_same_on_all_machines() {
    let quad = "v -0.902 -0.998 -0.0000000398\nv 0.980 -1.061 0.0000000042\nv 1.115 0.838 0.0000000420\n\
                v -0.811 1.134 0.0000000012\nf 1 2 3 4\n";
    let scene = "mesh = \"quad.obj\"\nsize = [64, 48]\n[camera]\neye = [0, 0, 4]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\n";
    let folder = Folder::with(&[("quad.obj", quad), ("quad.toml", scene)]);
    let table = folder.json("compare quad.toml --json");
    assert_eq!((&table["identical"], &table["polygons"]), (&json!(true), &json!(2)));
}

#[test]
fn a_machine_that_cannot_draw_the_scene_is_named() {
    let folder = Folder::with_pyramid();
    let run = folder.run("compare pyramid.obj --size 4x4");
    assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{run:?}");
    assert!(run.stderr.starts_with("error: vc1: "), "{}", run.stderr);
    assert_eq!(folder.run("compare pyramid.obj --size 4x4 --machine quadtree").code, Some(0));
}

/// Where large triangles are not drawn by all, a processing element draws in more patches than it has pages.
#[test]
fn a_vc1_swaps_on_overflow() {
    let folder = Folder::new();
    let report = folder.json("render textured --size 320x240 --apr off --json");
    let processors = report["report"]["frames"][0]["processors"].as_array().unwrap();
    let overflows: u64 = processors.iter().map(|it| it["overflows"].as_u64().unwrap()).sum();
    let table = folder.json("compare textured --size 320x240 --machine vc1 --json");
    assert!(overflows > 0, "{report}");
    assert!(report["golden"]["identical"] == true && table["identical"] == true, "{table}");
}

#[test]
fn what_is_odd_about_a_scene_is_said_once_and_no_input_is_written_over() {
    let folder = Folder::with(&[("pyramid.obj", PYRAMID), ("odd.obj", &format!("{PYRAMID}usemtl nowhere\n"))]);
    let run = folder.run("compare odd.obj --size 32x24");
    let warnings: Vec<&str> = run.stderr.lines().collect();
    assert!(run.code == Some(0) && warnings.len() == 1 && warnings[0].starts_with("warning: "), "{run:?}");
    let run = folder.run(&format!("{SMALL} -o pyramid.obj"));
    assert_eq!(run.code, Some(2), "{run:?}");
    assert_eq!(folder.read("pyramid.obj"), PYRAMID);
}
