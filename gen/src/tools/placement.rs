//! Placement and routing by nextpnr: how fast a design is on an FPGA.

use super::run::{Folder, is_installed, missing, problem, sources, top};
use super::{Device, Problems, Target};
use crate::VerilogFile;
use std::collections::BTreeMap;
use std::process::Command;

/// A placed and routed design that meets the timing of its constraints.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_gen::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_gen::tools::{Device, place};
///
/// let timing = constraints(&design, Dialect::Pcf, &Pins::none()).unwrap();
/// if let Some(placed) = place(&verilog(&design), &timing, Device::HX1K).unwrap() {
///     assert!(placed.crossings.is_empty()); // there is one clock
/// }
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// The clocks by their nets in the top.
    pub clocks: BTreeMap<String, Frequency>,
    /// The longest delay in nanoseconds from a register on the first clock to one on the second.
    pub crossings: BTreeMap<(String, String), f64>,
    /// The used cells of the device by type.
    pub cells: BTreeMap<String, u64>,
}

/// The frequency of a clock in MHz.
///
/// ```
/// let fast = tilewright_gen::tools::Frequency { reached: 140.5, wanted: 100.0 };
/// assert!(fast.reached > fast.wanted);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frequency {
    /// The highest one at which the slowest path is in time.
    pub reached: f64,
    /// That of the constraints.
    pub wanted: f64,
}

/// Synthesizes the design by Yosys, and places and routes it by nextpnr with these [constraints](crate::constraints()):
/// an `.lpf`, `.pcf` or `.sdc`. `None` if one of both is not installed. Ports without pins get some.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_gen::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_gen::tools::{Device, place};
///
/// let timing = constraints(&design, Dialect::Pcf, &Pins::none()).unwrap();
/// if let Some(placed) = place(&verilog(&design), &timing, Device::HX1K).unwrap() {
///     assert_eq!(placed.cells["SB_IO"], 17); // a clock, a byte in and a byte out
/// }
/// ```
///
/// # Errors
///
/// The output of Yosys or nextpnr, if it failed. nextpnr fails if a clock cannot be as fast as its constraint.
pub fn place(files: &[VerilogFile], constraints: &VerilogFile, device: Device) -> Result<Option<Placed>, Problems> {
    let python = format!("yowasp-{}", device.placer());
    let placer = [device.placer(), &python].into_iter().find(|program| is_installed(program));
    let (Some(placer), true) = (placer, is_installed("yosys")) else {
        let _ = missing(if is_installed("yosys") { &python } else { "yosys" });
        return Ok(None);
    };
    let folder = Folder::with(&[files, std::slice::from_ref(constraints)].concat());
    let (sources, top, pass) = (sources(files).join(" "), top(files), device.target().pass());
    let script = format!("read_verilog {sources}; {pass} -top {top} -json netlist.json");
    let (succeeded, output) = folder.run(Command::new("yosys").args(["-q", "-p", &script]));
    if !succeeded {
        return Err(problem("yosys", output));
    }
    let dialect = constraints.name.rsplit('.').next().unwrap_or_default();
    let unpinned =
        if device.target() == Target::Ecp5 { "--lpf-allow-unconstrained" } else { "--pcf-allow-unconstrained" };
    let mut command = Command::new(placer);
    command.args(device.options()).args([
        "--json",
        "netlist.json",
        &format!("--{dialect}"),
        &constraints.name,
        unpinned,
    ]);
    let (succeeded, output) = folder.run(&mut command);
    if !succeeded {
        return Err(problem(placer, output));
    }
    // All are printed before and after routing: the last ones stand.
    let clocks = output.lines().filter_map(clock).collect();
    let crossings = output.lines().filter_map(crossing).collect();
    let cells = output.lines().filter_map(cell).collect();
    Ok(Some(Placed { clocks, crossings, cells }))
}

/// The clock of a line such as `Info: Max frequency for clock 'clk': 140.53 MHz (PASS at 12.00 MHz)`.
fn clock(line: &str) -> Option<(String, Frequency)> {
    let (net, rest) = line.split_once("Max frequency for clock")?.1.trim().strip_prefix('\'')?.split_once('\'')?;
    let (reached, wanted) = rest.trim_start_matches(':').split_once(" MHz (PASS at ")?;
    let wanted = wanted.strip_suffix(" MHz)")?;
    Some((source_net(net), Frequency { reached: reached.trim().parse().ok()?, wanted: wanted.trim().parse().ok()? }))
}

/// The crossing of a line such as `Info: Max delay posedge clk -> posedge fast_clk : 1.02 ns`.
fn crossing(line: &str) -> Option<((String, String), f64)> {
    let (path, delay) = line.split_once("Max delay posedge ")?.1.rsplit_once(':')?;
    let (from, to) = path.split_once("-> posedge ")?;
    Some(((source_net(from), source_net(to)), delay.trim().strip_suffix(" ns")?.parse().ok()?))
}

/// The net of the design; one that a buffer of the chip distributes has the buffer's name, too.
fn source_net(net: &str) -> String {
    let net = net.trim().trim_start_matches("$glbnet$");
    net.split('$').next().unwrap_or_default().to_owned()
}

/// The cell of a line such as `Info:   SB_IO:     4/  112     3%`.
fn cell(line: &str) -> Option<(String, u64)> {
    let (name, count) = line.strip_prefix("Info:")?.trim().strip_suffix('%')?.split_once(':')?;
    let (used, _) = count.split_once('/')?;
    Some((name.to_owned(), used.trim().parse().ok()?)).filter(|(_, used)| *used > 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_nextpnr() {
        let line = "Info: Max frequency for clock            '$glbnet$clk': 140.53 MHz (PASS at 12.00 MHz)";
        assert_eq!(clock(line), Some(("clk".to_owned(), Frequency { reached: 140.53, wanted: 12.0 })));
        assert_eq!(
            clock("Info: Max frequency for clock 'a$SB_IO_IN_$glb_clk': 1.5 MHz (PASS at 1.00 MHz)").unwrap().0,
            "a"
        );
        let line = "Info: Max delay posedge clk$TRELLIS_IO_IN -> posedge $glbnet$fast_clk : 1.02 ns";
        assert_eq!(crossing(line), Some((("clk".to_owned(), "fast_clk".to_owned()), 1.02)));
        assert_eq!(crossing("Info: Max delay posedge odd_clk           -> <async>                  : 1.95 ns"), None);
        assert_eq!(cell("Info: \t               SB_IO:     4/  112     3%"), Some(("SB_IO".to_owned(), 4)));
        assert_eq!(cell("Info: \t            SB_WARM:     0/    1     0%"), None);
    }
}
