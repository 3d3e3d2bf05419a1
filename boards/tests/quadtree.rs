//! The quadtree generator on boards, by what the pins send.

use crate::board::{Board, seen, seen_of_pmod};
use crate::pins;
use tilewright_blocks::{Scan, VideoTiming};
use tilewright_boards::quadtree::{
    OnBoard, QuadtreeOnIcebreaker, QuadtreeOnUlx3s, Step, Walk, cube, for_icebreaker, for_ulx3s,
    quadtree_on_icebreaker, quadtree_on_ulx3s, shown,
};
use tilewright_boards::receiver::{Frame, frames, received};
use tilewright_rtl::parameter::Screen;
use tilewright_rtl::quadtree::format::Matrix;
use tilewright_sim::Simulation;

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

/// A small machine for a ULX3S with that matrix and picture, and what it draws.
fn small_ulx3s([columns, rows]: [u32; 2], [width, height]: [u32; 2]) -> (QuadtreeOnUlx3s, Vec<Step>) {
    let matrix = Matrix::new(columns, rows).unwrap();
    let OnBoard { mut picture, steps } = for_ulx3s(matrix, Screen { width, height }, &cube(5)).unwrap();
    picture.refreshes = 2;
    (QuadtreeOnUlx3s { picture, timing: small(2 * width, 2 * height) }, steps)
}

/// Three steps or more are shown, each twice.
fn golden_steps(frames: Vec<Frame>, steps: &[Step]) {
    let runs = steps_shown(frames);
    assert!(runs.len() >= 3, "{}", runs.len());
    for (number, (frame, count)) in runs.iter().enumerate() {
        assert!(*frame == on_screen(&steps[number], 2, 3), "step {number}");
        assert!(*count == 2 || number + 1 == runs.len(), "step {number} is shown {count} times");
    }
}

#[test]
fn a_ulx3s_shows_the_golden_pictures_of_a_turning_scene() {
    let (top, steps) = small_ulx3s([4, 4], [32, 24]);
    golden_steps(frames(&seen(&top, 5 * 8 * clocks(64, 48))), &steps);
}

/// Banks of 108 words are block RAMs, as those of the board are. Each of the two is shown.
#[test]
fn the_netlist_of_a_small_ulx3s_shows_the_golden_pictures_too() {
    let (top, steps) = small_ulx3s([2, 2], [24, 18]);
    if let Some(lines) = pins::of_netlist(&top, 10 * 6 * clocks(48, 36)) {
        let runs = steps_shown(frames(&received(&lines).unwrap()));
        let [first, second] = [0, 1].map(|step| on_screen(&steps[step], 2, 3));
        assert!(runs == [(first, 2), (second, 1)]);
    }
}

/// The windows of a quadtree of three levels that are visited if these pass.
fn visited(window: [u64; 3], passes: fn([u64; 3]) -> bool) -> Vec<[u64; 3]> {
    let [x, y, side] = window;
    let quarters = [[x, y], [x + side / 2, y], [x, y + side / 2], [x + side / 2, y + side / 2]];
    let below = quarters.into_iter().flat_map(|[x, y]| match passes(window) && side > 1 {
        true => visited([x, y, side / 2], passes),
        false => Vec::new(),
    });
    std::iter::once(window).chain(below).collect()
}

#[test]
fn a_walk_visits_windows_as_a_recursion_does() {
    let conditions: [fn([u64; 3]) -> bool; 4] =
        [|_| true, |_| false, |[x, y, _]| x + y < 5, |[x, y, side]| x + side > 5 && y <= 4];
    let mut sim = Simulation::of(&Walk { levels: 3 }).unwrap();
    sim.reset();
    let o = sim.o;
    // Each walk begins where the previous one has ended.
    for passes in conditions {
        let mut seen = Vec::new();
        while sim.get_u64(o.ends) == 0 {
            let [left, top, right, bottom] = [o.left, o.top, o.right, o.bottom].map(|bound| sim.get_u64(bound));
            let window = [left, top, right - left + 1];
            let visits = sim.get_u64(o.visits) == 1;
            if visits {
                assert_eq!(bottom - top, right - left);
                assert_eq!(sim.get_u64(o.is_leaf) == 1, left == right);
                seen.push(window);
            }
            sim.set(sim.i.passes, u64::from(visits && passes(window)));
            sim.set(sim.i.fails, u64::from(visits && !passes(window)));
            sim.step();
            sim.set(sim.i.passes, 0);
            sim.set(sim.i.fails, 0);
        }
        assert_eq!(seen, visited([0, 0, 8], passes));
        sim.step();
    }
}

/// What a PMOD takes of it: the upper four bits of each channel.
fn upper(frame: Frame) -> Frame {
    frame.into_iter().map(|row| row.into_iter().map(|colour| colour.map(|channel| channel & 0xf0)).collect()).collect()
}

/// A small machine for an iCEBreaker, and what it draws.
fn small_icebreaker() -> (QuadtreeOnIcebreaker, Vec<Step>) {
    let OnBoard { mut picture, steps } = for_icebreaker(Screen { width: 40, height: 24 }, &cube(5)).unwrap();
    picture.refreshes = 2;
    (QuadtreeOnIcebreaker { picture, timing: small(160, 96) }, steps)
}

/// The memories are unknown at the start, so the first frames are noise until both are cleared.
fn golden_after_noise(frames: &[Frame], steps: &[Step]) {
    let wanted = |step: usize| upper(on_screen(&steps[step], 4, 3));
    let begin = frames.iter().position(|frame| *frame == wanted(0)).expect("the first step is shown");
    assert_eq!(frames[..begin].len(), 4);
    for (number, shown) in frames[begin..].chunks(2).enumerate() {
        assert!(shown.iter().all(|frame| *frame == wanted(number)), "step {number}");
    }
}

#[test]
fn an_icebreaker_shows_the_golden_pictures_of_a_turning_scene() {
    let (top, steps) = small_icebreaker();
    golden_after_noise(&frames(&seen_of_pmod(&top, 0, 10 * clocks(160, 96))), &steps);
}

/// Yosys and Verilator take about 20 seconds: `cargo test -p tilewright-boards --test all netlist -- --ignored`.
#[test]
#[ignore = "takes 20 seconds"]
fn the_netlist_of_an_icebreaker_shows_the_golden_pictures_too() {
    let (top, steps) = small_icebreaker();
    if let Some(seen) = pins::of_pmod(&top, 8 * clocks(160, 96)) {
        golden_after_noise(&frames(&seen), &steps);
    }
}

/// The clocks of a line and of a refresh of the boards.
const LINE: usize = 800;
const REFRESH: usize = 525 * LINE;

/// Two refreshes show nothing yet, and the third one the first step.
#[test]
fn the_machine_of_the_ulx3s_shows_a_golden_frame() {
    let OnBoard { mut picture, steps } = quadtree_on_ulx3s().unwrap();
    picture.refreshes = 2;
    let mut board = Board::new(&QuadtreeOnUlx3s { picture, timing: VideoTiming::VGA });
    // The player begins when the first refresh ends.
    board.skip(5 * 481 * LINE);
    let drawing = (1..).find(|_| {
        board.skip(5 * 100);
        board.peek("u_screen.u_picture.drawn") == 1
    });
    let clocks = 100 * drawing.expect("it ends");
    // The machine's clock takes 60 ns, and that of the pixels 40 ns.
    println!("ULX3S: {} packets are drawn in about {} clocks of 60 ns", steps[0].packets.len(), clocks * 2 / 3);
    assert!(clocks < 2 * REFRESH);
    board.skip(5 * (3 * REFRESH - 40 * LINE - 481 * LINE - clocks));
    board.receive(5 * (REFRESH + 10 * LINE));
    let frames = frames(&received(&board.lines).unwrap());
    assert!(frames == [on_screen(&steps[0], 2, 3)]);
}

/// Two more refreshes clear the memories.
#[test]
fn the_machine_of_the_icebreaker_shows_a_golden_frame() {
    let OnBoard { mut picture, steps } = quadtree_on_icebreaker().unwrap();
    picture.refreshes = 2;
    let top = QuadtreeOnIcebreaker { picture, timing: VideoTiming::VGA };
    let frames = frames(&seen_of_pmod(&top, 5 * REFRESH - 40 * LINE, REFRESH + 10 * LINE));
    assert!(frames == [upper(on_screen(&steps[0], 4, 3))]);
}
