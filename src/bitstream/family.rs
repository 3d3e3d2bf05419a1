//! What the tools of a family of FPGAs are called, and what they take.

use crate::synth::device;
use tilewright_boards::Device;

/// The tools behind Yosys and nextpnr, and their files.
pub struct Family {
    /// As `synth` knows the FPGA.
    pub device: device::Device,
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

/// The family of an FPGA.
pub fn family(device: Device) -> Family {
    match device {
        Device::Ecp5Large => Family {
            device: device::Device::Ecp5Large,
            library: "+/ecp5/cells_sim.v +/ecp5/cells_bb.v",
            constraints: "--lpf",
            configuration: "--textcfg",
            packer: "ecppack",
            options: &["--compress"],
            ending: "bit",
        },
        Device::Ice40Up => Family {
            device: device::Device::Ice40Up,
            library: "+/ice40/cells_sim.v",
            constraints: "--pcf",
            configuration: "--asc",
            packer: "icepack",
            options: &[],
            ending: "bin",
        },
    }
}
