//! From a design to a program: flatten, unroll arrays that have to be, rewrite, schedule.

use std::collections::BTreeSet;

use tilewright_hdl::ir::{Design, Instance};

use super::flatten::{self, ArrayKey, Flat};
use super::{Passes, Program, ValueId, cycles, schedule};
use crate::engine::rewrite;

/// Compiles a design.
///
/// An instance array whose lanes depend on each other within a clock cycle would be a cycle if all its lanes were
/// evaluated at once; such an array, and no other, is run as single instances.
pub fn compile(design: &Design, passes: &Passes) -> Program {
    compile_lanes(design, 1, passes)
}

/// As [`compile`], for so many runs of the design side by side: lane `i` of the top module, and of all that is in it,
/// is run `i`.
///
/// # Panics
///
/// There are no lanes, or more than [`most_lanes`].
pub fn compile_lanes(design: &Design, lanes: u32, passes: &Passes) -> Program {
    let most = most_lanes(design);
    assert!((1..=most).contains(&lanes), "a program of this design has from 1 to {most} lanes, not {lanes}");
    let mut unrolled = BTreeSet::new();
    loop {
        let mut flat = flatten::flatten(design, lanes, &unrolled, passes);
        let cycles = cycles::cycles(&flat.program.circuit);
        if cycles.is_empty() {
            rewrite::simplify(&mut flat.program);
            schedule::schedule(&mut flat.program);
            return flat.program;
        }
        let arrays = arrays_on(&flat, &cycles);
        assert!(!arrays.is_empty(), "a design has no combinational cycle but through the lanes of arrays");
        unrolled.extend(arrays);
    }
}

/// The most lanes that a value has.
const MOST_LANES: u64 = 1 << 20;

/// How many runs of a design a program can have: no value may come to more than 2 to the 20 lanes, unless it does in
/// a single run.
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

/// The arrays that cycles lead through.
fn arrays_on(flat: &Flat, cycles: &[ValueId]) -> Vec<ArrayKey> {
    let on_cycle = |value: &ValueId| cycles.binary_search(value).is_ok();
    flat.array_outputs.iter().filter(|(value, _)| on_cycle(value)).map(|(_, key)| key.clone()).collect()
}
