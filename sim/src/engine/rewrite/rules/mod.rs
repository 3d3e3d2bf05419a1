//! The rules, each a few lines: an operation on numbered values, and its replacement.
//!
//! A rule gets a cell that is not in the circuit yet, and may read those that are. It may add cells, which are
//! numbered like all others. Its result must be simpler: fewer or simpler operations, or the same on fewer lanes.

mod choices;
mod constants;
mod lift;
mod logic;
mod names;
mod reduce;
mod repeat;
mod same;
mod taken;
#[cfg(test)]
mod tests;
mod wide;

use super::{Rewrite, Rewriter};
use crate::engine::program::Cell;

type Rule = fn(&mut Rewriter, &Cell) -> Option<Rewrite>;

/// Rules that always apply: engines cannot execute what they remove.
const ALWAYS: [Rule; 1] = [names::name];
/// Rules that compute constants and remove operations without effect.
const FOLD: [Rule; 11] = [
    constants::fold,
    choices::select,
    choices::case,
    choices::mux,
    logic::identity,
    same::operands,
    taken::lane,
    taken::packed,
    reduce::of_reduced,
    wide::lane,
    wide::slice,
];

/// The result of the first rule that applies to an operation.
pub(super) fn apply(rewriter: &mut Rewriter, cell: &Cell) -> Option<Rewrite> {
    let first = |rewriter: &mut Rewriter, rules: &[Rule]| rules.iter().find_map(|rule| rule(rewriter, cell));
    let mut found = first(rewriter, &ALWAYS);
    if found.is_none() && rewriter.passes.fold {
        found = first(rewriter, &FOLD);
    }
    if found.is_none() && rewriter.passes.lift {
        found = lift::stack(rewriter, cell);
    }
    if found.is_none() && rewriter.passes.uniform {
        found = first(rewriter, &[repeat::of_repeated, repeat::tile, repeat::hoist]);
    }
    found
}
