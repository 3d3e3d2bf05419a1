//! Loops that may get versions, each for frequent numbers: see the versions of a running engine.

use super::branch;
use super::{Kernel, Plan};
use crate::engine::Passes;
use crate::engine::function::Function;
use crate::engine::program::{Kind, ValueId};
use std::collections::BTreeSet;

/// The most bits of a key: one less than a number has, because 0 means no key.
const KEY: u32 = 63;

/// A loop that may get versions.
#[derive(Debug, Clone)]
pub(crate) struct Versioned {
    pub(crate) lanes: u32,
    /// Without branches.
    pub(crate) kernel: Kernel,
    /// The scalars whose numbers form the key.
    pub subjects: Vec<ValueId>,
}

impl Versioned {
    /// A loop that repeats `times` times; `None` if it is too small, or if one value selects alone, because a branch
    /// serves that.
    pub fn new(function: &Function, kernel: &Kernel, lanes: u32, times: usize, passes: &Passes) -> Option<Versioned> {
        let work = kernel.operations() * times;
        if passes.versions_after == u32::MAX || work < passes.versions_from || !is_plain(function, kernel) {
            return None;
        }
        let subjects = subjects(function, kernel);
        (subjects.len() > 1).then(|| Versioned { lanes, kernel: kernel.clone(), subjects })
    }

    /// Stores all scalars that versions use.
    pub fn store_what_it_takes(&self, function: &Function, plan: &mut Plan) {
        let is_computed = |id: &ValueId| {
            let cell = function.cell(*id);
            cell.lanes == 1 && !matches!(cell.kind, Kind::Const(_) | Kind::State)
        };
        let singles = singles(function, &self.kernel);
        plan.live_out.extend(self.subjects.iter().chain(&singles).copied().filter(is_computed));
    }
}

/// Whether a loop leaves nothing in machine registers and uses nothing in scratch memory.
fn is_plain(function: &Function, kernel: &Kernel) -> bool {
    let is_narrow = |id: ValueId| function.cell(id).width <= 64;
    let is_plain = |id: ValueId| {
        let kind = &function.cell(id).kind;
        let mut is_plain = is_narrow(id) && !matches!(kind, Kind::Reduce { .. });
        kind.for_each_operand(|operand| is_plain &= is_narrow(operand));
        is_plain
    };
    let mut taken = true;
    kernel.sinks.iter().for_each(|&sink| function.sinks[sink].for_each_operand(|id| taken &= is_narrow(id)));
    taken && kernel.cells.iter().all(|&id| is_plain(id))
}

/// The scalars that a loop's choices depend on, those of the most choices first, as many as fit in a key.
fn subjects(function: &Function, kernel: &Kernel) -> Vec<ValueId> {
    let mut scores: Vec<(ValueId, usize)> = branch::choosing(function, kernel).into_iter().collect();
    scores.sort_by_key(|&(id, score)| (std::cmp::Reverse(score), id));
    let mut left = KEY;
    let fits = |&(id, _): &(ValueId, usize)| {
        let width = function.cell(id).width;
        let fits = width <= left;
        left -= if fits { width } else { 0 };
        fits
    };
    scores.into_iter().filter(fits).map(|(id, _)| id).collect()
}

/// The scalars that a loop uses.
fn singles(function: &Function, kernel: &Kernel) -> BTreeSet<ValueId> {
    let mut singles = BTreeSet::new();
    let mut take = |id: ValueId| {
        let of = match function.cell(id).kind {
            Kind::Broadcast { of, .. } => of,
            _ => id,
        };
        singles.insert(of);
    };
    for &id in &kernel.cells {
        take(id);
        function.cell(id).kind.for_each_operand(&mut take);
    }
    kernel.sinks.iter().for_each(|&sink| function.sinks[sink].for_each_operand(&mut take));
    singles.retain(|id| function.cell(*id).lanes == 1);
    singles
}
