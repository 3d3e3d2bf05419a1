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

#[test]
fn pictures_of_several_passes_are_smoother() {
    let folder = Folder::new();
    let line = "render teapot --size 64x48 --processors 3 --refresh 3000";
    folder.stdout(&format!("{line} -o plain.png"));
    let report = folder.json(&format!("{line} --accumulate 4 -o smooth.png --json"));
    assert_eq!((&report["golden"]["identical"], &report["report"]["machine"]["passes"]), (&json!(true), &json!(4)));
    assert_eq!(report["report"]["frames"].as_array().unwrap().len(), 4);
    let colours = |name: &str| {
        let picture = Frame::read_png(folder.path(name)).unwrap();
        picture.words.iter().map(|word| word & 0xff_ffff).collect::<std::collections::BTreeSet<_>>().len()
    };
    assert!(colours("smooth.png") > colours("plain.png"), "{} {}", colours("smooth.png"), colours("plain.png"));

    let text = folder.stdout(&format!("{line} --accumulate 2 --frames 2 -o turn.png"));
    assert!(text.contains("\nThe average of frames 3 to 4 is on display from "), "{text}");
    assert!(text.ends_with("\nall 2 frames are identical to their golden images\n"), "{text}");
    assert_eq!(folder.names(), ["plain.png", "smooth.png", "turn-001.png", "turn-002.png"]);
}

#[test]
fn a_cursor_is_in_the_picture() {
    let folder = Folder::new();
    let line = "render teapot --size 64x48 --processors 3 --refresh 3000 --cursor 60,20 -o cursor.png";
    assert!(folder.stdout(line).ends_with("\nidentical to the golden image\n"));
    let picture = Frame::read_png(folder.path("cursor.png")).unwrap();
    assert_eq!([picture.rgb(60, 20), picture.rgb(63, 27)], [[255; 3]; 2]);
    assert_ne!(picture.rgb(59, 20), [255; 3]);
}

/// What the options of the hardware and of the host change in the report (VC1-TM, VC1-IMM).
#[test]
fn pages_overhead_and_immediate_mode_are_in_the_report() {
    let folder = Folder::new();
    let line = "render table --size 96x72 --processors 4 --refresh 2000";
    let report = |options: &str| folder.json(&format!("{line} {options} --json"))["report"].clone();
    let usual = report("--pages 60");
    let other = report("--pages auto --overhead 5 --immediate --frames 2");
    assert_eq!([&usual, &other].map(|it| it["merge_clocks"].as_u64().unwrap()), [116 * 72 + 16, 101 * 72 + 16]);
    let sum = |report: &serde_json::Value, of: &str| -> u64 {
        let frames = report["frames"].as_array().unwrap();
        let processors = frames.iter().flat_map(|frame| frame["processors"].as_array().unwrap());
        processors.map(|it| it[of].as_u64().unwrap()).sum()
    };
    assert!(sum(&usual, "overflows") > 0);
    assert_eq!(sum(&other, "overflows"), 0);
    let fewest = other["machine"]["pages"].as_u64().unwrap();
    assert!(sum(&report(&format!("--pages {} --frames 2", fewest - 1)), "overflows") > 0, "{fewest}");
    let words = |report: &serde_json::Value| report["frames"][0]["words"].as_u64().unwrap();
    let load = other["load_words"].as_u64().unwrap();
    assert_eq!(words(&other), 20 + load + load.div_ceil(1023) + 10 * sum(&other, "broadcast") / 2);
    assert_eq!(words(&usual), 20 + 10 * sum(&usual, "broadcast"));
}

#[test]
fn options_that_cannot_be_are_refused_in_a_sentence() {
    let folder = Folder::new();
    for (options, sentence) in [
        ("--pages 1", "give a whole number from 2 to 262144, or auto"),
        ("--accumulate 3", "[possible values: 2, 4, 8, 16]"),
        ("--cursor 5", "give two whole numbers of pixels, from the left and from the top, such as 100,50"),
        (
            "--cursor 64,0",
            "error: a cursor at 64,0 on a screen of 64x48: its upper left corner has to be on the screen\n",
        ),
        ("--cursor 1,1 --accumulate 2", "cannot be used with '--accumulate <N>'"),
        ("--overhead 0", "give a whole number from 1 to 1000"),
        ("--refresh 900000", "a line of the display would take "),
        ("--frames 2 -o -", "standard output takes one picture, and --frames makes several"),
        ("--frames 2 --golden x.png", "--golden names one picture, and --frames makes several"),
    ] {
        let run = folder.run(&format!("render teapot --size 64x48 {options}"));
        assert_eq!(run.code, Some(2), "{options}: {run:?}");
        assert!(run.stderr.contains(sentence), "{options}: {run:?}");
    }
}
