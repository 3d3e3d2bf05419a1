//! The printer: a fold, a plan, names, and then the text of each part of a module.

mod adopt;
mod array;
mod asserts;
mod branches;
mod constant;
mod contents;
mod expression;
mod fold;
mod instance;
mod lane_names;
mod layout;
mod literal;
mod memory;
mod module;
mod names;
mod nets;
mod order;
mod pattern;
mod plan;
mod printer;
mod reads;
mod reduction;
mod registers;
mod scope;
mod state;
mod statement;
mod states;
mod usage;

use crate::VerilogFile;
pub use layout::{connect, range};
use printer::Printer;
pub use scope::{Names, Scope};
pub use state::{ModuleState, State};
use tilewright_hdl::ir::{Design, Module};

/// The design as Verilog, one file a module, each followed by the data files of its memories; the top is the last
/// module.
///
/// The text is a Verilog-2001 subset with ANSI ports: free of warnings in Verilator, Icarus, Yosys and slang, the same
/// bytes for the same design, and with the names of the description.
pub fn verilog(design: &Design) -> Vec<VerilogFile> {
    let mut files = Vec::new();
    for module in design.modules() {
        let folded = simplified(module);
        let text = module::print(&mut Printer::new(design, &folded));
        files.push(VerilogFile { name: format!("{}.v", module.name), text });
        files.extend(contents::data_files(&folded));
    }
    files
}

/// What holds state in a module, by the names that its text has.
pub fn state(design: &Design, module: &Module) -> ModuleState {
    Printer::new(design, &simplified(module)).state()
}

fn simplified(module: &Module) -> Module {
    let mut folded = fold::fold(module);
    adopt::adopt_names(&mut folded);
    folded
}
