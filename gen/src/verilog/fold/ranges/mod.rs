//! Whether the address of a read can be beyond the last word of its memory, as far as the circuit shows.
//!
//! Each node has an interval that contains all values that it ever has. The interval of a register begins with the
//! start value, and grows by the next values until no interval changes. Each arm of a choice is examined under its
//! condition: so a counter that restarts at a limit stays below it.

mod assume;
mod interval;
mod operators;

use crate::verilog::order::operands_first;
use crate::verilog::reads::can_exceed;
use interval::Range;
use std::collections::{BTreeMap, BTreeSet};
use tilewright_circuit::ir::{Init, Memory, Module, NodeId, Op};

/// The depth to which nested choices are examined.
const DEEPEST: u32 = 8;
/// The most nodes that are examined for one node.
const MOST_WORK: u32 = 1024;
/// After this number of rounds, a register that still grows may have any value.
const PATIENT_ROUNDS: usize = 12;
/// After this number of rounds, the search gives up.
const MOST_ROUNDS: usize = 40;
/// Ranges of wider values are not searched.
const WIDEST: u32 = 63;

/// For each memory and read port, whether the address can be beyond the last word.
pub fn beyond(module: &Module) -> Vec<Vec<bool>> {
    let by_width = |memory: &Memory| {
        memory.reads.iter().map(|read| can_exceed(module, memory, read.address)).collect::<Vec<bool>>()
    };
    let mut beyond: Vec<Vec<bool>> = module.memories.iter().map(by_width).collect();
    if beyond.iter().flatten().any(|&can| can)
        && let Some(ranges) = Ranges::of(module, &cone(module, &beyond))
    {
        for (memory, ports) in module.memories.iter().zip(&mut beyond) {
            for (read, can) in memory.reads.iter().zip(ports) {
                *can &= ranges.all[read.address.0 as usize].high >= u64::from(memory.depth);
            }
        }
    }
    beyond
}

/// The nodes on which those addresses depend, operands first.
fn cone(module: &Module, beyond: &[Vec<bool>]) -> Vec<NodeId> {
    let reads = module.memories.iter().zip(beyond).flat_map(|(memory, beyond)| memory.reads.iter().zip(beyond));
    let mut stack: Vec<NodeId> = reads.filter(|(_, can)| **can).map(|(read, _)| read.address).collect();
    let mut is_in = vec![false; module.nodes.len()];
    while let Some(id) = stack.pop() {
        if std::mem::replace(&mut is_in[id.0 as usize], true) {
            continue;
        }
        match &module.node(id).op {
            Op::Register(register) => {
                let register = &module.registers[register.0 as usize];
                stack.extend(register.enable.into_iter().chain([register.next]));
            }
            op => op.for_each_operand(|operand| stack.push(operand)),
        }
    }
    operands_first(module).into_iter().filter(|id| is_in[id.0 as usize]).collect()
}

struct Ranges<'a> {
    module: &'a Module,
    /// For each node, its range in general.
    all: Vec<Range>,
    /// For each node, its range under the assumed conditions, and the earlier ranges to restore.
    known: BTreeMap<NodeId, Range>,
    before: Vec<(NodeId, Option<Range>)>,
    /// The number of nodes that may still be examined for the current one.
    work: u32,
}

impl<'a> Ranges<'a> {
    /// The ranges of all nodes, if they are found soon.
    fn of(module: &'a Module, order: &[NodeId]) -> Option<Ranges<'a>> {
        let is_wanted: BTreeSet<NodeId> = order.iter().copied().collect();
        let limits = limits(module);
        let all = module.nodes.iter().map(|node| Range::of_width(node.width)).collect();
        let mut ranges = Ranges { module, all, known: BTreeMap::new(), before: Vec::new(), work: 0 };
        for register in module.registers.iter().filter(|register| is_wanted.contains(&register.node)) {
            let width = module.width(register.node);
            let reset = register.reset.iter().flat_map(|reset| match reset {
                Init::Each(values) => values.clone(),
                reset => vec![reset.lane(0).clone()],
            });
            let start = reset.chain(register.initial.clone()).map(|value| Range::of_constant(&value));
            // A register with neither value starts with any.
            let start = start.reduce(Range::with).filter(|_| width <= WIDEST);
            ranges.all[register.node.0 as usize] = start.unwrap_or(Range::of_width(width));
        }
        for round in 0..MOST_ROUNDS {
            // With chains of lanes, a node comes before its operands, and nothing is known of it then.
            for &id in order {
                if !matches!(module.node(id).op, Op::Register(_)) {
                    ranges.all[id.0 as usize] = Range::of_width(module.width(id));
                }
            }
            for &id in order {
                if !matches!(module.node(id).op, Op::Register(_)) {
                    ranges.work = MOST_WORK;
                    // The range from the operands is known, but not the one under a choice's condition.
                    let is_choice = matches!(module.node(id).op, Op::Mux { .. } | Op::Select { .. } | Op::Case { .. });
                    let range = ranges.range(id, if is_choice { DEEPEST } else { 1 });
                    ranges.all[id.0 as usize] = range.unwrap_or(Range::of_width(module.width(id)));
                }
            }
            if !ranges.grow(&is_wanted, round, &limits) {
                return Some(ranges);
            }
        }
        None
    }

    /// Extends registers by the values that they take; returns whether that changed anything.
    fn grow(&mut self, is_wanted: &BTreeSet<NodeId>, round: usize, limits: &BTreeSet<u64>) -> bool {
        let module = self.module;
        let mut grown = false;
        for register in module.registers.iter().filter(|register| is_wanted.contains(&register.node)) {
            self.work = MOST_WORK;
            let taken = match register.enable {
                Some(enable) => self.where_it_is(enable, true, register.next, DEEPEST),
                None => self.range(register.next, DEEPEST),
            };
            let Some(taken) = taken else { continue };
            let own = &mut self.all[register.node.0 as usize];
            let all = own.with(taken);
            if all == *own {
                continue;
            }
            grown = true;
            let width = Range::of_width(module.width(register.node));
            let next = limits.range(all.high..).next().copied().unwrap_or(width.high).min(width.high);
            let high = if all.high == own.high { own.high } else { next };
            let low = if all.low == own.low { own.low } else { 0 };
            *own = if round < PATIENT_ROUNDS { Range { low, high } } else { width };
        }
        grown
    }
}

/// The numbers at which growing registers are examined: constants in comparisons, and their neighbours.
fn limits(module: &Module) -> BTreeSet<u64> {
    let mut limits: BTreeSet<u64> = module.memories.iter().map(|memory| u64::from(memory.depth) - 1).collect();
    for node in &module.nodes {
        let Op::Compare { operands, .. } = &node.op else { continue };
        for &operand in operands {
            if let Op::Const(value) = &module.node(operand).op
                && let Some(value) = value.to_u64()
            {
                limits.extend([value.saturating_sub(1), value, value.saturating_add(1)]);
            }
        }
    }
    limits
}

#[cfg(test)]
mod tests;
