//! `render` and `golden`.

use crate::cli::harness::{Folder, PYRAMID, Waveform};
use serde_json::{Value, json};
use tilewright_scenes::Frame;

const SMALL: &str = "render teapot --machine vc1 --size 64x48 --processors 2";

#[test]
fn the_report_counts_the_work_and_the_clocks() {
    let folder = Folder::new();
    let report = folder.json(&format!("{SMALL} -o frame.png --json"));
    let (machine, frame) = (&report["report"], &report["report"]["frames"][0]);
    assert_eq!(report["format"], 1);
    assert_eq!(report["golden"], json!({"identical": true, "differing": 0, "first": null}));
    assert_eq!(machine["polygons"], 4096);
    let drawn: u64 = frame["processors"].as_array().unwrap().iter().map(|it| it["pixels"].as_u64().unwrap()).sum();
    // VC1-TM: (M + beta) N + 4 n.
    assert_eq!(machine["merge_clocks"], (64 + 20) * 48 + 4 * 2);
    let time = |event: &str| frame["times"][event].as_u64().unwrap();
    assert!(["command", "drawn", "swapped", "merged", "shown"].map(time).is_sorted(), "{frame}");

    let text = folder.stdout(SMALL);
    let geometry = frame["processors"][1]["clocks"]["geometry"].to_string();
    for part in ["4096 polygons", &format!(" {drawn} "), "clocks of each", "T_m is 4040", "shown ms", &geometry] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(text.ends_with("\nidentical to the golden image\n"), "{text}");
    let frame = Frame::read_png(folder.path("frame.png")).unwrap();
    assert_eq!([frame.size().width(), frame.size().height()], [64, 48]);
}

#[test]
fn patches_and_pages_can_be_chosen() {
    let folder = Folder::new();
    let report = folder.json(&format!("{SMALL} --patch 8 --pages 40 --json"));
    assert_eq!(report["report"]["machine"]["patch"], 8);
    assert_eq!(report["report"]["machine"]["pages"], 40);
    assert_eq!(report["golden"]["identical"], true);
}

#[test]
fn costs_and_the_way_of_dealing_can_be_chosen() {
    let folder = Folder::new();
    let report = |options: &str| {
        folder.json(&format!("render teapot --size 64x48 --processors 3 {options} --json"))["report"].clone()
    };
    let usual = report("");
    let mut costs = usual["machine"]["costs"].clone();
    let geometry = |report: &Value| {
        let processors = report["frames"][0]["processors"].as_array().unwrap();
        processors.iter().map(|it| it["clocks"]["geometry"].as_u64().unwrap()).sum::<u64>()
    };
    let cheap = report("--cost vertex=0 --cost polygon=7 --cost set-up=20");
    assert_eq!(geometry(&cheap), 7 * 4096);
    for (step, clocks) in [("vertex", 0), ("polygon", 7), ("set_up", 20)] {
        costs[step] = json!(clocks);
    }
    assert_eq!(cheap["machine"]["costs"], costs, "the others stay");

    let each = report("--assign each");
    assert_eq!((&usual["machine"]["assign"], &each["machine"]["assign"]), (&json!("once"), &json!("each")));
    assert_eq!(usual["frames"], each["frames"], "one frame is the same");
    let polygons = |report: &Value| {
        let processors = report["frames"][0]["processors"].as_array().unwrap();
        processors.iter().map(|it| it["polygons"].clone()).collect::<Vec<_>>()
    };
    assert_eq!(polygons(&report("--assign count")), [1376, 1376, 1344]);
    assert_ne!(polygons(&usual), [1376, 1376, 1344]);
}

#[test]
fn a_mesh_and_a_scene_file_work_like_a_name() {
    let scene = "mesh = \"pyramid.obj\"\nsize = [40, 30]\n";
    let folder = Folder::with(&[("pyramid.obj", PYRAMID), ("scene.toml", scene)]);
    let of_mesh = folder.json("render pyramid.obj --size 40x30 --processors 1 --json");
    assert_eq!(of_mesh["scene"], "pyramid");
    let of_scene = folder.json("render scene.toml --processors 1 --json");
    for report in [of_mesh, of_scene] {
        assert_eq!(report["report"]["polygons"], 4, "{report}");
        assert_eq!(report["golden"]["identical"], true, "{report}");
        assert_eq!(report["report"]["machine"]["height"], 30, "{report}");
    }
}

#[test]
fn a_frame_that_differs_is_an_error_with_its_first_pixel_and_a_picture() {
    let folder = Folder::with_pyramid();
    folder.stdout("golden pyramid.obj --size 64x48 -o golden.png");
    let line = "render pyramid.obj --size 64x48 --processors 2 --golden golden.png -o frame.png";
    assert!(folder.stdout(line).ends_with("\nidentical to the golden image\n"));

    let mut golden = Frame::read_png(folder.path("golden.png")).unwrap();
    let [first, second] = [golden.index(3, 2), golden.index(60, 40)];
    golden.words[first] ^= 0x01_00_00;
    golden.words[second] ^= 0x80;
    golden.write_png(folder.path("golden.png")).unwrap();
    let run = folder.run(line);
    assert_eq!(run.code, Some(1), "{run:?}");
    let verdict = run.stdout.lines().last().unwrap();
    assert!(verdict.starts_with("NOT identical to the golden image: 2 of 3072 pixels differ"), "{verdict}");
    assert!(verdict.contains("the first is (3, 2): rgb #"), "{verdict}");
    assert!(!verdict.contains("z 0x"), "a picture has no depth: {verdict}");
    let picture = Frame::read_png(folder.path("frame.difference.png")).unwrap();
    assert_eq!(picture.rgb(60, 40), [255, 64, 32]);

    let run = folder.run(&format!("{line} --json"));
    let report: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!((run.code, &report["golden"]["first"]["x"]), (Some(1), &json!(3)), "{report}");
    assert_eq!(report["golden"]["first"]["golden"].as_str().map(str::len), Some(6), "{report}");

    folder.stdout("golden pyramid.obj --size 64x48 -o golden.png");
    let run = folder.run(line);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), "wrote frame.png\nremoved frame.difference.png\n"));
    assert!(!folder.path("frame.difference.png").exists());
}

#[test]
fn a_picture_of_the_differences_that_cannot_be_written_is_a_warning() {
    let folder = Folder::new();
    folder.stdout("golden ter1k --size 64x48 -o golden.png");
    std::fs::create_dir(folder.path("frame.difference.png")).unwrap();
    let run = folder.run(&format!("{SMALL} --golden golden.png -o frame.png"));
    assert_eq!(run.code, Some(1), "{run:?}");
    assert!(run.stdout.lines().last().unwrap().starts_with("NOT identical to the golden image: "), "{run:?}");
    assert!(run.stderr.contains("warning: frame.difference.png: cannot be written (is a directory)"), "{run:?}");
}

#[test]
fn what_is_no_picture_is_not_taken_for_one_of_differences() {
    let folder = Folder::with(&[("pyramid.obj", PYRAMID), ("frame.difference.png", "notes")]);
    let line = "render pyramid.obj --size 32x24 --processors 1 -o frame.png";
    let run = folder.run(line);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), "wrote frame.png\n"));
    folder.stdout("golden teapot --size 32x24 -o golden.png");
    let run = folder.run(&format!("{line} --golden golden.png"));
    let warning =
        "warning: frame.difference.png is not a picture and is kept: remove it to see the differences there\n";
    assert!(run.code == Some(1) && run.stderr.contains(warning), "{run:?}");
    assert_eq!(folder.read("frame.difference.png"), "notes");
}

#[test]
fn an_empty_waveform_is_a_warning() {
    let folder = Folder::with_pyramid();
    for line in ["wave merging-unit -o late.vcd", "render pyramid.obj --size 32x24 --processors 1 --vcd late.vcd"] {
        let run = folder.run(&format!("{line} --from 5s"));
        assert_eq!(run.code, Some(0), "{run:?}");
        assert!(run.stderr.contains("warning: the run ended at ") && run.stderr.contains("before --from"), "{run:?}");
    }
}

#[test]
fn a_waveform_of_the_run_can_be_filtered() {
    let folder = Folder::new();
    folder.stdout(&format!("{SMALL} --vcd run.vcd --scope **.scan_restart --scope line --from 2us --to 3us"));
    let waveform = Waveform::read(&folder.path("run.vcd"));
    assert!(waveform.names.iter().any(|name| name.ends_with(".scan_restart")), "{:?}", waveform.names);
    assert!(waveform.names.len() < 12, "{:?}", waveform.names);
    assert_eq!(waveform.times.first(), Some(&2_000_000));
    assert_eq!(waveform.times.last(), Some(&3_000_000));
}
