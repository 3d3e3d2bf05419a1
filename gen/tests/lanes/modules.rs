//! Modules with lanes about which no linter complains.

use super::build::Build;
use tilewright_hdl::Bits;
use tilewright_hdl::ir::*;

pub fn zero(width: u32) -> Option<Init> {
    Some(Init::Same(Bits::zero(width)))
}

/// A row of counters with different limits, which wake their neighbours.
pub fn counters() -> Module {
    let b = &mut Build::new("counters");
    let row = Shape::Row(5);
    let (go, limits) = (b.input("go", 1, Shape::Plain), b.input("limits", 8, row));
    let starts = [9, 7, 0, 200, 3].map(|value| Bits::new(8, value)).to_vec();
    let count = b.register("count", 8, row, Some(Init::Each(starts)));
    let done = b.node(Op::Compare { relation: Relation::Ge, signed: false, operands: [count, limits] }, 1, row);
    b.named("done", done);
    let woken = b.previous(done, 0, go);
    let one = b.constant(8, 1, row);
    let more = b.add(count, one);
    let nothing = b.constant(8, 0, row);
    let next = b.mux(done, nothing, more);
    b.next(count, Some(woken), next);
    let any = b.reduce(Reduction::Or, done, 0);
    b.output("any", any);
    let most = b.reduce(Reduction::Max, count, 0);
    b.output("most", most);
    b.output("counts", count);
    let idle = b.not(done);
    let reached = b.node(Op::Compare { relation: Relation::Ge, signed: false, operands: [count, limits] }, 1, row);
    let holds = b.or(idle, reached);
    b.assert(holds, "done at the limit");
    b.module.clone()
}

/// A tree in one row: the input at the root is at the leaves after three clocks, with the path that led there.
pub fn tree() -> Module {
    let b = &mut Build::new("tree");
    let (nodes, parent) = (15, Affine { mul: 1, add: -1, div: 2 });
    let root = b.input("root", 4, Shape::Plain);
    let value = b.register("value", 4, Shape::Row(nodes), zero(4));
    let above = b.map(value, 0, nodes, parent, Some(root));
    let numbers: Vec<NodeId> = (0..u64::from(nodes)).map(|i| b.constant(4, i, Shape::Plain)).collect();
    let number = b.stack(&numbers, 0);
    let sum = b.xor(above, number);
    b.next(value, None, sum);
    let leaves = b.map(value, 0, 8, Affine::shift(7), None);
    let (left, right) = (
        b.map(leaves, 0, 4, Affine { mul: 2, add: 0, div: 1 }, None),
        b.map(leaves, 0, 4, Affine { mul: -2, add: 7, div: 1 }, None),
    );
    let order = b.interleave(&[left, right], 0);
    b.named("order", order);
    b.output("leaves", leaves);
    b.output("order", order);
    b.module.clone()
}

/// Lanes selected by signals: of a port, of registers, of each column of a grid, of constants.
pub fn picks() -> Module {
    let b = &mut Build::new("picks");
    let (words, which) = (b.input("words", 8, Shape::Row(5)), b.input("which", 3, Shape::Plain));
    let (bits, place) = (b.input("bits", 1, Shape::Row(6)), b.input("place", 8, Shape::Plain));
    let (grid, rows) = (b.input("grid", 4, Shape::Grid(3, 4)), b.input("rows", 2, Shape::Row(4)));
    let held = b.delayed("held", words);
    for (name, of, index) in [("of_port", words, which), ("of_row", held, which), ("of_bits", bits, place)] {
        let picked = b.pick(of, 0, index);
        b.output(name, picked);
    }
    let texel = b.delayed("texel", grid);
    let of_columns = b.pick(texel, 0, rows);
    b.output("of_columns", of_columns);
    let low = b.node(Op::Slice { of: which, low: 0 }, 2, Shape::Plain);
    let first = b.lane(held, 0, 0);
    let primes: Vec<NodeId> = [2, 3, 5, 7].iter().map(|&prime| b.constant(8, prime, Shape::Plain)).collect();
    let primes = b.stack(&primes, 0);
    let prime = b.pick(primes, 0, low);
    let prime = b.add(prime, first);
    b.output("prime", prime);
    b.module.clone()
}

/// A memory of lanes with one address, whose enables are masks or not, and one with an address for each lane.
pub fn memories() -> Module {
    let b = &mut Build::new("memories");
    let row = Shape::Row(4);
    let (address, on, mask) =
        (b.input("address", 4, Shape::Plain), b.input("on", 1, Shape::Plain), b.input("mask", 1, row));
    let (data, own) = (b.input("data", 8, row), b.input("own", 3, row));
    let wide = b.memory("wide", 16, 8, row);
    b.module.memories[0].contents = Contents::Each((0..4).map(|lane| vec![Bits::new(8, lane); 2]).collect());
    b.write(wide, mask, address, data);
    let masked = b.read(wide, true, address, Some(mask));
    let whole = b.read(wide, true, address, Some(on));
    let now = b.read(wide, false, address, None);
    let plain = b.memory("plain", 10, 1, Shape::Grid(2, 3));
    let cells = b.input("cells", 1, Shape::Grid(2, 3));
    b.write(plain, on, address, cells);
    let texel = b.read(plain, false, address, None);
    let each = b.memory("each", 6, 8, row);
    b.module.memories[2].contents = Contents::Each((0..4).map(|lane| vec![Bits::new(8, 16 + lane)]).collect());
    b.write(each, mask, own, data);
    let later = b.read(each, true, own, Some(mask));
    let outputs = [("masked", masked), ("whole", whole), ("now", now), ("texel", texel), ("later", later)];
    outputs.map(|(name, node)| b.output(name, node)).iter().for_each(drop);
    b.module.clone()
}

/// A block with ports that have lanes: the sum of a row, and the row in reverse.
pub fn sums(inputs: u32) -> Module {
    let b = &mut Build::new(&format!("sums{inputs}"));
    let x = b.input("x", 8, Shape::Row(inputs));
    let sum = b.reduce(Reduction::Add, x, 0);
    let reverse = b.map(x, 0, inputs, Affine { mul: -1, add: inputs as i32 - 1, div: 1 }, None);
    let smallest = b.reduce(Reduction::Min, x, 0);
    b.output("sum", sum);
    b.output("reverse", reverse);
    b.output("smallest", smallest);
    b.module.clocks.clear();
    b.module.inputs[0].clock = None;
    b.module.clone()
}

/// Instances of [`sums`], single and in a row, fed by packed ports.
pub fn packed_ports() -> Vec<Module> {
    let child = sums(3);
    let b = &mut Build::new("packed_ports");
    let (x, word) = (b.input("x", 8, Shape::Grid(4, 3)), b.input("word", 12, Shape::Plain));
    let state = b.delayed("state", x);
    let outputs = b.instance("u_row", 0, &child, Shape::Row(4), &[state]);
    let columns = b.reduce(Reduction::Xor, outputs[1], 0);
    let single = b.instance("u_single", 0, &child, Shape::Plain, &[columns]);
    let nibbles = b.unpack(word, 0, 3);
    let packed = b.node(Op::Extend { of: nibbles, signed: true }, 8, Shape::Row(3));
    let packed = b.binary(Binary::Sub, packed, columns);
    let packed = b.pack(packed, 0);
    b.output("sums", outputs[0]);
    b.output("smallest", outputs[2]);
    b.output("single", single[0]);
    b.output("turned", single[1]);
    b.output("lanes", packed);
    vec![child, b.module.clone()]
}

/// A row that a grid reads, and that reads the grid; and sums that ripple through lanes without a register.
pub fn rings() -> Module {
    let b = &mut Build::new("rings");
    let (row, grid) = (Shape::Row(3), Shape::Grid(3, 4));
    let (x, first) = (b.input("x", 8, row), b.input("first", 8, Shape::Plain));
    let total = b.register("total", 8, row, zero(8));
    let totals = b.broadcast(total, 1, 4);
    let cell = b.register("held", 8, grid, zero(8));
    let mixed = b.add(cell, totals);
    b.next(cell, None, mixed);
    let largest = b.reduce(Reduction::Max, cell, 1);
    let sum = b.add(largest, x);
    b.next(total, None, sum);
    // Each lane adds to the previous one.
    let rippled = b.add(x, x);
    b.named("rippled", rippled);
    let before = b.previous(rippled, 0, first);
    b.module.nodes[rippled.0 as usize].op = Op::Binary(Binary::Add, x, before);
    let last = b.lane(rippled, 0, 2);
    b.output("last", last);
    b.output("held_out", cell);
    b.module.clone()
}

/// Constants by row, by column, by number and by table, in a grid; lanes in reverse, every second one, and lists of rows.
pub fn constants() -> Module {
    let b = &mut Build::new("constants");
    let (rows, columns) = (3, 4);
    let x = b.input("x", 8, Shape::Grid(rows, columns));
    let mut all = x;
    let values: [fn(u64, u64) -> u64; 4] = [
        |row, _| 10 * row,
        |_, column| column,
        |row, column| row * 4 + column,
        |row, column| (row * row + 3 * column) % 7,
    ];
    for value in values {
        let parts: Vec<NodeId> = (0..u64::from(rows))
            .map(|row| {
                let row: Vec<NodeId> =
                    (0..u64::from(columns)).map(|column| b.constant(8, value(row, column), Shape::Plain)).collect();
                b.stack(&row, 0)
            })
            .collect();
        let constant = b.stack(&parts, 0);
        all = b.add(all, constant);
    }
    b.named("all", all);
    let reverse = b.map(all, 1, columns, Affine { mul: -1, add: columns as i32 - 1, div: 1 }, None);
    let second = b.map(reverse, 0, 2, Affine { mul: 2, add: 0, div: 1 }, None);
    let (top, bottom) = (b.lane(second, 0, 0), b.lane(second, 0, 1));
    let difference = b.binary(Binary::Sub, top, bottom);
    b.named("difference", difference);
    let listed = b.stack(&[difference, top, bottom], 0);
    let beyond = b.map(listed, 1, 6, Affine { mul: 1, add: -1, div: 1 }, None::<NodeId>);
    let edge = b.lane(x, 1, 0);
    let node = &mut b.module.nodes[beyond.0 as usize];
    let Op::Map { edge: beyond_edge, .. } = &mut node.op else { unreachable!() };
    *beyond_edge = Some(edge);
    b.output("shown", beyond);
    b.output("corner", all);
    b.module.clone()
}

/// Two rows of instances that feed each other through registers, and a grid of them.
pub fn arrays() -> Vec<Module> {
    let child = sums(2);
    let b = &mut Build::new("arrays");
    let row = Shape::Row(4);
    let x = b.input("x", 8, row);
    let (first, second) = (b.register("first", 8, row, zero(8)), b.register("second", 8, row, zero(8)));
    let pair = |b: &mut Build, a, c| b.stack(&[a, c], 1);
    let fed = pair(b, second, x);
    let one = b.instance("u_one", 0, &child, row, &[fed]);
    b.next(first, None, one[0]);
    let fed = pair(b, first, x);
    let two = b.instance("u_two", 0, &child, row, &[fed]);
    let before = b.lane(two[1], 1, 1);
    b.next(second, None, before);
    b.output("first_out", first);
    b.output("reversed", one[1]);
    b.output("smallest", two[2]);
    // A child without lanes in a grid.
    let cell = adder();
    let (wide, tall) = (b.broadcast(x, 0, 3), b.input("tall", 8, Shape::Row(3)));
    let above = b.instance("u_cell", 1, &cell, Shape::Grid(3, 4), &[wide, wide])[0];
    let left = b.previous(above, 1, tall);
    b.module.instances.last_mut().unwrap().inputs[0] = left;
    b.output("added", above);
    vec![child, cell, b.module.clone()]
}

fn adder() -> Module {
    let b = &mut Build::new("adder");
    let (x, y) = (b.input("x", 8, Shape::Plain), b.input("y", 8, Shape::Plain));
    let sum = b.add(x, y);
    b.output("sum", sum);
    b.module.clocks.clear();
    b.module.inputs.iter_mut().for_each(|input| input.clock = None);
    b.module.clone()
}
