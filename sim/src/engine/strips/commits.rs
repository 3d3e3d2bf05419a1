//! Whether a strip program reads old values before it changes them.
//!
//! Each part of a program is an edge, or what comes before or after one; `then` stands between parts. In a part, what
//! edges change is read before it is stored. No load follows a store to a byte that it loads. Neither does one in a
//! later iteration of a loop. A loop that does not count repeats edges.
//!
//! Two things are legal beside that. Cases of one branch do not follow each other. A store to a memory that keeps some
//! of the lanes loads them first, from the place that it stores at. Lanes of a memory are apart from each other, so that
//! iterations of a loop over lanes are not compared there.

use std::collections::HashMap;

use rustc_hash::FxHashMap;

use super::bounds::{Access, Base, Bounds, Fact, step};
use super::operation::{Binary, Operation};
use super::program::{Loop, Program, Statement};
use super::value::Value;

/// Bytes that are accessed, in parts of a sum: counters of loops times constants, and a range.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::engine) struct Touched {
    base: Base,
    /// The first byte of the allocation.
    place: i64,
    counters: Vec<(Value, i64)>,
    first: i64,
    end: i64,
}

impl Touched {
    fn is_memory(&self) -> bool {
        matches!(self.base, Base::Known(_) | Base::Stored(_))
    }

    fn is_in_allocation_of(&self, other: &Touched) -> bool {
        (self.place, self.base) == (other.place, other.base)
    }
}

/// A counter: what it is at first and at last, and how much is added each time.
#[derive(Debug, Clone, Copy)]
struct Counter {
    least: i64,
    most: i64,
    step: i64,
}

impl Program {
    /// Checks it, after functions for other pieces of the same edge, which have changed `before`.
    ///
    /// # Errors
    /// The first load of what may have been changed.
    pub fn commits(&self, bounds: &Bounds, before: &mut Vec<Touched>) -> Result<(), String> {
        let changed = std::mem::take(before);
        let mut walk = Walk {
            program: self,
            facts: &bounds.facts,
            accesses: bounds.accesses.iter(),
            counters: FxHashMap::default(),
            open: Vec::new(),
            loaded: Vec::new(),
            changed,
        };
        walk.region(&self.body)?;
        *before = walk.changed.iter().map(|it| walk.without(it, None)).collect();
        Ok(())
    }
}

/// Counters of loops times constants, sorted, and what else is added at least and at most.
type Sum = (Vec<(Value, i64)>, i64, i64);

struct Walk<'p> {
    program: &'p Program,
    facts: &'p [Fact],
    /// Those that follow.
    accesses: std::slice::Iter<'p, Access>,
    /// Of all loops so far.
    counters: FxHashMap<Value, Counter>,
    /// The counters of the loops around.
    open: Vec<Value>,
    /// What the part has loaded and stored so far.
    loaded: Vec<(Value, Touched)>,
    changed: Vec<Touched>,
}

impl Walk<'_> {
    fn operation_of(&self, value: Value) -> &Operation {
        &self.program.values[value.index()].0
    }

    /// A number as a sum.
    fn sum(&self, value: Value) -> Sum {
        let constant = |value: Value| match *self.operation_of(value) {
            Operation::Constant(number) => Some(number),
            _ => None,
        };
        match *self.operation_of(value) {
            _ if self.open.contains(&value) => (vec![(value, 1)], 0, 0),
            Operation::Binary(Binary::Add, x, y) if y != Program::PARAMETERS[1] => {
                let ((mut counters, a, b), (others, c, d)) = (self.sum(x), self.sum(y));
                for (counter, by) in others {
                    match counters.iter_mut().find(|(it, _)| *it == counter) {
                        Some((_, sum)) => *sum += by,
                        None => counters.push((counter, by)),
                    }
                }
                counters.sort_unstable();
                (counters, a.saturating_add(c), b.saturating_add(d))
            }
            Operation::Binary(binary @ (Binary::Mul | Binary::Shl), x, by) => match (binary, constant(by)) {
                (Binary::Mul, Some(by)) if by > 0 => self.times(x, by),
                (Binary::Shl, Some(by)) if by < 32 => self.times(x, 1 << by),
                _ => self.range(value),
            },
            Operation::Binary(Binary::Min, x, y) => self.least(x, y).unwrap_or_else(|| self.range(value)),
            _ => self.range(value),
        }
    }

    /// The lesser one of two numbers without a sign, as a sum with the counters of the first one.
    fn least(&self, x: Value, y: Value) -> Option<Sum> {
        let ((counters, a, b), (others, c, d)) = (self.sum(x), self.sum(y));
        if counters == others {
            return (!counters.is_empty()).then(|| (counters, a.min(c), b.max(d)));
        }
        // The second one is so much more than the counters of the first one.
        (others.is_empty() && c >= 0).then_some(())?;
        let (low, high) = self.span(&counters);
        let (least, most) = (c.saturating_sub(high), d.saturating_sub(low));
        // Below zero, the first one is a large number.
        Some((counters, a.min(least), if low.saturating_add(a) < 0 { b.max(most) } else { b }))
    }

    fn times(&self, value: Value, by: i64) -> Sum {
        let (counters, a, b) = self.sum(value);
        let counters = counters.into_iter().map(|(counter, times)| (counter, times.saturating_mul(by))).collect();
        (counters, a.saturating_mul(by), b.saturating_mul(by))
    }

    fn range(&self, value: Value) -> Sum {
        let (least, most) = match self.facts[value.index()] {
            Fact::Address(_, least, most) => (least, most),
            Fact::Number(least, most) => (least as i64, most as i64),
            Fact::Vector(_) => (i64::MIN, i64::MAX),
        };
        if least <= most { (Vec::new(), least, most) } else { (Vec::new(), i64::MIN, i64::MAX) }
    }

    fn touched(&self, access: &Access) -> Touched {
        let (counters, first, last) = self.sum(access.address);
        let (first, end) = (first.saturating_add(access.offset), last.saturating_add(access.offset + access.size));
        Touched { base: access.base, place: access.extent.start, counters, first, end }
    }

    /// The least and the greatest sum of counters.
    fn span(&self, counters: &[(Value, i64)]) -> (i64, i64) {
        counters.iter().fold((0i64, 0i64), |(low, high), (counter, by)| {
            let Counter { least, most, .. } = self.counters[counter];
            let ends = [least, most].map(|end| end.saturating_mul(*by));
            (low.saturating_add(ends[0].min(ends[1])), high.saturating_add(ends[0].max(ends[1])))
        })
    }

    /// The same with the ranges of counters in place of all counters, or of those that are not open and not `kept`.
    fn without(&self, of: &Touched, kept: Option<Value>) -> Touched {
        let stays =
            |(counter, _): &(Value, i64)| kept.is_some() && (kept == Some(*counter) || self.open.contains(counter));
        let (counters, others): (Vec<_>, Vec<_>) = of.counters.iter().partition(|it| stays(it));
        let (low, high) = self.span(&others);
        Touched { counters, first: of.first.saturating_add(low), end: of.end.saturating_add(high), ..of.clone() }
    }

    /// Whether a load and a store may be of the same byte: in the same iteration if they have the same counters, or else
    /// in any ones.
    fn meet(&self, load: &Touched, store: &Touched) -> bool {
        if !load.is_in_allocation_of(store) {
            return false;
        }
        let overlap = |a: &Touched, b: &Touched| a.first < b.end && b.first < a.end;
        match load.counters == store.counters {
            true => overlap(load, store),
            false => overlap(&self.without(load, None), &self.without(store, None)),
        }
    }

    fn region(&mut self, region: &[Statement]) -> Result<(), String> {
        // Where each place of a memory is last stored at.
        let mut last = HashMap::new();
        for (index, statement) in region.iter().enumerate() {
            if let Statement::Store { address, offset, .. } = statement {
                last.insert((*address, i64::from(*offset)), index);
            }
        }
        for (index, statement) in region.iter().enumerate() {
            let updates = |access: &Access| last.get(&(access.address, access.offset)).is_some_and(|it| *it > index);
            self.statement(statement, updates)?;
        }
        Ok(())
    }

    fn statement(&mut self, statement: &Statement, updates: impl Fn(&Access) -> bool) -> Result<(), String> {
        match statement {
            Statement::Let(value) => {
                let Operation::Load { .. } = self.operation_of(*value) else { return Ok(()) };
                let access = self.accesses.next().expect("each load has one");
                let touched = self.touched(access);
                if !access.extent.is_state || (touched.is_memory() && updates(access)) {
                    return Ok(());
                }
                let mut stores = self.changed.iter().filter(|store| store.is_in_allocation_of(&touched));
                if stores.any(|store| self.meet(&touched, &self.seen(store))) {
                    return Err(format!("value {} is loaded after it was changed", value.0));
                }
                self.loaded.push((*value, touched));
                Ok(())
            }
            Statement::Store { .. } => {
                let access = self.accesses.next().expect("each store has one");
                if access.extent.is_state {
                    let touched = self.touched(access);
                    self.changed.push(touched);
                }
                Ok(())
            }
            Statement::If { then, otherwise, .. } => self.cases(&[then, otherwise]),
            Statement::Switch { regions, .. } => self.cases(&regions.iter().collect::<Vec<_>>()),
            Statement::Loop(all) => self.repeat(all),
            Statement::Then => {
                self.loaded.clear();
                self.changed.clear();
                Ok(())
            }
            Statement::Call { .. } | Statement::LeaveUnless { .. } | Statement::Return(_) => Ok(()),
        }
    }

    /// A store of an earlier loop, without its counters.
    fn seen(&self, store: &Touched) -> Touched {
        self.without(store, Some(Program::PARAMETERS[0]))
    }

    fn cases(&mut self, regions: &[&Vec<Statement>]) -> Result<(), String> {
        let before = self.changed.len();
        let mut all = Vec::new();
        for region in regions {
            self.region(region)?;
            all.extend(self.changed.drain(before..));
        }
        self.changed.extend(all);
        Ok(())
    }

    fn repeat(&mut self, all: &Loop) -> Result<(), String> {
        let counter = (0..all.parameters.len()).find_map(|index| {
            let value = all.parameters[index];
            let Fact::Number(least, most) = self.facts[value.index()] else { return None };
            let step = step(self.program, all, index).filter(|_| most < u64::MAX / 2)?;
            Some((value, Counter { least: least as i64, most: most as i64, step }))
        });
        let Some((value, counter)) = counter else {
            return self.region(&all.body);
        };
        self.counters.insert(value, counter);
        let (loaded, changed) = (self.loaded.len(), self.changed.len());
        self.open.push(value);
        self.region(&all.body)?;
        self.open.pop();
        let (loads, stores) = (self.loaded.get(loaded..), self.changed.get(changed..));
        for (value_loaded, load) in loads.unwrap_or_default() {
            for store in stores.unwrap_or_default().iter().filter(|store| !store.is_memory()) {
                let [load, store] = [load, store].map(|it| self.without(it, Some(value)));
                if self.meet_later(value, counter, &load, &store) {
                    return Err(format!("value {} is loaded after another lane was changed", value_loaded.0));
                }
            }
        }
        Ok(())
    }

    /// Whether a load in a later iteration of a loop may be of a byte that a store has changed in an earlier one.
    fn meet_later(&self, of: Value, counter: Counter, load: &Touched, store: &Touched) -> bool {
        let by = |it: &Touched| it.counters.iter().find(|(value, _)| *value == of).map_or(0, |(_, by)| *by);
        if by(load) != by(store) || load.counters != store.counters {
            return self.meet(&self.without(load, None), &self.without(store, None));
        }
        let far = by(load).saturating_mul(counter.step);
        // Each iteration is this much further.
        let is_past = if far > 0 { load.first + far >= store.end } else { far < 0 && load.end + far <= store.first };
        !is_past && {
            let last = by(load).saturating_mul(counter.most - counter.least);
            let (low, high) = if far > 0 { (far, last) } else { (-last, far) };
            let all =
                Touched { first: load.first.saturating_add(low), end: load.end.saturating_add(high), ..load.clone() };
            self.meet(&all, store)
        }
    }
}
