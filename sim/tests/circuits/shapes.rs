//! Circuits whose values have shapes, built node by node; each was once computed wrongly, or not at all.

use tilewright_hdl::ir::*;
use tilewright_hdl::{Bits, Design};
use tilewright_sim::{EngineKind, Passes, Simulation, Target};

use crate::circuits::build::Build;

/// All passes, none, and all but one, with code for constant inputs and functions that are cut early.
fn every_passes() -> Vec<Passes> {
    let without: [fn(&mut Passes); 13] = [
        |passes| passes.siblings = false,
        |passes| passes.fold = false,
        |passes| passes.share = false,
        |passes| passes.uniform = false,
        |passes| passes.lift = false,
        |passes| passes.postpone = false,
        |passes| passes.branch = false,
        |passes| passes.lookups = false,
        |passes| passes.side_by_side = false,
        |passes| passes.target = Target::Functions,
        |passes| passes.target = Target::Strips { vector: 64 },
        |passes| passes.target = Target::Strips { vector: 128 },
        |passes| passes.target = Target::Strips { vector: 256 },
    ];
    let without = without.map(|switch| {
        let mut passes = Passes { held_after: 3, longest: 20, near: 0, ..Passes::default() };
        switch(&mut passes);
        passes
    });
    let plain = Passes { target: Target::Functions, ..Passes::none() };
    [Passes::default(), Passes::none(), plain].into_iter().chain(without).collect()
}

/// The top of these modules under changing inputs, with machine code beside the reference engine, for all sets of
/// passes.
fn run(modules: Vec<Module>) {
    let design = Design::new(modules).unwrap();
    for passes in every_passes() {
        let mut sim = Simulation::with_passes(&design, &passes).unwrap().on(EngineKind::Both);
        for step in 0..20u64 {
            for (number, input) in (1..).zip(&design.top().inputs) {
                let node = design.top().node(input.node);
                let width = node.width * node.shape.lanes();
                let limbs: Vec<u64> = (1..=width.div_ceil(64).into())
                    .map(|limb: u64| (step * 8 + number).wrapping_mul(limb).wrapping_mul(0x9e37_79b9_7f4a_7c15))
                    .collect();
                let port = sim.port(&input.name).unwrap();
                sim.set(port, Bits::from_limbs(width, &limbs));
            }
            sim.try_step().unwrap_or_else(|error| panic!("{error} with {passes:?}"));
        }
    }
}

#[test]
fn instances_written_one_by_one_with_rows_as_ports_feed_each_other() {
    let child = &mut Build::new("child");
    let grid = child.input("grid", 1, Shape::Grid(1, 4));
    let zero = child.constant(5, 0, Shape::Row(1));
    let picked = child.pick(grid, 1, zero);
    let both = child.node(Op::Repeat(picked, 9), 9, Shape::Row(1));
    let inverse = child.not(both);
    let y = child.mux(picked, both, inverse);
    child.output("y", y);

    let b = &mut Build::new("top");
    let mut row = b.input("x", 9, Shape::Row(1));
    for number in 0..4 {
        let bit = b.node(Op::Slice { of: row, low: number }, 1, Shape::Row(1));
        let grid = b.broadcast(bit, 1, 4);
        row = b.instance(&format!("u{number}"), 0, &child.module, Shape::Plain, &[grid])[0];
    }
    b.output("y", row);
    let state = b.delayed("state", row);
    b.output("state_out", state);
    child.module.clocks[0].period = None;
    run(vec![child.module.clone(), b.module.clone()]);
}

#[test]
fn a_chain_from_lane_to_lane_leads_through_a_memory() {
    let b = &mut Build::new("top");
    let row = Shape::Row(5);
    let (start, data, writes) = (b.input("start", 3, Shape::Plain), b.input("data", 3, row), b.input("writes", 1, row));
    let memory = b.memory("words", 8, 3, row);
    let word = b.read(memory, false, NodeId(0), None);
    let address = b.previous(word, 0, start);
    b.module.memories[0].reads[0].address = address;
    b.write(memory, writes, data, word);
    b.module.memories[0].contents = Contents::Words((0..8).map(|word| Bits::new(3, word * 5 % 8)).collect());
    b.output("word", word);
    run(vec![b.module.clone()]);
}

#[test]
fn lanes_are_taken_from_a_row_of_one() {
    let b = &mut Build::new("top");
    let (x, edge) = (b.input("x", 16, Shape::Row(1)), b.input("ends", 16, Shape::Plain));
    let inverse = b.not(x);
    let all = b.map(inverse, 0, 5, Affine { mul: 1, add: 0, div: 5 }, None);
    b.output("all", all);
    let some = b.map(inverse, 0, 5, Affine { mul: 1, add: -4, div: 2 }, Some(edge));
    b.output("some", some);
    let state = b.delayed("state", some);
    b.output("state_out", state);
    run(vec![b.module.clone()]);
}

#[test]
fn a_write_that_never_happens_is_found_late() {
    let b = &mut Build::new("top");
    let row = Shape::Row(5);
    let (flags, data, at) = (b.input("flags", 1, row), b.input("data", 4, row), b.input("at", 3, Shape::Plain));
    // The sum of a lane is its number, which no flag has.
    let number = b.constant(4, 9, Shape::Row(1));
    let number = b.reduce(Reduction::Add, number, 0);
    let enable = b.pick(flags, 0, number);
    let memory = b.memory("words", 8, 4, row);
    b.write(memory, enable, at, data);
    let word = b.read(memory, true, at, None);
    b.output("word", word);
    run(vec![b.module.clone()]);
}

#[test]
fn a_row_of_one_number_is_repeated_in_another_function() {
    a_row_of_one_number_is_repeated(|b, number| b.not(number));
}

#[test]
fn a_row_of_one_register_is_repeated_after_the_register_has_changed() {
    a_row_of_one_number_is_repeated(|b, number| b.delayed("kept", number));
}

/// What `made` gives, in the lanes of a row, then of grids, then of all grids for instances that run side by side;
/// other work lies between the first and the last.
fn a_row_of_one_number_is_repeated(made: fn(&mut Build, NodeId) -> NodeId) {
    let child = &mut Build::new("child");
    let grid = child.input("grid", 16, Shape::Grid(4, 4));
    let row = child.lane(grid, 0, 0);
    let rows = child.broadcast(row, 0, 4);
    let inverse = child.not(rows);
    let twice = child.add(rows, rows);
    let mixed = child.xor(inverse, twice);
    child.output("mixed", mixed);
    child.module.clocks[0].period = None;

    let b = &mut Build::new("top");
    let number = b.input("number", 16, Shape::Plain);
    let number = made(b, number);
    let grid = b.everywhere(number, Shape::Grid(4, 4));
    let start = b.input("start", 16, Shape::Row(5));
    let mut other = start;
    for _ in 0..20 {
        let inverse = b.not(other);
        let either = b.or(start, inverse);
        other = b.add(other, either);
    }
    let other = b.lane(other, 0, 0);
    let other = b.everywhere(other, Shape::Grid(4, 4));
    for number in 0..5 {
        let mixed = b.instance(&format!("u{number}"), 0, &child.module, Shape::Plain, &[grid])[0];
        let all = b.xor(mixed, other);
        let state = b.delayed(&format!("state{number}"), all);
        b.output(&format!("all{number}"), state);
    }
    run(vec![child.module.clone(), b.module.clone()]);
}

#[test]
fn bits_become_lanes_along_each_axis() {
    let b = &mut Build::new("top");
    let words = b.input("words", 8, Shape::Row(3));
    let inverse = b.not(words);
    for axis in 0..2 {
        let bits = b.unpack(inverse, axis, 8);
        b.output(&format!("bits{axis}"), bits);
        let state = b.delayed(&format!("state{axis}"), bits);
        b.output(&format!("state_out{axis}"), state);
    }
    run(vec![b.module.clone()]);
}
