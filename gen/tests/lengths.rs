//! Very long chains, choices and concatenations: every tool reads their text, and it behaves correctly.

use crate::long::{KINDS, Kind, Long};
use tilewright_gen::{tools, verilog};
use tilewright_hdl::elaborate;

/// A chain of 1,425 `else if`s exhausts the parsers of Icarus and of Verilator.
#[test]
fn linters_read_2000_of_everything() {
    let files = KINDS.map(|kind| verilog(&elaborate(&Long { kind, count: 2000 }).unwrap()));
    tools::lint_all(&files.each_ref().map(|files| &files[..])).unwrap();
}

/// Icarus takes time quadratic in the parts that assignments take from one vector: 65,536 in 20 s, and in blocks in 2
/// s.
#[test]
fn blocks_take_many_bits_from_a_vector() {
    let printed = |count| {
        let files = verilog(&elaborate(&Long { kind: Kind::Concat, count }).unwrap());
        let text = &files.last().unwrap().text;
        let assigned = text.split(';').filter(|it| !it.contains("always"));
        let most = assigned.map(|it| it.matches("bits[").count()).max();
        (text.matches("always @*").count(), most.unwrap())
    };
    assert_eq!(printed(127), (0, 127));
    assert_eq!(printed(128), (1, 0));
    assert_eq!(printed(2000), (8, 0));
}
