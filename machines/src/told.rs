//! The steps that are told of a pixel, as units are observed.

use std::collections::HashSet;

use tilewright_sim::Violation;

use crate::error::Error;
use crate::way::{Compared, Step};

/// The steps so far.
#[derive(Default)]
pub(crate) struct Told {
    steps: Vec<Step>,
    /// Checks that have differed: each difference is told once for a unit, as all later ones may follow from it.
    differed: HashSet<(&'static str, u32)>,
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
        Step { primitive: None, unit, block, does, clock, cycle: number, time, net: None, values }
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
    /// Tells a step of the followed pixel.
    pub fn tell(&mut self, step: Step) {
        self.steps.push(step);
    }

    /// Tells a step of the followed pixel, or the first one of that check on a unit that differs.
    pub fn check(&mut self, check: &'static str, number: u32, is_followed: bool, step: impl FnOnce() -> Step) {
        if is_followed {
            self.steps.push(step());
        } else if self.differed.insert((check, number)) {
            let step = step();
            debug_assert!(step.differs(), "{step:?}");
            self.steps.push(step);
        }
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
