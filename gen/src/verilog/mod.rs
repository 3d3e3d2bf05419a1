//! The printer: a fold, a plan, names, and then the text of each part of a module.

mod adopt;
mod branches;
mod constant;
mod contents;
mod expression;
mod fold;
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
use fold::Folded;
pub use fold::lower::packed_width;
pub use layout::{connect, range};
pub use literal::pattern;
use printer::Printer;
pub use scope::{Names, Scope};
pub use state::{ModuleState, ScopeState, State};
use tilewright_hdl::ir::{Design, Module};

/// The design as Verilog, one file a module, each followed by the data files of its memories; the top is the last
/// module.
///
/// The text is a Verilog-2001 subset with ANSI ports: free of warnings in Verilator, Icarus, Yosys and slang, the same
/// bytes for the same design, and with the names of the description.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_gen::for_examples::Delay).unwrap();
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
    for (module, latency) in design.modules().iter().zip(design.latencies()) {
        let folded = simplified(design, module);
        let text = module::print(&mut Printer::new(design, &folded), latency.as_ref());
        files.push(VerilogFile { name: format!("{}.v", module.name), text });
        files.extend(contents::data_files(&folded.module));
    }
    files
}

/// What holds state in a module, by the names that its text has.
pub fn state(design: &Design, module: &Module) -> ModuleState {
    Printer::new(design, &simplified(design, module)).state()
}

fn simplified(design: &Design, module: &Module) -> Folded {
    let mut folded = fold::fold(design, module);
    adopt::adopt_names(&mut folded.module);
    folded
}
