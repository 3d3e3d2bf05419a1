//! `--engine` of `render` and `wave`.

use crate::cli::harness::Folder;

/// A scene of few clocks.
const FILES: &[(&str, &str)] = &[("triangle.obj", "v -1 0 -1\nv 1 0 -1\nv 0 1.5 0\nf 1 2 3\n")];

const ENGINES: [&str; 3] = ["reference", "compiled", "both"];

/// Runs a command without `--engine` and then on every engine, each in a folder of its own: all must print and write the same.
#[track_caller]
fn assert_alike(line: &str) {
    let folder = Folder::with(FILES);
    let usual = folder.run(line);
    assert_eq!(usual.code, Some(0), "{line}: {usual:?}");
    for engine in ENGINES {
        let other = Folder::with(FILES);
        let run = other.run(&format!("{line} --engine {engine}"));
        let [expected, got] = [&usual, &run].map(|run| (run.code, &run.stdout, &run.stderr));
        assert_eq!(expected, got, "{line} on {engine}");
        let [expected, got] = [&folder, &other].map(|folder| folder.files("."));
        assert!(expected.keys().eq(got.keys()), "{line} on {engine}");
        for (name, bytes) in &expected {
            assert!(*bytes == got[name], "{name} of {line} differs on {engine}");
        }
    }
}

#[test]
fn a_frame_is_the_same_on_every_engine() {
    // With a fast display, which the reference engine need not wait for.
    let vc1 = "--size 16x12 --processors 2 --refresh 2000";
    assert_alike(&format!("render triangle.obj {vc1} -o frame.png --vcd run.vcd --json"));
    let quadtree = "--machine quadtree --matrix 1x1 --form stack";
    assert_alike(&format!("render triangle.obj --size 4x3 {quadtree} -o frame.png --vcd run.vcd --json"));
}

#[test]
fn a_waveform_is_the_same_on_every_engine() {
    for block in ["merging-unit", "lfb-unit", "gfb-unit"] {
        assert_alike(&format!("wave {block} --ascii -o wave.vcd"));
        assert_alike(&format!("wave {block} -o wave.vcd --json"));
    }
}

#[test]
fn the_help_says_what_an_engine_costs_and_which_is_usual() {
    let folder = Folder::new();
    for command in ["render", "wave"] {
        let help = folder.stdout(&format!("{command} --help"));
        let option = help.split("--engine <ENGINE>").nth(1).unwrap_or_else(|| panic!("no --engine in {help}"));
        for part in
            ["reference: ", "interpreter: ", "compiled: ", "both: ", "thousands of times slower", "[default: compiled]"]
        {
            assert!(option.contains(part), "{command}: {part}: {help}");
        }
        assert!(
            help.contains("--engine both\nthe engines differ") || help.contains("--engine both the engines differ")
        );
    }
}

#[test]
fn completions_know_the_engines() {
    let folder = Folder::new();
    for shell in ["bash", "zsh"] {
        let script = folder.stdout(&format!("completions {shell}"));
        assert!(script.contains("--engine"), "{shell}");
        assert!(ENGINES.iter().all(|engine| script.contains(engine)), "{shell}");
    }
}
