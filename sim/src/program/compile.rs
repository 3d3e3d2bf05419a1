//! From a design to a program: flatten, unroll arrays that have to be, simplify, schedule.

use std::collections::BTreeSet;

use tilewright_hdl::ir::Design;

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
    let mut unrolled = BTreeSet::new();
    loop {
        let mut netlist = flatten::flatten(design, &unrolled, passes);
        match order::order(&netlist) {
            Ok(order) => {
                simplify::simplify(&mut netlist, &order, passes);
                return Ok(Program { passes: passes.clone(), ..schedule::schedule(netlist) });
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
