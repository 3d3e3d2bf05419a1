//! The FPGAs that can be asked for, and what is counted of each.

use clap::ValueEnum;
use tilewright_gen::tools;

/// A device.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Device {
    /// Lattice LFE5U-85F
    #[value(name = "ecp5-85k")]
    Ecp5Large,
    /// Lattice LFE5U-25F
    #[value(name = "ecp5-25k")]
    Ecp5Small,
    /// Lattice iCE40 UP5K
    #[value(name = "ice40-up5k")]
    Ice40Up,
    /// Lattice iCE40 HX8K
    #[value(name = "ice40-hx8k")]
    Ice40Hx,
    /// Gowin GW2AR-18, as on the Tang Nano 20K
    #[value(name = "gowin")]
    Gowin,
}

/// The flip-flop that is put at a port, and the names of its pins.
pub struct FlipFlop {
    pub cell: &'static str,
    pub clock: &'static str,
    pub data: &'static str,
    pub output: &'static str,
    pub parameters: &'static [(&'static str, &'static str)],
}

/// Something that is counted.
pub struct Counted {
    /// What it is called in the table.
    pub name: &'static str,
    pub how: How,
    /// The rows of nextpnr whose units are available.
    pub available: &'static str,
}

/// How the used ones are counted.
pub enum How {
    /// The sum of these rows of nextpnr's utilisation.
    Rows(&'static [&'static str]),
    /// The cells of the netlist whose type begins so; nextpnr's rows also have the flip-flops at the ports.
    Cells(&'static str),
}

use How::{Cells, Rows};

const fn counted(name: &'static str, how: How, available: &'static str) -> Counted {
    Counted { name, how, available }
}

const ECP5: &[Counted] = &[
    counted("LUTs", Rows(&["TRELLIS_COMB"]), "TRELLIS_COMB"),
    counted("LUT RAMs", Rows(&["TRELLIS_RAMW"]), "TRELLIS_RAMW"),
    counted("flip-flops", Cells("TRELLIS_FF"), "TRELLIS_FF"),
    counted("block RAMs", Rows(&["DP16KD"]), "DP16KD"),
    counted("DSPs", Rows(&["MULT18X18D"]), "MULT18X18D"),
];

const ICE40_HX: &[Counted] = &[
    counted("LUTs", Cells("SB_LUT4"), "ICESTORM_LC"),
    counted("flip-flops", Cells("SB_DFF"), "ICESTORM_LC"),
    counted("block RAMs", Rows(&["ICESTORM_RAM"]), "ICESTORM_RAM"),
];

const ICE40_UP: &[Counted] = &[
    counted("LUTs", Cells("SB_LUT4"), "ICESTORM_LC"),
    counted("flip-flops", Cells("SB_DFF"), "ICESTORM_LC"),
    counted("block RAMs", Rows(&["ICESTORM_RAM"]), "ICESTORM_RAM"),
    counted("large RAMs", Rows(&["ICESTORM_SPRAM"]), "ICESTORM_SPRAM"),
    counted("DSPs", Rows(&["ICESTORM_DSP"]), "ICESTORM_DSP"),
];

const GOWIN: &[Counted] = &[
    counted("LUTs", Rows(&["LUT4", "ALU"]), "LUT4"),
    counted("LUT RAMs", Rows(&["RAM16SDP4"]), "RAM16SDP4"),
    counted("flip-flops", Cells("DFF"), "DFF"),
    counted("block RAMs", Rows(&["BSRAM"]), "BSRAM"),
    counted("DSPs", Rows(&["MULT18X18"]), "MULT18X18"),
];

impl Device {
    /// As the tools know it.
    pub fn chip(self) -> tools::Device {
        match self {
            Device::Ecp5Large => tools::Device::LFE5U_85F,
            Device::Ecp5Small => tools::Device::LFE5U_25F,
            Device::Ice40Up => tools::Device::UP5K,
            Device::Ice40Hx => tools::Device::HX8K,
            Device::Gowin => tools::Device::GW2AR_18,
        }
    }

    pub fn name(self) -> String {
        self.to_possible_value().map_or_else(String::new, |it| it.get_name().to_owned())
    }

    pub fn counted(self) -> &'static [Counted] {
        match self {
            Device::Ecp5Large | Device::Ecp5Small => ECP5,
            Device::Ice40Up => ICE40_UP,
            Device::Ice40Hx => ICE40_HX,
            Device::Gowin => GOWIN,
        }
    }

    pub fn flip_flop(self) -> &'static FlipFlop {
        match self {
            // A blank behind digits tells them from a number in Yosys's format.
            Device::Ecp5Large | Device::Ecp5Small => &FlipFlop {
                cell: "TRELLIS_FF",
                clock: "CLK",
                data: "DI",
                output: "Q",
                parameters: &[
                    ("CEMUX", "1 "),
                    ("CLKMUX", "CLK"),
                    ("GSR", "DISABLED"),
                    ("LSRMUX", "LSR"),
                    ("REGSET", "RESET"),
                ],
            },
            Device::Ice40Up | Device::Ice40Hx => {
                &FlipFlop { cell: "SB_DFF", clock: "C", data: "D", output: "Q", parameters: &[] }
            }
            Device::Gowin => &FlipFlop { cell: "DFF", clock: "CLK", data: "D", output: "Q", parameters: &[] },
        }
    }
}
