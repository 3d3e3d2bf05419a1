//! The conditions under which registers and memories stay the same.

use rustc_hash::FxHashMap;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Binary, Reduction, Unary};

use super::flags::Flags;
use crate::engine::function::{Function, Sink};
use crate::engine::plan::Plan;
use crate::engine::program::{Axis, Cell, Kind, ValueId};

/// A condition for a fact.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(in crate::engine::plan) enum Holds {
    /// It is unknown.
    #[default]
    Never,
    Always,
    /// True where this value, of one lane and one bit, is 1.
    If(ValueId),
}

/// Finds the conditions under which registers and memories stay the same.
pub(super) struct Stays<'a> {
    function: &'a mut Function,
    plan: &'a Plan,
    /// The condition under which a value equals a state in all lanes or, without a state, is 0.
    known: FxHashMap<(ValueId, Option<ValueId>), Holds>,
    flags: &'a mut Flags,
    /// The scalars that were made.
    made: FxHashMap<Kind, ValueId>,
}

impl<'a> Stays<'a> {
    pub fn new(function: &'a mut Function, plan: &'a Plan, flags: &'a mut Flags) -> Stays<'a> {
        Stays { function, plan, known: FxHashMap::default(), flags, made: FxHashMap::default() }
    }

    /// The condition under which these sinks have no effect.
    pub fn all(&mut self, sinks: &[usize]) -> Holds {
        let mut all = Holds::Always;
        for &sink in sinks {
            let stays = match self.function.sinks[sink] {
                // A late change waits elsewhere and must be copied.
                Sink::Register { state, .. } if self.plan.hazards.contains(&state) => Holds::Never,
                Sink::Register { state, next, enable } => {
                    let is_off = enable.map_or(Holds::Never, |enable| self.is(enable, None));
                    let same = self.is(next, Some(state));
                    self.or(is_off, same)
                }
                Sink::Write { enable, .. } => self.is(enable, None),
                _ => Holds::Never,
            };
            all = self.and(all, stays);
            if all == Holds::Never {
                break;
            }
        }
        all
    }

    /// The condition under which a value is a state, or 0, in all lanes.
    fn is(&mut self, id: ValueId, state: Option<ValueId>) -> Holds {
        if let Some(holds) = self.known.get(&(id, state)) {
            return *holds;
        }
        let holds = self.find(id, state);
        self.known.insert((id, state), holds);
        holds
    }

    fn find(&mut self, id: ValueId, state: Option<ValueId>) -> Holds {
        if Some(id) == state {
            return Holds::Always;
        }
        if state.is_none() && self.flags.has(id) {
            let any = self.any(id);
            return Holds::If(self.inverse(any));
        }
        let Cell { kind, width, .. } = self.function.cell(id).clone();
        match kind {
            Kind::Const(bits) if state.is_none() && bits == Bits::zero(width) => Holds::Always,
            Kind::Alias(of) => self.is(of, state),
            Kind::Broadcast { of, .. } if state.is_none() => match self.function.cell(of) {
                Cell { lanes: 1, width: 1, kind, .. } if !matches!(kind, Kind::Const(_)) => Holds::If(self.inverse(of)),
                _ => self.is(of, None),
            },
            Kind::Binary(Binary::And, a, b) if state.is_none() => {
                let [a, b] = [a, b].map(|id| self.is(id, None));
                self.or(a, b)
            }
            Kind::Binary(Binary::Or, a, b) if state.is_none() => {
                let [a, b] = [a, b].map(|id| self.is(id, None));
                self.and(a, b)
            }
            Kind::Mux { select, on_true, on_false } => self.choice(&[(select, on_true)], on_false, state),
            Kind::Select { arms, default } => self.choice(&arms, default, state),
            Kind::Case { subject, arms, default } => self.case(subject, &arms, default, state),
            _ => Holds::Never,
        }
    }

    /// The condition under which the first value with a true condition is a state, or 0.
    fn choice(&mut self, arms: &[(ValueId, ValueId)], default: ValueId, state: Option<ValueId>) -> Holds {
        let mut holds = self.is(default, state);
        for &(condition, value) in arms.iter().rev() {
            let taken = self.is(value, state);
            holds = match self.shared(condition) {
                Some(select) => {
                    let not = self.inverse(select);
                    let [on_true, on_false] =
                        [(select, taken), (not, holds)].map(|(at, holds)| self.and(Holds::If(at), holds));
                    self.or(on_true, on_false)
                }
                None => {
                    let off = self.is(condition, None);
                    let either = self.or(off, taken);
                    self.and(either, holds)
                }
            };
        }
        holds
    }

    /// The same if a value of all lanes selects.
    fn case(&mut self, subject: ValueId, arms: &[(Bits, ValueId)], default: ValueId, state: Option<ValueId>) -> Holds {
        let mut values: Vec<Holds> = arms.iter().map(|(_, value)| self.is(*value, state)).collect();
        values.push(self.is(default, state));
        let Some(subject) = self.shared(subject) else {
            return values.into_iter().fold(Holds::Always, |all, holds| self.and(all, holds));
        };
        if values.iter().all(|holds| *holds == values[0]) {
            return values[0];
        }
        let values: Vec<ValueId> = values.into_iter().map(|holds| self.value(holds)).collect();
        let arms = arms.iter().map(|(key, _)| key.clone()).zip(values.iter().copied()).collect();
        let default = *values.last().expect("there is a default");
        Holds::If(self.push(Kind::Case { subject, arms, default }))
    }

    /// The scalar that a value is in all lanes.
    fn shared(&self, id: ValueId) -> Option<ValueId> {
        match self.function.cell(id).kind {
            Kind::Broadcast { of, .. } if self.function.cell(of).lanes == 1 => Some(of),
            _ => None,
        }
    }

    fn and(&mut self, a: Holds, b: Holds) -> Holds {
        match (a, b) {
            (Holds::Never, _) | (_, Holds::Never) => Holds::Never,
            (Holds::Always, other) | (other, Holds::Always) => other,
            (Holds::If(a), Holds::If(b)) if a == b => Holds::If(a),
            (Holds::If(a), Holds::If(b)) => Holds::If(self.push(Kind::Binary(Binary::And, a, b))),
        }
    }

    fn or(&mut self, a: Holds, b: Holds) -> Holds {
        match (a, b) {
            (Holds::Always, _) | (_, Holds::Always) => Holds::Always,
            (Holds::Never, other) | (other, Holds::Never) => other,
            (Holds::If(a), Holds::If(b)) if a == b => Holds::If(a),
            (Holds::If(a), Holds::If(b)) => Holds::If(self.push(Kind::Binary(Binary::Or, a, b))),
        }
    }

    fn inverse(&mut self, of: ValueId) -> ValueId {
        self.push(Kind::Unary(Unary::Not, of))
    }

    /// Whether any lane has a flag.
    fn any(&mut self, flag: ValueId) -> ValueId {
        if let Some(any) = self.flags.any.get(&flag) {
            return *any;
        }
        let axis = Axis::last(self.function.cell(flag).lanes);
        let any = self.push(Kind::Reduce { by: Reduction::Or, of: flag, axis });
        self.flags.any.insert(flag, any);
        any
    }

    fn value(&mut self, holds: Holds) -> ValueId {
        match holds {
            Holds::If(id) => id,
            Holds::Always => self.push(Kind::Const(Bits::ones(1))),
            Holds::Never => self.push(Kind::Const(Bits::zero(1))),
        }
    }

    /// A scalar computed for this purpose only: another use of the same computation may come later.
    fn push(&mut self, kind: Kind) -> ValueId {
        if let Some(made) = self.made.get(&kind) {
            return *made;
        }
        let made = self.function.rewriter.push(Cell::new(kind.clone(), 1, 1));
        self.made.insert(kind, made);
        made
    }
}
