//! The steps of a way while it is found: what a unit does, and where a plain model of it differs.

use std::fmt::Display;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tilewright_sim::Error;

use crate::way::{Compared, Step};

/// Differences of a unit that are kept: the first ones say all.
const DIFFERENCES: usize = 3;

/// The steps so far, of units that are simulated at the same time. Clones share them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trail(Arc<Mutex<Vec<Step>>>);

impl Trail {
    fn steps(&self) -> MutexGuard<'_, Vec<Step>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Adds a step.
    pub fn push(&self, step: Step) {
        self.steps().push(step);
    }

    /// Adds steps.
    pub fn extend(&self, steps: impl IntoIterator<Item = Step>) {
        self.steps().extend(steps);
    }

    /// Whether a step differs.
    pub fn differs(&self) -> bool {
        self.steps().iter().any(Step::differs)
    }

    /// All steps, by time; those of one time in the sequence in which they were added.
    pub fn take(&self) -> Vec<Step> {
        let mut steps = std::mem::take(&mut *self.steps());
        steps.sort_by_key(|step| step.time);
        steps
    }
}

/// A unit whose steps are found, and how many of them differed.
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

    /// A step at that edge of its clock.
    pub fn step(&self, cycle: u64, primitive: Option<usize>, does: impl Into<String>, values: Vec<Compared>) -> Step {
        let (clock, period) = self.clock;
        Step {
            primitive,
            unit: self.name.clone(),
            block: self.block,
            does: does.into(),
            clock: clock.to_owned(),
            cycle,
            time: cycle * period,
            net: None,
            values,
        }
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
        let net = Some(format!("{}{net}", self.path));
        Step { net, ..self.step(cycle, primitive, does, values) }
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
            self.0.push(compared(what, hardware, Some(golden)));
        }
    }

    /// Compares bits.
    pub fn bit(&mut self, what: &'static str, hardware: u64, golden: bool) {
        self.same(what, hardware, u64::from(golden));
    }
}

/// A value beside the model's.
pub(crate) fn compared<T: Display>(what: &'static str, hardware: T, golden: Option<T>) -> Compared {
    Compared { what, hardware: hardware.to_string(), golden: golden.map(|golden| golden.to_string()) }
}

/// The instance and the sentence of the first assertion or assumption that an error is about.
pub(crate) fn violated(error: &crate::Error) -> Option<(&str, &str)> {
    match error {
        crate::Error::Simulation(Error::Violated(all)) => {
            all.first().map(|it| (it.instance.as_str(), it.message.as_str()))
        }
        _ => None,
    }
}
