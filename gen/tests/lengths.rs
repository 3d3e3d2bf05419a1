//! Very long chains, choices and concatenations: every tool reads what is printed of them, and it says the same.

use crate::long::{KINDS, Long};
use tilewright_gen::{tools, verilog};
use tilewright_hdl::elaborate;

/// 1,425 conditions that are `else if`s of each other exhaust the parsers of Icarus and of Verilator.
#[test]
fn linters_read_2000_of_everything() {
    let files = KINDS.map(|kind| verilog(&elaborate(&Long { kind, count: 2000 }).unwrap()));
    tools::lint_all(&files.each_ref().map(|files| &files[..])).unwrap();
}
