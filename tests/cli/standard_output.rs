//! Pictures and waveforms on standard output, and commands that are to be quiet.
#![cfg(unix)]

use crate::cli::harness::{Folder, Run};
use std::fs;

const GOLDEN: &str = "golden teapot --size 32x24 -o";

const RENDER: &str = "render pyramid.obj --size 32x24 --processors 1";

/// Runs a line in a shell, which has to succeed without printing anything to standard output.
#[track_caller]
fn silent(folder: &Folder, line: &str) -> Run {
    let run = folder.shell(line);
    assert_eq!((run.code, run.stdout.as_str()), (Some(0), ""), "{line}: {run:?}");
    run
}

#[test]
fn standard_output_takes_a_picture_and_standard_error_the_report() {
    let folder = Folder::new();
    let report = folder.stdout(&format!("{GOLDEN} plain.png"));
    let picture = fs::read(folder.path("plain.png")).unwrap();
    for name in ["-", "/dev/stdout", "x.png"] {
        fs::write(folder.path("x.png"), "head\n").unwrap();
        let run = silent(&folder, &format!("tilewright {GOLDEN} {name} > x.png"));
        assert!(fs::read(folder.path("x.png")).unwrap() == picture, "{name}: another picture");
        assert_eq!(run.stderr, report, "{name}");

        fs::write(folder.path("x.png"), "head\n").unwrap();
        silent(&folder, &format!("tilewright {GOLDEN} {name} >> x.png"));
        assert!(fs::read(folder.path("x.png")).unwrap() == [b"head\n", &picture[..]].concat(), "{name}: appended");
    }
    for name in ["-", "/dev/stdout"] {
        silent(&folder, &format!("tilewright {GOLDEN} {name} | cat > piped.png"));
        assert!(fs::read(folder.path("piped.png")).unwrap() == picture, "{name}: another picture in a pipe");
    }
    assert_eq!(folder.names(), ["piped.png", "plain.png", "x.png"]);
}

#[test]
fn standard_output_takes_a_waveform() {
    let folder = Folder::with_pyramid();
    for line in ["wave merging-unit -o", &format!("{RENDER} --scope line --vcd")] {
        let report = folder.stdout(&format!("{line} plain.vcd"));
        let waveform = folder.read("plain.vcd");
        for name in ["-", "/dev/stdout"] {
            let run = silent(&folder, &format!("tilewright {line} {name} > x.vcd"));
            assert!(folder.read("x.vcd") == waveform, "{line} {name}: another waveform");
            let viewers = report.starts_with("gtkwave");
            assert_eq!(run.stderr, if viewers { "" } else { &report }, "{line} {name}");
            fs::write(folder.path("log"), "head\n").unwrap();
            silent(&folder, &format!("tilewright {line} {name} >> log"));
            assert!(folder.read("log") == format!("head\n{waveform}"), "{line} {name}: appended");
        }
    }
    let run = silent(&folder, &format!("tilewright {RENDER} --scope line --vcd - --json > x.vcd"));
    assert!(run.stderr.starts_with("{\n  \"format\": 1,") && run.stderr.ends_with("}\n"), "{run:?}");
    let run = silent(&folder, "tilewright wave merging-unit -o - --ascii > x.vcd");
    assert!(run.stderr.starts_with("clk    |__"), "{run:?}");
    assert_eq!(folder.names(), ["log", "plain.gtkw", "plain.sucl", "plain.vcd", "pyramid.obj", "x.vcd"]);
}

#[test]
fn errors_do_not_go_into_an_output() {
    let folder = Folder::new();
    for line in [format!("{GOLDEN} - > x.png 2>&1"), format!("{GOLDEN} x.png 2> x.png")] {
        let run = folder.shell(&format!("tilewright {line}"));
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{line}: {run:?}");
        let said = folder.read("x.png");
        assert!(said.contains(": would be mixed with the errors on standard error"), "{line}: {said}");
    }
    let run = folder.run("verilog merging-unit -o -");
    assert!(run.code == Some(2) && run.stderr.contains("name a folder"), "{run:?}");
    assert_eq!(folder.names(), ["x.png"]);
}

#[test]
fn who_stops_reading_ends_a_picture_silently_and_a_waveform_with_a_sentence() {
    let folder = Folder::new();
    let run = folder.shell(&format!("(sleep 0.2; tilewright {GOLDEN} - --quiet; echo $? >&2) | true"));
    assert_eq!(run.stderr, "0\n");
    let run = folder.shell("(sleep 0.2; tilewright wave gfb-unit -o -; echo $? >&2) | true");
    assert_eq!(run.stderr, "error: standard output: cannot be written (broken pipe): choose another place\n3\n");
}

#[test]
fn a_quiet_command_says_nothing_of_a_success() {
    let folder = Folder::with_pyramid();
    let lines = [
        format!("{GOLDEN} g.png"),
        format!("{RENDER} -o f.png --vcd f.vcd --scope line"),
        "wave merging-unit -o w.vcd".to_owned(),
        "verilog merging-unit -o out --testbench".to_owned(),
    ];
    for line in lines {
        for line in [format!("{line} --quiet"), format!("-q {line}")] {
            let run = folder.run(&line);
            assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (Some(0), "", ""), "{line}");
        }
    }
    let report = folder.json(&format!("{RENDER} --quiet --json"));
    assert_eq!(report["golden"]["identical"], true);
    assert!(folder.stdout("list --quiet").starts_with("Scenes"));
    assert!(folder.stdout("wave merging-unit --ascii --quiet").starts_with("clk "));
}

#[test]
fn a_quiet_command_still_warns_and_tells_what_failed() {
    let folder = Folder::with_pyramid();
    let run = folder.run("wave merging-unit -o late.vcd --from 5s --quiet");
    assert!(run.code == Some(0) && run.stderr.starts_with("warning: the run ended at "), "{run:?}");
    let run = folder.run("golden teepot -o g.png --quiet");
    assert!(run.code == Some(2) && run.stderr.starts_with("error: there is no scene `teepot`"), "{run:?}");
    folder.stdout("golden ter1k --size 32x24 -o other.png");
    let run = folder.run(&format!("{RENDER} --golden other.png --quiet"));
    assert!(run.code == Some(1) && run.stdout.contains("NOT identical to the golden image"), "{run:?}");
}
