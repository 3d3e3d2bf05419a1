//! The whole Verilog of a few small blocks, about which no linter complains; and two testbenches.
//!
//! `UPDATE_GOLDEN=1 cargo test -p tilewright-gen` rewrites the files.

pub mod compare;

use crate::blocks::{Clocks, Counter, Latest, LineBuffer, Mirror, Pump, Row, Updates};
use crate::shapes::{Grid, Shapes, Words};
use compare::compare;
use tilewright_gen::{testbench, tools, verilog};
use tilewright_hdl::recording::{Initial, Step};
use tilewright_hdl::{Bits, Block, Recording, elaborate};

fn check<B: Block>(block: &B) {
    let files = verilog(&elaborate(block).expect("the block is sound"));
    assert_eq!(files, verilog(&elaborate(block).expect("the block is sound")), "the same design prints differently");
    files.iter().filter(|file| file.name.ends_with(".v")).for_each(compare);
    tools::lint(&files).unwrap();
}

#[test]
fn a_counter() {
    check(&Counter { width: 8, limit: 10 });
}

#[test]
fn what_is_said_about_ports() {
    check(&Mirror);
}

#[test]
fn updates_by_priority() {
    check(&Updates);
    check(&Latest);
}

#[test]
fn a_state_machine() {
    check(&Pump);
}

#[test]
fn memories() {
    check(&LineBuffer);
}

#[test]
fn an_array() {
    check(&Row { lanes: 5 });
}

#[test]
fn expressions_and_choices() {
    check(&Shapes);
}

#[test]
fn ports_of_memories() {
    check(&Words);
}

fn check_bench<B: Block>(block: &B, recording: &Recording) {
    compare(&testbench(&elaborate(block).expect("the block is sound"), recording));
}

#[test]
fn a_testbench_that_sets_lanes_of_lanes() {
    let step = |time_ps: u64| Step {
        time_ps,
        rising: vec![0],
        resets: vec![],
        inputs: vec![Bits::ones(1), Bits::new(8, time_ps)],
        outputs: vec![Bits::zero(8)],
    };
    let initial = Initial { path: "u_row[1].u_cell[2].q".to_string(), address: 0, words: vec![Bits::new(8, 9)] };
    check_bench(&Grid, &Recording { steps: [5, 10, 15].map(step).to_vec(), initial: vec![initial] });
}

#[test]
fn a_testbench_of_two_clocks() {
    let step = |(time_ps, rising): (u64, &[usize])| Step {
        time_ps,
        rising: rising.to_vec(),
        resets: rising[..1].to_vec(),
        inputs: vec![],
        outputs: vec![Bits::new(8, time_ps), Bits::zero(8)],
    };
    let steps = [(10, &[0][..]), (14, &[1]), (20, &[0]), (70, &[0, 1])].map(step);
    check_bench(&Clocks, &Recording { steps: steps.to_vec(), initial: vec![] });
}
