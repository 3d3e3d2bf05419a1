//! Ctrl-C during a run: the waveform opens, and the exit code says what happened.
#![cfg(unix)]

use crate::harness::{Folder, Run, Waveform};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// Runs a command, interrupts it when its waveform has grown to some size, and returns how it ended.
fn interrupted(folder: &Folder, line: &str, waveform: &str) -> Run {
    let mut child = folder.command(line).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    while std::fs::metadata(folder.path(waveform)).map_or(0, |it| it.len()) < 200_000 {
        assert!(child.try_wait().unwrap().is_none(), "{line} ended before it could be interrupted");
        sleep(Duration::from_millis(5));
    }
    let killed = Command::new("kill").args(["-s", "INT", &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    Run::of(child.wait_with_output().unwrap())
}

#[test]
fn an_interrupted_scenario_leaves_a_waveform_that_opens() {
    let folder = Folder::new();
    let run = interrupted(&folder, "wave gfb-unit --set width=2048 --set height=2048 -o long.vcd", "long.vcd");
    assert_eq!((run.code, run.stdout.as_str()), (Some(130), ""), "{run:?}");
    assert!(run.stderr.contains("error: the run was interrupted at "), "{run:?}");
    assert!(Waveform::read(&folder.path("long.vcd")).times.len() > 1000);
    assert!(folder.path("long.gtkw").exists());
}

#[test]
fn an_interrupted_frame_leaves_a_waveform_that_opens_and_no_picture() {
    let folder = Folder::new();
    let run = interrupted(&folder, "render teapot --processors 2 --vcd run.vcd -o frame.png", "run.vcd");
    assert_eq!((run.code, run.stdout.as_str()), (Some(130), ""), "{run:?}");
    assert!(run.stderr.contains("error: the run was interrupted at "), "{run:?}");
    assert!(Waveform::read(&folder.path("run.vcd")).times.len() > 100);
    assert_eq!(folder.names(), ["run.vcd"]);
}
