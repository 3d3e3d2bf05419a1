//! Outputs that cannot be written, readers that go away, and what goes where.

use crate::cli::harness::{Folder, PYRAMID, Run, Waveform};
use std::process::Stdio;

const RENDER: &str = "render pyramid.obj --size 32x24 --processors 1";

#[test]
fn an_output_that_cannot_be_written_is_named() {
    let folder = Folder::with(&[("file", ""), ("pyramid.obj", PYRAMID)]);
    let cases = [
        (format!("{RENDER} -o ."), ".: cannot be written (is a directory): name a file in that folder"),
        (
            format!("{RENDER} -o none/frame.png"),
            "none/frame.png: cannot be written (no such file or directory): make the folder `none` first",
        ),
        (
            format!("{RENDER} -o file/frame.png"),
            "file/frame.png: cannot be written (not a directory): `file` is no folder: name a file in one",
        ),
        (
            format!("{RENDER} --vcd none/run.vcd"),
            "none/run.vcd: cannot be written (no such file or directory): make the folder `none` first",
        ),
        (
            "golden teapot -o none/g.png".to_owned(),
            "none/g.png: cannot be written (no such file or directory): make the folder `none` first",
        ),
        ("wave merging-unit -o .".to_owned(), ".: cannot be written (is a directory): name a file in that folder"),
        ("verilog merging-unit -o file".to_owned(), "file: cannot be written"),
    ];
    for (line, sentence) in cases {
        let run = folder.run(&line);
        assert_eq!((run.code, run.stdout.as_str()), (Some(3), ""), "{line}: {run:?}");
        assert!(run.stderr.starts_with(&format!("error: {sentence}")), "{line}: {run:?}");
        assert_eq!(run.stderr.lines().count(), 1, "{line}: {run:?}");
    }
    assert_eq!(folder.names(), ["file", "pyramid.obj"]);
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_no_success() {
    let folder = Folder::with_pyramid();
    let lines = [
        format!("{RENDER} -o /dev/full"),
        format!("{RENDER} --vcd /dev/full"),
        "golden teapot -o /dev/full".to_owned(),
        "wave merging-unit -o /dev/full".to_owned(),
    ];
    for line in lines {
        let run = folder.run(&line);
        assert_eq!((run.code, run.stdout.as_str()), (Some(3), ""), "{line}: {run:?}");
        assert!(run.stderr.starts_with("error: /dev/full: cannot be written (no space left on device)"), "{run:?}");
    }
    for line in ["list", "--help", "wave merging-unit --ascii"] {
        let full = std::fs::File::create("/dev/full").unwrap();
        let run = Run::of(folder.command(line).stdout(full).stderr(Stdio::piped()).output().unwrap());
        assert_eq!(run.code, Some(3), "{line}: {run:?}");
        assert!(run.stderr.starts_with("error: standard output: cannot be written (no space left"), "{line}: {run:?}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_disk_that_fills_up_is_no_success_either() {
    let folder = Folder::new();
    let lines = [
        "wave gfb-unit --set width=64 --set height=64 -o big.vcd",
        "render teapot --vcd big.vcd",
        "golden teapot -o big.png",
    ];
    for line in lines {
        // No file may grow beyond 50 KiB or so; the signal that would end the program is ignored.
        let run = folder.shell(&format!("trap '' XFSZ; ulimit -f 100; tilewright {line}"));
        assert_eq!((run.code, run.stdout.as_str()), (Some(3), ""), "{line}: {run:?}");
        assert!(run.stderr.starts_with("error: big.") && run.stderr.contains("(file too large)"), "{line}: {run:?}");
        assert_eq!(run.stderr.lines().count(), 1, "{line}: {run:?}");
    }
    assert_eq!(folder.names(), ["big.vcd"], "a picture that could not be written is left");
}

#[test]
#[cfg(target_os = "linux")]
fn a_waveform_goes_to_a_pipe_or_a_device_without_a_save_file() {
    let folder = Folder::with_pyramid();
    folder.stdout("wave merging-unit -o plain.vcd");
    let run = folder.shell("timeout 20 tilewright wave merging-unit -o /dev/stdout | cat > piped.vcd");
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    assert_eq!(folder.read("piped.vcd"), folder.read("plain.vcd"));
    let line =
        "mkfifo pipe; cat pipe > fifo.vcd & timeout 20 tilewright wave merging-unit -o pipe; code=$?; wait; exit $code";
    let run = folder.shell(line);
    assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (Some(0), "", "wrote pipe\n"));
    assert_eq!(folder.read("fifo.vcd"), folder.read("plain.vcd"));
    for line in [
        "wave merging-unit -o /dev/null",
        "render pyramid.obj --size 32x24 --processors 1 -o /dev/null --vcd /dev/null --scope line",
    ] {
        let run = folder.run(line);
        assert_eq!((run.code, run.stderr.replace("wrote /dev/null\n", "").as_str()), (Some(0), ""), "{line}: {run:?}");
    }
    for left in ["stdout.gtkw", "null.gtkw", "null.sucl", "null.difference.png"] {
        assert!(!std::path::Path::new("/dev").join(left).exists(), "{left} is left in /dev");
    }
    assert_eq!(
        folder.names(),
        ["fifo.vcd", "pipe", "piped.vcd", "plain.gtkw", "plain.sucl", "plain.vcd", "pyramid.obj"]
    );
}

#[test]
fn a_scene_with_no_name_is_unknown() {
    let run = Folder::new().shell("tilewright render ''");
    assert!(run.code == Some(2) && run.stderr.starts_with("error: there is no scene ``: "), "{run:?}");
}

#[test]
#[cfg(target_os = "linux")]
fn a_disk_that_fills_up_leaves_the_whole_steps_that_fit() {
    let folder = Folder::new();
    let run = |line: &str| folder.shell(&format!("{line} wave gfb-unit --set width=64 --set height=64 -o run.vcd"));
    let text = || std::fs::read_to_string(folder.path("run.vcd")).unwrap();
    assert_eq!(run("tilewright").code, Some(0));
    let whole = text();
    // The limit, of about 250 KiB, falls within a step.
    assert_eq!(run("trap '' XFSZ; ulimit -f 500; tilewright").code, Some(3));
    let fitted = text();
    assert!(Waveform::read(&folder.path("run.vcd")).times.len() > 1000);
    let rest = whole.strip_prefix(&fitted).expect("the file begins like the whole one");
    assert!(rest.starts_with('#'), "the next line belongs to the last step: {}", &rest[..rest.len().min(20)]);
}

#[test]
fn a_reader_that_has_gone_away_stops_it_silently() {
    let folder = Folder::new();
    for line in ["list", "--help", "completions bash", "wave merging-unit --ascii"] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let run = Run::of(folder.command(line).stdout(writer).stderr(Stdio::piped()).output().unwrap());
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{line}: {run:?}");
    }
}

#[test]
fn results_go_to_standard_output_and_talk_to_standard_error() {
    let folder = Folder::with_pyramid();
    let run = folder.run(&format!("{RENDER} -o frame.png --json"));
    assert_eq!(run.stderr, "wrote frame.png\n", "no progress bar either, where there is no terminal");
    assert!(run.stdout.starts_with("{\n  \"format\": 1,\n"), "{run:?}");
}
