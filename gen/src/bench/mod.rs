//! The replay testbench: drives the inputs of a recorded run, and compares every output before every edge.
//!
//! The time unit of the testbench is a picosecond. Clocks return, and inputs change, halfway between two edges.
//! Outputs are compared at the edge itself, just before the clocks change. Registers start at their reset values and everything
//! else at zero, as in the simulation, unless the recording says otherwise.
//!
//! A failing assertion ends the testbench by itself. So a testbench of a run that ended at a failing assertion fails
//! at the same edge, which the recording includes.

mod start;
mod table;
mod text;

pub use start::{Net, nets};

use crate::VerilogFile;
use crate::verilog::{Names, packed_width};
use std::collections::BTreeSet;
use tilewright_circuit::ir::Design;
use tilewright_circuit::recording::Initial;
use tilewright_circuit::{Bits, Recording};

/// Prints a testbench that replays a run: a module `TOP_tb` (`TOP_tb_2` if the design has a module `TOP_tb`), for
/// both `iverilog -g2005` and `verilator --binary`. It prints `PASS: n cycles` and finishes, or it prints the first
/// mismatches by port and cycle and ends with a non-zero status. A failing assertion of the design is printed as
/// `FAIL: time t: INSTANCE: message`, and ends the run immediately with a non-zero status. With
/// `-DTILEWRIGHT_COVERS`, the testbench prints the covers that are hit. A design with foreign modules needs
/// `-DTILEWRIGHT_MODELS`.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_hdl::recording::{Recording, Step};
///
/// // As a simulation records it: 5 goes in, and comes out one clock later.
/// let at = |time_ps, word, late| Step {
///     time_ps,
///     rising: vec![0],
///     resets: vec![],
///     inputs: vec![Bits::new(8, word)],
///     outputs: vec![Bits::new(8, late)],
/// };
/// let recording = Recording { steps: vec![at(10_000, 5, 0), at(20_000, 0, 5)], initial: vec![] };
/// let bench = tilewright_gen::testbench(&design, &recording);
/// assert_eq!(bench.name, "delay_tb.v");
/// assert!(bench.text.contains("PASS: "));
/// ```
///
/// # Panics
///
/// The recording does not fit the design: a step has too many or too few values or values of another width, steps are
/// not in the sequence of time, or an initial value belongs to nothing in the design.
pub fn testbench(design: &Design, recording: &Recording) -> VerilogFile {
    check(design, recording);
    let mut modules = Names::default();
    design.modules().iter().for_each(|module| modules.take(&module.name));
    let name = modules.fresh(&format!("{}_tb", design.top().name));
    VerilogFile { text: text::print(design, recording, &name), name: format!("{name}.v") }
}

/// The words of memories, given by path and depth, as the testbench of a design names them: `dut.u_row.held[3]`. A
/// memory that nothing reads is not printed and has none. Lanes of a memory that share a word have it once.
pub fn words(design: &Design, memories: &[(&str, u32)]) -> Vec<String> {
    let initial = |(path, depth): &(&str, u32)| Initial {
        path: (*path).to_owned(),
        address: 0,
        words: vec![Bits::zero(1); *depth as usize],
    };
    let initial: Vec<Initial> = memories.iter().map(initial).collect();
    let (dut, mut known) = (text::instance(design), BTreeSet::new());
    let all = nets(design, &initial).into_iter().flatten().map(|net| format!("{dut}.{}", net.name));
    all.filter(|net| known.insert(net.clone())).collect()
}

/// A recording that does not fit would make a testbench that passes or fails for the wrong reason.
fn check(design: &Design, recording: &Recording) {
    let top = design.top();
    let mut before = 0;
    for (cycle, step) in recording.steps.iter().enumerate() {
        assert!(step.time_ps >= before + 2, "step {cycle} of the recording is less than 2 ps after the step before");
        before = step.time_ps;
        let clocks = step.rising.iter().chain(&step.resets);
        let known = clocks.copied().all(|clock| clock < top.clocks.len());
        assert!(known, "step {cycle} of the recording names a clock that `{}` does not have", top.name);
        let inputs: Vec<u32> = top.inputs.iter().map(|port| packed_width(top, port.node)).collect();
        let outputs: Vec<u32> = top.outputs.iter().map(|port| packed_width(top, port.node)).collect();
        for (ports, values) in [(inputs, &step.inputs), (outputs, &step.outputs)] {
            let widths: Vec<u32> = values.iter().map(Bits::width).collect();
            assert_eq!(ports, widths, "the values of step {cycle} of the recording have other widths than the ports");
        }
    }
}
