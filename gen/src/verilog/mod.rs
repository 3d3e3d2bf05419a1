//! The printer: a fold, a plan, names, and then the text of each part of a module.

mod adopt;
mod border;
mod branches;
mod constant;
mod contents;
mod expression;
mod fold;
mod foreign;
mod group;
mod groups;
mod instance;
mod lane_names;
mod lane_values;
mod layout;
mod literal;
mod memory;
mod module;
mod names;
mod nets;
mod order;
mod own_name;
mod part;
mod pattern;
mod pick;
mod plan;
mod ports;
mod printer;
mod properties;
mod reads;
mod reduction;
mod registers;
mod scope;
mod state;
mod stated;
mod statement;
mod states;
mod text;
mod usage;

use crate::VerilogFile;
pub use fold::lower::packed_width;
pub use foreign::WITH_MODELS;
pub use layout::{connect, range};
pub use literal::pattern;
use printer::Printer;
pub use properties::{WITH_COVERS, stop};
pub use scope::Names;
pub use state::{ModuleState, ScopeState, State};
use tilewright_circuit::ir::{Design, Module};

/// Prints the design as Verilog: one file a module, each followed by the data files of its memories; the top is the
/// last module.
///
/// The text is a Verilog-2001 subset with ANSI ports. It causes no warnings in Verilator, Icarus, Yosys and slang,
/// has the same bytes for the same design, and uses the names of the description.
///
/// A foreign module is instantiated with its parameters. If the macro `TILEWRIGHT_MODELS` is defined, its model is
/// instantiated in its place: for simulators, as in `iverilog -DTILEWRIGHT_MODELS`, and for linters.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// let files = tilewright_gen::verilog(&design);
/// # let folder = std::env::temp_dir().join(format!("tilewright-{}", std::process::id()));
/// # std::fs::create_dir_all(&folder).unwrap();
/// for file in &files {
///     std::fs::write(folder.join(&file.name), &file.text).unwrap();
/// }
/// assert!(folder.join("delay.v").is_file());
/// # std::fs::remove_dir_all(&folder).unwrap();
/// ```
pub fn verilog(design: &Design) -> Vec<VerilogFile> {
    let mut files = Vec::new();
    print_all(design, |printer, _, text| {
        files.push(VerilogFile { name: format!("{}.v", printer.module.name), text });
        files.extend(contents::data_files(printer.module));
    });
    files
}

/// The ports of the top without models, with their widths.
pub fn top_ports(design: &Design) -> Vec<(String, u32)> {
    ports::of_chip(&fold::fold(design, design.top()).module, design)
}

/// The state of each module, by the names in its text.
pub fn states(design: &Design) -> Vec<ModuleState> {
    let mut states = Vec::new();
    print_all(design, |printer, module, _| states.push(printer.state(module)));
    states
}

/// Calls `visit` with each module as printed, as it is described, and its text.
fn print_all(design: &Design, mut visit: impl FnMut(&Printer, &Module, String)) {
    let (mut names, mut waits) = (Vec::<Names>::new(), Vec::new());
    for (module, latency) in design.modules().iter().zip(design.latencies()) {
        let mut folded = fold::fold(design, module);
        adopt::adopt_names(&mut folded.module);
        let mut printer = Printer::new(design, &folded, &names, &waits);
        let text = module::print(&mut printer, module, latency.as_ref());
        let waits_below = module.instances.iter().any(|instance| waits[instance.module.0 as usize]);
        let waits_here = waits_below || text.contains("always @*");
        visit(&printer, module, text);
        names.push(printer.taken);
        waits.push(waits_here);
    }
}
