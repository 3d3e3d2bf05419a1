//! The test picture, by what its four serial pins send.

use crate::board::seen;
use crate::pins;
use tilewright_blocks::{Scan, VideoTiming};
use tilewright_boards::TestPictureOnUlx3s;
use tilewright_boards::receiver::{Seen, beginnings, frames, received};

/// Runs of equal parts: each with its length.
fn runs<T: PartialEq>(all: impl IntoIterator<Item = T>) -> Vec<(T, usize)> {
    let mut runs: Vec<(T, usize)> = Vec::new();
    for part in all {
        match runs.last_mut() {
            Some((last, count)) if *last == part => *count += 1,
            _ => runs.push((part, 1)),
        }
    }
    runs
}

/// A part of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    Visible,
    Porch,
    Pulse,
}

/// The horizontal parts; both pulses are low.
fn across(seen: &[Seen]) -> Vec<(Part, usize)> {
    runs(seen.iter().map(|it| match it {
        Seen::Pixel(_) => Part::Visible,
        Seen::Blank { hsync: true, .. } => Part::Porch,
        Seen::Blank { hsync: false, .. } => Part::Pulse,
    }))
}

fn is_in_vsync(seen: &Seen) -> bool {
    matches!(seen, Seen::Blank { vsync: false, .. })
}

/// What the picture is meant to be.
fn expected(x: usize, y: usize, frame: usize) -> [u8; 3] {
    let is_white = (x / 32 + y / 32) % 2 == 1;
    let bar = (x + frame) / 64;
    let full = |bit: usize| if bar >> bit & 1 == 1 { 255 } else { 0 };
    if is_white { [full(0), full(1), full(2)] } else { [(x % 256) as u8, (y % 256) as u8, 128] }
}

const COLUMNS: usize = 72;
const ROWS: usize = 40;
/// A line and a frame of the small screen.
const LINE: usize = COLUMNS + 3 + 5 + 4;
const FRAME: usize = LINE * (ROWS + 2 + 2 + 3);

#[test]
fn a_receiver_sees_the_picture_pixel_for_pixel() {
    let columns = Scan::new(COLUMNS as u32, [3, 5, 4], false);
    let timing = VideoTiming { columns, rows: Scan::new(ROWS as u32, [2, 2, 3], false) };
    let seen = seen(&TestPictureOnUlx3s { timing }, 5 * (3 * FRAME + LINE));
    let begins = beginnings(&seen);
    let of_vsync: Vec<usize> =
        runs(seen.iter().map(is_in_vsync)).into_iter().filter(|run| run.0).map(|run| run.1).collect();
    assert_eq!((begins[1] - begins[0], of_vsync[0]), (FRAME, 2 * LINE));
    // The first frame that is whole is number 1.
    let frames = frames(&seen);
    assert_eq!(frames.len(), 2);
    for (frame, number) in frames.iter().zip(1..) {
        let wanted = (0..ROWS).map(|y| (0..COLUMNS).map(|x| expected(x, y, number)).collect::<Vec<_>>());
        assert!(frame.iter().eq(&wanted.collect::<Vec<_>>()), "frame {number}");
    }
    // Lines 40 to 46 show nothing, and the pulse of the frame begins with one of a line, 2 lines behind the last visible.
    let ends = |at: usize| seen[..at].iter().rposition(|it| matches!(it, Seen::Pixel(_))).unwrap();
    let vsync = begins[1] - 2 * LINE;
    assert!(is_in_vsync(&seen[vsync]) && matches!(seen[vsync], Seen::Blank { hsync: false, .. }));
    assert_eq!(vsync - ends(vsync), 2 * LINE + 3 + 1);
}

/// VESA's numbers of 640 x 480 at 60 Hz: front porch 16, pulse 96, back porch 48, both pulses low.
fn has_lines_of_vga(seen: &[Seen]) {
    let parts = across(seen);
    let first = parts.iter().position(|(part, _)| *part == Part::Pulse).unwrap();
    let line = [(Part::Pulse, 96), (Part::Porch, 48), (Part::Visible, 640), (Part::Porch, 16)];
    assert_eq!(parts[first..][..8], [line, line].concat());
    let visible = seen.split(|it| matches!(it, Seen::Blank { .. })).filter(|line| !line.is_empty());
    for (y, line) in visible.enumerate().skip(1).take(2) {
        let wanted = (0..640).map(|x| Seen::Pixel(expected(x, y, 0)));
        assert!(line.iter().copied().eq(wanted), "line {y}");
    }
}

const VGA: TestPictureOnUlx3s = TestPictureOnUlx3s { timing: VideoTiming::VGA };

#[test]
fn the_lines_have_the_parts_of_vga() {
    has_lines_of_vga(&seen(&VGA, 5 * 800 * 4));
}

#[test]
fn the_verilog_without_models_sends_the_same_at_both_edges() {
    if let Some(lines) = pins::of_verilog(&VGA, 4 * 800 * 10) {
        has_lines_of_vga(&received(&lines).unwrap());
    }
}

#[test]
fn the_netlist_of_yosys_sends_the_same() {
    if let Some(lines) = pins::of_netlist(&VGA, 4 * 800 * 10) {
        has_lines_of_vga(&received(&lines).unwrap());
    }
}
