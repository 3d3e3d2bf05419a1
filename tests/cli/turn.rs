//! `render --frames`: several frames of a camera that turns.

use crate::cli::harness::Folder;
use serde_json::json;
use tilewright_scenes::Frame;

const TURN: &str = "render teapot --size 64x48 --processors 3 --frames 3 --turn 40 --refresh 3000";

#[test]
fn each_frame_is_a_file_and_is_compared() {
    let folder = Folder::new();
    let text = folder.stdout(&format!("{TURN} -o turn.png"));
    assert!(text.ends_with("\nall 3 frames are identical to their golden images\n"), "{text}");
    assert_eq!(folder.names(), ["turn-001.png", "turn-002.png", "turn-003.png"]);
    let frame = |number: u32| Frame::read_png(folder.path(format!("turn-00{number}.png"))).unwrap();
    folder.stdout("golden teapot --size 64x48 -o first.png");
    assert_eq!(frame(1), Frame::read_png(folder.path("first.png")).unwrap());
    assert!(frame(1) != frame(2) && frame(2) != frame(3), "the camera turns");

    let report = folder.json(&format!("{TURN} --json"));
    let verdict = json!({"identical": true, "differing": 0, "first": null});
    assert_eq!(report["golden"], json!({"identical": true, "frames": [verdict, verdict, verdict]}));
    let frames = report["report"]["frames"].as_array().unwrap();
    let shown: Vec<u64> = frames.iter().map(|it| it["times"]["shown"].as_u64().unwrap()).collect();
    assert!(shown.len() == 3 && shown.is_sorted(), "{shown:?}");
    // While a frame is drawn, the one before is merged and shown.
    assert_eq!(frames[1]["times"]["command"], frames[0]["times"]["drawn"]);
}

#[test]
fn one_frame_is_the_file_that_is_named() {
    let folder = Folder::new();
    folder.stdout("render teapot --size 64x48 --processors 3 --frames 1 --refresh 3000 -o one.png");
    assert_eq!(folder.names(), ["one.png"]);
}

/// The slab of the table is drawn by all, or by one that runs out of pages on the way (VC1-APR, VC1-SW4).
#[test]
fn large_polygons_are_drawn_by_all_or_overflow() {
    let folder = Folder::new();
    let counts = |options: &str| {
        let line = format!("render table --size 160x120 --processors 4 --refresh 1000 {options} --json");
        let report = folder.json(&line);
        assert_eq!(report["golden"]["identical"], true);
        let processors = report["report"]["frames"][0]["processors"].as_array().unwrap().clone();
        ["overflows", "broadcast"].map(|of| processors.iter().map(|it| it[of].as_u64().unwrap()).sum::<u64>())
    };
    let [alone, together] = [counts("--pages 250 --apr off"), counts("--pages 500 --apr 30 --queue 10 --bus 3")];
    assert!(alone[0] > 0 && alone[1] == 0 && together[0] == 0 && together[1] > 0, "{alone:?} {together:?}");
}
