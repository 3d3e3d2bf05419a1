//! From a design to a program: flatten, unroll some arrays, rewrite, schedule.

use std::collections::BTreeSet;

use tilewright_circuit::ir::{Design, Instance, Node, NodeId, Op};

use super::flatten::{self, Flat, Unrolled};
use super::{Passes, Program, ValueId, apart, cycles, schedule};
use crate::engine::rewrite;

/// Compiles a design.
///
/// Lanes that depend on each other within a clock cycle would form a cycle if all of them were evaluated at once.
/// Only such an instance array is run as single instances; for such nodes, each lane is computed separately.
pub fn compile(design: &Design, passes: &Passes) -> Program {
    compile_lanes(design, 1, passes)
}

/// Like [`compile`], for `lanes` runs of the design side by side: lane `i` of the top module, and of everything in
/// it, is run `i`.
///
/// # Panics
///
/// There are no lanes, or more than [`most_lanes`].
pub fn compile_lanes(design: &Design, lanes: u32, passes: &Passes) -> Program {
    let most = most_lanes(design);
    assert!((1..=most).contains(&lanes), "a program of this design has from 1 to {most} lanes, not {lanes}");
    // With several runs, all are busy.
    let arrays = if lanes == 1 { apart::arrays(design, passes) } else { BTreeSet::new() };
    let mut unrolled = Unrolled { apart: arrays.clone(), arrays, ..Unrolled::default() };
    loop {
        let flat = flatten::flatten(design, lanes, &unrolled, passes);
        let cycles = cycles::cycles(&flat.program.circuit);
        if cycles.is_empty() {
            return tidy(flat.program);
        }
        let before = unrolled.clone();
        unroll(design, &flat, &cycles, &mut unrolled);
        assert!(unrolled != before, "a design has no combinational cycle except through lanes");
    }
}

/// Rewrites a program, and orders its values.
pub(crate) fn tidy(program: Program) -> Program {
    let mut program = program;
    rewrite::simplify(&mut program);
    schedule::schedule(&mut program);
    program
}

/// A flattened design; its values are in no particular sequence.
pub(crate) fn flat(design: &Design, passes: &Passes) -> Program {
    let mut program = flatten::flatten(design, 1, &Unrolled::default(), passes).program;
    schedule::assign_to_clocks(&mut program);
    program
}

/// The most lanes of a value.
const MOST_LANES: u64 = 1 << 20;

/// The most runs of a design in one program: no value may have more than 2 to the 20 lanes, unless it does in a
/// single run.
pub fn most_lanes(design: &Design) -> u32 {
    let mut widest: Vec<u64> = Vec::new();
    for module in design.modules() {
        let nodes = module.nodes.iter().map(|node| u64::from(node.shape.lanes()));
        let inside = |instance: &Instance| u64::from(instance.shape.lanes()) * widest[instance.module.0 as usize];
        let lanes = nodes.chain(module.instances.iter().map(inside)).max();
        widest.push(lanes.unwrap_or(1).max(1));
    }
    let most = MOST_LANES / widest.last().copied().unwrap_or(1);
    most.max(1) as u32
}

/// Unrolls the arrays and the nodes with lanes that are on cycles.
fn unroll(design: &Design, flat: &Flat, cycles: &[ValueId], unrolled: &mut Unrolled) {
    let on_cycle = |value: &ValueId| cycles.binary_search(value).is_ok();
    let arrays = flat.array_outputs.iter().filter(|(value, _)| on_cycle(value));
    unrolled.arrays.extend(arrays.map(|(_, key)| key.clone()));
    for (base, module, key) in &flat.instances {
        let nodes = (0..).map(NodeId).zip(&design.module(*module).nodes);
        // A port is one value outside: either its array is unrolled, or its driver.
        let is_port = |node: &Node| matches!(node.op, Op::Input(_) | Op::Output(..));
        let split =
            nodes.filter(|(id, node)| !node.shape.is_plain() && !is_port(node) && on_cycle(&ValueId(base + id.0)));
        let split: BTreeSet<NodeId> = split.map(|(id, _)| id).collect();
        if !split.is_empty() {
            unrolled.nodes.entry(key.clone()).or_default().extend(split);
        }
    }
}
