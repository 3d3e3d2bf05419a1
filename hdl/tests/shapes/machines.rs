//! Regular machines as circuits: as many nodes as a lane has gates, for any number of lanes.

#![allow(dead_code)] // Each test takes what it needs.

use super::build::Build;
use tilewright_hdl::ir::*;
use tilewright_hdl::{Bits, index_width};

/// The bits of memory of each processor.
const WORDS: u32 = 208;

const ZERO: u64 = 0;

fn zero() -> Option<Init> {
    Some(Init::Same(Bits::zero(1)))
}

/// The sum of two bits a clock, lowest first; `restart`, plain, clears the carry.
fn serial_sum(b: &mut Build, name: &str, x: NodeId, y: NodeId, restart: NodeId) -> NodeId {
    let shape = b.shape(x);
    let held = b.register(&format!("{name}_carry"), 1, shape, zero());
    let keeps = b.not(restart);
    let keeps = b.everywhere(keeps, shape);
    let carry = b.and(held, keeps);
    let half = b.xor(x, y);
    let sum = b.xor(half, carry);
    let (both, passed) = (b.and(x, y), b.and(half, carry));
    let next = b.or(both, passed);
    b.next(held, None, next);
    sum
}

/// `slope * i + start` in lane `i` of `side`, serially: a tree in which each level is twice as wide as the previous
/// one. A left child has its parent's value, a right child adds the slope.
fn tree_of_levels(b: &mut Build, name: &str, side: u32, start: NodeId, slope: NodeId, restart: NodeId) -> NodeId {
    let mut level = b.broadcast(start, 0, 1);
    let (mut slope, mut restart) = (slope, restart);
    let mut depth = 0;
    while b.shape(level).lanes() < side {
        let slopes = b.everywhere(slope, b.shape(level));
        let right = serial_sum(b, &format!("{name}{depth}"), level, slopes, restart);
        let left = b.delayed(&format!("{name}{depth}_left"), level);
        let right = b.delayed(&format!("{name}{depth}_right"), right);
        level = b.interleave(&[left, right], 0);
        slope = b.delayed(&format!("{name}{depth}_slope"), slope);
        restart = b.delayed(&format!("{name}{depth}_restart"), restart);
        depth += 1;
    }
    level
}

/// The same with all levels in one row: node `i` has the parent `(i - 1) / 2`, and the leaves are the last nodes.
fn tree_in_a_row(b: &mut Build, name: &str, side: u32, start: NodeId, slope: NodeId, restart: NodeId) -> NodeId {
    let nodes = 2 * side - 1;
    let parent = Affine { mul: 1, add: -1, div: 2 };
    let row = Shape::Row(nodes);
    let passed_on = |b: &mut Build, what: &str, first: NodeId| {
        let register = b.register(&format!("{name}_{what}"), 1, row, zero());
        let above = b.map(register, 0, nodes, parent, Some(first));
        b.next(register, None, above);
        (register, above)
    };
    let (_, slopes) = passed_on(b, "slope", slope);
    let (_, restarts) = passed_on(b, "restart", restart);
    let (value, above) = passed_on(b, "value", start);
    let bits: Vec<NodeId> = [0, 1].map(|bit| b.constant(1, bit, Shape::Plain)).to_vec();
    // Right children have even numbers; node 0 is not a child.
    let is_right: Vec<NodeId> = (0..nodes).map(|i| bits[usize::from(i > 0 && i % 2 == 0)]).collect();
    let is_right = b.stack(&is_right, 0);
    let added = b.and(slopes, is_right);
    let held = b.register(&format!("{name}_carry"), 1, row, zero());
    let keeps = b.not(restarts);
    let carry = b.and(held, keeps);
    let half = b.xor(above, added);
    let sum = b.xor(half, carry);
    let (both, passed) = (b.and(above, added), b.and(half, carry));
    let next = b.or(both, passed);
    b.next(held, None, next);
    b.next(value, None, sum);
    b.map(value, 0, side, Affine::shift(side as i32 - 1), None)
}

/// A grid of `side` x `side` one-bit processors, each with a memory. All execute the same operations on their own
/// data: the value of a linear expression at their place, and their stored bits.
pub fn processors(side: u32) -> Module {
    let b = &mut Build::new("processors");
    let grid = Shape::Grid(side, side);
    let [dx, dy, start, restart] = ["dx", "dy", "start", "restart"].map(|name| b.input(name, 1, Shape::Plain));
    let address = b.input("address", 8, Shape::Plain);
    let (operation, writes) = (b.input("operation", 3, Shape::Plain), b.input("writes", 1, Shape::Plain));
    let loads_enable = b.input("loads_enable", 1, Shape::Plain);

    let no = b.constant(1, ZERO, Shape::Plain);
    let x = tree_of_levels(b, "x", side, start, dx, restart);
    let y = tree_in_a_row(b, "y", side, no, dy, restart);
    // `x` is the same in all rows, `y` in all columns.
    let (x, y) = (b.broadcast(x, 0, side), b.broadcast(y, 1, side));
    let linear = serial_sum(b, "linear", x, y, restart);
    b.named("linear", linear);

    let memory = b.memory("words", WORDS, 1, grid);
    let read = b.read(memory, false, address, None);
    let enable = b.register("enable", 1, grid, zero());
    let carry = b.register("carry", 1, grid, zero());
    let operation = b.everywhere(operation, grid);

    let half = b.xor(read, linear);
    let sum = b.xor(half, carry);
    let (both, passed) = (b.and(read, linear), b.and(half, carry));
    let carry_out = b.or(both, passed);
    let either = b.or(read, linear);
    let inverse = b.not(linear);
    let result = b.case(operation, &[linear, read, sum, half, both, either], inverse);
    b.named("result", result);
    b.next(carry, Some(enable), carry_out);
    let loads = b.everywhere(loads_enable, grid);
    b.next(enable, Some(loads), result);
    let writes = b.everywhere(writes, grid);
    let stores = b.and(writes, enable);
    b.write(memory, stores, address, result);

    // A row of the frame buffer, and whether any processor is on.
    let row = b.input("row", index_width(side.into()), Shape::Plain);
    let rows = b.broadcast(row, 0, side);
    let shown = b.pick(read, 0, rows);
    let shown = b.pack(shown, 0);
    b.output("shown", shown);
    let of_rows = b.reduce(Reduction::Or, enable, 1);
    let any = b.reduce(Reduction::Or, of_rows, 0);
    b.output("any", any);
    b.module.clone()
}

/// The product of two matrices, a step a clock: `a` enters from the left, `b` from above, and each cell adds to its sum.
pub fn systolic(side: u32) -> Module {
    let b = &mut Build::new("systolic");
    let grid = Shape::Grid(side, side);
    let (left, above) = (b.input("left", 8, Shape::Row(side)), b.input("above", 8, Shape::Row(side)));
    let clear = b.input("clear", 1, Shape::Plain);
    let zero = |width| Some(Init::Same(Bits::zero(width)));
    let (x, y) = (b.register("x", 8, grid, zero(8)), b.register("y", 8, grid, zero(8)));
    let (from_left, from_above) = (b.previous(x, 1, left), b.previous(y, 0, above));
    b.next(x, None, from_left);
    b.next(y, None, from_above);
    let sum = b.register("sum", 16, grid, zero(16));
    let product = b.binary(Binary::Mul, x, y);
    let added = b.add(sum, product);
    let (clear, nothing) = (b.everywhere(clear, grid), b.constant(16, 0, grid));
    let next = b.mux(clear, nothing, added);
    b.next(sum, None, next);
    b.output("product", sum);
    b.module.clone()
}
