//! Loops in which nothing would change.
//!
//! The work of an array in a clock often depends on a few values that all lanes share: an opcode that changes no
//! flag, a port that is not written. From the choices for each register and memory follows a condition on scalars
//! under which it *stays* the same. If all of a loop's stay, one branch skips it. To make this frequent, a loop is
//! first split into independent loops:
//!
//! ```text
//! flag  <- case op { 0: flag, 1: .. }      stays where op == 0    } a loop, left out where op == 0 and not write
//! bytes <- data if write & mine            stays where not write  }
//! sum   <- sum + x                         never                  a loop of its own
//! ```

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::{FxHashMap, FxHashSet};
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Binary, Unary};

use super::function::{Function, Sink};
use super::plan::{Kernel, Plan, Switch};
use super::strip_sizes::StripSizes;
use crate::engine::program::{Cell, Kind, Lowered, ValueId};

/// The least number of strip operations of a loop that is examined: for fewer, a branch saves little.
const LEAST: usize = 256;
/// The least number of strip operations for each scalar operation that decides whether the loop is skipped.
const WORTH: usize = 16;

/// Splits loops, and puts branches around parts that may have nothing to do.
pub(super) fn quiet(function: &mut Function, plan: &mut Plan, strips: &StripSizes) {
    let mut stages = std::mem::take(&mut plan.stages);
    for stage in &mut stages {
        for (&lanes, kernel) in &mut stage.kernels {
            let times = lanes.div_ceil(strips.strip(lanes)) as usize;
            if (kernel.cells.len() + kernel.sinks.len()) * times >= LEAST {
                guard(function, plan, kernel, times, &mut stage.single);
            }
        }
    }
    plan.stages = stages;
}

/// Splits a loop if some part of it may be skipped; the deciding condition is computed with the scalars of its stage.
fn guard(function: &mut Function, plan: &Plan, kernel: &mut Kernel, times: usize, single: &mut Vec<ValueId>) {
    let mut parts = parts(function, plan, kernel);
    let mut is_guarded = false;
    for part in &mut parts {
        let cells = function.circuit().len();
        let may_rest = !part.cells.iter().any(|id| plan.live_out.contains(id));
        let mut stays = if may_rest { Stays::new(function, plan).all(&part.sinks) } else { Holds::Never };
        let cost = function.circuit().len() - cells;
        if cost * WORTH > (part.cells.len() + part.sinks.len()) * times {
            function.rewriter.truncate(cells);
            stays = Holds::Never;
        }
        if let Holds::If(subject) = stays {
            let made = (cells..function.circuit().len()).map(|index| ValueId(index as u32));
            single.extend(made.filter(|id| function.circuit().constant(*id).is_none()));
            let kernels = vec![part.clone(), Kernel::default()];
            part.switch = Some(Box::new(Switch { subject, kernels, table: vec![0, 1] }));
            is_guarded = true;
        }
    }
    match parts.len() {
        _ if !is_guarded => {}
        1 => kernel.switch = parts.remove(0).switch,
        _ => kernel.parts = parts,
    }
}

/// The contents of a part of a loop.
#[derive(Default)]
struct Part {
    cells: FxHashSet<ValueId>,
    sinks: BTreeSet<usize>,
    /// Registers that it reads, and changes.
    reads: FxHashSet<ValueId>,
    writes: FxHashSet<ValueId>,
    /// The same for memories.
    words: FxHashSet<u32>,
    /// For each memory, the sinks that write to it.
    written: BTreeMap<u32, BTreeSet<usize>>,
}

impl Part {
    fn join(&mut self, other: Part) {
        self.cells.extend(other.cells);
        self.sinks.extend(other.sinks);
        self.reads.extend(other.reads);
        self.writes.extend(other.writes);
        self.words.extend(other.words);
        other.written.into_iter().for_each(|(memory, sinks)| self.written.entry(memory).or_default().extend(sinks));
    }

    /// Whether it must run before another part, because that one changes what it reads, or writes later to the same
    /// memory.
    fn is_before(&self, other: &Part) -> bool {
        let is_later = |(memory, sinks): (&u32, &BTreeSet<usize>)| {
            self.words.contains(memory) || self.written.get(memory).is_some_and(|own| own.first() < sinks.last())
        };
        !self.reads.is_disjoint(&other.writes) || other.written.iter().any(is_later)
    }
}

/// The independent parts of a loop, in a sequence in which each reads the old state.
fn parts(function: &Function, plan: &Plan, kernel: &Kernel) -> Vec<Kernel> {
    let inside: FxHashSet<ValueId> = kernel.cells.iter().copied().collect();
    let mut open: Vec<Part> = Vec::new();
    let mut add = |mut part: Part| {
        // A value that several loops need is computed once, unless it costs nothing.
        let (common, others) = open.drain(..).partition(|other: &Part| !other.cells.is_disjoint(&part.cells));
        open = others;
        let common: Vec<Part> = common;
        common.into_iter().for_each(|other| part.join(other));
        open.push(part);
    };
    for &index in &kernel.sinks {
        let sink = &function.sinks[index];
        let mut part = Part { sinks: BTreeSet::from([index]), ..Part::default() };
        match *sink {
            Sink::Register { state, .. } => part.writes.extend([state]),
            Sink::Write { memory, .. } => part.written.extend([(memory, BTreeSet::from([index]))]),
            _ => {}
        }
        sink.for_each_operand(|operand| part.take(function, plan, &inside, operand));
        add(part);
    }
    for &id in kernel.cells.iter().filter(|id| plan.live_out.contains(id)) {
        let mut part = Part::default();
        part.take(function, plan, &inside, id);
        add(part);
    }
    let in_order = ordered(open);
    let kernel_of = |part: &Part| {
        let mut cells = part.cells.clone();
        // A value that costs nothing is computed wherever it is used.
        for &id in kernel.cells.iter().rev() {
            if cells.contains(&id) {
                function.cell(id).kind.for_each_operand(|operand| cells.extend([operand]));
            }
        }
        part.sinks.iter().for_each(|&sink| function.sinks[sink].for_each_operand(|operand| cells.extend([operand])));
        Kernel {
            cells: kernel.cells.iter().copied().filter(|id| cells.contains(id)).collect(),
            sinks: kernel.sinks.iter().copied().filter(|sink| part.sinks.contains(sink)).collect(),
            descends: kernel.descends,
            ..Kernel::default()
        }
    };
    in_order.iter().map(kernel_of).collect()
}

impl Part {
    /// Adds a value, with everything that the loop computes for it.
    fn take(&mut self, function: &Function, plan: &Plan, inside: &FxHashSet<ValueId>, id: ValueId) {
        let mut open = vec![id];
        let mut seen = FxHashSet::default();
        while let Some(id) = open.pop() {
            let kind = &function.cell(id).kind;
            if *kind == Kind::State {
                self.reads.insert(id);
            }
            if !inside.contains(&id) || !seen.insert(id) {
                continue;
            }
            if plan.live_out.contains(&id) || !matches!(kind, Kind::Broadcast { .. }) {
                self.cells.insert(id);
            }
            if let Kind::Lowered(Lowered::Word { memory, .. }) = kind {
                self.words.insert(*memory);
            }
            kind.for_each_operand(|operand| open.push(operand));
        }
    }
}

/// Brings parts into sequence; those that must each precede the other are merged.
fn ordered(mut open: Vec<Part>) -> Vec<Part> {
    let mut order = Vec::new();
    while !open.is_empty() {
        let is_first = |index: &usize| {
            let others = open.iter().enumerate().filter(|(other, _)| other != index);
            !others.into_iter().any(|(_, other)| other.is_before(&open[*index]))
        };
        match (0..open.len()).find(is_first) {
            Some(index) => order.push(open.remove(index)),
            None => {
                // Every waiting part leads to a cycle: follow it from any of them.
                let mut at = 0;
                let mut path = Vec::new();
                while !path.contains(&at) {
                    path.push(at);
                    let before = |other: &usize| *other != at && open[*other].is_before(&open[at]);
                    at = (0..open.len()).find(before).expect("something is before it");
                }
                let start = path.iter().position(|&other| other == at).expect("it was there");
                let circle: BTreeSet<usize> = path[start..].iter().copied().collect();
                let mut joined = Part::default();
                circle.into_iter().rev().for_each(|index| joined.join(open.remove(index)));
                open.push(joined);
            }
        }
    }
    order
}

/// A condition for a fact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Holds {
    /// It is unknown.
    Never,
    Always,
    /// True where this value, of one lane and one bit, is 1.
    If(ValueId),
}

/// Finds the conditions under which registers and memories stay the same.
struct Stays<'a> {
    function: &'a mut Function,
    plan: &'a Plan,
    /// The condition under which a value equals a state in all lanes or, without a state, is 0.
    known: FxHashMap<(ValueId, Option<ValueId>), Holds>,
    inverted: FxHashMap<ValueId, ValueId>,
}

impl<'a> Stays<'a> {
    fn new(function: &'a mut Function, plan: &'a Plan) -> Stays<'a> {
        Stays { function, plan, known: FxHashMap::default(), inverted: FxHashMap::default() }
    }

    /// The condition under which these sinks have no effect.
    fn all(&mut self, sinks: &[usize]) -> Holds {
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
        match self.inverted.get(&of) {
            Some(inverse) => *inverse,
            None => {
                let inverse = self.push(Kind::Unary(Unary::Not, of));
                self.inverted.insert(of, inverse);
                inverse
            }
        }
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
        self.function.rewriter.push(Cell::new(kind, 1, 1))
    }
}
