//! The largest number that a value can be, as far as small operations show it: code selects lanes by number.

use rustc_hash::FxHashMap;
use tilewright_circuit::ir::{Binary, Relation};
use tilewright_circuit::top_mask;

use crate::engine::program::{Circuit, Kind, Lowered, ValueId};

/// The longest chain of operations that is followed.
const DEPTH: u32 = 24;

/// Finds the largest numbers of values, each once. A bound that follows from elementwise operations is also true in
/// the padding lanes of the last strip.
pub(super) struct Bounds<'a> {
    circuit: &'a Circuit,
    found: FxHashMap<ValueId, u64>,
}

impl<'a> Bounds<'a> {
    pub fn new(circuit: &'a Circuit) -> Bounds<'a> {
        Bounds { circuit, found: FxHashMap::default() }
    }

    /// No lane of a value is larger.
    pub fn most(&mut self, id: ValueId) -> u64 {
        self.within(id, DEPTH)
    }

    fn within(&mut self, id: ValueId, depth: u32) -> u64 {
        if let Some(&most) = self.found.get(&id) {
            return most;
        }
        let cell = &self.circuit[id];
        let all = if cell.width > 64 { u64::MAX } else { top_mask(cell.width) };
        if depth == 0 {
            return all;
        }
        let most = self.operation(&cell.kind, all, depth - 1).unwrap_or(all).min(all);
        self.found.insert(id, most);
        most
    }

    /// The largest result of an operation whose width allows `all`; `None` if it may reach that.
    fn operation(&mut self, kind: &Kind, all: u64, depth: u32) -> Option<u64> {
        // A larger number wraps to 0.
        let whole = |most: Option<u64>| most.filter(|&most| most <= all);
        match kind {
            Kind::Const(bits) => bits.to_u64(),
            Kind::Mux { select, on_true, on_false } => {
                let taken = self.where_below(*select, *on_true, depth);
                Some(taken.max(self.within(*on_false, depth)))
            }
            Kind::Select { arms, default } => self.greatest(arms.iter().map(|arm| arm.1).chain([*default]), depth),
            Kind::Case { arms, default, .. } => self.greatest(arms.iter().map(|arm| arm.1).chain([*default]), depth),
            Kind::Stack { parts, .. } => self.greatest(parts.iter().copied(), depth),
            Kind::Binary(Binary::Mul, a, b) => whole(self.within(*a, depth).checked_mul(self.within(*b, depth))),
            Kind::Binary(Binary::Add, a, b) => whole(self.within(*a, depth).checked_add(self.within(*b, depth))),
            Kind::Binary(Binary::And, a, b) => Some(self.within(*a, depth).min(self.within(*b, depth))),
            Kind::Slice(of, 0) => whole(Some(self.within(*of, depth))),
            Kind::Alias(of)
            | Kind::Extend(of, false)
            | Kind::Broadcast { of, .. }
            | Kind::Lane { of, .. }
            | Kind::Lowered(Lowered::Gather { of, .. } | Lowered::Slide { of, .. }) => Some(self.within(*of, depth)),
            _ => None,
        }
    }

    fn greatest(&mut self, values: impl Iterator<Item = ValueId>, depth: u32) -> Option<u64> {
        values.map(|id| self.within(id, depth)).max()
    }

    /// The largest number of a value where a flag is 1; the flag may say that the value is less than a constant.
    fn where_below(&mut self, flag: ValueId, value: ValueId, depth: u32) -> u64 {
        let most = self.within(value, depth);
        let limit = match self.circuit[flag].kind {
            Kind::Compare(Relation::Lt, false, less, limit) if less == value => self.circuit.constant(limit),
            _ => None,
        };
        limit.and_then(|limit| limit.to_u64()).map_or(most, |limit| most.min(limit.saturating_sub(1)))
    }
}
