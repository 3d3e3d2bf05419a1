//! Words, added to a circuit whose lanes they pack.

use rustc_hash::FxHashMap;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Binary, Reduction, Relation, Unary};

use super::choose::Choice;
use super::making::{Making, known, making, repeated};
use crate::engine::program::{Axis, Cell, Circuit, Kind, ValueId};

/// A circuit that words are added to. Its values keep their numbers.
pub(super) struct Words<'a> {
    pub circuit: Circuit,
    choice: &'a Choice,
    /// By value and lanes in a word.
    made: FxHashMap<(ValueId, u32), ValueId>,
}

impl<'a> Words<'a> {
    pub fn new(circuit: Circuit, choice: &'a Choice) -> Words<'a> {
        Words { circuit, choice, made: FxHashMap::default() }
    }

    /// Adds the words of all values that are packed.
    pub fn add(&mut self) {
        for id in self.circuit.needed(self.circuit.ids()) {
            if let Some(&lanes) = self.choice.values.get(&id) {
                let words = self.make(id, lanes);
                self.made.insert((id, lanes), words);
            }
        }
    }

    /// Computes all packed values from their words, and makes operations that use lanes of words use the words.
    pub fn unpack(&mut self, values: impl Iterator<Item = ValueId>) {
        for id in values {
            match self.choice.values.get(&id) {
                None => self.gather(id),
                Some(&lanes) => {
                    let (of, axis) = (self.made[&(id, lanes)], Axis::last(lanes));
                    if self.circuit[of].kind != (Kind::Pack { of: id, axis }) {
                        self.circuit.set_kind(id, Kind::Unpack { of, axis });
                    }
                }
            }
        }
    }

    /// The words of a value, with this number of lanes each.
    pub fn of(&mut self, id: ValueId, lanes: u32) -> ValueId {
        if lanes == 1 {
            return id;
        }
        if let Some(&made) = self.made.get(&(id, lanes)) {
            return made;
        }
        let (words, making) = (self.words(id, lanes), making(&self.circuit, id, lanes));
        let other = self.choice.values.get(&id).and_then(|&other| Some((other, *self.made.get(&(id, other))?)));
        let made = match (making, other) {
            (Some(Making::Constant | Making::Known | Making::Repeated { .. }), _) => self.make(id, lanes),
            (_, Some((other, of))) if other.is_multiple_of(lanes) => {
                self.push(id, Kind::Unpack { of, axis: Axis::last(other / lanes) }, words, lanes)
            }
            (_, Some((other, of))) if lanes.is_multiple_of(other) => {
                self.push(id, Kind::Pack { of, axis: Axis::last(lanes / other) }, words, lanes)
            }
            _ => self.push(id, Kind::Pack { of: id, axis: Axis::last(lanes) }, words, lanes),
        };
        self.made.insert((id, lanes), made);
        made
    }

    /// The words of `on_true` where `select` is high, and of `on_false` elsewhere.
    pub fn choose(&mut self, select: ValueId, lanes: u32, on_true: ValueId, on_false: ValueId) -> ValueId {
        let Cell { lanes: words, width, .. } = self.circuit[on_true];
        let flag =
            |words: &Self, id: ValueId| {
                words.circuit.constant(id).map(Bits::is_zero).filter(|is_zero| {
                    *is_zero || words.circuit.constant(id).is_some_and(|bits| *bits == Bits::ones(width))
                })
            };
        if let Some(plain) = self.same(select, lanes) {
            return self.push(select, Kind::Mux { select: plain, on_true, on_false }, words, width);
        }
        let (is_true, known) = (self.of(select, lanes), [on_true, on_false].map(|id| flag(self, id)));
        let mut logic = |kind| self.push(select, kind, words, width);
        match known {
            [Some(true), _] => {
                let is_false = logic(Kind::Unary(Unary::Not, is_true));
                logic(Kind::Binary(Binary::And, is_false, on_false))
            }
            [Some(false), _] => logic(Kind::Binary(Binary::Or, is_true, on_false)),
            [_, Some(true)] => logic(Kind::Binary(Binary::And, is_true, on_true)),
            _ => {
                let is_false = logic(Kind::Unary(Unary::Not, is_true));
                let there = logic(Kind::Binary(Binary::And, is_true, on_true));
                let elsewhere = logic(Kind::Binary(Binary::And, is_false, on_false));
                logic(Kind::Binary(Binary::Or, there, elsewhere))
            }
        }
    }

    /// For each word, the value common to all its lanes, if there is one.
    pub fn same(&mut self, id: ValueId, lanes: u32) -> Option<ValueId> {
        let Cell { ref kind, width, .. } = self.circuit[id];
        let words = self.words(id, lanes);
        if let Kind::Const(bits) = kind {
            return Some(self.push(id, Kind::Const(bits.clone()), words, width));
        }
        let (of, count) = repeated(&self.circuit, id, lanes)?;
        Some(if count == 1 { of } else { self.push(id, Kind::Broadcast { of, axis: Axis::last(count) }, words, width) })
    }

    /// A flag for each word, high at least if one of its bits is; the same for all words if possible.
    pub fn any(&mut self, id: ValueId, lanes: u32) -> ValueId {
        if let Some(same) = self.same(id, lanes) {
            return same;
        }
        let words = self.words(id, lanes);
        match self.circuit[id].kind.clone() {
            Kind::Case { subject, arms, default } if repeated(&self.circuit, subject, lanes).is_some() => {
                let subject = self.same(subject, lanes).expect("it is repeated");
                let arms = arms.into_iter().map(|(key, value)| (key, self.any(value, lanes))).collect();
                let default = self.any(default, lanes);
                self.push(id, Kind::Case { subject, arms, default }, words, 1)
            }
            Kind::Binary(Binary::And, a, b) => {
                let [a, b] = [a, b].map(|operand| self.any(operand, lanes));
                self.push(id, Kind::Binary(Binary::And, a, b), words, 1)
            }
            _ => self.push(id, Kind::Const(Bits::ones(1)), words, 1),
        }
    }

    /// The words of a memory at an address.
    pub fn word(&mut self, memory: u32, address: ValueId, lanes: u32, width: u32) -> ValueId {
        self.push(address, Kind::Read { memory, address }, lanes, width)
    }

    fn words(&self, id: ValueId, lanes: u32) -> u32 {
        self.circuit[id].lanes / lanes
    }

    pub(super) fn push(&mut self, like: ValueId, kind: Kind, lanes: u32, width: u32) -> ValueId {
        self.circuit.push(Cell::new(kind, lanes, width), self.circuit.loc(like))
    }

    /// Adds the words of a value, from those of its operands.
    fn make(&mut self, id: ValueId, lanes: u32) -> ValueId {
        let (words, making) = (self.words(id, lanes), making(&self.circuit, id, lanes));
        let mut kind = self.circuit[id].kind.clone();
        match making {
            None => kind = Kind::Pack { of: id, axis: Axis::last(lanes) },
            Some(Making::Constant) => {
                let is_zero = self.circuit.constant(id).is_none_or(Bits::is_zero);
                kind = Kind::Const(if is_zero { Bits::zero(lanes) } else { Bits::ones(lanes) });
            }
            Some(Making::Known) => kind = self.known(id, lanes),
            Some(Making::Repeated { of, words: count }) => {
                let of = self.push(id, Kind::Extend(of, true), words / count, lanes);
                kind = if count == 1 { Kind::Alias(of) } else { Kind::Broadcast { of, axis: Axis::last(count) } };
            }
            Some(Making::Parts) => {
                let Kind::Unpack { axis, .. } = &mut kind else { unreachable!("only what is unpacked has parts") };
                axis.count /= lanes;
            }
            Some(Making::Kept) => match &mut kind {
                Kind::Read { address, .. } => {
                    *address = self.same(*address, lanes).expect("a packed memory has one address")
                }
                _ => return self.push(id, Kind::State, words, lanes),
            },
            Some(Making::Moved) => {
                kind.rewrite(|operand| *operand = self.of(*operand, lanes));
                shorten(&mut kind, lanes);
            }
            Some(Making::Picked) => {
                let Kind::Pick { of, axis, index } = &mut kind else { unreachable!("only a pick is picked") };
                (*of, *index) = (self.of(*of, lanes), self.same(*index, lanes).expect("it is the same in each word"));
                axis.inner /= lanes;
            }
            Some(Making::Joined) => kind = self.joined(kind),
            Some(Making::Alternating) => return self.alternating(id, &kind, lanes),
            Some(Making::Shifted) => kind = self.shifted(id, &kind, lanes),
            Some(Making::Logic) => return self.logic(id, kind, lanes),
        }
        self.push(id, kind, words, lanes)
    }

    /// Words whose bits are known.
    fn known(&mut self, id: ValueId, lanes: u32) -> Kind {
        let word = |first: u32| {
            let bits = (0..lanes).filter(|bit| known(&self.circuit, id, first + bit));
            Bits::new(lanes, bits.fold(0, |word, bit| word | 1 << bit))
        };
        let words: Vec<Bits> = (0..self.circuit[id].lanes).step_by(lanes as usize).map(word).collect();
        if words.iter().all(|word| *word == words[0]) {
            return Kind::Const(words[0].clone());
        }
        let parts = words.into_iter().map(|word| self.push(id, Kind::Const(word), 1, lanes)).collect();
        Kind::Stack { parts, inner: 1 }
    }

    /// Adds logic on words.
    fn logic(&mut self, id: ValueId, mut kind: Kind, lanes: u32) -> ValueId {
        let words = self.words(id, lanes);
        match kind {
            Kind::Mux { select, on_true, on_false } => {
                let [on_true, on_false] = [on_true, on_false].map(|operand| self.of(operand, lanes));
                return self.choose(select, lanes, on_true, on_false);
            }
            Kind::Select { arms, default } => {
                let default = self.of(default, lanes);
                return arms.into_iter().rev().fold(default, |otherwise, (condition, value)| {
                    let value = self.of(value, lanes);
                    self.choose(condition, lanes, value, otherwise)
                });
            }
            Kind::Case { ref mut subject, ref mut arms, ref mut default } => {
                *subject = self.same(*subject, lanes).expect("it is the same in each word");
                arms.iter_mut().for_each(|(_, value)| *value = self.of(*value, lanes));
                *default = self.of(*default, lanes);
            }
            Kind::Compare(relation, is_signed, a, b) => {
                let [a, b] = [a, b].map(|operand| self.of(operand, lanes));
                // As a sign, 1 is the smaller.
                let (a, b) = if is_signed { (b, a) } else { (a, b) };
                let mut logic = |kind| self.push(id, kind, words, lanes);
                let (op, of, inverted) = match relation {
                    Relation::Eq => (Binary::Xor, b, a),
                    Relation::Ne => return logic(Kind::Binary(Binary::Xor, a, b)),
                    Relation::Lt => (Binary::And, b, a),
                    Relation::Le => (Binary::Or, b, a),
                    Relation::Gt => (Binary::And, a, b),
                    Relation::Ge => (Binary::Or, a, b),
                };
                let inverted = logic(Kind::Unary(Unary::Not, inverted));
                kind = Kind::Binary(op, of, inverted);
            }
            // Every reduction of one bit is the bit.
            Kind::Unary(op, of) => {
                let of = self.of(of, lanes);
                kind = if op == Unary::Not { Kind::Unary(op, of) } else { Kind::Alias(of) };
            }
            Kind::Binary(op, ref mut a, ref mut b) => {
                [a, b].into_iter().for_each(|operand| *operand = self.of(*operand, lanes));
                if let (Binary::Add | Binary::Sub, Kind::Binary(op, ..)) = (op, &mut kind) {
                    *op = Binary::Xor;
                }
            }
            _ => kind.rewrite(|operand| *operand = self.of(*operand, lanes)),
        }
        self.push(id, kind, words, lanes)
    }

    /// Makes an operation that combines lanes, concatenates them or selects some of them use their words.
    fn gather(&mut self, id: ValueId) {
        let Cell { ref kind, lanes: all, .. } = self.circuit[id];
        let kind = kind.clone();
        let (Kind::Reduce { of, axis, .. } | Kind::Pack { of, axis } | Kind::Lane { of, axis, .. }) = kind else {
            return;
        };
        let Some(&lanes) = self.choice.values.get(&of) else { return };
        let words = self.made[&(of, lanes)];
        let is_along = axis.inner == 1 && axis.count.is_multiple_of(lanes);
        let (one, count) = (axis.count == lanes, axis.count / lanes);
        let kind = match kind {
            Kind::Reduce { by, .. } if is_along => {
                let (by, op) = match by {
                    Reduction::And | Reduction::Min => (Reduction::And, Unary::AllOnes),
                    Reduction::Or | Reduction::Max => (Reduction::Or, Unary::AnyOne),
                    Reduction::Xor | Reduction::Add => (Reduction::Xor, Unary::Parity),
                };
                let reduced = Kind::Reduce { by, of: words, axis: Axis::last(count) };
                Kind::Unary(op, if one { words } else { self.push(id, reduced, all, lanes) })
            }
            Kind::Pack { .. } if is_along && one => Kind::Alias(words),
            Kind::Pack { .. } if is_along => Kind::Pack { of: words, axis: Axis::last(count) },
            // A row within a word.
            Kind::Lane { index, .. } if all == axis.inner && lanes.is_multiple_of(all) => {
                let first = index * all;
                let of_words = Axis::last(self.circuit[words].lanes);
                let word = Kind::Lane { of: words, axis: of_words, index: first / lanes };
                let word = self.push(id, word, 1, lanes);
                let row = self.push(id, Kind::Slice(word, first % lanes), 1, all);
                Kind::Unpack { of: row, axis: Axis::last(all) }
            }
            _ => return,
        };
        self.circuit.set_kind(id, kind);
    }
}

/// Makes an operation that moves lanes, or combines distant ones, move words with this number of lanes.
fn shorten(kind: &mut Kind, lanes: u32) {
    match kind {
        Kind::Broadcast { axis, .. }
        | Kind::Map { axis, .. }
        | Kind::Interleave { axis, .. }
        | Kind::Lane { axis, .. } => {
            axis.inner /= lanes;
        }
        Kind::Stack { inner, .. } => *inner /= lanes,
        Kind::Reduce { by, axis, .. } => {
            axis.inner /= lanes;
            *by = match by {
                Reduction::And | Reduction::Min => Reduction::And,
                Reduction::Or | Reduction::Max => Reduction::Or,
                Reduction::Xor | Reduction::Add => Reduction::Xor,
            };
        }
        _ => unreachable!("it moves no lanes: {kind:?}"),
    }
}
