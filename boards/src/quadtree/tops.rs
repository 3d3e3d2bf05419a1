//! The machine on boards.

use tilewright_blocks::VideoTiming;
use tilewright_hdl::{Clock, Module, block, def};
use tilewright_rtl::parameter::{ParameterError, Screen as Pixels};
use tilewright_rtl::quadtree::coverage_test::Test;
use tilewright_rtl::quadtree::format::{Format, Matrix};
use tilewright_rtl::quadtree::generator::QuadtreeGenerator;
use tilewright_rtl::quadtree::precision::Precision;
use tilewright_rtl::quadtree::processor::{Queues, VideoProcessor};
use tilewright_rtl::quadtree::raster::Form;

use super::compact::{CompactGenerator, Lanes};
use super::picture::{Machine, QuadtreePicture};
use super::scenes::{cube, teapot};
use super::store::Store;
use super::turning::{Step, Turning};
use crate::icebreaker::{self, Pmod};
use crate::screen::Screen;
use crate::ulx3s::{self, SlowPll, Socket, at_rest};

/// A machine for a board, with what it draws.
#[derive(Debug, Clone)]
pub struct OnBoard {
    /// The machine as a picture.
    pub picture: QuadtreePicture,
    /// What it draws in each step.
    pub steps: Vec<Step>,
}

/// How a board shows its machine.
struct Shown {
    refreshes: u32,
    scale: u32,
    clock: Clock,
}

impl Shown {
    fn on_board(self, machine: Machine, format: &Format, turning: &Turning, steps: Vec<Step>) -> OnBoard {
        let Shown { refreshes, scale, clock } = self;
        let blank = tilewright_scenes::frame::blank(turning.scene.background);
        let background = format.precision().stored(blank) & ((1 << (3 * format.precision().colour)) - 1);
        let picture = QuadtreePicture { machine, background, refreshes, scale, clock: Some(clock) };
        OnBoard { picture, steps }
    }
}

/// The machine for a ULX3S: a matrix of compact video processors, 2 or more along each side, with words of 18 bits. Its
/// scene is as large as the machine's memory allows.
///
/// # Errors
///
/// The scene does not fit the machine's numbers.
pub fn for_ulx3s(matrix: Matrix, pixels: Pixels, turning: &Turning) -> Result<OnBoard, ParameterError> {
    // A multiplier has 18 bits.
    let precision = Precision { position: 9, slope: 14, edge: 23, plane: 18, depth: 9, colour: 3 };
    let format = Format::new(pixels, matrix, 3)?.with_precision(precision)?;
    let steps = turning.set_up(&format)?;
    let machine = Machine::Compact(CompactGenerator { format }, Lanes::new(format, &steps));
    Ok(Shown { refreshes: 8, scale: 1, clock: ulx3s::SLOW }.on_board(machine, &format, turning, steps))
}

/// The machine for an iCEBreaker: one video processor, with words of 16 bits in single-port memories.
///
/// # Errors
///
/// The scene does not fit the machine's numbers.
pub fn for_icebreaker(pixels: Pixels, turning: &Turning) -> Result<OnBoard, ParameterError> {
    let precision = Precision { position: 8, slope: 12, edge: 20, plane: 16, depth: 7, colour: 3 };
    let format = Format::new(pixels, Matrix::new(1, 1)?, 3)?.with_precision(precision)?.with_spram()?;
    let queues = Queues { broadcast: 1, packets: 1, windows: 1 };
    let video_processor = VideoProcessor { format, form: Form::parse("stack", &format)?, test: Test::Serial, queues };
    let steps = turning.set_up(&format)?;
    let machine = Machine::Paper(QuadtreeGenerator { video_processor }, Store::new(format, &steps, 64));
    Ok(Shown { refreshes: 8, scale: 2, clock: icebreaker::MACHINE }.on_board(machine, &format, turning, steps))
}

/// The machine and the scene of the ULX3S: 4 x 4 video processors, and the teapot at 320 x 240 pixels.
///
/// # Errors
///
/// As [`for_ulx3s`].
pub fn quadtree_on_ulx3s() -> Result<OnBoard, ParameterError> {
    for_ulx3s(Matrix::new(4, 4)?, Pixels { width: 320, height: 240 }, &teapot())
}

/// The machine and the scene of the iCEBreaker: a cube at 160 x 120 pixels.
///
/// # Errors
///
/// As [`for_icebreaker`].
pub fn quadtree_on_icebreaker() -> Result<OnBoard, ParameterError> {
    for_icebreaker(Pixels { width: 160, height: 120 }, &cube(24))
}

block! {
    /// The machine on a ULX3S.
    pub struct QuadtreeOnUlx3s {
        /// The machine as a picture.
        pub picture: QuadtreePicture,
        /// The timing of the screen: [`VideoTiming::VGA`] on the board, others in tests.
        pub timing: VideoTiming,
    }
    name = "quadtree";
    out = Socket;
}

impl QuadtreeOnUlx3s {
    /// The machine of the board.
    ///
    /// # Errors
    ///
    /// As [`for_ulx3s`].
    pub fn full() -> Result<QuadtreeOnUlx3s, ParameterError> {
        Ok(QuadtreeOnUlx3s { picture: quadtree_on_ulx3s()?.picture, timing: VideoTiming::VGA })
    }

    fn build(&self, m: Module, (): ()) -> Socket {
        def!(slow_pll = m.instance(&SlowPll, at_rest()));
        let screen = Screen { picture: self.picture.clone(), timing: self.timing.clone(), double: false };
        ulx3s::show(m, &screen, &[slow_pll.lock])
    }
}

block! {
    /// The machine on an iCEBreaker.
    pub struct QuadtreeOnIcebreaker {
        /// The machine as a picture.
        pub picture: QuadtreePicture,
        /// The timing of the screen: [`VideoTiming::VGA`] on the board, others in tests.
        pub timing: VideoTiming,
    }
    name = "quadtree";
    out = Pmod;
}

impl QuadtreeOnIcebreaker {
    /// The machine of the board.
    ///
    /// # Errors
    ///
    /// As [`for_icebreaker`].
    pub fn full() -> Result<QuadtreeOnIcebreaker, ParameterError> {
        Ok(QuadtreeOnIcebreaker { picture: quadtree_on_icebreaker()?.picture, timing: VideoTiming::VGA })
    }

    fn build(&self, m: Module, (): ()) -> Pmod {
        icebreaker::show(m, &Screen { picture: self.picture.clone(), timing: self.timing.clone(), double: false })
    }
}
