//! What the tools of a family of FPGAs are called, and what they take.

use tilewright_gen::tools::Target;

/// The tools behind Yosys and nextpnr, and their files.
pub struct Family {
    /// Yosys's models of the cells.
    pub library: &'static str,
    /// nextpnr's option for the constraints.
    pub constraints: &'static str,
    /// nextpnr's option for the configuration in text.
    pub configuration: &'static str,
    pub packer: &'static str,
    /// The packer's options.
    pub options: &'static [&'static str],
    /// The ending of a bitstream's name.
    pub ending: &'static str,
}

/// The family. No machine is there for one of the others.
pub fn family(target: Target) -> Family {
    match target {
        Target::Ecp5 => Family {
            library: "+/ecp5/cells_sim.v +/ecp5/cells_bb.v",
            constraints: "--lpf",
            configuration: "--textcfg",
            packer: "ecppack",
            options: &["--compress"],
            ending: "bit",
        },
        Target::Ice40 => Family {
            library: "+/ice40/cells_sim.v",
            constraints: "--pcf",
            configuration: "--asc",
            packer: "icepack",
            options: &[],
            ending: "bin",
        },
        Target::Xilinx | Target::Gowin => unreachable!("no board has one"),
    }
}
