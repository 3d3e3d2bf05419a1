//! Writes a waveform file while a simulation runs.

use std::collections::VecDeque;
use std::ops::Range;

use super::changes::Id;
use super::rows::Rows;
use super::shown::Shown;
use super::sink::Sink;
use super::vcd_header::{Header, Variable, VariableKind};
use super::words::Words;
use super::{Observer, View};
use crate::engine::Done;
use crate::engine::program::{Program, Triggers};
use crate::testbench::error::Error;

/// No edge.
const NOTHING: Done = Done { edges: 0, changed: Triggers::NONE };

/// Writes a waveform file.
pub(crate) struct Dump<S: Sink> {
    to: S,
    header: Header,
    window: Range<u64>,
    /// The values of the last step: of the file, or of the flight recorder.
    shown: Shown,
    words: Words,
    /// Takes many steps at once, if the engine supports it.
    rows: Option<Rows<S>>,
    /// Whether the file has a step.
    begun: bool,
    /// The resets as the file shows them.
    resets: Vec<bool>,
    /// The time of the last change in the file.
    time: u64,
    /// When clocks return to their first level in a step, and their indices; kept to avoid an allocation.
    backs: Vec<(u64, usize)>,
    flight: Option<Flight>,
}

/// A flight recorder: the last steps.
struct Flight {
    /// The largest number of steps that it keeps.
    capacity: usize,
    steps: VecDeque<Step>,
}

/// The values between two instants.
#[derive(Default)]
struct Step {
    since: u64,
    until: u64,
    /// As in [`Shown::limbs`] and [`Words::limbs`].
    limbs: Vec<u64>,
    words: Vec<u64>,
    resets: Vec<bool>,
}

impl<S: Sink> Dump<S> {
    /// Creates the file; for a flight recorder that keeps the `last` steps, only prepares it. `rows` is the engine's
    /// index for the values of all variables.
    pub fn new(
        to: S,
        program: &Program,
        mut header: Header,
        window: Range<u64>,
        rows: Option<usize>,
        last: Option<usize>,
    ) -> Result<Dump<S>, Error> {
        let lanes: Vec<_> = header.variables.iter().map(|variable| (variable.value, variable.lane)).collect();
        let shown = Shown::new(program, &lanes);
        let mut dump = Dump {
            to,
            rows: rows.filter(|_| last.is_none()).map(|rows| Rows::new(rows, program, &shown, &header.variables)),
            shown,
            words: Words::new(program, std::mem::take(&mut header.words)),
            header,
            window,
            begun: false,
            resets: Vec::new(),
            time: 0,
            backs: Vec::new(),
            flight: last.map(|capacity| Flight { capacity, steps: VecDeque::new() }),
        };
        if dump.flight.is_none() {
            dump.to.open();
        }
        dump.to.report()?;
        Ok(dump)
    }

    /// Writes a time step: the values shown since its begin, and the clocks that return within it.
    fn step(&mut self, since: u64, until: u64, resets: &[bool]) {
        // If an assertion fails at an instant and the instant is tried again, it is shown again. Time continues from
        // the first attempt.
        let at = since.max(self.time);
        if self.begun {
            self.changes(at, resets);
        } else {
            self.to.at(at);
            self.to.first();
            self.shown.mark_all();
            self.changes(at, resets);
            self.to.first_ends();
            self.begun = true;
        }
        self.time = at;
        self.backs(at, until, resets);
        self.to.flush_much();
    }

    /// Writes the changes since the last step.
    fn changes(&mut self, at: u64, resets: &[bool]) {
        let Dump { to, header, shown, words, .. } = self;
        shown.visit_changed(|number, limbs| {
            to.at(at);
            let Variable { id, kind, .. } = &header.variables[number];
            change(to, *id, kind, limbs);
        });
        words.visit_changed(|id, kind, limbs| {
            to.at(at);
            change(to, id, kind, limbs);
        });
        for (index, clock) in header.clocks.iter().enumerate() {
            let past_edge = clock.is_past_edge(at);
            if let Some(id) = clock.id.filter(|_| !self.begun || past_edge != clock.is_past_edge(self.time)) {
                to.at(at);
                to.bit(id, clock.level(past_edge));
            }
            let before = self.resets.get(index).copied();
            let reset = resets[index] || before == Some(true) && clock.releases_later(at);
            if let Some(id) = clock.reset_id.filter(|_| before != Some(reset)) {
                to.at(at);
                to.bit(id, clock.reset_level(reset));
            }
            match self.resets.get_mut(index) {
                Some(shown) => *shown = reset,
                None => self.resets.push(reset),
            }
        }
    }

    /// Writes the clocks that return to their first level before `until`, and the releases that waited for that.
    fn backs(&mut self, since: u64, until: u64, resets: &[bool]) {
        let Dump { to, header, time, backs, .. } = self;
        let returning = header.clocks.iter().enumerate();
        let returning = returning.filter_map(|(index, clock)| Some((clock.back(since)?, index)));
        backs.clear();
        backs.extend(returning.filter(|&(back, _)| *time < back && back < until));
        // At one time, the sequence of the clocks remains.
        backs.sort_by_key(|back| back.0);
        for &(back, index) in &*backs {
            let clock = &header.clocks[index];
            to.at(back);
            clock.id.into_iter().for_each(|id| to.bit(id, clock.level(false)));
            if std::mem::replace(&mut self.resets[index], resets[index]) != resets[index] {
                clock.reset_id.into_iter().for_each(|id| to.bit(id, clock.reset_level(resets[index])));
            }
            *time = back;
        }
    }

    /// Writes the steps of the flight recorder; from now on, every step is written.
    fn land(&mut self) {
        let Some(flight) = self.flight.take() else { return };
        self.to.open();
        for step in flight.steps {
            self.shown.go_to(&step.limbs);
            self.words.go_to(&step.words);
            self.step(step.since, step.until, &step.resets);
        }
    }
}

impl Flight {
    /// Keeps a step, and drops the oldest one if there are too many.
    fn keep(&mut self, since: u64, until: u64, [limbs, words]: [&[u64]; 2], resets: &[bool]) {
        let oldest = if self.steps.len() == self.capacity { self.steps.pop_front() } else { None };
        let mut step = oldest.unwrap_or_default();
        (step.since, step.until) = (since, until);
        step.limbs.clear();
        step.limbs.extend_from_slice(limbs);
        step.words.clear();
        step.words.extend_from_slice(words);
        step.resets.clear();
        step.resets.extend_from_slice(resets);
        self.steps.push_back(step);
    }
}

/// Writes a variable's new value.
pub(super) fn change(to: &mut impl Sink, id: Id, kind: &VariableKind, limbs: &[u64]) {
    match kind {
        VariableKind::Bit => to.bit(id, limbs[0] != 0),
        VariableKind::Bits => to.bits(id, limbs),
        VariableKind::Code(names) => match names.name(limbs[0]) {
            Some(name) => to.string(id, name),
            None => to.string(id, &format!("code_{}", limbs[0])),
        },
    }
}

impl<S: Sink> Observer for Dump<S> {
    fn sample(&mut self, view: &mut View) -> Result<(), Error> {
        self.to.report()?;
        let (since, until) = (view.since.max(self.window.start), view.until.min(self.window.end));
        if since < until {
            if let Some(rows) = &mut self.rows {
                rows.leave(&mut self.shown);
            }
            self.shown.take(&mut **view.engine, view.changed);
            self.words.take(view);
            match &mut self.flight {
                None => self.step(since, until, view.resets),
                Some(flight) => flight.keep(since, until, [self.shown.limbs(), self.words.limbs()], view.resets),
            }
        } else {
            self.words.leave();
        }
        Ok(())
    }

    fn rows(&mut self, view: &mut View, count: u64) -> Result<Done, Error> {
        self.to.report()?;
        let Dump { rows: Some(rows), header, shown, to, .. } = self else { return Ok(NOTHING) };
        // A step unlike the previous ones is left to `sample`.
        let is_alike = self.begun && self.resets == view.resets && view.since > self.time.max(self.window.start);
        if !is_alike {
            return Ok(NOTHING);
        }
        let period = view.until - view.since;
        let count = count.min(self.window.end.saturating_sub(view.since) / period);
        let done = rows.take(view, count, shown, header, to);
        if done.edges > 0 {
            let last = view.since + (done.edges - 1) * period;
            self.time = header.clocks[0].back(last).unwrap_or(last);
        }
        self.to.flush_much();
        Ok(done)
    }

    fn needs(&self, now: u64) -> u64 {
        // A flight recorder has to see an assertion fail.
        match self.flight {
            None if now >= self.window.end => u64::MAX,
            None => now.max(self.window.start),
            Some(_) => now,
        }
    }

    fn failed(&mut self) {
        self.land();
        self.to.flush();
    }

    fn finish(&mut self, view: &mut View) -> Result<(), Error> {
        self.sample(view)?;
        let end = view.until.min(self.window.end);
        if self.begun && self.time < end {
            self.to.at(end);
        }
        self.to.close();
        self.to.report()
    }
}

/// A run that ends without [`Simulation::finish`](crate::Simulation::finish), for example by a panic, still leaves
/// its waves.
impl<S: Sink> Drop for Dump<S> {
    fn drop(&mut self) {
        self.to.close();
        if let Err(error) = self.to.report() {
            eprintln!("{error}");
        }
    }
}
