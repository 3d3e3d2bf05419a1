//! Circuits that break a rule of lanes: each rule has its own sentence.

use crate::shapes::build::Build;
use tilewright_hdl::ir::*;
use tilewright_hdl::{Bits, Design};

/// The problems of a module that has a plain value, two rows and a grid to work on.
fn problems(build: impl FnOnce(&mut Build, [NodeId; 4])) -> Vec<String> {
    let b = &mut Build::new("top");
    let shapes = [Shape::Plain, Shape::Row(4), Shape::Row(3), Shape::Grid(4, 3)];
    let [plain, row, short, grid] = shapes;
    let inputs =
        [("plain", plain), ("row", row), ("short", short), ("grid", grid)].map(|(name, shape)| b.input(name, 8, shape));
    build(b, inputs);
    match Design::new(vec![b.module.clone()]) {
        Ok(_) => Vec::new(),
        Err(problems) => problems.0.into_iter().map(|problem| problem.message).collect(),
    }
}

/// The module is rejected, and this is the first sentence.
#[track_caller]
fn refused(sentence: &str, build: impl FnOnce(&mut Build, [NodeId; 4])) {
    let found = problems(build);
    assert_eq!(found.first().map(String::as_str), Some(sentence), "{found:#?}");
}

/// A node of 8 bits called `x`.
fn x(b: &mut Build, op: Op, shape: Shape) {
    let node = b.node(op, 8, shape);
    b.named("x", node);
}

const ROW: Shape = Shape::Row(4);
const GRID: Shape = Shape::Grid(4, 3);

#[test]
fn sound_ones_are_a_design() {
    let found = problems(|b, [plain, row, short, grid]| {
        let (columns, rows) = (b.broadcast(short, 0, 4), b.broadcast(row, 1, 3));
        let both = b.add(columns, rows);
        let (all, some) = (b.stack(&[short; 4], 0), b.stack(&[row; 3], 1));
        let both = b.add(both, all);
        let both = b.add(both, some);
        let half = b.map(grid, 0, 2, Affine { mul: 2, add: 1, div: 1 }, None);
        let again = b.interleave(&[half, half], 0);
        let both = b.add(both, again);
        let beside = b.previous(both, 1, row);
        let (first, last) = (b.lane(beside, 0, 3), b.lane(beside, 1, 2));
        let (picked, small) = (b.pick(grid, 0, first), b.reduce(Reduction::Min, grid, 1));
        let index = b.node(Op::Slice { of: small, low: 0 }, 3, ROW);
        let chosen = b.pick(grid, 1, index);
        let total = b.reduce(Reduction::Add, picked, 0);
        let total = b.add(total, plain);
        let packed = b.pack(chosen, 0);
        let lanes = b.unpack(packed, 0, 8);
        let holds = b.node(Op::Unary(Unary::AnyOne, lanes), 1, Shape::Row(8));
        b.assert(holds, "some bit");
        for (name, node) in [("last", last), ("total", total), ("lanes", lanes), ("both", both)] {
            b.output(name, node);
        }
    });
    assert_eq!(found, Vec::<String>::new());
}

#[test]
fn elementwise_operations_are_of_one_shape() {
    refused("an operand of `top.x`, `top.short`, has 3 lanes, not 4 lanes", |b, [_, row, short, _]| {
        x(b, Op::Binary(Binary::Add, row, short), ROW);
    });
    refused("an operand of `top.x`, `top.plain`, has no lanes, not 4 x 3 lanes", |b, [plain, _, _, grid]| {
        x(b, Op::Binary(Binary::Add, grid, plain), GRID);
    });
    refused("the operand of `top.x`, `top.grid`, has 4 x 3 lanes, but must be plain", |b, [_, _, _, grid]| {
        x(b, Op::Unary(Unary::Not, grid), Shape::Plain);
    });
    refused("the amount of `top.x`, `top.plain`, has no lanes, not 4 lanes", |b, [plain, row, ..]| {
        x(b, Op::Shift(Shift::Left, row, plain), ROW);
    });
    refused("the subject of `top.x`, `top.plain`, has no lanes, not 4 lanes", |b, [plain, row, ..]| {
        x(b, Op::Case { subject: plain, arms: vec![], default: row }, ROW);
    });
    refused("`top.x` needs at least 1 lane", |b, _| x(b, Op::Const(Bits::zero(8)), Shape::Grid(4, 0)));
}

#[test]
fn an_axis_is_put_in_or_dropped() {
    refused("`top.x` is laid out along axis 1, but has 4 lanes", |b, [plain, ..]| {
        x(b, Op::Broadcast { of: plain, axis: 1 }, ROW);
    });
    refused("the operand of `top.x`, `top.row`, has 4 lanes, not 3 lanes", |b, [_, row, ..]| {
        x(b, Op::Broadcast { of: row, axis: 0 }, GRID);
    });
    refused("a lane of `top.x`, `top.row`, has 4 lanes, not 3 lanes", |b, [_, row, ..]| {
        x(b, Op::Stack { parts: vec![row; 4], axis: 0 }, GRID);
    });
    refused("`top.x` lists 2 signals for 3 lanes", |b, [_, row, ..]| {
        x(b, Op::Stack { parts: vec![row; 2], axis: 1 }, GRID);
    });
    refused("`top.x` goes along axis 1 of `top.row`, which has 4 lanes", |b, [_, row, ..]| {
        x(b, Op::Lane { of: row, axis: 1, index: 0 }, Shape::Plain);
    });
    refused("`top.x` has 4 lanes, but `top.grid` without axis 0 has 3 lanes", |b, [_, _, _, grid]| {
        x(b, Op::Reduce { by: Reduction::Max, of: grid, axis: 0 }, ROW);
    });
    refused("`top.x` is lane 3 of 3", |b, [_, _, _, grid]| x(b, Op::Lane { of: grid, axis: 1, index: 3 }, ROW));
    refused("the operand of `top.x` is node 4000000000 of 5", |b, _| {
        x(b, Op::Reduce { by: Reduction::Max, of: NodeId(4_000_000_000), axis: 0 }, ROW);
    });
    let bit = |b: &mut Build, of| {
        let node = b.node(Op::Lane { of, axis: 0, index: 0 }, 1, Shape::Plain);
        b.named("x", node);
    };
    refused("the operand of `top.x`, `top.row`, has 8 bits, not 1 bit", |b, [_, row, ..]| bit(b, row));
}

#[test]
fn lanes_from_elsewhere() {
    let map = |b: &mut Build, of, axis, index, edge, shape| x(b, Op::Map { of, axis, index, edge }, shape);
    let shift = Affine::shift(-1);
    refused("`top.x` takes 4 lanes from 4, some from beyond the ends, but has no edge", |b, [_, row, ..]| {
        map(b, row, 0, shift, None, ROW);
    });
    let floor = Affine { mul: 1, add: -1, div: 4 };
    refused("`top.x` takes 4 lanes from 4, some from beyond the ends, but has no edge", |b, [_, row, ..]| {
        map(b, row, 0, floor, None, ROW);
    });
    refused("`top.x` takes 4 lanes from 4, none from beyond the ends, but has an edge", |b, [plain, row, ..]| {
        map(b, row, 0, Affine { mul: -1, add: 3, div: 1 }, Some(plain), ROW);
    });
    refused("the edge of `top.x`, `top.plain`, has no lanes, not 4 lanes", |b, [plain, _, _, grid]| {
        map(b, grid, 1, shift, Some(plain), GRID);
    });
    refused("the operand of `top.x`, `top.grid`, has 4 x 3 lanes, not 5 x 3 lanes", |b, [_, row, _, grid]| {
        map(b, grid, 1, shift, Some(row), Shape::Grid(5, 3));
    });
    refused("the operand of `top.x`, `top.plain`, has no lanes, not 4 lanes", |b, [plain, ..]| {
        map(b, plain, 0, shift, Some(plain), ROW);
    });
    refused("`top.x` is laid out along axis 2, but has 4 x 3 lanes", |b, [_, row, _, grid]| {
        map(b, grid, 2, shift, Some(row), GRID);
    });
    refused("`top.x` divides lane numbers by 0", |b, [_, row, ..]| {
        map(b, row, 0, Affine { mul: 1, add: 0, div: 0 }, None, ROW);
    });
}

#[test]
fn parts_that_are_interleaved() {
    refused("`top.x` has 4 lanes, which 3 parts cannot share evenly", |b, [_, row, ..]| {
        x(b, Op::Interleave { parts: vec![row; 3], axis: 0 }, ROW);
    });
    refused("`top.x` has 4 lanes, which 0 parts cannot share evenly", |b, _| {
        x(b, Op::Interleave { parts: vec![], axis: 0 }, ROW);
    });
    refused("a part of `top.x`, `top.row`, has 4 lanes, not 2 lanes", |b, [_, row, ..]| {
        x(b, Op::Interleave { parts: vec![row; 2], axis: 0 }, ROW);
    });
    refused("a part of `top.x`, `top.grid`, has 4 x 3 lanes, not 4 x 1 lanes", |b, [_, _, _, grid]| {
        x(b, Op::Interleave { parts: vec![grid; 3], axis: 1 }, GRID);
    });
}

#[test]
fn picked_and_packed() {
    refused("the index of `top.x`, `top.plain`, has no lanes, not 3 lanes", |b, [plain, _, _, grid]| {
        x(b, Op::Pick { of: grid, axis: 0, index: plain }, Shape::Row(3));
    });
    refused("`top.x` has 8 bits, but its lanes side by side have 32", |b, [_, row, ..]| {
        x(b, Op::Pack { of: row, axis: 0 }, Shape::Plain);
    });
    refused("`top.x` unpacks 8 bits into 4 lanes of 8, which have 32", |b, [plain, ..]| {
        x(b, Op::Unpack { of: plain, axis: 0 }, ROW);
    });
}

#[test]
fn registers() {
    let register = |b: &mut Build, shape, reset| {
        b.register("r", 8, shape, Some(reset));
    };
    let values = |count| Init::Each(vec![Bits::zero(8); count]);
    assert_eq!(problems(|b, _| register(b, GRID, values(12))), Vec::<String>::new());
    refused("`top.r` has 4 x 3 lanes, but 11 reset values", |b, _| register(b, GRID, values(11)));
    refused("`top.r` has no lanes, but 1 reset values", |b, _| register(b, Shape::Plain, values(1)));
    refused("the reset value of `top.r` has 7 bits, not 8", |b, _| {
        register(b, ROW, Init::Each([8, 8, 7, 8].map(Bits::zero).to_vec()));
    });
    refused("the next value of `top.r`, `top.plain`, has no lanes, not 4 lanes", |b, [plain, ..]| {
        let register = b.register("r", 8, ROW, None);
        b.next(register, None, plain);
    });
    refused("the enable of `top.r`, `top.on`, has no lanes, not 4 lanes", |b, [_, row, ..]| {
        let on = b.input("on", 1, Shape::Plain);
        let register = b.register("r", 8, ROW, None);
        b.next(register, Some(on), row);
    });
}

#[test]
fn memories() {
    let words = |b: &mut Build, row: NodeId| {
        let memory = b.memory("words", 256, 8, ROW);
        let (one, each) = (b.input("one", 1, Shape::Plain), b.input("each", 1, ROW));
        let address = b.input("address", 8, Shape::Plain);
        b.read(memory, true, address, Some(one));
        b.read(memory, true, row, Some(each));
        b.write(memory, one, row, row);
        b.write(memory, each, address, row);
        memory.0 as usize
    };
    assert_eq!(
        problems(|b, [_, row, ..]| {
            words(b, row);
        }),
        Vec::<String>::new()
    );
    refused(
        "the address of read port 1 of `top.words`, `top.short`, has 3 lanes, not 4 lanes",
        |b, [_, row, short, _]| {
            let memory = words(b, row);
            b.module.memories[memory].reads[1].address = short;
        },
    );
    refused(
        "the data of write port 0 of `top.words`, `top.plain`, has no lanes, not 4 lanes",
        |b, [plain, row, ..]| {
            let memory = words(b, row);
            b.module.memories[memory].writes[0].data = plain;
        },
    );
    refused("the enable of write port 1 of `top.words`, `top.some`, has 3 lanes, not 4 lanes", |b, [_, row, ..]| {
        let memory = words(b, row);
        let some = b.input("some", 1, Shape::Row(3));
        b.module.memories[memory].writes[1].enable = some;
    });
    refused("the data of read port 0 of `top.words`, `top.word`, has no lanes, not 4 lanes", |b, [_, row, ..]| {
        let memory = words(b, row);
        let node = b.module.memories[memory].reads[0].node;
        b.named("word", node);
        b.module.nodes[node.0 as usize].shape = Shape::Plain;
    });
    refused("memory `top.words` needs at least 1 lane", |b, [_, row, ..]| {
        let memory = words(b, row);
        b.module.memories[memory].shape = Shape::Row(0);
    });
    let contents = |b: &mut Build, row, contents| {
        let memory = words(b, row);
        b.module.memories[memory].contents = contents;
    };
    refused("memory `top.words` has 4 lanes, but contents of 3", |b, [_, row, ..]| {
        contents(b, row, Contents::Each(vec![vec![]; 3]));
    });
    refused("memory `top.words` has 256 words, but contents of 257", |b, [_, row, ..]| {
        contents(b, row, Contents::Each(vec![vec![], vec![Bits::zero(8); 257], vec![], vec![]]));
    });
    refused("the contents of memory `top.words` are not as wide as a word, which has 8 bits", |b, [_, row, ..]| {
        contents(b, row, Contents::Each(vec![vec![], vec![], vec![], vec![Bits::zero(9)]]));
    });
    refused("memory `top.words` has no lanes, but contents of 1", |b, _| {
        b.memory("words", 4, 8, Shape::Plain);
        b.module.memories[0].contents = Contents::Each(vec![vec![]]);
    });
}

#[test]
fn ports_and_instances() {
    let child = |shape| {
        let b = &mut Build::new("child");
        let x = b.input("x", 8, shape);
        b.output("y", x);
        b.module.clone()
    };
    let of = |child: Module, array: Shape, fed: Shape| {
        let b = &mut Build::new("top");
        let x = b.input("x", 8, fed);
        let outputs = b.instance("u_child", 0, &child, array, &[x]);
        b.output("y", outputs[0]);
        match Design::new(vec![child, b.module.clone()]) {
            Ok(_) => String::new(),
            Err(problems) => problems.0[0].message.clone(),
        }
    };
    for (port, array, fed) in [(ROW, Shape::Plain, ROW), (Shape::Plain, GRID, GRID), (Shape::Row(3), ROW, GRID)] {
        assert_eq!(of(child(port), array, fed), "");
    }
    assert_eq!(
        of(child(Shape::Row(3)), ROW, Shape::Grid(3, 4)),
        "input `x` of `top.u_child`, `top.x`, has 3 x 4 lanes, not 4 x 3 lanes"
    );
    let message = {
        let (b, mut child) = (&mut Build::new("top"), child(Shape::Plain));
        let x = b.input("x", 8, GRID);
        b.instance("u_child", 0, &child, GRID, &[x]);
        child.nodes[0].shape = ROW;
        Design::new(vec![child, b.module.clone()]).unwrap_err().0[0].message.clone()
    };
    assert_eq!(
        message,
        "`top.u_child` is an array of 4 x 3 lanes, and its port `x` has 4 lanes: more than two axes in all"
    );
}

#[test]
fn ports_are_vectors() {
    refused("port `top.wide` has 2097152 bits in its 512 x 512 lanes, more than 1048576", |b, _| {
        b.input("wide", 8, Shape::Grid(512, 512));
    });
    refused("port `top.wide` has 2097152 bits in its 262144 lanes, more than 1048576", |b, _| {
        let wide = b.constant(8, 0, Shape::Row(1 << 18));
        b.output("wide", wide);
    });
}

#[test]
fn assertions() {
    refused("the condition of a property of `top`, `top.row`, has 8 bits, not 1 bit", |b, [_, row, ..]| {
        b.assert(row, "a bit");
    });
}

#[test]
fn sizes() {
    refused("`top` has too many lanes: 33554432, more than 16777216", |b, _| {
        b.constant(1, 0, Shape::Grid(1 << 20, 32));
    });
    refused("`top` has a memory of too many 64-bit words in all lanes: 8589934592, more than 4294967296", |b, _| {
        b.memory("words", 1 << 20, 64, Shape::Grid(128, 64));
    });
    refused(
        "`chained` of `top` is on a path that comes back to it, of 67108871 lanes: more than 67108864 are not looked \
         through for a combinational loop",
        |b, [plain, ..]| {
            let rows = 1 << 24;
            let value = b.constant(8, 0, Shape::Row(rows));
            let mut last = value;
            for _ in 0..3 {
                last = b.not(last);
            }
            let end = b.lane(last, 0, 0);
            b.named("chained", end);
            let lanes = b.broadcast(end, 0, 4);
            let first = b.lane(lanes, 0, 0);
            let sum = b.add(first, plain);
            b.module.nodes[value.0 as usize].op =
                Op::Map { of: lanes, axis: 0, index: Affine::shift(-1), edge: Some(sum) };
        },
    );
}
