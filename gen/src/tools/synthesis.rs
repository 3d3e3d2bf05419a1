//! Synthesis by Yosys: the cost of a design on an FPGA.

use super::Problems;
use super::run::{Folder, is_installed, missing, problem, sources, top};
use crate::VerilogFile;
use std::collections::BTreeMap;
use std::process::Command;

/// An FPGA family.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_gen::tools::{Target, cells};
///
/// // A byte of registers, on two families whose flip-flops have different names.
/// let files = tilewright_gen::verilog(&design);
/// for (target, flip_flop) in [(Target::Ice40, "SB_DFF"), (Target::Ecp5, "TRELLIS_FF")] {
///     if let Some(cells) = cells(&files, target).unwrap() {
///         assert_eq!(cells[flip_flop], 8);
///     }
/// }
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// Lattice iCE40.
    Ice40,
    /// Lattice ECP5.
    Ecp5,
    /// Xilinx 7 series.
    Xilinx,
    /// Gowin.
    Gowin,
}

impl Target {
    pub(super) fn pass(self) -> &'static str {
        match self {
            Target::Ice40 => "synth_ice40",
            Target::Ecp5 => "synth_ecp5",
            Target::Xilinx => "synth_xilinx",
            Target::Gowin => "synth_gowin",
        }
    }
}

/// The cells of the whole design on that family, by type; `None` if Yosys is not installed.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_gen::tools::{Target, cells};
///
/// let files = tilewright_gen::verilog(&design);
/// if let Some(cells) = cells(&files, Target::Ice40).unwrap() {
///     assert_eq!(cells.get("SB_LUT4"), None); // there is no logic
/// }
/// ```
///
/// # Errors
///
/// The output of Yosys, if it failed.
pub fn cells(files: &[VerilogFile], target: Target) -> Result<Option<BTreeMap<String, u64>>, Problems> {
    if !is_installed("yosys") {
        let _ = missing("yosys");
        return Ok(None);
    }
    let folder = Folder::with(files);
    let (sources, top, pass) = (sources(files).join(" "), top(files), target.pass());
    let script = format!("read_verilog {sources}; {pass} -top {top} -flatten; tee -o stat.txt stat");
    let (succeeded, output) = folder.run(Command::new("yosys").args(["-q", "-p", &script]));
    let stat = std::fs::read_to_string(folder.path().join("stat.txt")).unwrap_or_default();
    if !succeeded {
        return Err(problem("yosys", output));
    }
    let cell = |line: &str| {
        let mut words = line.split_whitespace();
        let (name, count) = (words.next()?, words.next()?.parse().ok()?);
        (words.next().is_none() && line.starts_with("     ")).then(|| (name.to_string(), count))
    };
    Ok(Some(stat.lines().filter_map(cell).collect()))
}
