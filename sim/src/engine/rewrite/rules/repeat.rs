//! A value that is the same in all lanes, or in all rows, is computed once and then repeated.

use super::super::{Rewrite, Rewriter};
use super::lift::lift;
use crate::engine::program::{Axis, Cell, Kind, ValueId};

/// Repetitions along two adjacent axes become one.
pub(super) fn of_repeated(rewriter: &mut Rewriter, cell: &Cell) -> Option<Rewrite> {
    let Kind::Broadcast { of, axis } = cell.kind else { return None };
    let Kind::Broadcast { of: plain, axis: before } = rewriter.circuit()[of].kind else { return None };
    let lies_together = axis.inner == before.inner || axis.inner == before.lanes();
    let axis = Axis { count: axis.count * before.count, inner: before.inner };
    lies_together.then_some(Rewrite::As(Kind::Broadcast { of: plain, axis }))
}

/// A row whose lanes are the same in all rows is repeated.
pub(super) fn tile(rewriter: &mut Rewriter, cell: &Cell) -> Option<Rewrite> {
    let Kind::Stack { parts, inner: 1 } = &cell.kind else { return None };
    let row = parts.len() as u32;
    let rows = cell.lanes / row;
    let plain = parts.iter().map(|part| match rewriter.circuit()[*part].kind {
        Kind::Broadcast { of, axis } if axis == Axis::last(rows) => Some(of),
        _ => None,
    });
    let plain = plain.collect::<Option<Vec<ValueId>>>().filter(|_| rows > 1)?;
    let of = match lift(rewriter, &plain, row) {
        Some(of) => of,
        None => rewriter.add(Kind::Stack { parts: plain, inner: 1 }, row, cell.width),
    };
    Some(Rewrite::As(Kind::Broadcast { of, axis: Axis { count: rows, inner: row } }))
}

/// An operation whose operands are all repeated in the same way, or constant, is repeated.
pub(super) fn hoist(rewriter: &mut Rewriter, cell: &Cell) -> Option<Rewrite> {
    if !cell.kind.is_elementwise() {
        return None;
    }
    let circuit = rewriter.circuit();
    let (mut axes, mut is_alike) = (None, true);
    cell.kind.for_each_operand(|operand| match circuit[operand].kind {
        Kind::Broadcast { axis, .. } => is_alike &= *axes.get_or_insert(axis) == axis,
        Kind::Const(_) => {}
        _ => is_alike = false,
    });
    let axis = axes.filter(|_| is_alike)?;
    let (mut kind, lanes) = (cell.kind.clone(), cell.lanes / axis.count);
    kind.rewrite(|operand| {
        *operand = match rewriter.circuit()[*operand].clone() {
            Cell { kind: Kind::Broadcast { of, .. }, .. } => of,
            Cell { kind, width, .. } => rewriter.add(kind, lanes, width),
        }
    });
    let of = rewriter.add(kind, lanes, cell.width);
    Some(Rewrite::As(Kind::Broadcast { of, axis }))
}
