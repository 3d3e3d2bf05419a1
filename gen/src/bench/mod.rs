//! The replay testbench: drives the inputs of a recorded run, and compares every output before every edge.
//!
//! One time unit of the bench is a picosecond. Clocks fall, and inputs change, halfway between two edges; outputs are
//! compared at the edge itself, just before the clocks rise. Registers start at their reset value and everything
//! else at zero, as in the simulation, unless the replay says otherwise.

mod start;
mod text;

use crate::VerilogFile;
use tilewright_hdl::Bits;
use tilewright_hdl::ir::Design;

/// A recorded run of a design's top module.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Replay {
    /// The instants at which clocks rise, in order of time; in a design without clocks, those of comparison.
    pub steps: Vec<ReplayStep>,
    /// State that starts neither at its reset value nor at zero.
    pub initial: Vec<Initial>,
}

/// One instant of a [`Replay`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReplayStep {
    /// Its time in picoseconds, above 1 and at least 2 after the step before.
    pub time_ps: u64,
    /// The clocks that rise, by index in [`Module::clocks`](tilewright_hdl::ir::Module::clocks).
    pub rising: Vec<usize>,
    /// The clocks whose reset is high before and at the edge.
    pub resets: Vec<usize>,
    /// The inputs before and at the edge, in order of the ports.
    pub inputs: Vec<Bits>,
    /// What the outputs are just before the edge, in order of the ports.
    pub outputs: Vec<Bits>,
}

/// What a register, the data of a synchronous read or a memory holds at the start.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Initial {
    /// The path below the top, such as `u_row.u_cell[3].q`.
    pub path: String,
    /// The value of a register; the words of a memory from address 0, the rest of which is zero.
    pub words: Vec<Bits>,
}

/// The testbench that replays a run: a module `TOP_tb`, for `iverilog -g2005` and `verilator --binary` alike. It prints
/// `PASS: n cycles`, or the first mismatches by port and cycle.
///
/// # Panics
///
/// If the replay does not fit the design: a step with too many or too few values or values of another width, steps
/// out of order, or initial values of something that the design does not have.
pub fn testbench(design: &Design, replay: &Replay) -> VerilogFile {
    check(design, replay);
    let name = format!("{}_tb", design.top().name);
    VerilogFile { text: text::print(design, replay, &name), name: format!("{name}.v") }
}

/// A replay that does not fit would make a testbench that passes or fails for the wrong reason.
fn check(design: &Design, replay: &Replay) {
    let top = design.top();
    let mut before = 0;
    for (cycle, step) in replay.steps.iter().enumerate() {
        assert!(step.time_ps >= before + 2, "step {cycle} of the replay is less than 2 ps after the step before");
        before = step.time_ps;
        let clocks = step.rising.iter().chain(&step.resets);
        let known = clocks.copied().all(|clock| clock < top.clocks.len());
        assert!(known, "step {cycle} of the replay names a clock that `{}` does not have", top.name);
        let inputs: Vec<u32> = top.inputs.iter().map(|port| top.width(port.node)).collect();
        let outputs: Vec<u32> = top.outputs.iter().map(|port| top.width(port.node)).collect();
        for (ports, values) in [(inputs, &step.inputs), (outputs, &step.outputs)] {
            let widths: Vec<u32> = values.iter().map(Bits::width).collect();
            assert_eq!(ports, widths, "the values of step {cycle} of the replay have other widths than the ports");
        }
    }
}
