//! From a design to a program: flatten, unroll arrays that have to be, simplify, schedule.

use std::collections::BTreeSet;

use tilewright_hdl::ir::{Design, Instance};

use super::netlist::{ArrayKey, Netlist};
use super::{Passes, Program, ValueId, flatten, order, schedule, simplify};

/// A combinational cycle, which elaboration should have reported.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the circuit has a combinational cycle through {}: put a register into it", .hops.join(", "))]
pub struct Looping {
    /// Nodes on the cycle: module, name if it has one, and place in the source.
    pub hops: Vec<String>,
}

/// Compiles a design.
///
/// An instance array whose lanes depend on each other within a clock cycle would be a cycle if all its lanes were
/// evaluated at once; such an array, and no other, is run as single instances.
pub fn compile(design: &Design, passes: &Passes) -> Result<Program, Looping> {
    compile_lanes(design, 1, passes)
}

/// As [`compile`], for so many runs of the design side by side: lane `i` of the top module, and of all that is in it,
/// is run `i`.
///
/// # Panics
///
/// There are no lanes, or more than [`most_lanes`].
pub fn compile_lanes(design: &Design, lanes: u32, passes: &Passes) -> Result<Program, Looping> {
    let most = most_lanes(design);
    assert!((1..=most).contains(&lanes), "a program of this design has from 1 to {most} lanes, not {lanes}");
    let mut unrolled = BTreeSet::new();
    loop {
        let mut netlist = flatten::flatten(design, lanes, &unrolled, passes);
        match order::order(&netlist) {
            Ok(order) => {
                simplify::simplify(&mut netlist, &order, passes);
                return Ok(schedule::schedule(netlist, passes));
            }
            Err(cycle) => {
                let arrays = arrays_on(&netlist, &cycle);
                if arrays.is_empty() {
                    return Err(looping(design, &netlist, &cycle));
                }
                unrolled.extend(arrays);
            }
        }
    }
}

/// The most lanes that a value has.
const MOST_LANES: u64 = 1 << 20;

/// How many runs of a design a program can have: no value may come to more than 2 to the 20 lanes, unless it does in
/// a single run.
pub fn most_lanes(design: &Design) -> u32 {
    let mut widest: Vec<u64> = Vec::new();
    for module in design.modules() {
        let nodes = module.nodes.iter().map(|node| u64::from(node.lanes.unwrap_or(1)));
        let inside = |instance: &Instance| u64::from(instance.lanes.unwrap_or(1)) * widest[instance.module.0 as usize];
        let lanes = nodes.chain(module.instances.iter().map(inside)).max();
        widest.push(lanes.unwrap_or(1).max(1));
    }
    let most = MOST_LANES / widest.last().copied().unwrap_or(1);
    most.max(1) as u32
}

/// The arrays that a cycle leads through.
fn arrays_on(netlist: &Netlist, cycle: &[ValueId]) -> Vec<ArrayKey> {
    let on_cycle = |value: &ValueId| cycle.binary_search(value).is_ok();
    netlist.array_outputs.iter().filter(|(value, _)| on_cycle(value)).map(|(_, key)| key.clone()).collect()
}

fn looping(design: &Design, netlist: &Netlist, cycle: &[ValueId]) -> Looping {
    let hop = |value: &ValueId| {
        let (module, node) = netlist.cell(*value).origin?;
        let module = design.module(module);
        let node = &module.nodes[node as usize];
        let name = node.name.as_deref().map(|name| format!("{name}, ")).unwrap_or_default();
        Some(format!("`{}` ({name}{})", module.name, node.loc))
    };
    Looping { hops: cycle.iter().filter_map(hop).take(8).collect() }
}
