//! Skips edges of clocks at which nothing happens.
//!
//! In a circuit of several clocks, one often has nothing to do while the others run. Its edges then change nothing,
//! or only registers that count ([`counting`]). An edge is compared with the state before it from time to time. If
//! nothing else has changed, the clock *rests*: as long as its edges read the same values, each does only the
//! remaining work. No input may be set meanwhile. State of other clocks is compared with its earlier value, and so
//! are the flags of counters.

mod counting;
mod instants;
mod way;

use std::collections::BTreeSet;

use super::Compiled;
use crate::engine::Done;
use crate::engine::cranelift::Code;
use crate::engine::layout::Place;
use crate::engine::layout::span::{Span, span};
use crate::engine::program::{Program, Triggers, ValueId};
use way::Way;

/// Edges between two comparisons: after a rest, and at most.
const FIRST: u64 = 3;
const MOST: u64 = 4096;
/// Comparisons after a rest until they become fewer.
const EAGER: u32 = 8;
/// The most registers that count while a clock rests.
const COUNTING: usize = 8;
/// The number of comparisons that must find the same registers counting before code is made for them, and the most
/// such sets.
const SEEN: u32 = 4;
const WAYS: usize = 8;

/// The first 64 clocks, one in each bit.
pub(super) type Clocks = u64;

/// Data about the edges of a clock.
pub(super) struct Idle {
    /// Its registers and read data.
    own: Vec<(ValueId, Span)>,
    /// Those that count by themselves.
    counters: BTreeSet<ValueId>,
    /// The state of others that it reads.
    others: Vec<Span>,
    /// The clocks of that state.
    looks_at: Clocks,
    /// Both, with their earlier values.
    before: Vec<u64>,
    seen: Vec<u64>,
    rests: bool,
    /// Edges until the next comparison, and from one to the next.
    left: u64,
    patience: u64,
    eager: u32,
    /// The ways in which it may rest, and the last one.
    ways: Vec<Way>,
    latest: usize,
    /// Sets of registers that were the only changes, with their counts.
    alone: Vec<(Vec<ValueId>, u32)>,
}

impl Idle {
    /// For each clock; `None` if its edges are too short, or not suited, for checking.
    pub fn of(program: &Program, places: &[Option<Place>]) -> Vec<Option<Idle>> {
        let span_of = |id: ValueId| places[id.index()].map(span).expect("it is state");
        let of = |clock: usize| {
            let cells = program.circuit.needed(program.sampled(clock, false));
            let work: usize = cells.iter().map(|&id| program.circuit[id].lanes.div_ceil(4) as usize).sum();
            let others = counting::others(program, clock).filter(|_| work >= program.passes.idle_from)?;
            let counters = counting::counters(program, clock);
            let mut own: Vec<_> = counting::states(program, clock).map(|id| (id, span_of(id))).collect();
            // State that changes only when something happens comes first: a difference there settles it.
            own.sort_by_key(|(id, _)| counters.contains(id));
            let is_looked_at = |of: &usize| counting::states(program, *of).any(|id| others.contains(&id));
            let looks_at = (0..program.clocks.len().min(Clocks::BITS as usize)).filter(is_looked_at);
            Some(Idle {
                own,
                counters,
                looks_at: looks_at.fold(0, |all, of| all | 1 << of),
                others: others.into_iter().map(span_of).collect(),
                before: Vec::new(),
                seen: Vec::new(),
                rests: false,
                left: FIRST,
                patience: FIRST,
                eager: 0,
                ways: Vec::new(),
                latest: 0,
                alone: Vec::new(),
            })
        };
        (0..program.clocks.len()).map(of).collect()
    }

    /// For each clock, those whose edges read its state.
    pub fn seen_by(clocks: &[Option<Idle>]) -> Vec<Clocks> {
        let looks = |idle: &Option<Idle>, at: usize| idle.as_ref().is_some_and(|idle| idle.looks_at >> at & 1 == 1);
        let seen_by = |at| (0..clocks.len()).filter(|&it| looks(&clocks[it], at)).fold(0, |all, it| all | 1 << it);
        (0..clocks.len().min(Clocks::BITS as usize)).map(seen_by).collect()
    }

    /// Whether a register counts by itself, or with others.
    fn may_count(&self, register: ValueId) -> bool {
        self.counters.contains(&register) || self.ways.iter().any(|way| way.registers.contains(&register))
    }

    /// The clock has something to do.
    fn wake(&mut self) {
        if std::mem::take(&mut self.rests) {
            (self.left, self.patience, self.eager) = (FIRST, FIRST, EAGER);
        }
    }

    /// An edge was compared; the next comparison comes some edges later.
    fn wait(&mut self) {
        match self.eager.checked_sub(1) {
            Some(eager) => self.eager = eager,
            None => self.patience = (2 * self.patience).min(MOST),
        }
        self.left = self.patience;
    }
}

impl Compiled {
    /// An edge of these clocks, if one of them rests or must be compared; `None` if the edge is to be executed as
    /// usual. Wakes clocks that have something to do.
    pub(super) fn idle_edge(&mut self, rising: &[usize], count: u64) -> Option<Done> {
        if std::mem::take(&mut self.stirred) {
            self.wake_clocks();
        }
        if count > 1 || self.any_reset {
            self.wake_clocks();
            return None;
        }
        let &[clock] = rising else { return self.edge_together(rising) };
        if self.rests_on(clock) {
            return Some(Done { edges: 1, changed: self.go(clock) });
        }
        let idle = self.idle[clock].as_mut()?;
        idle.left = idle.left.saturating_sub(1);
        if idle.left > 0 { None } else { Some(self.compared_edge(clock)) }
    }

    /// All clocks have something to do.
    pub(super) fn wake_clocks(&mut self) {
        self.idle.iter_mut().flatten().for_each(Idle::wake);
    }

    /// An edge of several clocks. The remaining work of a resting clock follows the edge of the others, if it reads
    /// no state that they change.
    fn edge_together(&mut self, rising: &[usize]) -> Option<Done> {
        let mut resting = None;
        for &clock in rising {
            if self.rests_on(clock) && !self.way(clock)?.looks_at.iter().any(|of| *of != clock && rising.contains(of)) {
                resting = Some(clock);
            }
        }
        let clock = resting?;
        let mut others = std::mem::take(&mut self.rising);
        others.clear();
        others.extend(rising.iter().filter(|other| **other != clock));
        let done = self.usual_edges(&others, 1);
        self.rising = others;
        if done.edges == 0 {
            return Some(done);
        }
        Some(Done { changed: done.changed.with(self.go(clock)), ..done })
    }

    /// The way in which a clock rests, or last rested.
    fn way(&self, clock: usize) -> Option<&Way> {
        let idle = self.idle[clock].as_ref()?;
        idle.ways.get(idle.latest)
    }

    /// Whether a clock rests and its coming edge reads the same values; otherwise it wakes.
    fn rests_on(&mut self, clock: usize) -> bool {
        let Some(idle) = self.idle[clock].as_ref().filter(|idle| idle.rests) else { return false };
        let rests_on = self.sees_same(idle) && self.call_or_true(self.way(clock).and_then(|way| way.same));
        if !rests_on {
            self.idle[clock].as_mut().into_iter().for_each(Idle::wake);
        }
        rests_on
    }

    /// Does the remaining work of an edge of a resting clock; returns what it changes.
    fn go(&mut self, clock: usize) -> Triggers {
        self.idle_edges += 1;
        let Some(go) = self.way(clock).and_then(|way| way.go) else { return Triggers::NONE };
        self.call(go, 1);
        self.change(Triggers::state(clock));
        Triggers::state(clock)
    }

    /// Whether the state of others is the same as when a clock began to rest.
    fn sees_same(&self, idle: &Idle) -> bool {
        let mut seen = idle.seen.as_slice();
        idle.others.iter().all(|span| {
            let (kept, rest) = seen.split_at(span.limbs);
            seen = rest;
            !self.state.differs(*span, kept)
        })
    }

    /// Runs code, if there is any; returns whether it ran to its end.
    fn call_or_true(&mut self, code: Option<Code>) -> bool {
        code.is_none_or(|code| self.call(code, 1) == 0)
    }

    /// An edge as usual; if it changes only counters, the clock rests from then on.
    fn compared_edge(&mut self, clock: usize) -> Done {
        let mut idle = self.idle[clock].take().expect("it is there");
        if idle.ways.is_empty() {
            idle.ways.extend(self.make_way(clock, &[]));
        }
        let leave = idle.ways.get(idle.latest).map(|way| way.leave);
        let may_rest = leave.is_some_and(|leave| self.call_or_true(leave));
        self.state.keep(idle.own.iter().map(|(_, span)| *span), &mut idle.before);
        let done = self.usual_edges(&[clock], 1);
        if done.edges == 1 {
            self.conclude(clock, &mut idle, may_rest);
        }
        self.idle[clock] = Some(idle);
        done
    }

    /// Draws the conclusions from an edge for the next ones.
    fn conclude(&mut self, clock: usize, idle: &mut Idle, may_rest: bool) {
        idle.wait();
        let Some(changed) = self.changed_registers(idle) else { return };
        let fits = |way: &Way| changed.iter().all(|id| way.registers.contains(id));
        match idle.ways.get(idle.latest) {
            Some(way) if fits(way) => {
                if may_rest {
                    self.state.keep(idle.others.iter().copied(), &mut idle.seen);
                    idle.rests = true;
                }
                return;
            }
            _ => {}
        }
        if let Some(way) = idle.ways.iter().position(fits) {
            (idle.latest, idle.left) = (way, 1);
            return;
        }
        if !changed.iter().all(|id| idle.counters.contains(id)) {
            return;
        }
        let known = idle.alone.iter().position(|(registers, _)| *registers == changed);
        let known = known.unwrap_or_else(|| {
            idle.alone.push((changed.clone(), 0));
            idle.alone.len() - 1
        });
        idle.alone[known].1 += 1;
        if idle.alone[known].1 == SEEN && idle.ways.len() < WAYS {
            idle.ways.extend(self.make_way(clock, &changed));
        }
    }

    /// The registers that an edge has changed, if they may count and are few.
    fn changed_registers(&self, idle: &Idle) -> Option<Vec<ValueId>> {
        let (mut changed, mut before) = (Vec::new(), idle.before.as_slice());
        for &(id, span) in &idle.own {
            let (kept, rest) = before.split_at(span.limbs);
            before = rest;
            if self.state.differs(span, kept) {
                changed.push(id);
                if changed.len() > COUNTING || !idle.may_count(id) {
                    return None;
                }
            }
        }
        Some(changed)
    }
}
