//! A chain from lane to lane is a loop only if a lane depends on itself.

use super::build::Build;
use tilewright_hdl::Design;
use tilewright_hdl::ir::*;

/// The problems of a module, after these others.
fn problems(modules: Vec<Module>) -> Vec<String> {
    match Design::new(modules) {
        Ok(_) => Vec::new(),
        Err(problems) => problems.0.into_iter().map(|problem| problem.message).collect(),
    }
}

const NONE: [&str; 0] = [];

/// A row whose lanes are the exclusive or of an input and of the result of `chain` for the row.
fn row(count: u32, chain: impl FnOnce(&mut Build, NodeId, NodeId) -> NodeId) -> Vec<String> {
    let b = &mut Build::new("top");
    let (first, x) = (b.input("first", 1, Shape::Plain), b.input("x", 1, Shape::Row(count)));
    let value = b.xor(x, x);
    b.named("value", value);
    let other = chain(b, value, first);
    b.named("other", other);
    b.module.nodes[value.0 as usize].op = Op::Binary(Binary::Xor, x, other);
    let last = b.lane(value, 0, count - 1);
    b.output("last", last);
    problems(vec![b.module.clone()])
}

#[test]
fn a_chain_of_neighbours() {
    assert_eq!(row(5, |b, value, first| b.previous(value, 0, first)), NONE);
    assert_eq!(row(5, |b, value, first| b.map(value, 0, 5, Affine::shift(3), Some(first))), NONE);
}

#[test]
fn a_tree_whose_root_is_its_own_parent() {
    let parent = |add| Affine { mul: 1, add, div: 2 };
    assert_eq!(row(7, |b, value, first| b.map(value, 0, 7, parent(-1), Some(first))), NONE);
    assert_eq!(
        row(7, |b, value, _| b.map(value, 0, 7, parent(0), None)),
        ["a combinational loop in `top`: `value[0]` -> `other[0]` -> `value[0]`"]
    );
}

#[test]
fn a_row_in_reverse() {
    let reverse = Affine { mul: -1, add: 3, div: 1 };
    assert_eq!(
        row(4, |b, value, _| b.map(value, 0, 4, reverse, None)),
        ["a combinational loop in `top`: `value[0]` -> `other[3]` -> `value[3]` -> `other[0]` -> `value[0]`"]
    );
}

#[test]
fn a_row_of_a_combination_of_itself() {
    let whole = |b: &mut Build, value, _| {
        let any = b.reduce(Reduction::Or, value, 0);
        b.broadcast(any, 0, 3)
    };
    assert_eq!(row(3, whole), ["a combinational loop in `top`: `value[0]` -> `node 3` -> `other[0]` -> `value[0]`"]);
    let packed = |b: &mut Build, value, _| {
        let packed = b.pack(value, 0);
        b.unpack(packed, 0, 3)
    };
    assert_eq!(row(3, packed), ["a combinational loop in `top`: `value[0]` -> `node 3` -> `other[0]` -> `value[0]`"]);
    let picked = |b: &mut Build, value, first| {
        let picked = b.pick(value, 0, first);
        b.broadcast(picked, 0, 3)
    };
    assert_eq!(row(3, picked), ["a combinational loop in `top`: `value[0]` -> `node 3` -> `other[0]` -> `value[0]`"]);
}

#[test]
fn lanes_that_are_picked_by_lanes() {
    let indexed = |b: &mut Build, value, first| {
        let index = b.lane(value, 0, 0);
        let table = b.broadcast(first, 0, 2);
        let picked = b.pick(table, 0, index);
        let others = [first, picked, picked];
        b.stack(&others, 0)
    };
    assert_eq!(row(3, indexed), NONE);
    let itself = |b: &mut Build, value, first| {
        let index = b.lane(value, 0, 1);
        let table = b.broadcast(first, 0, 2);
        let picked = b.pick(table, 0, index);
        let others = [first, picked, picked];
        b.stack(&others, 0)
    };
    assert_eq!(
        row(3, itself),
        ["a combinational loop in `top`: `value[1]` -> `node 3` -> `node 5` -> `other[1]` -> `value[1]`"]
    );
}

#[test]
fn levels_that_are_interleaved() {
    // Lanes 2 and 3 depend on lanes 0 and 1.
    let upper = |b: &mut Build, value, first| {
        let halves = b.map(value, 0, 2, Affine::shift(0), None);
        let given = b.broadcast(first, 0, 2);
        let in_order = b.interleave(&[given, halves], 0);
        // Lanes 0, 2, 1, 3 of the interleaved row: given, given, halves.
        let lanes = [0, 2, 1, 3].map(|lane| b.lane(in_order, 0, lane));
        b.stack(&lanes, 0)
    };
    assert_eq!(row(4, upper), NONE);
    let same = |b: &mut Build, value, first| {
        let halves = b.map(value, 0, 2, Affine::shift(0), None);
        let given = b.broadcast(first, 0, 2);
        b.interleave(&[halves, given], 0)
    };
    assert_eq!(row(4, same), ["a combinational loop in `top`: `value[0]` -> `node 3[0]` -> `other[0]` -> `value[0]`"],);
}

/// A grid each of whose lanes depends on its neighbours.
fn grid(neighbours: &[(u32, i32)]) -> Vec<String> {
    let (rows, columns) = (3, 4);
    let b = &mut Build::new("top");
    let x = b.input("x", 1, Shape::Grid(rows, columns));
    let edges = [b.input("above", 1, Shape::Row(columns)), b.input("left", 1, Shape::Row(rows))];
    let value = b.xor(x, x);
    b.named("value", value);
    let mut all = x;
    for &(axis, by) in neighbours {
        let count = b.shape(x).extent(axis);
        let neighbour = b.map(value, axis, count, Affine::shift(by), Some(edges[axis as usize]));
        all = b.xor(all, neighbour);
    }
    b.module.nodes[value.0 as usize].op = Op::Wire(all);
    b.output("all", value);
    problems(vec![b.module.clone()])
}

#[test]
fn neighbours_in_two_dimensions() {
    assert_eq!(grid(&[(0, -1), (1, -1)]), NONE);
    assert_eq!(grid(&[(0, 1), (1, -1)]), NONE);
    let found = grid(&[(0, -1), (1, 1), (1, -1)]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].starts_with("a combinational loop in `top`: `value[0][0]` -> `"), "{found:?}");
    assert!(found[0].ends_with(" -> `value[0][0]`"), "{found:?}");
}

/// A module that passes on a row of two.
fn pair() -> Module {
    let b = &mut Build::new("pair");
    let x = b.input("x", 1, Shape::Row(2));
    let y = b.not(x);
    b.output("y", y);
    b.module.clocks.clear();
    b.module.inputs[0].clock = None;
    b.module.clone()
}

/// Instances of [`pair`], each with an output fed back to the other input, of the next instance or its own.
fn pairs(by: i32, from: u32) -> Vec<String> {
    let (b, child) = (&mut Build::new("top"), pair());
    let first = b.input("first", 1, Shape::Plain);
    let placeholder = NodeId(0);
    let y = b.instance("u_pair", 0, &child, Shape::Row(3), &[placeholder])[0];
    b.named("y", y);
    let other = b.lane(y, 1, from);
    let edge = (by != 0).then_some(first);
    let passed = b.map(other, 0, 3, Affine::shift(by), edge);
    b.named("passed", passed);
    let firsts = b.broadcast(first, 0, 3);
    let x = if from == 1 { b.stack(&[passed, firsts], 1) } else { b.stack(&[firsts, passed], 1) };
    b.named("x", x);
    b.module.instances[0].inputs[0] = x;
    b.output("all", y);
    problems(vec![child, b.module.clone()])
}

/// Lane 1 of `y` depends only on lane 1 of `x`, but dependencies of an instance are known for whole ports only.
#[test]
fn a_port_with_lanes_is_one_port() {
    assert_eq!(pairs(-1, 1), NONE);
    assert_eq!(pairs(-1, 0), NONE);
    assert_eq!(
        pairs(0, 1),
        ["a combinational loop in `top`: `y[0][1]` -> `node 2[0]` -> `passed[0]` -> `x[0][0]` -> `y[0][1]`"]
    );
    assert_eq!(
        pairs(0, 0),
        ["a combinational loop in `top`: `y[0][0]` -> `node 2[0]` -> `passed[0]` -> `x[0][1]` -> `y[0][0]`"]
    );
}

/// A memory's plain address is that of all lanes; an address with lanes has one for each.
#[test]
fn words_that_address_their_neighbours_words() {
    let read = |address: fn(&mut Build, NodeId, NodeId) -> NodeId| {
        let b = &mut Build::new("top");
        let first = b.input("first", 2, Shape::Plain);
        let memory = b.memory("words", 4, 2, Shape::Row(3));
        let word = b.read(memory, false, first, None);
        b.named("word", word);
        let address = address(b, word, first);
        b.module.memories[0].reads[0].address = address;
        b.output("word", word);
        problems(vec![b.module.clone()])
    };
    assert_eq!(read(|b, word, first| b.previous(word, 0, first)), NONE);
    assert_eq!(
        read(|b, word, _| b.lane(word, 0, 1)),
        ["a combinational loop in `top`: `word[1]` -> `node 2` -> `word[1]`"]
    );
}
