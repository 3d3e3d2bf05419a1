//! Loops in which nothing would change.
//!
//! The work of an array in a clock often depends on a few values that all lanes share: an opcode that changes no
//! flag, a port that is not written. Or it depends on a flag of each lane, and often no lane has it: a queue that
//! takes no word. From the choices for each register and memory follows a condition on scalars under which it *stays*
//! the same. If all of a loop's stay, one branch skips it. To make this frequent, a loop is first split into
//! independent loops:
//!
//! ```text
//! flag  <- case op { 0: flag, 1: .. }      stays where op == 0    } a loop, left out where op == 0 and not write
//! bytes <- data if write & mine            stays where not write  }
//! sum   <- sum + x                         never                  a loop of its own
//! ```
//!
//! A flag of lanes is of use if it is in a register or if an earlier loop computes it, which then also tells whether any
//! lane has it. Loops that rest under the same condition stay together, and share a branch.

mod flags;
mod stays;

use std::collections::BTreeSet;

use super::parts::{parts, places, together};
use super::{Kernel, Plan, Stage};
use crate::engine::function::Function;
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::program::{Kind, ValueId};
use flags::Flags;
pub(super) use stays::Holds;
use stays::Stays;

/// The least number of strip operations of a loop that is examined: for fewer, a branch saves little.
const LEAST: usize = 256;
/// The least number of strip operations for each scalar operation that decides whether the loop is skipped.
const WORTH: usize = 16;

/// Splits loops, and puts branches around parts that may have nothing to do.
pub(super) fn quiet(function: &mut Function, plan: &mut Plan, strips: &StripSizes) {
    let mut stages = std::mem::take(&mut plan.stages);
    // Flags in registers are combined before all else.
    stages.insert(0, Stage::default());
    // From the last one on: a loop that combines flags for later ones is not split yet.
    for number in (1..stages.len()).rev() {
        let (before, rest) = stages.split_at_mut(number);
        let mut flags = Flags::of(function, before, strips);
        let stage = &mut rest[0];
        for (&lanes, kernel) in &mut stage.kernels {
            let times = times(lanes, strips);
            if work(kernel, times) >= LEAST {
                guard(function, plan, kernel, times, (&mut stage.single, &mut flags));
            }
        }
        flags.place(function, plan, before);
    }
    if stages[0].kernels.is_empty() {
        stages.remove(0);
    }
    plan.stages = stages;
}

/// The number of strips of a loop.
fn times(lanes: u32, strips: &StripSizes) -> usize {
    lanes.div_ceil(strips.strip(lanes)) as usize
}

/// The number of strip operations of a loop.
fn work(kernel: &Kernel, times: usize) -> usize {
    kernel.operations() * times
}

/// Splits a loop if some part of it may be skipped; the deciding condition is computed with the scalars of its stage.
fn guard(
    function: &mut Function,
    plan: &Plan,
    kernel: &mut Kernel,
    times: usize,
    (single, flags): (&mut Vec<ValueId>, &mut Flags),
) {
    let first = function.circuit().len();
    let places = places(kernel);
    let mut parts = parts(function, plan, kernel, &places);
    let mut stays = Stays::new(function, plan, flags);
    for part in &mut parts {
        let may_rest = !part.cells.iter().any(|id| plan.live_out.contains(id));
        let sinks: Vec<usize> = part.sinks.iter().copied().collect();
        part.stays = if may_rest { stays.all(&sinks) } else { Holds::Never };
    }
    let (mut parts, mut made) = (together(parts), BTreeSet::new());
    for part in &mut parts {
        let cells = made_for(function, part.stays, first);
        if cells.len() * WORTH > part.operations() * times {
            part.stays = Holds::Never;
        } else {
            made.extend(cells);
        }
    }
    flags.any.retain(|_, any| any.index() < first || made.contains(any));
    let is_single = |id: &ValueId| {
        let kind = &function.cell(*id).kind;
        !matches!(kind, Kind::Const(_) | Kind::Reduce { .. })
    };
    single.extend(made.into_iter().filter(is_single));
    let kernels = parts.iter().map(|part| part.kernel(function, kernel, &places));
    let mut kernels: Vec<Kernel> = kernels.collect();
    match kernels.len() {
        _ if kernels.iter().all(|kernel| kernel.switch.is_none()) => {}
        1 => kernel.switch = kernels.remove(0).switch,
        _ => kernel.parts = kernels,
    }
}

/// The cells of a condition that were made for this purpose: those from a number on.
fn made_for(function: &Function, stays: Holds, first: usize) -> BTreeSet<ValueId> {
    let mut made = BTreeSet::new();
    let mut open: Vec<ValueId> = if let Holds::If(subject) = stays { vec![subject] } else { Vec::new() };
    while let Some(id) = open.pop() {
        if id.index() >= first && made.insert(id) {
            function.cell(id).kind.for_each_operand(|operand| open.push(operand));
        }
    }
    made
}
