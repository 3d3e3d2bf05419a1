//! The steps that are told of a pixel, as units are observed: what a unit does, and where a plain model of it differs.

use std::collections::HashSet;
use std::fmt::Display;

use tilewright_sim::Violation;

use crate::error::Error;
use crate::way::{Apart, Compared, Step};

/// Differences of a unit that are kept: the first ones say all.
const DIFFERENCES: usize = 3;

/// The steps so far.
#[derive(Debug, Default)]
pub(crate) struct Told {
    steps: Vec<Step>,
    /// Checks that have differed: each difference is told once for a unit, as all later ones may follow from it.
    differed: HashSet<(&'static str, u32)>,
    /// The unit, if it is simulated by itself.
    apart: Option<Apart>,
}

/// The unit of a step.
pub(crate) struct At {
    pub unit: String,
    pub block: &'static str,
    /// The clock's name, the number of its edge, and the time.
    pub edge: Edge,
}

/// An edge of a clock.
#[derive(Clone, Copy)]
pub(crate) struct Edge {
    pub clock: &'static str,
    pub number: u64,
    pub time: u64,
}

impl At {
    /// A step of that unit.
    pub fn step(self, does: impl Into<String>, values: Vec<Compared>) -> Step {
        let At { unit, block, edge: Edge { clock, number, time } } = self;
        let (does, clock) = (does.into(), clock.to_owned());
        Step { primitive: None, unit, block, does, clock, cycle: number, time, net: None, values, apart: None }
    }
}

impl Step {
    /// The same step of that primitive.
    pub(crate) fn of(self, primitive: Option<usize>) -> Step {
        Step { primitive, ..self }
    }

    /// The same step on that net.
    pub(crate) fn on(self, net: impl Into<String>) -> Step {
        Step { net: Some(net.into()), ..self }
    }
}

impl Told {
    /// Of a unit that is simulated by itself.
    pub fn of(unit: impl Into<String>) -> Told {
        Told { apart: Some(Apart { unit: unit.into(), time: 0 }), ..Told::default() }
    }

    /// Notes the time of its simulation in the next steps.
    pub fn at(&mut self, time: u64) {
        if let Some(apart) = &mut self.apart {
            apart.time = time;
        }
    }

    /// Tells a step of the followed pixel.
    pub fn tell(&mut self, step: Step) {
        self.steps.push(Step { apart: self.apart.clone(), ..step });
    }

    /// Tells a step of the followed pixel, or the first one of that check on a unit that differs.
    pub fn check(&mut self, check: &'static str, number: u32, is_followed: bool, step: impl FnOnce() -> Step) {
        if is_followed {
            self.tell(step());
        } else if self.differed.insert((check, number)) {
            let step = step();
            debug_assert!(step.differs(), "{step:?}");
            self.tell(step);
        }
    }

    /// Tells steps of the followed pixel, or differences.
    pub fn extend(&mut self, steps: impl IntoIterator<Item = Step>) {
        steps.into_iter().for_each(|step| self.tell(step));
    }

    /// Whether a step so far differs.
    pub fn differs(&self) -> bool {
        self.steps.iter().any(Step::differs)
    }

    /// Tells what ended a run: assertions that failed. `block` gives the block of an instance by its name.
    pub fn fails(&mut self, error: &Error, clocks: &[&'static str], block: impl Fn(&str) -> &'static str) {
        let Error::Simulation(tilewright_sim::Error::Violated(violations)) = error else { return };
        for Violation { message, instance, clock, cycle, time, .. } in violations {
            let Some(clock) = clocks.iter().find(|it| *it == clock) else { continue };
            let last = instance.rsplit('.').next().unwrap_or(instance);
            let name = last.split('[').next().unwrap_or(last);
            let edge = Edge { clock, number: cycle + 1, time: *time };
            let at = At { unit: format!("`{instance}`"), block: block(name), edge };
            let values = vec![compared("assertion", "fails", "passes")];
            self.tell(at.step(format!("states that {message}"), values));
        }
    }

    /// All steps, by time.
    pub fn take(&mut self) -> Vec<Step> {
        let mut steps = std::mem::take(&mut self.steps);
        // Stable: what happens at the same time keeps its sequence.
        steps.sort_by_key(|step| step.time);
        steps
    }
}

/// A unit of which steps are told, and how many of them differed.
#[derive(Clone, Debug)]
pub(crate) struct Unit {
    /// Its name.
    pub name: String,
    /// The block of the catalogue that it is.
    pub block: &'static str,
    /// The name and the period of its clock in picoseconds.
    pub clock: (&'static str, u64),
    /// The path of its nets, with a point at its end.
    pub path: String,
    differed: usize,
}

impl Unit {
    pub fn new(name: impl Into<String>, block: &'static str, clock: (&'static str, u64), path: &str) -> Unit {
        Unit { name: name.into(), block, clock, path: path.to_owned(), differed: 0 }
    }

    /// The unit at that edge of its clock.
    pub fn at(&self, cycle: u64) -> At {
        let (clock, period) = self.clock;
        At { unit: self.name.clone(), block: self.block, edge: Edge { clock, number: cycle, time: cycle * period } }
    }

    /// A step at that edge of its clock.
    pub fn step(&self, cycle: u64, primitive: Option<usize>, does: impl Into<String>, values: Vec<Compared>) -> Step {
        self.at(cycle).step(does, values).of(primitive)
    }

    /// A step at a net.
    pub fn step_at(
        &self,
        net: &str,
        cycle: u64,
        primitive: Option<usize>,
        does: impl Into<String>,
        values: Vec<Compared>,
    ) -> Step {
        self.step(cycle, primitive, does, values).on(format!("{}{net}", self.path))
    }

    /// The step of an assertion that fails, or of what else ends a run.
    pub fn fails(&self, cycle: u64, what: &str) -> Step {
        self.step(cycle, None, "fails", vec![compared("assertion", what, "none fails")])
    }

    /// Whether it is the instance of that path.
    pub fn is(&self, instance: &str) -> bool {
        self.path.trim_end_matches('.') == instance
    }

    /// A step with values that differ, unless there are none, or the unit has had several such steps.
    pub fn differing(&mut self, cycle: u64, does: &str, checks: &mut Checks) -> Option<Step> {
        if checks.0.is_empty() {
            return None;
        }
        let values = std::mem::take(&mut checks.0);
        self.differed += 1;
        (self.differed <= DIFFERENCES).then(|| {
            let net = values[0].what;
            self.step_at(net, cycle, None, does, values)
        })
    }
}

/// The values that differ, of those that are compared.
#[derive(Debug, Default)]
pub(crate) struct Checks(Vec<Compared>);

impl Checks {
    /// Whether a value differs.
    pub fn differ(&self) -> bool {
        !self.0.is_empty()
    }

    /// Compares two values.
    pub fn same<T: PartialEq + Display>(&mut self, what: &'static str, hardware: T, golden: T) {
        if hardware != golden {
            self.0.push(compared(what, hardware, golden));
        }
    }

    /// Compares bits.
    pub fn bit(&mut self, what: &'static str, hardware: u64, golden: bool) {
        self.same(what, hardware, u64::from(golden));
    }
}

/// The instance and the sentence of the first assertion or assumption that an error is about.
pub(crate) fn violated(error: &Error) -> Option<(&str, &str)> {
    match error {
        Error::Simulation(tilewright_sim::Error::Violated(all)) => {
            all.first().map(|it| (it.instance.as_str(), it.message.as_str()))
        }
        _ => None,
    }
}

/// A value in the hardware, with nothing to compare it with.
pub(crate) fn value(what: &'static str, hardware: impl ToString) -> Compared {
    Compared { what, hardware: hardware.to_string(), golden: None }
}

/// A value in the hardware beside the model's.
pub(crate) fn compared(what: &'static str, hardware: impl ToString, golden: impl ToString) -> Compared {
    Compared { what, hardware: hardware.to_string(), golden: Some(golden.to_string()) }
}

/// A word of a pixel as it is shown.
pub(crate) fn hex(word: u64) -> String {
    format!("{word:012x}")
}

/// `yes` or `no`.
pub(crate) fn yes(holds: bool) -> &'static str {
    if holds { "yes" } else { "no" }
}
