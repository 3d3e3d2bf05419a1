//! Modules with lanes about which some tool complains or has complained.

use super::build::Build;
use super::modules::zero;
use tilewright_hdl::ir::*;

/// A selection from this many lanes, by a number of this many bits.
pub fn far_pick(lanes: u32, bits: u32) -> Module {
    let b = &mut Build::new("far_pick");
    let (seed, which) = (b.input("seed", 40, Shape::Plain), b.input("which", bits, Shape::Plain));
    let lanes = b.broadcast(seed, 0, lanes);
    let chain = b.delayed("chain", lanes);
    let next = b.previous(chain, 0, seed);
    b.next(chain, None, next);
    let picked = b.pick(chain, 0, which);
    b.output("picked", picked);
    b.module.clone()
}

/// One of three lanes of 40 bits.
pub fn pick_of_three() -> Module {
    let b = &mut Build::new("pick_of_three");
    let (lanes, which) = (b.input("lanes", 40, Shape::Row(3)), b.input("which", 2, Shape::Plain));
    let picked = b.pick(lanes, 0, which);
    b.output("picked", picked);
    b.module.clone()
}

/// A list of constants.
fn list(b: &mut Build, width: u32, values: &[u64]) -> NodeId {
    let parts: Vec<NodeId> = values.iter().map(|&value| b.constant(width, value, Shape::Plain)).collect();
    b.stack(&parts, 0)
}

/// Comparisons that are constant in some lanes.
pub fn comparisons() -> Module {
    let b = &mut Build::new("comparisons");
    let (x, which) = (b.input("x", 2, Shape::Row(4)), b.input("which", 8, Shape::Row(3)));
    let (low, other) = (list(b, 2, &[0, 1, 2, 3]), list(b, 2, &[3, 0, 0, 3]));
    let reached = b.node(Op::Compare { relation: Relation::Ge, signed: false, operands: [x, low] }, 1, Shape::Row(4));
    let known = b.node(Op::Compare { relation: Relation::Ge, signed: false, operands: [other, low] }, 1, Shape::Row(4));
    let both = b.xor(reached, known);
    b.output("both", both);
    let places = list(b, 2, &[3, 1, 2, 0]);
    let grid = b.broadcast(which, 1, 4);
    let picked = b.pick(grid, 0, places);
    b.output("picked", picked);
    let (on, zero) = (list(b, 1, &[0, 0, 1, 0]), list(b, 2, &[0, 0, 1, 3]));
    let choice = b.mux(on, x, zero);
    let chosen = b.node(Op::Compare { relation: Relation::Lt, signed: false, operands: [x, choice] }, 1, Shape::Row(4));
    b.output("chosen", chosen);
    b.module.clone()
}

/// Constants that enable, select and address.
pub fn decided() -> Module {
    let b = &mut Build::new("decided");
    let row = Shape::Row(4);
    let x = b.input("x", 3, row);
    let (on, place) = (list(b, 1, &[0, 1, 1, 0]), list(b, 2, &[0, 1, 3, 2]));
    let enabled = b.register("enabled", 3, row, None);
    b.next(enabled, Some(on), x);
    let chosen = b.register("chosen", 3, row, None);
    let next = b.mux(on, x, chosen);
    b.next(chosen, None, next);
    let kind = list(b, 2, &[2, 0, 1, 2]);
    let (three, four) = (b.constant(3, 3, row), list(b, 3, &[4, 5, 6, 7]));
    let constant = b.case(kind, &[three, four], three);
    let few = b.memory("few", 3, 3, row);
    let seen = b.read(few, false, place, None);
    let nowhere = b.input("nowhere", 1, row);
    b.write(few, nowhere, place, x);
    let words = b.memory("words", 4, 3, row);
    b.write(words, on, place, x);
    let word = b.read(words, true, place, Some(on));
    for (name, node) in
        [("enabled_out", enabled), ("chosen_out", chosen), ("constant", constant), ("word", word), ("seen", seen)]
    {
        b.output(name, node);
    }
    b.module.clone()
}

/// The greatest and the least of sums of constants, less a constant each: one in a column of the same constants.
pub fn greatest_of_constants() -> Module {
    let b = &mut Build::new("greatest_of_constants");
    let rows = [[0, 3, 2], [2, 3, 0], [2, 1, 0]].map(|row| list(b, 2, &row));
    let grid = b.stack(&rows, 0);
    let sums = b.reduce(Reduction::Add, grid, 1);
    let less = b.node(Op::Lane { of: grid, axis: 1, index: 0 }, 2, Shape::Row(3));
    let differences = b.node(Op::Binary(Binary::Sub, sums, less), 2, Shape::Row(3));
    let greatest = b.reduce(Reduction::Max, differences, 0);
    b.output("greatest", greatest);
    let least = b.reduce(Reduction::Min, differences, 0);
    b.output("least", least);
    b.module.clone()
}

/// The least of sixteen sums by a tree of choices; some lanes are known to be zero, and so are some choices.
pub fn least_of_some_constants() -> Module {
    let b = &mut Build::new("least_of_some_constants");
    let x = b.input("x", 3, Shape::Plain);
    let zero = b.constant(3, 0, Shape::Plain);
    let parts: Vec<NodeId> = (0..16).map(|lane| if lane < 8 || lane == 9 { zero } else { x }).collect();
    let single = b.stack(&parts, 0);
    let row = Shape::Row(16);
    let twice = b.node(Op::Binary(Binary::Add, single, single), 3, row);
    let mut lanes = b.node(Op::Binary(Binary::Sub, twice, single), 3, row);
    for count in [8, 4, 2, 1] {
        let half = |b: &mut Build, add| {
            let index = Affine { mul: 2, add, div: 1 };
            b.node(Op::Map { of: lanes, axis: 0, index, edge: None }, 3, Shape::Row(count))
        };
        let (even, odd) = (half(b, 0), half(b, 1));
        let operands = [odd, even];
        let less = b.node(Op::Compare { relation: Relation::Lt, signed: false, operands }, 1, Shape::Row(count));
        lanes = b.mux(less, odd, even);
    }
    let least = b.node(Op::Lane { of: lanes, axis: 0, index: 0 }, 3, Shape::Plain);
    b.output("least", least);
    b.module.clone()
}

/// A row of memories of this many words; a grid reads their data, and the row reads the grid.
pub fn read_ahead(depth: u32) -> Module {
    let b = &mut Build::new("read_ahead");
    let row = Shape::Row(3);
    let (address, writes) = (b.input("address", 3, row), b.input("writes", 1, row));
    let id = b.memory("words", depth, 4, row);
    let data = b.read(id, true, address, None);
    b.named("data", data);
    let rows = b.broadcast(data, 0, 2);
    let numbers = [1, 2].map(|number| b.constant(4, number, row));
    let numbers = b.stack(&numbers, 0);
    let sums = b.add(rows, numbers);
    b.named("sums", sums);
    let all = b.reduce(Reduction::Xor, sums, 0);
    let mixed = b.xor(all, data);
    b.named("mixed", mixed);
    b.write(id, writes, address, mixed);
    b.output("out", mixed);
    b.module.clone()
}

/// A grid of memories of this many words, each of which is read when it is told to. All have the address of a lane.
pub fn masked_reads(grid: Shape, depth: u32) -> Module {
    let b = &mut Build::new("masked_reads");
    let (numbers, on) = (b.input("numbers", 3, Shape::Row(3)), b.input("on", 1, Shape::Plain));
    let (mask, data) = (b.input("mask", 1, grid), b.input("data", 4, grid));
    let sums = b.add(numbers, numbers);
    let [from, to] = [0, 1].map(|lane| b.lane(sums, 0, lane));
    let id = b.memory("words", depth, 4, grid);
    b.write(id, on, to, data);
    let later = b.read(id, true, from, Some(mask));
    let now = b.read(id, false, from, None);
    b.output("later", later);
    b.output("now", now);
    b.module.clone()
}

/// A row of memories with a common address, all of which are read when a bit says so; and a port that reads some.
pub fn read_together() -> Module {
    let b = &mut Build::new("read_together");
    let row = Shape::Row(3);
    let (at, on, data) = (b.input("at", 3, Shape::Plain), b.input("on", 1, Shape::Plain), b.input("data", 4, row));
    let id = b.memory("words", 8, 4, row);
    b.write(id, on, at, data);
    let flags = b.everywhere(on, row);
    let all = b.read(id, true, at, Some(flags));
    let flags = [1, 0, 1].map(|flag| b.constant(1, flag, Shape::Plain));
    let flags = b.stack(&flags, 0);
    let some = b.read(id, true, at, Some(flags));
    b.output("all", all);
    b.output("some", some);
    b.module.clone()
}

/// Bits of computed and broadcast values, and the selected lane of a row of one.
pub fn bits_of_lanes() -> Module {
    let b = &mut Build::new("bits_of_lanes");
    let (x, y) = (b.input("x", 4, Shape::Plain), b.input("y", 1, Shape::Row(1)));
    let sum = b.add(x, x);
    let lanes = b.broadcast(sum, 0, 3);
    let low = b.node(Op::Slice { of: lanes, low: 1 }, 2, Shape::Row(3));
    let signed = b.node(Op::Extend { of: lanes, signed: true }, 8, Shape::Row(3));
    let number = b.node(Op::Slice { of: x, low: 0 }, 1, Shape::Plain);
    let picked = b.pick(y, 0, number);
    b.output("low", low);
    b.output("extended", signed);
    b.output("picked", picked);
    b.module.clone()
}

/// Each lane equals the previous one, with nothing in between.
pub fn passed_on() -> Module {
    let b = &mut Build::new("passed_on");
    let first = b.input("first", 4, Shape::Plain);
    let lanes = b.node(Op::Wire(NodeId(2)), 4, Shape::Row(5));
    b.named("lanes", lanes);
    let before = b.previous(lanes, 0, first);
    assert_eq!(before, NodeId(2));
    b.output("out", lanes);
    b.module.clone()
}

/// Shifts by constants of the lanes, some of which shift everything out.
pub fn shifted_out() -> Module {
    let b = &mut Build::new("shifted_out");
    let row = Shape::Row(3);
    let x = b.input("x", 12, row);
    let amounts = [1, 0xfff, 12].map(|amount| b.constant(12, amount, Shape::Plain));
    let amounts = b.stack(&amounts, 0);
    for (name, shift) in [("left", Shift::Left), ("right", Shift::Right), ("arithmetic", Shift::RightSigned)] {
        let shifted = b.node(Op::Shift(shift, x, amounts), 12, row);
        b.output(name, shifted);
    }
    b.module.clone()
}

/// Comparisons with constants that lanes take from others: every second one of two interleaved rows, and the next one
/// of a row of a grid.
pub fn passed_constants() -> Module {
    let b = &mut Build::new("passed_constants");
    let x = b.input("x", 2, Shape::Row(4));
    let (even, odd) = (list(b, 2, &[3, 1, 2, 0]), list(b, 2, &[0, 1, 3, 2]));
    let woven = b.node(Op::Interleave { parts: vec![even, odd], axis: 0 }, 2, Shape::Row(8));
    let index = Affine { mul: 2, add: 1, div: 1 };
    let second = b.node(Op::Map { of: woven, axis: 0, index, edge: None }, 2, Shape::Row(4));
    let grid = b.stack(&[even, odd], 0);
    let (index, edge) = (Affine { mul: 1, add: 1, div: 1 }, list(b, 2, &[3, 0]));
    let next = b.node(Op::Map { of: grid, axis: 1, index, edge: Some(edge) }, 2, Shape::Grid(2, 4));
    let rows = b.broadcast(x, 0, 2);
    for (name, relation, operands, shape) in
        [("less", Relation::Lt, [second, x], Shape::Row(4)), ("reached", Relation::Ge, [rows, next], Shape::Grid(2, 4))]
    {
        let output = b.node(Op::Compare { relation, signed: false, operands }, 1, shape);
        b.output(name, output);
    }
    b.module.clone()
}

/// A comparison outside of lanes with the low bits of a lane that is 8.
pub fn constant_in_a_lane() -> Module {
    let b = &mut Build::new("constant_in_a_lane");
    let (x, value) = (b.input("x", 3, Shape::Plain), b.input("value", 4, Shape::Row(3)));
    let edge = b.constant(4, 8, Shape::Plain);
    let moved = b.map(value, 0, 8, Affine::shift(-3), Some(edge));
    let low = b.node(Op::Slice { of: moved, low: 0 }, 3, Shape::Row(8));
    let lanes = b.delayed("lanes", low);
    b.next(lanes, None, low);
    b.output("lanes_before", lanes);
    let last = b.node(Op::Lane { of: low, axis: 0, index: 7 }, 3, Shape::Plain);
    let less = b.node(Op::Compare { relation: Relation::Lt, signed: false, operands: [x, last] }, 1, Shape::Plain);
    b.output("less", less);
    b.module.clone()
}

/// The inputs of rows of registers, and values beside them, are computed from a constant for each row.
pub fn entered_constants() -> Module {
    let b = &mut Build::new("entered_constants");
    let x = b.input("x", 3, Shape::Row(2));
    let numbers = [2, 3].map(|number| b.constant(3, number, Shape::Plain));
    let numbers = b.stack(&numbers, 0);
    let entered = b.xor(numbers, x);
    let value = b.register("value", 3, Shape::Grid(2, 4), zero(3));
    let next = b.map(value, 1, 4, Affine::shift(-1), Some(entered));
    b.next(value, None, next);
    let sum = b.add(numbers, x);
    let beside = b.stack(&[x, sum], 1);
    b.output("values", value);
    b.output("beside", beside);
    b.module.clone()
}

/// Rows in rows, down four levels, of arrays, rows and trees with the same names at each level; enough that some are
/// inlined and some are not.
pub fn nested() -> Vec<Module> {
    let mut modules = Vec::new();
    for (level, lanes) in [2, 2, 2, 40].into_iter().enumerate() {
        let b = &mut Build::new(&format!("nested{level}"));
        let row = Shape::Row(lanes);
        let x = b.input("x", 2, Shape::Plain);
        let inner = match modules.last() {
            None => b.input("y", 2, row),
            Some(child) => {
                let x = b.everywhere(x, row);
                let y = b.input("y", 2, Shape::Row(2));
                let y = b.broadcast(y, 0, lanes);
                b.instance("u_cell", level as u32 - 1, child, row, &[x, y])[0]
            }
        };
        let before = b.previous(inner, 0, x);
        let total = b.reduce(Reduction::Add, before, 0);
        b.output("total", total);
        modules.push(b.module.clone());
    }
    modules
}

/// A choice by a value of a later lane.
pub fn chosen_by_another() -> Module {
    let b = &mut Build::new("chosen_by_another");
    let row = Shape::Row(3);
    let (x, y) = (b.input("x", 2, row), b.input("y", 2, row));
    let value = b.add(x, y);
    b.named("value", value);
    let mirrored = b.map(value, 0, 3, Affine { mul: -1, add: 2, div: 1 }, None);
    let values: Vec<NodeId> = (0..3).map(|value| b.constant(2, value ^ 2, row)).collect();
    let chosen = b.case(mirrored, &values, x);
    b.output("chosen", chosen);
    let sum = b.add(mirrored, y);
    let later = b.case(sum, &values, mirrored);
    b.output("later", later);
    b.module.clone()
}

/// The maximum and the minimum of lanes, every second of which is computed to be an end of the range, and comparisons
/// with them.
pub fn ends_in_some_lanes() -> Module {
    let b = &mut Build::new("ends_in_some_lanes");
    let x = b.input("x", 4, Shape::Plain);
    let nothing = b.constant(4, 0, Shape::Plain);
    let parts: Vec<NodeId> = (0..6).map(|lane| if lane % 2 == 0 { x } else { nothing }).collect();
    let listed = b.stack(&parts, 0);
    let double = b.add(listed, listed);
    let inverse = b.not(double);
    for (name, by, of) in [("most", Reduction::Max, inverse), ("least", Reduction::Min, double)] {
        let output = b.reduce(by, of, 0);
        b.output(name, output);
    }
    let y = b.input("y", 4, Shape::Row(6));
    let below = b.node(Op::Compare { relation: Relation::Lt, signed: false, operands: [y, double] }, 1, Shape::Row(6));
    b.output("below", below);
    // Two of the lanes are shifted beyond their width.
    let far = b.constant(4, 12, Shape::Plain);
    let parts: Vec<NodeId> = (0..6).map(|lane| if lane < 4 { x } else { far }).collect();
    let amounts = b.stack(&parts, 0);
    for (name, shift) in [("left", Shift::Left), ("right", Shift::Right)] {
        let shifted = b.node(Op::Shift(shift, y, amounts), 4, Shape::Row(6));
        let inverse = b.not(shifted);
        let operands = [inverse, y];
        let below = b.node(Op::Compare { relation: Relation::Lt, signed: false, operands }, 1, Shape::Row(6));
        b.output(name, below);
    }
    b.module.clone()
}

/// A list in which each entry is computed from the previous one, and a comparison with it: the second entry is always
/// zero.
pub fn listed_of_each_other() -> Module {
    let b = &mut Build::new("listed_of_each_other");
    let row = Shape::Row(3);
    let (x, y) = (b.input("x", 4, Shape::Plain), b.input("y", 4, row));
    let list = NodeId(y.0 + 5);
    let mut entries = vec![x];
    for index in 0..2 {
        let before = b.node(Op::Lane { of: list, axis: 0, index }, 4, Shape::Plain);
        entries.push(b.xor(before, x));
    }
    assert_eq!(b.stack(&entries, 0), list);
    let below = b.node(Op::Compare { relation: Relation::Lt, signed: false, operands: [y, list] }, 1, row);
    b.output("below", below);
    b.module.clone()
}

/// A shift by the second entry of a list in which each entry is computed from the previous one: it is always zero.
pub fn shifted_by_an_entry() -> Module {
    let b = &mut Build::new("shifted_by_an_entry");
    let (x, y) = (b.input("x", 24, Shape::Plain), b.input("y", 24, Shape::Plain));
    let list = NodeId(y.0 + 3);
    let before = b.node(Op::Lane { of: list, axis: 0, index: 0 }, 24, Shape::Plain);
    let second = b.xor(before, x);
    assert_eq!(b.stack(&[x, second], 0), list);
    let amount = b.node(Op::Lane { of: list, axis: 0, index: 1 }, 24, Shape::Plain);
    let shifted = b.node(Op::Shift(Shift::Left, y, amount), 24, Shape::Plain);
    b.output("shifted", shifted);
    b.module.clone()
}

/// Two choices, each of which reads three nets. What one of them reads is two nets outside, which the other one reads
/// as well.
pub fn fed_twice() -> Vec<Module> {
    let b = &mut Build::new("choices");
    let [steps, p, q, c] = ["steps", "p", "q", "c"].map(|name| b.input(name, 2, Shape::Plain));
    for (name, subject, value) in [("by_steps", steps, p), ("by_input", p, q)] {
        let inverse = b.not(value);
        let chosen = b.case(subject, &[value, c, inverse], c);
        b.output(name, chosen);
    }
    let child = b.module.clone();
    let b = &mut Build::new("fed_twice");
    let (x, c) = (b.input("x", 2, Shape::Plain), b.input("c", 2, Shape::Plain));
    let steps = b.register("steps", 2, Shape::Plain, zero(2));
    let one = b.constant(2, 1, Shape::Plain);
    let next = b.add(steps, one);
    b.next(steps, None, next);
    let outputs = b.instance("u_choices", 0, &child, Shape::Plain, &[steps, x, x, c]);
    for (name, output) in ["by_steps", "by_input"].into_iter().zip(outputs) {
        b.output(name, output);
    }
    vec![child, b.module.clone()]
}
