//! `render --machine pixelflow`, and what goes wrong with it.

use crate::cli::harness::Folder;
use serde_json::json;
use tilewright_scenes::Frame;

const SMALL: &str = "render pyramid.obj --machine pixelflow --size 24x16 --nodes 4 --shaders 1 --array 8x8";

#[test]
fn the_report_has_each_region_s_way_and_each_node() {
    let folder = Folder::with_pyramid();
    let report = folder.json(&format!("{SMALL} -o frame.png --json"));
    assert_eq!((&report["format"], &report["machine"]), (&json!(1), &json!("pixelflow")));
    assert_eq!(report["golden"], json!({"identical": true, "differing": 0, "first": null}));
    let report = &report["report"];
    assert_eq!((&report["system"], &report["array"], &report["nodes"]), (&json!("Base"), &json!([8, 8]), &json!(4)));
    let nodes = |kind: &str| report[kind].as_array().unwrap().len();
    assert_eq!((nodes("turns"), nodes("rasterizers"), nodes("shaders")), (6, 2, 1));
    let tick = |turn: usize, stage: &str, end: &str| report["turns"][turn][stage][end].as_u64().unwrap();
    for turn in 0..6 {
        // 21 bytes, then 3, of 16 pixels of a chip (PFL-BYTES).
        assert_eq!(tick(turn, "composed", "end") - tick(turn, "composed", "start"), 21 * 16);
        assert_eq!(tick(turn, "sent", "end") - tick(turn, "sent", "start"), 3 * 16);
        assert!(tick(turn, "shaded", "end") <= tick(turn, "sent", "start"));
    }
    let text = folder.stdout(SMALL);
    for part in [
        "pyramid: PixelFlow, base system, deferred shading: 24x16 pixels in 6 regions of 8x8,\n",
        "4 nodes: 2 rasterize, 1 shade, one has the frame buffer\n",
        "\nshader 1 ",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(text.ends_with("\nidentical to the golden image\n"), "{text}");
}

#[test]
fn any_nodes_and_both_systems_draw_the_golden_image() {
    let folder = Folder::with_pyramid();
    let of = |options: &str| {
        let line = format!("render pyramid.obj --machine pixelflow --array 8x8 {options} --json");
        let report = folder.json(&line);
        assert_eq!(report["golden"]["identical"], true, "{options}: {report}");
        report["report"]["turns"].as_array().unwrap().last().unwrap()["loaded"]["end"].as_u64().unwrap()
    };
    let few = of("--size 24x16 --nodes 3 --shaders 1");
    assert!(of("--size 24x16 --nodes 5 --shaders 2") < few);
    of("--size 16x12 --nodes 2 --system non-texturing");
    of("--size 8x6 --nodes 2 --system non-texturing --engine both");
}

#[test]
fn a_front_end_that_sorts_before_works_beside_the_arrays() {
    let folder = Folder::with_pyramid();
    let of = |system: &str| {
        let report = folder.json(&format!("{SMALL} --system {system} --json"));
        assert_eq!(report["golden"]["identical"], true, "{system}: {report}");
        report["report"].clone()
    };
    let (base, sorted) = (of("base"), of("pre-sorting"));
    assert_eq!((&base["system"], &sorted["system"]), (&json!("Base"), &json!("PreSort")));
    let ticks = |report: &serde_json::Value, of: &str| report[of].as_u64().unwrap();
    // PFL-PRE: 0.1 ms and 0.74 us a primitive of the first pass, and 1.45 us of the second; PFL-LAT1: 1.85 us in one.
    let most = ticks(&sorted["rasterizers"][0], "primitives");
    assert_eq!((ticks(&sorted, "front"), ticks(&sorted, "second")), (20_000 + 148 * most, 290 * most));
    assert_eq!((ticks(&base, "front"), ticks(&base, "second")), (20_000 + 370 * most, 0));
    // Its last primitive is there no sooner.
    assert!(ticks(&sorted["turns"][5], "rasterized") > ticks(&sorted, "front") + ticks(&sorted, "second"));
    let text = folder.stdout(&format!("{SMALL} --system pre-sorting"));
    assert!(text.contains("pre-sorting system, deferred shading") && text.contains("\nsecond pass "), "{text}");
}

#[test]
fn a_front_end_that_sorts_before_has_fields_and_two_eyes() {
    let folder = Folder::new();
    let line = "render teapot --machine pixelflow --size 12x8 --array 8x8 --system pre-sorting --field odd --eyes 0.5";
    for how in ["--nodes 6 --shaders 2 --stereo halved", "--nodes 4 --shaders 1 --stereo sequential"] {
        let report = folder.json(&format!("{line} {how} --json"));
        assert_eq!(report["golden"]["identical"], true, "{how}: {report}");
        let report = &report["report"];
        for eye in ["left", "right"] {
            let ticks = |of: &str| report[eye][of].as_u64().unwrap();
            assert_eq!((&report[eye]["system"], &report[eye]["field"]), (&json!("PreSort"), &json!("odd")));
            // Many primitives are between the lines: of these no instructions are made.
            let turns = report[eye]["turns"].as_array().unwrap();
            let rasterized = turns.last().unwrap()["rasterized"].as_u64().unwrap();
            let made = ticks("front") + ticks("second");
            assert!(ticks("second") > 0 && (made..made + 500).contains(&rasterized), "{how}: {made}, {rasterized}");
        }
        let ends: Vec<u64> = report["ends"].as_array().unwrap().iter().map(|end| end.as_u64().unwrap()).collect();
        assert_eq!(ends[1] > ends[0] + 20_000, how.ends_with("sequential"), "{ends:?}");
    }
}

#[test]
fn a_textured_scene_is_drawn() {
    let report =
        Folder::new().json("render textured --machine pixelflow --size 24x16 --nodes 4 --shaders 1 --array 8x8 --json");
    assert_eq!(report["golden"]["identical"], true, "{report}");
}

#[test]
fn eight_samples_are_averaged_in_the_frame_buffer() {
    let folder = Folder::with_pyramid();
    let line = "render pyramid.obj --machine pixelflow --size 16x8 --nodes 4 --shaders 1 --array 16x8 --samples 8";
    let report = folder.json(&format!("{line} --json"))["report"].clone();
    assert_eq!((&report["samples"], &report["size"]), (&json!(8), &json!([16, 8])));
    // Both renderings of a region, then it is written: 24 bytes of each of 8 pixels of a chip, and a turn more.
    for turns in report["turns"].as_array().unwrap().chunks(2) {
        let writes = |turn: &serde_json::Value| {
            turn["loaded"]["end"].as_u64().unwrap() - turn["loaded"]["start"].as_u64().unwrap()
        };
        assert_eq!([writes(&turns[0]), writes(&turns[1])], [0, 2 * 24 * 9]);
    }
    let text = folder.stdout(line);
    assert!(
        text.starts_with("pyramid: PixelFlow, base system, deferred shading: 16x8 pixels of 8 samples in 8 regions"),
        "{text}"
    );
    assert!(text.ends_with("\nidentical to the golden image\n"), "{text}");
}

#[test]
fn eight_samples_are_drawn_one_after_another_without_textures() {
    let folder = Folder::with_pyramid();
    let line =
        "render pyramid.obj --machine pixelflow --size 24x16 --nodes 3 --array 8x8 --system non-texturing --samples 8";
    let text = folder.stdout(line);
    for part in ["non-texturing system: 24x16 pixels of 8 samples in 48 regions", "\nframe's holder "] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(text.ends_with("\nidentical to the golden image\n"), "{text}");
    let text = folder.stdout(&format!("{line} --field odd"));
    assert!(text.contains("24x8 pixels of the odd field of 8 samples in 24 regions"), "{text}");
    // They are the samples of `tilewright golden`.
    folder.stdout("golden pyramid.obj --size 24x16 --samples 8 -o golden.png");
    folder.stdout(&format!("{line} --golden golden.png"));
}

#[test]
fn eight_samples_are_shaded_once() {
    let folder = Folder::with_pyramid();
    let line = "render pyramid.obj --machine pixelflow --size 16x12 --nodes 4 --shaders 1 --array 8x8 --samples 8 --shade-once";
    let text = folder.stdout(line);
    assert!(text.contains("16x12 pixels of 8 samples shaded once in 32 regions of 8x8"), "{text}");
    assert!(text.ends_with("\nidentical to the golden image\n"), "{text}");
    // They are the samples of `tilewright golden`.
    folder.stdout("golden pyramid.obj --size 16x12 --deferred --samples 8 --shade-once -o golden.png");
    folder.stdout(&format!("{line} --golden golden.png"));
    let text = folder.stdout(&format!("{line} --field even"));
    assert!(text.contains("16x6 pixels of the even field of 8 samples shaded once in 16 regions"), "{text}");
}

#[test]
fn fields_have_half_the_lines() {
    let folder = Folder::with_pyramid();
    let line = "render pyramid.obj --machine pixelflow --size 16x24 --array 8x8 --nodes 4";
    for (options, parts) in [
        ("--shaders 1 --field even", ["16x12 pixels of the even field in 4 regions", "base system"]),
        ("--system non-texturing --field odd", ["16x12 pixels of the odd field in 4 regions", "non-texturing system"]),
    ] {
        let text = folder.stdout(&format!("{line} {options}"));
        assert!(parts.iter().all(|part| text.contains(part)), "{text}");
        assert!(text.ends_with("\nidentical to the golden image\n"), "{text}");
    }
}

#[test]
fn two_eyes_are_side_by_side() {
    let folder = Folder::with_pyramid();
    let line = "render pyramid.obj --machine pixelflow --size 16x12 --array 8x8";
    let of = |options: &str| {
        let report = folder.json(&format!("{line} {options} -o both.png --json"));
        assert_eq!(report["golden"]["identical"], true, "{options}: {report}");
        assert_eq!(Frame::read_png(folder.path("both.png")).unwrap().size().to_string(), "32x12");
        report["report"].clone()
    };
    let halved = of("--nodes 6 --shaders 2 --stereo halved");
    assert_eq!(
        (&halved["stereo"], &halved["left"]["nodes"], &halved["right"]["nodes"]),
        (&json!("halved"), &json!(3), &json!(3))
    );
    let sequential = of("--nodes 4 --system non-texturing --stereo sequential --eyes 0.25");
    assert_eq!((&sequential["eye_distance"], &sequential["left"]["nodes"]), (&json!(0.25), &json!(4)));
    assert!(sequential["ends"][0].as_u64() < sequential["ends"][1].as_u64());
    let text = folder.stdout(&format!("{line} --nodes 4 --system non-texturing --field odd --stereo halved"));
    for part in [
        "pyramid: two eyes, ",
        " apart, both at once, each on half of the nodes\n\nleft eye: PixelFlow, non-texturing system: 16x6 pixels",
        "\n\nright eye: PixelFlow",
        " ms for both.\n",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(text.ends_with("\nidentical to the golden image\n"), "{text}");
}

#[test]
fn mistakes_are_said() {
    let folder = Folder::with_pyramid();
    let said = |options: &str, sentence: &str| {
        let run = folder.run(&format!("render pyramid.obj --machine pixelflow {options}"));
        assert_eq!(run.code, Some(2), "{options}: {}", run.stderr);
        assert!(run.stderr.contains(sentence), "{options}: {}", run.stderr);
    };
    said("--nodes 3 --shaders 2 --size 32x24", "none is left to rasterize; give at least 4");
    said("--array 12x8", "an array of 12x8 pixels: each side has to be a power of two from 8 to 256");
    said("--array 4x8", "an array of 4x8 pixels: each side has to be a power of two from 8 to 256");
    said("--array wide", "give width and height in pixels, such as 128x64");
    said("--system non-texturing --shaders 2", "has no shaders: leave out --shaders");
    said("--system non-texturing --array 8x8 --size 64x64", "have room for 44");
    said("--system non-texturing --samples 8 --array 8x8 --size 64x64", "have room for 44");
    said("--system non-texturing --samples 8 --size 2048x8", "give a width and a height up to 1024, or one sample");
    said("--samples 8 --field even", "leave out one of them, add --shade-once");
    said("--shade-once", "needs several samples per pixel: add --samples 8");
    said("--samples 8 --shade-once --system non-texturing", "shades nothing: leave out --shade-once");
    said("--field odd --size 32x1", "has no odd lines: give a height of 2 or more");
    said("--eyes 1", "add --stereo halved or --stereo sequential");
    said("--stereo halved --nodes 5", "5 nodes have no halves for two eyes: give an even number");
    said("--stereo halved --nodes 4 --shaders 2", "in each half, 2 nodes with 1 shaders");
    said("--stereo sequential --eyes -1", "the distance between the eyes is -1: give a number from 0 on");
    said("--stereo halved --size 1500x8", "side by side are too wide: give a width up to 1024");
    said("--samples 4", "[possible values: 1, 8]");
    said("--strict", "--strict is an option of quadtree");
    said("--renderers 2", "--renderers is an option of pixel-planes-5");
    said("--vcd frame.vcd", "use `tilewright wave pixelflow-node`");
}
