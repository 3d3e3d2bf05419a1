//! Parts of words, taken from the sources of the words.

use rustc_hash::FxHashMap;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::Unary;

use super::layout::is_bitwise;
use super::{Piece, WIDE};
use crate::engine::program::{Axis, Cell, Circuit, Kind, ValueId};

/// The depth to which choices are followed for a part; beyond that it is a slice.
const DEPTH: u32 = 64;

/// The most parts of a word in which a part is looked for.
const MOST: usize = 1024;

/// A circuit that parts of words are added to. Its values keep their numbers.
pub(super) struct Extract {
    pub circuit: Circuit,
    /// For each value: it is split, so that a part of it does not depend on the others.
    is_split: Vec<bool>,
    made: FxHashMap<(ValueId, Piece), ValueId>,
    repeated: FxHashMap<(ValueId, u32), ValueId>,
}

impl Extract {
    pub fn new(circuit: Circuit, is_split: Vec<bool>) -> Extract {
        Extract { circuit, is_split, made: FxHashMap::default(), repeated: FxHashMap::default() }
    }

    /// A part of a value: each lane gives as many lanes as the part has.
    pub fn part(&mut self, of: ValueId, piece: Piece) -> ValueId {
        self.within(of, piece, DEPTH)
    }

    /// A value, repeated in each lane.
    pub fn repeat(&mut self, of: ValueId, times: u32) -> ValueId {
        if times == 1 {
            return of;
        }
        if let Some(&made) = self.repeated.get(&(of, times)) {
            return made;
        }
        let Cell { ref kind, lanes, width } = self.circuit[of];
        // A value that is the same in all lanes is recognised as such.
        let (from, count) = match *kind {
            Kind::Broadcast { of, .. } if self.circuit[of].lanes == 1 => (of, lanes * times),
            _ => (of, times),
        };
        let kind = Kind::Broadcast { of: from, axis: Axis::last(count) };
        let made = self.circuit.push(Cell::new(kind, lanes * times, width), self.circuit.loc(of));
        self.repeated.insert((of, times), made);
        made
    }

    /// A word assembled from parts, the lowest first.
    pub fn join(&mut self, of: ValueId, parts: &[(Piece, ValueId)]) -> Kind {
        let (lanes, mut all) = (self.circuit[of].lanes, Vec::new());
        for &(piece, part) in parts.iter().rev() {
            all.push(match piece.lanes {
                1 => part,
                count => self.add(of, Kind::Pack { of: part, axis: Axis::last(count) }, lanes, piece.width),
            });
        }
        if let [one] = all[..] { Kind::Alias(one) } else { Kind::Concat(all) }
    }

    fn add(&mut self, like: ValueId, kind: Kind, lanes: u32, width: u32) -> ValueId {
        self.circuit.push(Cell::new(kind, lanes, width), self.circuit.loc(like))
    }

    fn within(&mut self, of: ValueId, piece: Piece, depth: u32) -> ValueId {
        if piece == Piece::all(self.circuit[of].width) {
            return of;
        }
        if let Some(&made) = self.made.get(&(of, piece)) {
            return made;
        }
        let made = match depth {
            0 => None,
            _ => self.of_operands(of, piece, depth - 1),
        };
        let made = made.unwrap_or_else(|| self.cut(of, piece));
        self.made.insert((of, piece), made);
        made
    }

    /// As a slice of the word, with its lanes side by side.
    fn cut(&mut self, of: ValueId, piece: Piece) -> ValueId {
        let Cell { lanes, width, .. } = self.circuit[of];
        let sliced = match piece {
            Piece { low: 0, width: all, .. } if all == width => of,
            _ => self.add(of, Kind::Slice(of, piece.low), lanes, piece.width),
        };
        match piece.lanes {
            1 => sliced,
            count => {
                let unpack = Kind::Unpack { of: sliced, axis: Axis::last(count) };
                self.add(of, unpack, lanes * count, piece.each())
            }
        }
    }

    /// A part of an operation, from parts of its operands.
    fn of_operands(&mut self, of: ValueId, piece: Piece, depth: u32) -> Option<ValueId> {
        let Cell { kind, lanes, width } = self.circuit[of].clone();
        match &kind {
            Kind::Alias(from) => Some(self.within(*from, piece, depth)),
            Kind::Const(bits) => Some(self.constant(of, bits, lanes, piece)),
            Kind::Slice(from, low) => Some(self.within(*from, Piece { low: piece.low + low, ..piece }, depth)),
            Kind::Concat(parts) if parts.len() <= MOST => {
                let parts: Vec<ValueId> = parts.iter().rev().copied().collect();
                self.of_concat(of, &parts, piece, depth)
            }
            Kind::Repeat(from, _) => {
                let each = self.circuit[*from].width;
                let (first, last) = (piece.low / each, (piece.low + piece.width - 1) / each);
                (first == last).then(|| self.within(*from, Piece { low: piece.low % each, ..piece }, depth))
            }
            Kind::Extend(from, false) => {
                let wider = width - self.circuit[*from].width;
                if wider == 0 {
                    return Some(self.within(*from, piece, depth));
                }
                let zeros = self.add(of, Kind::Const(Bits::zero(wider)), lanes, wider);
                self.of_concat(of, &[*from, zeros], piece, depth)
            }
            Kind::Pack { of: row, axis: Axis { count, inner: 1 } } => self.of_pack(of, (*row, *count), piece, depth),
            Kind::Unpack { of: word, axis: Axis { count, inner: 1 } } if piece.low == 0 && piece.width == width => {
                let all = Piece { low: 0, width: width * count, lanes: count * piece.lanes };
                Some(self.within(*word, all, depth))
            }
            _ if width > WIDE && self.is_split.get(of.index()) == Some(&true) => {
                self.of_choice(of, kind, lanes, piece, depth)
            }
            _ => None,
        }
    }

    fn constant(&mut self, of: ValueId, bits: &Bits, lanes: u32, piece: Piece) -> ValueId {
        let values: Vec<Bits> = (0..piece.lanes).map(|lane| piece.of_lane(lane, bits)).collect();
        if values.iter().all(|value| *value == values[0]) {
            return self.add(of, Kind::Const(values[0].clone()), lanes * piece.lanes, piece.each());
        }
        let parts = values.into_iter().map(|value| self.add(of, Kind::Const(value), lanes, piece.each())).collect();
        self.add(of, Kind::Stack { parts, inner: 1 }, lanes * piece.lanes, piece.each())
    }

    /// A part of values side by side, the lowest first.
    fn of_concat(&mut self, of: ValueId, parts: &[ValueId], piece: Piece, depth: u32) -> Option<ValueId> {
        let (mut low, end) = (0, piece.low + piece.width);
        let mut found: Vec<(ValueId, Piece)> = Vec::new();
        for &part in parts {
            let width = self.circuit[part].width;
            let (first, last) = (low.max(piece.low), (low + width).min(end));
            if first < last {
                found.push((part, Piece { low: first - low, width: last - first, lanes: 1 }));
            }
            low += width;
        }
        if let [(part, at)] = found[..] {
            return Some(self.within(part, Piece { lanes: piece.lanes, ..at }, depth));
        }
        if piece.lanes > 1 {
            return Some(self.stack(of, piece, depth));
        }
        let lanes = self.circuit[of].lanes;
        let parts = found.into_iter().rev().map(|(part, at)| self.within(part, at, depth)).collect();
        Some(self.add(of, Kind::Concat(parts), lanes, piece.width))
    }

    /// A part of lanes side by side.
    fn of_pack(&mut self, of: ValueId, row: (ValueId, u32), piece: Piece, depth: u32) -> Option<ValueId> {
        let ((row, count), Cell { lanes, width, .. }) = (row, self.circuit[of].clone());
        let each = width / count;
        if (piece.low, piece.width) == (0, width) && piece.lanes > 1 {
            if piece.lanes.is_multiple_of(count) {
                let within = Piece { low: 0, width: each, lanes: piece.lanes / count };
                return Some(self.within(row, within, depth));
            }
            if count.is_multiple_of(piece.lanes) {
                let axis = Axis::last(count / piece.lanes);
                return Some(self.add(of, Kind::Pack { of: row, axis }, lanes * piece.lanes, piece.each()));
            }
        }
        let (first, last) = (piece.low / each, (piece.low + piece.width - 1) / each);
        if first == last {
            let lane = self.add(of, Kind::Lane { of: row, axis: Axis::last(count), index: first }, lanes, each);
            return Some(self.within(lane, Piece { low: piece.low % each, ..piece }, depth));
        }
        (piece.lanes > 1).then(|| self.stack(of, piece, depth))
    }

    /// Lanes that are parts of a word, one after the other.
    fn stack(&mut self, of: ValueId, piece: Piece, depth: u32) -> ValueId {
        let each =
            (0..piece.lanes).map(|lane| Piece { low: piece.low + lane * piece.each(), width: piece.each(), lanes: 1 });
        let parts = each.map(|lane| self.within(of, lane, depth)).collect();
        let lanes = self.circuit[of].lanes * piece.lanes;
        self.add(of, Kind::Stack { parts, inner: 1 }, lanes, piece.each())
    }

    /// A part of an operation that takes each bit from the same bit of its operands.
    fn of_choice(&mut self, of: ValueId, kind: Kind, lanes: u32, piece: Piece, depth: u32) -> Option<ValueId> {
        let mut part = |it: &mut ValueId| *it = self.within(*it, piece, depth);
        let mut kind = kind;
        // Lanes of the part come after those of the word.
        let behind = |axis: &mut Axis| axis.inner *= piece.lanes;
        match &mut kind {
            Kind::Unary(Unary::Not, a) => part(a),
            Kind::Binary(op, a, b) if is_bitwise(*op) => [a, b].into_iter().for_each(part),
            Kind::Mux { select, on_true, on_false } => {
                [on_true, on_false].into_iter().for_each(part);
                *select = self.repeat(*select, piece.lanes);
            }
            Kind::Select { arms, default } => {
                arms.iter_mut().map(|arm| &mut arm.1).chain([default]).for_each(part);
                arms.iter_mut().for_each(|arm| arm.0 = self.repeat(arm.0, piece.lanes));
            }
            Kind::Case { subject, arms, default } => {
                arms.iter_mut().map(|arm| &mut arm.1).chain([default]).for_each(part);
                *subject = self.repeat(*subject, piece.lanes);
            }
            Kind::Pick { of, axis, index } => {
                part(of);
                *index = self.repeat(*index, piece.lanes);
                behind(axis);
            }
            Kind::Broadcast { of, axis } | Kind::Lane { of, axis, .. } => {
                part(of);
                behind(axis);
            }
            Kind::Stack { parts, inner } => {
                parts.iter_mut().for_each(part);
                *inner *= piece.lanes;
            }
            Kind::Interleave { parts, axis } => {
                parts.iter_mut().for_each(part);
                behind(axis);
            }
            Kind::Map { of, axis, edge, .. } => {
                [of].into_iter().chain(edge.as_mut()).for_each(part);
                behind(axis);
            }
            _ => return None,
        }
        Some(self.add(of, kind, lanes * piece.lanes, piece.each()))
    }
}
