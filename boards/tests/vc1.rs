//! The VC-1 on a ULX3S, by what its pins send.

use crate::board::{Board, seen};
use crate::pins;
use tilewright_blocks::{Scan, VideoTiming};
use tilewright_boards::receiver::{Frame, frames, received};
use tilewright_boards::vc1::{Turning, Vc1OnUlx3s, Vc1Picture, as_shown};
use tilewright_rtl::lfb::{LfbUnit, Patches};
use tilewright_rtl::parameter::Screen;

/// A step of the scene as the screen shows it: each pixel four times.
fn wanted(scene: &Turning, step: usize) -> Frame {
    let golden = scene.golden(step);
    let (width, height) = (golden.size().width(), golden.size().height());
    let row = |y: u32| (0..2 * width).map(|x| as_shown(golden.rgb(x / 2, y / 2))).collect();
    (0..2 * height).map(row).collect()
}

/// A machine that a simulation of several frames takes little time for.
fn small([width, height]: [u32; 2], steps: u32) -> Vc1OnUlx3s {
    let screen = Screen { width, height };
    let patches = Patches::new(screen, 4).unwrap();
    let scene = Turning::star([width, height], steps, 2, 0.9).unwrap();
    let pages = scene.pages(&patches) as u32;
    let [columns, rows] = [Scan::new(2 * width, [8, 8, 8], false), Scan::new(2 * height, [2, 2, 26], false)];
    let timing = VideoTiming { columns, rows };
    Vc1OnUlx3s { picture: Vc1Picture { lfb: LfbUnit { patches, pages }, processors: 2, scene }, timing }
}

/// The steps of the scene that the frames show; `None` for a frame that shows none.
fn steps(scene: &Turning, frames: &[Frame]) -> Vec<Option<usize>> {
    let of_step: Vec<Frame> = (0..scene.steps()).map(|step| wanted(scene, step)).collect();
    frames.iter().map(|frame| of_step.iter().position(|wanted| wanted == frame)).collect()
}

#[test]
fn a_receiver_sees_the_golden_frames_one_after_the_other() {
    let top = small([48, 36], 3);
    let VideoTiming { columns, rows } = &top.timing;
    let refresh = 5 * (columns.total() * rows.total()) as usize;
    let frames = frames(&seen(&top, 5 * refresh));
    let scene = &top.picture.scene;
    assert_ne!(wanted(scene, 0), wanted(scene, 1));
    assert_eq!(steps(scene, &frames), [0, 1, 2, 0].map(Some));
}

/// The machine of the board: two refreshes, of which the second one shows the first step.
#[test]
fn the_board_shows_the_golden_frame() {
    let top = Vc1OnUlx3s::full().unwrap();
    let scene = &top.picture.scene;
    assert!(scene.pages(&top.picture.lfb.patches) <= 128);
    let (line, refresh) = (5 * 800, 5 * 800 * 525);
    let mut board = Board::new(&top);
    // The first refresh ends with the pulse of frames and its back porch.
    board.skip(refresh - 40 * line);
    board.receive(refresh + 10 * line);
    let frames = frames(&received(&board.lines).unwrap());
    assert_eq!(steps(scene, &frames), [Some(0)]);
}

/// Yosys and Icarus take 34 seconds of a processor: `cargo test -p tilewright-boards --test all netlist -- --ignored`.
#[test]
#[ignore = "takes 34 seconds"]
fn the_netlist_of_a_small_machine_shows_the_golden_frame() {
    let top = small([40, 28], 2);
    let VideoTiming { columns, rows } = &top.timing;
    let refresh = 10 * (columns.total() * rows.total()) as usize;
    if let Some(lines) = pins::of_netlist(&top, 2 * refresh + refresh / 4) {
        let frames = frames(&received(&lines).unwrap());
        assert_eq!(steps(&top.picture.scene, &frames), [Some(0)]);
    }
}
