//! The quadtree generator on boards, by what the pins send.

use crate::board::{seen, seen_of_pmod};
use tilewright_blocks::{Scan, VideoTiming};
use tilewright_boards::quadtree::{
    OnBoard, QuadtreeOnIcebreaker, QuadtreeOnUlx3s, Step, cube, for_icebreaker, for_ulx3s, shown,
};
use tilewright_boards::receiver::{Frame, frames};
use tilewright_rtl::parameter::Screen;

/// A screen of that size, with short blankings.
fn small(columns: u32, rows: u32) -> VideoTiming {
    VideoTiming { columns: Scan::new(columns, [3, 5, 4], false), rows: Scan::new(rows, [2, 2, 3], false) }
}

/// The clocks of a frame of that screen.
fn clocks(columns: u32, rows: u32) -> usize {
    (columns as usize + 12) * (rows as usize + 7)
}

/// The golden picture as a screen shows it: each pixel takes `scale` columns and rows.
fn on_screen(step: &Step, scale: usize, bits: u32) -> Frame {
    let repeated = |row: &Vec<[u8; 3]>| -> Vec<[u8; 3]> {
        row.iter().flat_map(|colour| std::iter::repeat_n(colour.map(|channel| shown(channel, bits)), scale)).collect()
    };
    step.golden_rows().iter().flat_map(|row| std::iter::repeat_n(repeated(row), scale)).collect()
}

/// The frames as runs of equal ones, without the whole ones before the first step.
fn steps_shown(frames: Vec<Frame>) -> Vec<(Frame, usize)> {
    let mut runs: Vec<(Frame, usize)> = Vec::new();
    for frame in frames {
        match runs.last_mut() {
            Some((last, count)) if *last == frame => *count += 1,
            _ => runs.push((frame, 1)),
        }
    }
    runs.split_off(1)
}

#[test]
fn a_ulx3s_shows_the_golden_pictures_of_a_turning_scene() {
    let OnBoard { mut picture, steps } = for_ulx3s(Screen { width: 32, height: 24 }, &cube(5)).unwrap();
    picture.refreshes = 2;
    let top = QuadtreeOnUlx3s { picture, timing: small(64, 48) };
    let frames = frames(&seen(&top, 5 * 8 * clocks(64, 48)));
    let runs = steps_shown(frames);
    assert!(runs.len() >= 3, "{}", runs.len());
    for (number, (frame, count)) in runs.iter().enumerate() {
        assert!(*frame == on_screen(&steps[number], 2, 3), "step {number}");
        assert!(*count == 2 || number + 1 == runs.len(), "step {number} is shown {count} times");
    }
}

#[test]
fn an_icebreaker_shows_the_golden_pictures_of_a_turning_scene() {
    let OnBoard { mut picture, steps } = for_icebreaker(Screen { width: 40, height: 24 }, &cube(5)).unwrap();
    picture.refreshes = 2;
    let top = QuadtreeOnIcebreaker { picture, timing: small(160, 96) };
    let frames = frames(&seen_of_pmod(&top, 10 * clocks(160, 96)));
    // The PMOD takes the upper four bits.
    let upper = |step: &Step| {
        on_screen(step, 4, 3)
            .into_iter()
            .map(|row| row.into_iter().map(|it| it.map(|c| c & 0xf0)).collect())
            .collect::<Frame>()
    };
    // The memories are unknown at the start, so the first frames are noise until both are cleared.
    let begin = frames.iter().position(|frame| *frame == upper(&steps[0])).expect("the first step is shown");
    let shown = [&frames[begin], &frames[begin + 2], &frames[begin + 4]];
    for (number, frame) in shown.into_iter().enumerate() {
        assert!(*frame == upper(&steps[number]), "step {number}");
    }
}
