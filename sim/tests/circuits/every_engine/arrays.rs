//! Instance arrays as lanes, compared with the same circuit as single instances, nested, and unrolled where
//! necessary.

use crate::circuits::engine::{engine, of};
use proptest::prelude::*;
use tilewright_hdl::ir::{Design, Instance, InstanceId, Module as IrModule, Node, NodeId, Op, Reduction, Shape};
use tilewright_hdl::{Bits, Module, ReadUnderWrite, bits, block, constants, elaborate, mux};
use tilewright_sim::Simulation;

block! {
    /// A cell with a memory, a register and a combinational path from its left neighbour.
    struct Cell {
        width: u32,
        /// Whether `at_once` depends on the neighbour within the cycle.
        chained: bool,
    }
    in(self) CellIn { left: bits(self.width), common: bits(self.width), own: bits(self.width) }
    out CellOut { value: _, at_once: _ }
}

impl Cell {
    fn build(&self, m: Module, i: CellIn) -> CellOut {
        let value = m.reg("value", self.width);
        let store = m.memory("store", 4, self.width, ReadUnderWrite::Any);
        store.write(i.own.bit(0), value.slice(0..2), i.left + i.own);
        let read = store.read(i.left.slice(0..2));
        value.next(mux(i.common.bit(0), value + i.left, read ^ (i.common + 3)));
        let seen = if self.chained { i.left } else { i.common };
        CellOut { value: *value, at_once: seen ^ *value }
    }
}

block! {
    /// A chain of cells, linked through `value` or, if chained, through `at_once`.
    struct Row { lanes: u32, width: u32, chained: bool }
    in(self) RowIn { common: bits(self.width), entering: bits(self.width) }
    out RowOut { sum: _, any: _, last: _, all: _ }
}

impl Row {
    fn build(&self, m: Module, i: RowIn) -> RowOut {
        let cell = Cell { width: self.width, chained: self.chained };
        let out = m.array("u_cell", self.lanes, &cell, |a| CellIn {
            left: if self.chained { a.at_once.previous(i.entering) } else { a.value.following(i.entering) },
            common: i.common,
            own: constants(bits(self.width).of(self.lanes), |lane| u64::from(3 * lane % 8)),
        });
        RowOut {
            sum: out.value.sum(),
            any: out.at_once.or_all() ^ out.value.and_all(),
            last: out.at_once.last(),
            all: out.value.xor_all(),
        }
    }
}

/// The same design with every array as single instances, lane by lane: the definition of an array.
fn without_arrays(design: &Design) -> Design {
    Design::new(design.modules().iter().map(single_instances).collect()).unwrap()
}

fn single_instances(module: &IrModule) -> IrModule {
    let mut out = module.clone();
    let count = module.nodes.len();
    // Node `n`'s lane `i` is `lanes[n] + i`.
    let mut lanes = vec![0; count];
    for (index, node) in module.nodes.iter().enumerate() {
        lanes[index] = out.nodes.len() as u32;
        for _ in (0..node.shape.lanes()).filter(|_| !node.shape.is_plain()) {
            out.nodes.push(Node { shape: Shape::Plain, name: None, ..node.clone() });
        }
    }
    let lane = |node: NodeId, i: u32| NodeId(lanes[node.0 as usize] + i);
    let mut instances: Vec<Instance> = Vec::new();
    let mut first = Vec::new();
    for instance in &module.instances {
        first.push(instances.len() as u32);
        let count = instance.shape.lanes();
        for i in 0..count {
            let each = |node: &NodeId| if !instance.shape.is_plain() { lane(*node, i) } else { *node };
            instances.push(Instance {
                name: if !instance.shape.is_plain() { format!("{}_{i}", instance.name) } else { instance.name.clone() },
                shape: Shape::Plain,
                inputs: instance.inputs.iter().map(each).collect(),
                outputs: instance.outputs.iter().map(each).collect(),
                ..instance.clone()
            });
        }
    }
    out.instances = instances;
    for (index, node) in module.nodes.iter().enumerate() {
        let n = if node.shape.is_plain() { 0 } else { node.shape.lanes() };
        for i in 0..n {
            out.nodes[lanes[index] as usize + i as usize].op = match &node.op {
                Op::Output(instance, port) => Op::Output(InstanceId(first[instance.0 as usize] + i), *port),
                Op::Broadcast { of, .. } => Op::Wire(*of),
                Op::Stack { parts, .. } => Op::Wire(parts[i as usize]),
                Op::Map { of, index, edge, .. } => match index.source(i, n) {
                    Some(from) => Op::Wire(lane(*of, from)),
                    None => Op::Wire(edge.unwrap()),
                },
                other => panic!("{other:?} has no lanes"),
            };
        }
        out.nodes[index] = match &node.op {
            Op::Lane { of, index: i, .. } => Node { op: Op::Wire(lane(*of, *i)), ..node.clone() },
            Op::Reduce { by, of, .. } => reduced(&mut out, module, *by, *of, lane, node),
            Op::Output(instance, port) if n == 0 => {
                Node { op: Op::Output(InstanceId(first[instance.0 as usize]), *port), ..node.clone() }
            }
            _ if n > 0 => Node { op: Op::Const(Bits::zero(node.width)), shape: Shape::Plain, ..node.clone() },
            _ => continue,
        };
    }
    out
}

/// A reduction as a chain of two-operand nodes.
fn reduced(
    out: &mut IrModule,
    module: &IrModule,
    by: Reduction,
    of: NodeId,
    lane: impl Fn(NodeId, u32) -> NodeId,
    node: &Node,
) -> Node {
    let op = by.operator().expect("no smallest or largest");
    let mut all = lane(of, 0);
    for i in 1..module.node(of).shape.lanes() {
        out.nodes.push(Node { op: Op::Binary(op, all, lane(of, i)), name: None, ..node.clone() });
        all = NodeId(out.nodes.len() as u32 - 1);
    }
    Node { op: Op::Wire(all), ..node.clone() }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn an_array_is_as_many_instances(
        lanes in 1..9u32,
        width in prop_oneof![3..20u32, Just(64), Just(65), Just(130)],
        chained: bool,
        stimulus in prop::collection::vec((any::<u64>(), any::<u64>()), 1..20),
    ) {
        let design = elaborate(&Row { lanes, width, chained }).unwrap();
        let mut whole = Simulation::from_design(&design).unwrap().on(engine());
        let mut single = Simulation::from_design(&without_arrays(&design)).unwrap().on(engine());
        let lanes_kept = whole.program().hierarchy.scopes.iter().any(|scope| scope.lanes == lanes);
        prop_assert_eq!(lanes_kept, !chained || lanes == 1);
        for (common, entering) in stimulus {
            for sim in [&mut whole, &mut single] {
                sim.set(sim.port("common").unwrap(), Bits::from_limbs(width, &[common, entering, common]));
                sim.set(sim.port("entering").unwrap(), Bits::from_limbs(width, &[entering, common]));
                sim.step();
            }
            for name in ["sum", "any", "last", "all"] {
                let port = whole.port(name).unwrap();
                prop_assert_eq!(whole.get(port), single.get(port), "{}", name);
            }
            for lane in 0..lanes {
                let value = single.peek(&format!("u_cell_{lane}.value")).unwrap();
                for address in 0..4 {
                    let word = single.peek_memory(&format!("u_cell_{lane}.store"), address).unwrap();
                    prop_assert_eq!(whole.peek_memory(&format!("u_cell[{lane}].store"), address).unwrap(), word);
                }
                prop_assert_eq!(whole.peek(&format!("u_cell[{lane}].value")).unwrap(), value.clone());
                prop_assert_eq!(whole.peek(&format!("u_cell[{lane}].lane.value")).unwrap(), value);
            }
        }
    }

    #[test]
    fn a_seed_fills_an_array_alike_in_lanes_and_unrolled(seed in 1..u64::MAX) {
        let start = |chained| {
            let mut sim = of(&Row { lanes: 3, width: 70, chained }).seeded(seed);
            let word = |sim: &Simulation<_, _>, lane| sim.peek_memory(&format!("u_cell[{lane}].store"), 3).unwrap();
            (0..3).map(|lane| (sim.peek(&format!("u_cell[{lane}].value")).unwrap(), word(&sim, lane))).collect::<Vec<_>>()
        };
        prop_assert!(start(false).iter().all(|(value, word)| !value.is_zero() && !word.is_zero()));
        prop_assert_eq!(start(false), start(true));
    }
}

block! {
    /// Rows in an array: lanes of lanes.
    struct Grid { width: u32 }
    in(self) = RowIn { common: bits(self.width), entering: bits(self.width) };
    out GridOut { total: _ }
}

impl Grid {
    fn build(&self, m: Module, i: RowIn) -> GridOut {
        let row = Row { lanes: 3, width: self.width, chained: false };
        let rows = m.array("u_row", 2, &row, |_| RowIn {
            common: i.common,
            entering: constants(bits(self.width).of(2), u64::from),
        });
        m.ignore(&i.entering);
        GridOut { total: rows.sum.sum() }
    }
}

#[test]
fn arrays_nest() {
    for width in [8, 70] {
        let mut sim = of(&Grid { width });
        sim.drive(RowIn { common: 201, entering: 0 });
        sim.run(5);
        let mut total = 0;
        for row in 0..2 {
            let mut alone = of(&Row { lanes: 3, width, chained: false });
            alone.drive(RowIn { common: 201, entering: row });
            alone.run(5);
            for cell in 0..3 {
                let value = sim.peek(&format!("u_row[{row}].u_cell[{cell}].value")).unwrap();
                assert_eq!(value, alone.peek(&format!("u_cell[{cell}].value")).unwrap());
                total += value.to_u128().unwrap();
            }
        }
        assert_eq!(sim.get(sim.o.total).to_u128().unwrap(), total % (1 << width));
        let error = sim.peek("u_row[2].u_cell[0].value").unwrap_err().to_string();
        assert_eq!(error, "there is no signal `u_row[2]`: did you mean `u_row[0]`?");
    }
}

block! {
    /// A chain of adders as deep as it is long.
    struct Deep { depth: u32 }
    in DeepIn { x: bits(32) }
    out DeepOut { y: _ }
}

impl Deep {
    fn build(&self, _: Module, i: DeepIn) -> DeepOut {
        DeepOut { y: (0..self.depth).fold(i.x, |y, _| y + i.x) }
    }
}

#[test]
fn a_chain_100000_deep_compiles_and_runs() {
    let mut sim = of(&Deep { depth: 100_000 });
    sim.set(sim.i.x, 7);
    assert_eq!(sim.get(sim.o.y), 700_007);
}
