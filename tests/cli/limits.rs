//! Full disks, limits of the system and names that are no text: a sentence, an exit code, and nothing torn.
#![cfg(unix)]

use crate::cli::harness::{Folder, Run};
use std::ffi::OsStr;
use std::fs;
use std::os::unix::ffi::OsStrExt;

#[test]
fn the_limit_of_file_sizes_is_a_sentence_and_leaves_nothing() {
    let folder = Folder::new();
    for line in ["golden teapot -o f.png", "render teapot --size 64x48 --processors 1 -o f.png"] {
        let run = folder.shell(&format!("ulimit -f 1; tilewright {line}"));
        assert_eq!((run.code, run.stdout.as_str()), (Some(3), ""), "{line}: {run:?}");
        let sentence = "error: f.png: cannot be written (file too large): allow larger files (`ulimit -f`)";
        assert!(run.stderr.starts_with(sentence), "{line}: {run:?}");
        assert_eq!(folder.names(), [""; 0], "{line}");
    }
}

#[test]
fn verilog_is_written_in_whole_or_not_at_all() {
    let folder = Folder::with(&[]);
    let line = "verilog image-merger -o out/deep --testbench";
    folder.stdout(line);
    let files = fs::read_dir(folder.path("out/deep")).unwrap().map(|it| it.unwrap().path());
    let mut sizes: Vec<u64> = files.map(|path| fs::metadata(path).unwrap().len()).collect();
    sizes.sort_unstable();
    let [.., second, most] = sizes[..] else { panic!("{sizes:?}") };
    // A limit that all but one file keep.
    let blocks = second.div_ceil(512);
    assert!(blocks * 512 < most, "{sizes:?}");
    fs::remove_dir_all(folder.path("out")).unwrap();
    let fails = || folder.shell(&format!("trap '' XFSZ; ulimit -f {blocks}; tilewright {line}"));
    let run = fails();
    assert_eq!((run.code, run.stdout.as_str()), (Some(3), ""), "{run:?}");
    assert!(run.stderr.contains("_tb.v: cannot be written (file too large)"), "{run:?}");
    assert_eq!(run.stderr.lines().count(), 1, "{run:?}");
    assert_eq!(folder.names(), [""; 0], "a part of the set, or the folder, is left");
    // What was there before stays, and nothing comes beside it.
    fs::create_dir_all(folder.path("out/deep")).unwrap();
    fs::write(folder.path("out/deep/merging_unit.v"), "old").unwrap();
    assert_eq!(fails().code, Some(3));
    assert_eq!(folder.read("out/deep/merging_unit.v"), "old");
    assert_eq!(fs::read_dir(folder.path("out/deep")).unwrap().count(), 1);
}

#[test]
fn what_stood_in_standard_output_before_a_waveform_stays() {
    let folder = Folder::with(&[("log", "head\n")]);
    let run = folder.shell("ulimit -f 200; tilewright wave gfb-unit --set width=64 --set height=64 -o - >> log");
    assert_eq!(run.code, Some(3), "{run:?}");
    assert!(run.stderr.starts_with("error: standard output: cannot be written (file too large)"), "{run:?}");
    let log = folder.read("log");
    assert!(log.starts_with("head\n$version\n") && log.len() > 50_000, "{}", log.len());
}

#[test]
#[cfg(target_os = "linux")]
fn no_memory_has_an_exit_code() {
    let limited = |kilobytes: u32, line: &str| {
        Folder::new().shell(&format!("RUST_BACKTRACE=0; ulimit -v {kilobytes}; tilewright {line}"))
    };
    // What the program itself takes.
    let starts = |kilobytes: &u32| limited(*kilobytes, "--version").code == Some(0);
    let least = (10_000..200_000).step_by(2_000).find(starts).expect("it starts in 200 megabytes");
    // Not even for the machine's state, and not for the golden image.
    for kilobytes in [least + 2_000, least + 20_000] {
        let run = limited(kilobytes, "render teapot");
        assert_eq!((run.code, run.stdout.as_str()), (Some(71), ""), "{kilobytes}: {run:?}");
        assert!(run.stderr.starts_with("memory allocation of "), "{kilobytes}: {run:?}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn names_that_are_no_text_work_everywhere() {
    let folder = Folder::new();
    let name = |end: &str| [b"a\xff", end.as_bytes()].concat();
    fs::write(folder.path(OsStr::from_bytes(&name(".obj"))), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let run = |line: &str| {
        let words = line.split(' ').map(|word| match word.strip_prefix('@') {
            Some(end) => OsStr::from_bytes(&name(end)).to_owned(),
            None => OsStr::new(word).to_owned(),
        });
        let run = Run::of(folder.command("").args(words).output().unwrap());
        assert_eq!(run.code, Some(0), "{line}: {run:?}");
        run
    };
    let json = |line: &str| serde_json::from_str::<serde_json::Value>(&run(line).stdout).unwrap();
    assert_eq!(json("golden @.obj --size 16x12 -o @.png --json")["scene"], "a\u{fffd}");
    assert_eq!(json("render @.obj --size 16x12 -o @2.png --vcd @.vcd --json")["golden"]["identical"], true);
    assert_eq!(json("verilog merging-unit -o @ --json")["files"][0], "a\u{fffd}/merging_unit.v");
    let wave = json("wave merging-unit -o @.vcd --json");
    assert_eq!(wave["files"][1], "a\u{fffd}.gtkw");
    assert_eq!(wave["commands"][0], r"gtkwave $'a\377.vcd' $'a\377.gtkw'");
    for end in ["", ".png", "2.png", ".vcd", ".gtkw", ".sucl"] {
        assert!(folder.path(OsStr::from_bytes(&name(end))).exists(), "{end}");
    }
}
