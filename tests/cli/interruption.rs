//! Signals during a run: the waveform opens, and sentence and exit code say what happened.
#![cfg(unix)]

use crate::cli::harness::{Folder, Run, Waveform};
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::flag;
use std::process::{Child, Command, Stdio};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Once};
use std::thread::sleep;
use std::time::{Duration, Instant};
use tilewright_scenes::Frame;

/// A scenario that takes long.
const LONG: &str = "wave gfb-unit --set width=2048 --set height=2048 -o long.vcd";

/// The signals that ask a run to stop, with the exit codes.
const STOPS: [(&str, i32); 3] = [("INT", 130), ("TERM", 143), ("HUP", 129)];

/// How long a command may go on after it was stopped: little beside what it would take, and enough on a computer that is busy.
const SOON: Duration = Duration::from_secs(30);

/// Lets signals reach what is started, also where they are ignored here, as below `nohup`: a program inherits what is ignored, but not
/// what is handled.
fn handle_signals() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let unset = || Arc::new(AtomicBool::new(false));
        flag::register(SIGHUP, unset()).unwrap();
        for signal in [SIGINT, SIGTERM] {
            flag::register_conditional_default(signal, Arc::new(AtomicBool::new(true))).unwrap();
        }
    });
}

fn start(folder: &Folder, line: &str) -> Child {
    start_command(&mut folder.command(line))
}

/// Starts a command that a signal reaches.
pub fn start_command(command: &mut Command) -> Child {
    handle_signals();
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

/// Waits until a command's waveform has grown to some size.
fn await_waveform(folder: &Folder, child: &mut Child, waveform: &str) {
    while std::fs::metadata(folder.path(waveform)).map_or(0, |it| it.len()) < 200_000 {
        assert!(child.try_wait().unwrap().is_none(), "it ended before it could be interrupted");
        sleep(Duration::from_millis(5));
    }
}

pub fn send(child: &Child, signal: &str) {
    // The shell's own: a bare Debian has no program of that name.
    let killed = Command::new("sh").args(["-c", &format!("kill -s {signal} {}", child.id())]).status().unwrap();
    assert!(killed.success());
}

/// Runs a command, stops it when its waveform has grown to some size, and returns how it ended.
fn interrupted(folder: &Folder, line: &str, waveform: &str, signal: &str) -> Run {
    let mut child = start(folder, line);
    await_waveform(folder, &mut child, waveform);
    send(&child, signal);
    Run::of(child.wait_with_output().unwrap())
}

/// The processor time that a process has had; elsewhere than on Linux what the clock says.
fn processor_time(child: &Child, started: Instant) -> Duration {
    if !cfg!(target_os = "linux") {
        return started.elapsed();
    }
    let stat = std::fs::read_to_string(format!("/proc/{}/stat", child.id())).unwrap_or_default();
    // Behind the name, which may hold blanks, the 12th and 13th number, in hundredths of a second.
    let numbers = stat.rsplit(')').next().unwrap_or_default().split_whitespace().skip(11).take(2);
    Duration::from_millis(10 * numbers.filter_map(|number| number.parse::<u64>().ok()).sum::<u64>())
}

/// Runs a command, stops it when it has worked for a while, and returns how it ended and how long that took.
fn stopped_after(folder: &Folder, line: &str, work: Duration) -> (Run, Duration) {
    let mut child = start(folder, line);
    let started = Instant::now();
    while processor_time(&child, started) < work {
        assert!(child.try_wait().unwrap().is_none(), "{line} ended before it could be interrupted");
        sleep(Duration::from_millis(5));
    }
    let begin = Instant::now();
    send(&child, "INT");
    (Run::of(child.wait_with_output().unwrap()), begin.elapsed())
}

#[test]
fn an_interrupted_scenario_leaves_a_waveform_that_opens() {
    for (signal, code) in STOPS {
        let folder = Folder::new();
        let run = interrupted(&folder, LONG, "long.vcd", signal);
        assert_eq!((run.code, run.stdout.as_str()), (Some(code), ""), "{signal}: {run:?}");
        assert!(run.stderr.contains("error: the run was interrupted at "), "{signal}: {run:?}");
        assert!(Waveform::read(&folder.path("long.vcd")).times.len() > 1000);
        assert!(folder.path("long.gtkw").exists());
    }
}

#[test]
fn an_interrupted_frame_leaves_a_waveform_that_opens_and_no_picture() {
    let machines = ["--processors 2", "--machine quadtree --matrix 1x2 --form stack", "--processors 2"];
    for ((signal, code), machine) in STOPS.into_iter().zip(machines) {
        let folder = Folder::new();
        let line = format!("render teapot {machine} --vcd run.vcd -o frame.png");
        let run = interrupted(&folder, &line, "run.vcd", signal);
        assert_eq!((run.code, run.stdout.as_str()), (Some(code), ""), "{signal}: {run:?}");
        assert!(run.stderr.contains("error: the run was interrupted at "), "{signal}: {run:?}");
        assert!(Waveform::read(&folder.path("run.vcd")).times.len() > 100);
        assert_eq!(folder.names(), ["run.vcd"]);
    }
}

#[test]
fn an_interrupted_turn_leaves_the_frames_that_were_shown() {
    let folder = Folder::new();
    let line = "render teapot --size 64x48 --processors 2 --refresh 3000 --frames 1000 -o turn.png";
    let mut child = start(&folder, line);
    while !folder.path("turn-0002.png").exists() {
        assert!(child.try_wait().unwrap().is_none(), "it ended before it could be interrupted");
        sleep(Duration::from_millis(5));
    }
    send(&child, "INT");
    let run = Run::of(child.wait_with_output().unwrap());
    assert_eq!((run.code, run.stdout.as_str()), (Some(130), ""), "{run:?}");
    assert!(run.stderr.contains("error: the run was interrupted at "), "{run:?}");
    let names = folder.names();
    assert_eq!(names[..2], ["turn-0001.png", "turn-0002.png"]);
    assert!(names.len() < 1000);
    for name in names {
        Frame::read_png(folder.path(&name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_run_below_nohup_goes_on_when_the_terminal_goes_away() {
    handle_signals();
    let folder = Folder::new();
    let mut shell = Command::new("sh");
    let line = format!("trap '' HUP; exec {} {LONG}", crate::cli::harness::PROGRAM);
    shell.args(["-c", &line]).current_dir(folder.path(".")).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = shell.spawn().unwrap();
    await_waveform(&folder, &mut child, "long.vcd");
    send(&child, "HUP");
    sleep(Duration::from_millis(300));
    assert!(child.try_wait().unwrap().is_none(), "SIGHUP was to be ignored");
    send(&child, "TERM");
    assert_eq!(child.wait_with_output().unwrap().status.code(), Some(143));
}

/// The tests pass below `nohup`, and in the background of a shell.
#[test]
fn what_is_ignored_here_is_not_ignored_by_what_is_started() {
    let test = "cli::interruption::an_interrupted_scenario_leaves_a_waveform_that_opens";
    let tests = std::env::current_exe().unwrap();
    let line = format!("trap '' HUP INT TERM; exec '{}' --exact {test}", tests.display());
    let run = Run::of(Command::new("sh").args(["-c", &line]).output().unwrap());
    assert!(run.code == Some(0) && run.stdout.contains("1 passed"), "{run:?}");
}

#[test]
fn two_runs_do_not_write_one_waveform() {
    let folder = Folder::new();
    let mut first = start(&folder, LONG);
    await_waveform(&folder, &mut first, "long.vcd");
    std::fs::hard_link(folder.path("long.vcd"), folder.path("again.vcd")).unwrap();
    for line in ["wave merging-unit -o again.vcd", "render teapot --size 16x12 --vcd long.vcd"] {
        let run = folder.run(line);
        assert_eq!((run.code, run.stdout.as_str()), (Some(3), ""), "{line}: {run:?}");
        assert!(run.stderr.contains(".vcd: another run is writing it: wait until it ends"), "{line}: {run:?}");
    }
    send(&first, "INT");
    assert_eq!(first.wait_with_output().unwrap().status.code(), Some(130));
    assert!(Waveform::read(&folder.path("long.vcd")).times.len() > 1000);
    // The file is free again.
    folder.stdout("wave merging-unit -o long.vcd");
    assert!(Waveform::read(&folder.path("again.vcd")).times.len() < 100);
}

#[test]
fn a_golden_image_can_be_interrupted() {
    let triangles = "f 1 2 3\n".repeat(20_000);
    let folder = Folder::with(&[
        ("s.obj", &format!("v -50 -50 0\nv 50 -50 0\nv 0 80 0\n{triangles}")),
        ("s.toml", "mesh = \"s.obj\"\nsize = [1024, 1024]\n[camera]\neye = [0, 0, 10]\ntarget = [0, 0, 0]\n"),
    ]);
    let names = folder.names();
    for line in ["golden s.toml -o x.png", "golden s.toml --deferred -o x.png", "render s.toml -o x.png --vcd x.vcd"] {
        let (run, took) = stopped_after(&folder, line, Duration::from_secs(1));
        assert_eq!((run.code, run.stdout.as_str()), (Some(130), ""), "{line}: {run:?}");
        assert_eq!(run.stderr, "error: interrupted while the golden image was drawn\n", "{line}");
        assert!(took < SOON, "{line}: {took:?}");
        assert_eq!(folder.names(), names, "{line}");
    }
}

#[test]
fn an_interrupted_comparison_leaves_no_picture() {
    let folder = Folder::new();
    let (run, took) =
        stopped_after(&folder, "compare ter250 --size 1024x768 --machine quadtree -o x.png", Duration::from_secs(4));
    assert_eq!((run.code, run.stdout.as_str()), (Some(130), ""), "{run:?}");
    assert!(run.stderr.contains("interrupted"), "{run:?}");
    assert!(took < SOON, "{took:?}");
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}

#[test]
fn an_interrupted_report_leaves_no_file() {
    for paper in ["quadtree", "pixel-planes-5", "all"] {
        let folder = Folder::new();
        let line = format!("reproduce {paper} -o report");
        let (run, took) = stopped_after(&folder, &line, Duration::from_secs(1));
        assert_eq!((run.code, run.stdout.as_str()), (Some(130), ""), "{run:?}");
        assert_eq!(run.stderr, "error: interrupted while the machine was measured\n");
        assert!(took < SOON, "{paper}: {took:?}");
        assert_eq!(std::fs::read_dir(folder.path("report")).map_or(0, Iterator::count), 0);
    }
}

#[test]
fn what_does_not_look_is_ended_soon() {
    let (run, took) = stopped_after(&Folder::new(), "bench qt4096*64", Duration::from_secs(1));
    assert_eq!((run.code, run.stdout.as_str()), (Some(130), ""), "{run:?}");
    assert!(run.stderr.contains("interrupted") && run.stderr.lines().count() == 1, "{run:?}");
    assert!(took < SOON, "{took:?}");
}
