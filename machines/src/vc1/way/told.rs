//! The steps that are told.

use std::collections::HashSet;

use tilewright_rtl::clocks::{MERGE, PE};

use super::{compared, hex};
use crate::way::{Compared, Primitive, Step};

/// The steps so far.
#[derive(Default)]
pub(super) struct Told {
    steps: Vec<Step>,
    /// Checks that have differed: each difference is told once for a unit, as all later ones may follow from it.
    differed: HashSet<(&'static str, u32)>,
}

/// The unit of a step.
pub(super) struct At {
    pub unit: String,
    pub block: &'static str,
    /// The clock's name, the number of its edge, and the time.
    pub edge: Edge,
}

/// An edge of a clock.
#[derive(Clone, Copy)]
pub(super) struct Edge {
    pub clock: &'static str,
    pub number: u64,
    pub time: u64,
}

impl Edge {
    /// An edge of the processing elements' clock, counted from 1 at power-on.
    pub fn pe(number: u64) -> Edge {
        Edge { clock: PE.name, number, time: number * PE.period.picoseconds() }
    }

    /// An edge of the merger's clock.
    pub fn merge(number: u64) -> Edge {
        Edge { clock: MERGE.name, number, time: number * MERGE.period.picoseconds() }
    }
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
    pub(super) fn of(self, primitive: Option<usize>) -> Step {
        Step { primitive, ..self }
    }

    /// The same step on that net.
    pub(super) fn on(self, net: impl Into<String>) -> Step {
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

    /// Tells that a primitive never reached its local frame buffer.
    pub fn never_drawn(&mut self, clock: u64, primitive: &Primitive) {
        let at = At { unit: "processing elements".to_owned(), block: "vc1", edge: Edge::pe(clock) };
        let values = vec![compared("word", "nothing", hex(primitive.golden.unwrap_or_default()))];
        self.tell(at.step("draws the pixel", values).of(Some(primitive.number)));
    }

    /// All steps, in the sequence in which they were told.
    pub fn take(&mut self) -> Vec<Step> {
        std::mem::take(&mut self.steps)
    }
}
