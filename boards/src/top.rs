//! The tops, and the boards that they are for.

use crate::icebreaker;
use crate::quadtree::{QuadtreeOnIcebreaker, QuadtreeOnUlx3s};
use crate::test_picture::TestPictureOnUlx3s;
use crate::ulx3s;
use crate::vc1::Vc1OnUlx3s;
use tilewright_blocks::VideoTiming;
use tilewright_gen::tools::Device;
use tilewright_gen::{Dialect, PinProblems, Pins, VerilogFile, constraints, verilog};
use tilewright_hdl::{Design, Problems, elaborate};

/// A machine on a board.
#[derive(Debug, Clone, Copy)]
pub struct Top {
    /// The machine.
    pub name: &'static str,
    /// The board.
    pub board: &'static str,
    /// What is on the screen, in a phrase.
    pub about: &'static str,
    /// The board's FPGA.
    pub device: Device,
    /// The program that loads a bitstream onto the board, with its arguments before the file.
    pub loader: &'static str,
    /// The board's pins, as [`Pins::read`] takes them.
    pub pins: &'static str,
    /// The language of the constraints.
    pub dialect: Dialect,
    /// The circuit.
    pub design: fn() -> Result<Design, Problems>,
}

/// All tops. A machine on another board is one more entry.
pub const TOPS: &[Top] = &[
    Top {
        name: "test-picture",
        board: "ulx3s",
        about: "a chessboard with moving bars",
        device: Device::LFE5U_85F,
        loader: ulx3s::LOADER,
        pins: ulx3s::PINS,
        dialect: Dialect::Lpf,
        design: || elaborate(&TestPictureOnUlx3s { timing: VideoTiming::VGA }),
    },
    Top {
        name: "vc1",
        board: "ulx3s",
        about: "the VC-1 with six local frame buffers, which draws a turning star",
        device: Device::LFE5U_85F,
        loader: ulx3s::LOADER,
        pins: ulx3s::PINS,
        dialect: Dialect::Lpf,
        design: || elaborate(&Vc1OnUlx3s::full().expect("the star is built in")),
    },
    Top {
        name: "quadtree",
        board: "ulx3s",
        about: "the quadtree generator with 4 x 4 video processors, which draws a turning teapot",
        device: Device::LFE5U_85F,
        loader: ulx3s::LOADER,
        pins: ulx3s::PINS,
        dialect: Dialect::Lpf,
        design: || elaborate(&QuadtreeOnUlx3s::full().expect("the teapot is built in")),
    },
    Top {
        name: "quadtree",
        board: "icebreaker",
        about: "the quadtree generator with one video processor, which draws a turning cube",
        device: Device::UP5K,
        loader: icebreaker::LOADER,
        pins: icebreaker::PINS,
        dialect: Dialect::Pcf,
        design: || elaborate(&QuadtreeOnIcebreaker::full().expect("the cube fits")),
    },
];

impl Top {
    /// The top of this name on this board.
    ///
    /// ```
    /// use tilewright_boards::Top;
    ///
    /// assert!(Top::find("test-picture", "ulx3s").is_some());
    /// ```
    pub fn find(name: &str, board: &str) -> Option<&'static Top> {
        TOPS.iter().find(|top| top.name == name && top.board == board)
    }

    /// Verilog and constraints of a top: the files that Yosys and nextpnr read.
    ///
    /// ```
    /// use tilewright_boards::Top;
    ///
    /// let top = Top::find("test-picture", "ulx3s").unwrap();
    /// let files = top.files(&(top.design)()?)?;
    /// assert_eq!(files.last().unwrap().name, "test_picture.lpf");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// A pin does not fit a port.
    pub fn files(&self, design: &Design) -> Result<Vec<VerilogFile>, PinProblems> {
        let mut files = verilog(design);
        files.push(constraints(design, self.dialect, &Pins::read(self.pins)?)?);
        Ok(files)
    }
}
