//! Scalars that are computed alike become one array.

use rustc_hash::FxHashMap;

use super::super::{Rewrite, Rewriter};
use crate::engine::program::{Axis, Cell, Kind, ValueId};

/// The depth to which expressions are compared.
const DEPTH: u32 = 16;

/// A stack of `a[i] + b` is `a + b`.
pub(super) fn stack(rewriter: &mut Rewriter, cell: &Cell) -> Option<Rewrite> {
    let Kind::Stack { parts, inner: 1 } = &cell.kind else { return None };
    lift(rewriter, parts, cell.lanes).map(Rewrite::Same)
}

/// The array with these lanes, if there is one. If the lanes are computed alike from the lanes of arrays, from
/// constants and from common values, the array is computed in all lanes together.
pub(super) fn lift(rewriter: &mut Rewriter, parts: &[ValueId], lanes: u32) -> Option<ValueId> {
    let is_computed = |part: &ValueId| match rewriter.circuit()[*part].kind {
        Kind::Lane { .. } => true,
        ref kind => kind.is_elementwise(),
    };
    if parts.len() < 2 || !parts.iter().any(is_computed) {
        return None;
    }
    Lift { rewriter, lanes, found: FxHashMap::default() }.array(parts, DEPTH)
}

struct Lift<'a> {
    rewriter: &'a mut Rewriter,
    lanes: u32,
    /// The results so far.
    found: FxHashMap<Vec<ValueId>, Option<ValueId>>,
}

impl Lift<'_> {
    /// An array with these lanes.
    fn array(&mut self, parts: &[ValueId], depth: u32) -> Option<ValueId> {
        if let Some(found) = self.found.get(parts) {
            return *found;
        }
        let found = self.make(parts, depth);
        self.found.insert(parts.to_vec(), found);
        found
    }

    fn make(&mut self, parts: &[ValueId], depth: u32) -> Option<ValueId> {
        let (circuit, n) = (self.rewriter.circuit(), parts.len() as u32);
        let Cell { kind: first, width, .. } = circuit[parts[0]].clone();
        if parts.iter().all(|part| *part == parts[0]) {
            return Some(self.add(Kind::Broadcast { of: parts[0], axis: Axis::last(n) }, width));
        }
        if parts.iter().all(|part| circuit.constant(*part).is_some()) {
            return Some(self.add(Kind::Stack { parts: parts.to_vec(), inner: 1 }, width));
        }
        if let Kind::Lane { of, axis, .. } = first {
            let is_lane = |(index, part): (u32, &ValueId)| circuit[*part].kind == Kind::Lane { of, axis, index };
            return (axis == Axis::last(n) && (0..).zip(parts).all(is_lane)).then_some(of);
        }
        if depth == 0 || !first.is_elementwise() {
            return None;
        }
        let mut operands = Vec::new();
        for column in &self.columns(parts)? {
            operands.push(self.array(column, depth - 1)?);
        }
        let mut operands = operands.into_iter();
        let mut kind = first;
        kind.rewrite(|operand| *operand = operands.next().expect("one for each operand"));
        Some(self.add(kind, width))
    }

    /// For each operand of similar operations, the operands of all of them.
    fn columns(&self, parts: &[ValueId]) -> Option<Vec<Vec<ValueId>>> {
        let circuit = self.rewriter.circuit();
        let form = form(&circuit[parts[0]].kind);
        let mut columns: Vec<Vec<ValueId>> = Vec::new();
        for part in parts {
            let kind = &circuit[*part].kind;
            if self::form(kind) != form {
                return None;
            }
            let mut operands = Vec::new();
            kind.for_each_operand(|operand| operands.push(operand));
            columns.resize_with(operands.len(), Vec::new);
            columns.iter_mut().zip(operands).for_each(|(column, operand)| column.push(operand));
        }
        let of_one_width =
            |column: &Vec<ValueId>| column.iter().all(|operand| circuit[*operand].width == circuit[column[0]].width);
        columns.iter().all(of_one_width).then_some(columns)
    }

    fn add(&mut self, kind: Kind, width: u32) -> ValueId {
        self.rewriter.add(kind, self.lanes, width)
    }
}

/// An operation without its operands.
fn form(kind: &Kind) -> Kind {
    let mut form = kind.clone();
    form.rewrite(|operand| *operand = ValueId(0));
    form
}
