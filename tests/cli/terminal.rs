//! What reaches a terminal: no control characters out of files, no endless lines, and progress that fits.
#![cfg(unix)]

use crate::cli::harness::Folder;
use tilewright_gen::tools::skipped;

#[test]
fn content_of_files_does_not_steer_the_terminal() {
    let folder = Folder::with(&[
        ("word.obj", "v 0 0 0\nv \u{1b}]0;owned\u{7} 0 0\n"),
        ("key.toml", "mesh = \"teapot\"\n\"\u{85}\\u001b[2J\" = 1\n"),
        ("mesh.toml", "mesh = \"a\\u001b]0;owned\\u0007\\n.obj\"\n"),
        ("material.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl \u{1b}[31m\nf 1 2 3\n"),
    ]);
    for line in
        ["golden word.obj", "golden key.toml", "render mesh.toml", "golden material.obj --size 8x8", "render \u{1b}c"]
    {
        let run = folder.run(&format!("{line} -o x.png"));
        let steers = |c: char| c.is_control() && c != '\n';
        assert!(!run.stderr.contains(steers), "{line}: {run:?}");
        assert!(run.stderr.contains("\\u{1b}"), "{line}: {run:?}");
        assert_eq!(run.stderr.lines().filter(|line| !line.starts_with("wrote")).count(), 1, "{line}: {run:?}");
    }
    let folder = Folder::with(&[("a\u{9b}31m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")]);
    let line = "golden a\u{9b}31m.obj --size 8x8 -o x.png";
    assert!(folder.stdout(line).starts_with("a\\u{9b}31m: 1 polygon, 1 packets"));
    let json = folder.stdout(&format!("{line} --json"));
    assert!(!json.contains('\u{9b}') && json.contains(r#""scene": "a\u009b31m""#), "{json}");
}

#[test]
fn a_long_word_does_not_fill_the_terminal() {
    let folder = Folder::new();
    std::fs::write(folder.path("long.obj"), format!("v 0 0 {}\n", "z".repeat(10_000_000))).unwrap();
    let run = folder.run("golden long.obj -o x.png");
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.len() < 1000, "{} bytes", run.stderr.len());
    assert!(run.stderr.starts_with("error: long.obj:1: `zzz"), "{run:?}");
    let run = folder.run(&format!("wave merging-unit -o x.vcd --scope {}", "z".repeat(100_000)));
    assert!(run.code == Some(2) && run.stderr.len() < 1000, "{} bytes", run.stderr.len());
    assert!(run.stderr.contains("zzz[..]zzz") && run.stderr.ends_with("z`: there are `**`\n"), "{run:?}");
}

/// Whether terminals can be made here.
pub fn has_terminals(folder: &Folder) -> bool {
    let probe = folder.shell("script -qec true typescript");
    if probe.code != Some(0) {
        let _ = skipped(&format!("`script` of util-linux makes no terminal: {}", probe.stderr.trim_end()));
    }
    probe.code == Some(0)
}

/// What a line writes to a terminal of so many columns, or `None` where no terminal can be made.
#[cfg(target_os = "linux")]
fn on_a_terminal(folder: &Folder, columns: u32, line: &str) -> Option<String> {
    if !has_terminals(folder) {
        return None;
    }
    let run = folder.shell(&format!("TERM=xterm script -qec 'stty cols {columns}; tilewright {line}' typescript"));
    assert_eq!(run.code, Some(0), "{line}: {run:?}");
    Some(run.stdout)
}

#[test]
#[cfg(target_os = "linux")]
fn progress_is_a_short_line_that_goes_away() {
    let folder = Folder::new();
    for columns in [80, 20_000] {
        let Some(text) = on_a_terminal(&folder, columns, "render teapot --size 64x48 --processors 1 -o x.png") else {
            return;
        };
        let (before, report) = text.split_once("teapot: VC-1").unwrap();
        for phase in ["golden image", "drawing", "merging", "showing"] {
            assert!(before.contains(phase), "{phase}: {before:?}");
        }
        let drawn: Vec<&str> = before.split('\r').filter(|line| line.contains(" %")).collect();
        assert!(drawn.len() >= 5 && drawn.iter().all(|line| line.len() < 60), "{drawn:?}");
        assert!(before.ends_with("\r\u{1b}[Kwrote x.png\r\n"), "{before:?}");
        assert!(!report.contains('\u{1b}'), "{report:?}");
    }
    let quiet = on_a_terminal(&folder, 80, "render teapot --size 64x48 --processors 1 -o x.png --quiet");
    assert_eq!(quiet.as_deref(), Some(""));
    let text = on_a_terminal(&folder, 80, "golden teapot --size 64x48 -o x.png").unwrap();
    assert!(text.contains("\rgolden image --"), "{text:?}");
}

#[test]
#[cfg(target_os = "linux")]
fn work_that_does_not_know_how_far_it_is_has_a_line_after_a_second() {
    let folder = Folder::with_pyramid();
    // The scene comes late, so that reading it takes long and no work.
    std::fs::rename(folder.path("pyramid.obj"), folder.path("late")).unwrap();
    let late = |line: &str| {
        let made = folder.shell("rm -f pyramid.obj; mkfifo pyramid.obj");
        assert_eq!(made.code, Some(0), "{made:?}");
        on_a_terminal(&folder, 80, &format!("{line} & sleep 1.4; cat late > pyramid.obj; wait $!"))
    };
    let line = "golden pyramid.obj --size 16x12 -o x.png";
    let Some(text) = late(line) else { return };
    assert!(text.starts_with("\rreading      ") && text.contains("s\u{1b}[K\r\u{1b}[Kwrote x.png\r\n"), "{text:?}");
    assert_eq!(late(&format!("{line} --quiet")).as_deref(), Some(""));
    let piped = folder.shell(&format!("(sleep 1.4; cat late > pyramid.obj) & tilewright {line}; wait"));
    assert_eq!((piped.code, piped.stderr.as_str()), (Some(0), "wrote x.png\n"), "no line where there is no terminal");
}
