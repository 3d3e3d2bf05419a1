//! The clocks of a coverage-test unit: those of a window's division, and the unit's counters (MPG-EQ5).
//!
//! The clock in which a unit takes or sends a window is the last one of its step before. So a window taken at clock t has its first test at
//! t + 1, and the next window is taken in the last clock of its last quarter.

use super::record::{Counts, Visit};
use crate::quadtree::windows::{Costs, Search, Window};
use tilewright_rtl::quadtree::coverage_test::Test;
use tilewright_scenes::Polygon;

/// The common data of all units of a run.
#[derive(Clone, Copy)]
pub(super) struct Course<'a> {
    pub search: &'a Search,
    pub polygons: &'a [Polygon],
    pub test: Test,
}

impl<'a> Course<'a> {
    /// Parameters of a surface, kp: depth and three colours.
    pub const PARAMETERS: u64 = 4;

    pub fn polygon(&self, work: Work) -> &'a Polygon {
        &self.polygons[work.packet as usize]
    }

    fn costs(&self, work: Work) -> Costs {
        Costs::new(self.test, self.polygon(work).edges.len() as u64, Course::PARAMETERS)
    }
}

/// A window of a packet.
#[derive(Clone, Copy)]
pub(super) struct Work {
    /// The packet's number.
    pub packet: u32,
    pub window: Window,
}

/// The division of a window.
pub(super) struct Division {
    work: Work,
    quarters: [Option<Window>; 4],
    /// The quarter that is tested or sent.
    number: usize,
    costs: Costs,
    taken: u64,
    /// The current clock: the one from which on a quarter is offered, or the last of the division.
    clock: u64,
    sent: [u64; 4],
    counts: Counts,
}

impl Division {
    /// The division of a window that is taken in a clock.
    pub fn new(course: &Course, work: Work, taken: u64) -> Division {
        Division {
            work,
            quarters: course.search.quarters(course.polygon(work), work.window),
            number: 0,
            costs: course.costs(work),
            taken,
            clock: taken,
            sent: [0; 4],
            counts: Counts::default(),
        }
    }

    /// The current clock.
    pub fn clock(&self) -> u64 {
        self.clock
    }

    /// The quarter that is offered.
    pub fn number(&self) -> usize {
        self.number
    }

    /// Advances to the next quarter that passes, which is offered from then on; `None` at the end.
    pub fn next(&mut self) -> Option<Work> {
        while let Some(quarter) = self.quarters.get(self.number).copied() {
            self.works_for(self.costs.test);
            if let Some(window) = quarter {
                self.works_for(self.costs.window);
                return Some(Work { window, ..self.work });
            }
            self.number += 1;
        }
        None
    }

    /// Sends the offered quarter in that clock.
    pub fn send(&mut self, clock: u64) {
        self.counts.stalled += clock - self.clock;
        self.sent[self.counts.results as usize] = clock;
        self.counts.results += 1;
        self.clock = clock;
        self.number += 1;
    }

    fn works_for(&mut self, clocks: u64) {
        self.clock += clocks;
        self.counts.busy += clocks;
    }
}

/// A coverage-test unit.
pub(super) struct Unit {
    /// The level of the greatest windows that it sends.
    level: u32,
    /// By level of the windows that it sends.
    counts: Vec<Counts>,
    /// The last clock of the window that it took last.
    end: u64,
    visits: Option<Vec<Visit>>,
}

impl Unit {
    /// A unit that sends windows of several levels, the first of which is `level`.
    pub fn new(level: u32, levels: u32, keeps_visits: bool) -> Unit {
        Unit { level, counts: vec![Counts::default(); levels as usize], end: 0, visits: keeps_visits.then(Vec::new) }
    }

    /// The clock from which on it can take the next window.
    pub fn end(&self) -> u64 {
        self.end
    }

    /// The level of the smallest windows that it sends.
    pub fn last_level(&self) -> u32 {
        self.level + self.counts.len() as u32 - 1
    }

    /// Divides a window that it takes in that clock. `send` takes a quarter that is offered from a clock on, and returns the clock in which
    /// it goes.
    pub fn divide(&mut self, course: &Course, work: Work, taken: u64, mut send: impl FnMut(Work, u64) -> u64) {
        let mut division = Division::new(course, work, taken);
        while let Some(quarter) = division.next() {
            division.send(send(quarter, division.clock));
        }
        self.count(&division);
    }

    /// Counts a division that has ended.
    pub fn count(&mut self, division: &Division) {
        let Division { work, taken, clock, sent, counts, .. } = division;
        let unit = work.window.level + 1;
        self.counts[(unit - self.level) as usize] += *counts;
        self.end = *clock;
        if let Some(visits) = &mut self.visits {
            let sent = sent[..counts.results as usize].to_vec();
            visits.push(Visit { unit, packet: work.packet, window: work.window, taken: *taken, sent, ended: *clock });
        }
    }

    /// Adds its counters to those of all units of a video processor, and passes on its visits.
    pub fn hand_over(self, counts: &mut [Counts], visits: &mut Vec<Visit>) {
        let from = self.level as usize;
        counts[from..].iter_mut().zip(self.counts).for_each(|(sum, counts)| *sum += counts);
        visits.extend(self.visits.into_iter().flatten());
    }
}
