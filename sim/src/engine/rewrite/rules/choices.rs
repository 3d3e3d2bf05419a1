//! Choices with known parts.

use super::super::{Rewrite, Rewriter};
use crate::engine::program::{Cell, Kind, ValueId};

/// `mux(1, a, b)` is `a`; `mux(s, a, a)` is `a`.
pub(super) fn mux(rewriter: &mut Rewriter, cell: &Cell) -> Option<Rewrite> {
    let Kind::Mux { select, on_true, on_false } = cell.kind else { return None };
    match rewriter.circuit().known(select) {
        _ if on_true == on_false => Some(Rewrite::Same(on_true)),
        Some(true) => Some(Rewrite::Same(on_true)),
        Some(false) => Some(Rewrite::Same(on_false)),
        None => None,
    }
}

/// Arms that are never taken are removed, and an arm that is always taken becomes the default; a single arm is a
/// `mux`.
pub(super) fn select(rewriter: &mut Rewriter, cell: &Cell) -> Option<Rewrite> {
    let Kind::Select { arms, default } = &cell.kind else { return None };
    let mut default = *default;
    let mut kept: Vec<(ValueId, ValueId)> = Vec::new();
    for &(condition, value) in arms {
        match rewriter.circuit().known(condition) {
            Some(false) => {}
            Some(true) => {
                default = value;
                break;
            }
            None => kept.push((condition, value)),
        }
    }
    while kept.last().is_some_and(|(_, value)| *value == default) {
        kept.pop();
    }
    match kept.as_slice() {
        [] => Some(Rewrite::Same(default)),
        &[(select, on_true)] => Some(Rewrite::As(Kind::Mux { select, on_true, on_false: default })),
        _ => (kept.len() < arms.len()).then_some(Rewrite::As(Kind::Select { arms: kept, default })),
    }
}

/// The arm of a known subject is taken; arms equal to the default are removed.
pub(super) fn case(rewriter: &mut Rewriter, cell: &Cell) -> Option<Rewrite> {
    let Kind::Case { subject, arms, default } = &cell.kind else { return None };
    if let Some(subject) = rewriter.circuit().constant(*subject) {
        let taken = arms.iter().find(|(key, _)| key == subject);
        return Some(Rewrite::Same(taken.map_or(*default, |(_, value)| *value)));
    }
    let kept: Vec<_> = arms.iter().filter(|(_, value)| value != default).cloned().collect();
    match kept.len() {
        0 => Some(Rewrite::Same(*default)),
        left if left == arms.len() => None,
        _ => Some(Rewrite::As(Kind::Case { subject: *subject, arms: kept, default: *default })),
    }
}
