//! What the README shows is what the code holds and the commands print.

use std::path::Path;
use std::process::Command;
use tilewright_scenes::{Frame, compare_colours};

const README: &str = include_str!("../README.md");

/// The text of the README's first block in that language, or of the first `text` block that contains `mark`.
fn block(language: &str, mark: &str) -> &'static str {
    let opening = format!("```{language}\n");
    let blocks = README.split(&opening).skip(1).map(|rest| rest.split("```").next().unwrap());
    blocks.into_iter().find(|block| block.contains(mark)).unwrap_or_else(|| panic!("no {language} block with {mark}"))
}

fn tilewright(arguments: &str) -> String {
    let program = Command::new(env!("CARGO_BIN_EXE_tilewright")).args(arguments.split(' ')).output().unwrap();
    assert!(program.status.success(), "{arguments}: {program:?}");
    String::from_utf8(program.stdout).unwrap()
}

/// All lines of `part`, in one piece of `whole`, but for their indentation.
#[track_caller]
fn assert_part(whole: &str, part: &str) {
    let plain = |text: &str| text.lines().map(|line| line.trim()).collect::<Vec<_>>().join("\n");
    assert!(plain(whole).contains(plain(part).trim()), "not in what the code has now:\n{part}");
}

#[test]
fn the_description_is_the_blocks() {
    assert_part(include_str!("../rtl/src/merger/unit.rs"), block("rust", "MergingUnitIn"));
}

#[test]
fn the_wave_is_the_commands() {
    assert_eq!(tilewright("wave merging-unit --ascii").trim(), block("text", "nearer |").trim());
}

#[test]
fn the_verilog_is_the_commands() {
    let folder = tempfile::tempdir().unwrap();
    tilewright(&format!("verilog merging-unit -o {}", folder.path().display()));
    let printed = std::fs::read_to_string(folder.path().join("merging_unit.v")).unwrap();
    assert_part(&printed, block("verilog", "nearer"));
}

#[test]
fn the_report_is_the_frames() {
    let printed = tilewright("render teapot --machine vc1");
    for part in block("text", "T_m is").split("\n..\n") {
        assert_part(&printed, part);
    }
}

#[test]
fn the_comparison_is_the_commands() {
    let (command, printed) = block("text", "tilewright compare").split_once('\n').unwrap();
    assert_eq!(command, "$ tilewright compare teapot");
    assert_eq!(tilewright("compare teapot"), printed);
}

#[test]
fn the_report_of_pixel_planes_5_is_the_frames() {
    for scene in ["teapot", "molecule"] {
        let (_, shown) = block("text", &format!("render {scene} --machine pixel-planes-5")).split_once('\n').unwrap();
        let printed = tilewright(&format!("render {scene} --machine pixel-planes-5 --renderers 16"));
        for part in shown.split("\n..\n") {
            assert_part(&printed, part);
        }
    }
}

#[test]
fn the_report_of_pixelflow_is_the_frames() {
    let (_, shown) = block("text", "--machine pixelflow").split_once('\n').unwrap();
    let printed = tilewright("render teapot --machine pixelflow");
    for part in shown.split("\n..\n") {
        assert_part(&printed, part);
    }
}

#[test]
fn the_pictures_are_the_golden_images() {
    let folder = tempfile::tempdir().unwrap();
    let golden = folder.path().join("golden.png");
    for scene in ["teapot", "molecule"] {
        tilewright(&format!("golden {scene} -o {}", golden.display()));
        let shown = format!("docs/{scene}.png");
        let [drawn, kept] = [golden.as_path(), Path::new(&shown)].map(|path| Frame::read_png(path).unwrap());
        // Releases of the encoder differ in the bytes.
        assert!(compare_colours(&drawn, &kept).is_equal(), "{shown} is another picture");
    }
}
