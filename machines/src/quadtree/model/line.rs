//! The stages of a raster processor, one after another, and the pixel processor at the end.
//!
//! A stage answers the clock in which it takes a window that is offered from a clock on. Windows keep their sequence, so the answer follows from
//! earlier windows: a queue of depth d takes its k-th window after window k - d has left it. So a stage works when its queue is full, or at the
//! end. The model needs only maxima and sums, and does not step through clocks.

use super::division::{Course, Unit, Work};
use super::queue::Queue;
use super::record::{Counts, Visit};
use super::tree::Tree;

/// A stage.
pub(super) enum Stage {
    /// A unit of a pipe, or a tree of one level.
    Unit(Queued),
    Stack(Stack),
    Tree(Tree),
    Pixels(Pixels),
}

/// The clock in which the first stage takes a window that is offered from a clock on.
pub(super) fn take(stages: &mut [Stage], course: &Course, work: Work, offered: u64) -> u64 {
    match stages.split_first_mut() {
        Some((Stage::Unit(unit), behind)) => unit.take(behind, course, work, offered),
        Some((Stage::Stack(stack), behind)) => stack.take(behind, course, work, offered),
        Some((Stage::Tree(tree), behind)) => tree.take(behind, course, work, offered),
        Some((Stage::Pixels(pixels), _)) => pixels.take(course, work, offered),
        None => offered,
    }
}

/// Finishes the remaining work.
pub(super) fn finish(stages: &mut [Stage], course: &Course) {
    if let Some((stage, behind)) = stages.split_first_mut() {
        match stage {
            Stage::Unit(unit) => while unit.divide_oldest(behind, course).is_some() {},
            Stage::Tree(tree) => tree.finish(behind, course),
            Stage::Stack(_) | Stage::Pixels(_) => {}
        }
        finish(behind, course);
    }
}

impl Stage {
    /// The first clock after all its work.
    pub fn idle(&self) -> u64 {
        match self {
            Stage::Unit(Queued { unit, .. }) | Stage::Stack(Stack { unit, .. }) => unit.end() + 1,
            Stage::Tree(tree) => tree.idle(),
            Stage::Pixels(pixels) => pixels.idle,
        }
    }

    /// Passes on its counters.
    pub fn hand_over(self, counts: &mut [Counts], visits: &mut Vec<Visit>) -> u64 {
        match self {
            Stage::Unit(Queued { unit, .. }) | Stage::Stack(Stack { unit, .. }) => unit.hand_over(counts, visits),
            Stage::Tree(tree) => tree.hand_over(counts, visits),
            Stage::Pixels(pixels) => return pixels.fragments,
        }
        0
    }
}

/// A unit with a queue before it.
pub(super) struct Queued {
    queue: Queue<Work>,
    unit: Unit,
}

impl Queued {
    pub fn new(depth: usize, unit: Unit) -> Queued {
        Queued { queue: Queue::new(depth), unit }
    }

    fn take(&mut self, behind: &mut [Stage], course: &Course, work: Work, offered: u64) -> u64 {
        let mut clock = offered;
        if self.queue.is_full() {
            clock = clock.max(self.divide_oldest(behind, course).map_or(0, |left| left + 1));
        }
        self.queue.push(work, clock);
        clock
    }

    /// Divides the oldest window of the queue. Returns the clock in which the window left it.
    fn divide_oldest(&mut self, behind: &mut [Stage], course: &Course) -> Option<u64> {
        let (work, since) = self.queue.pop()?;
        let taken = self.unit.end().max(since + 1);
        self.unit.divide(course, work, taken, |quarter, offered| take(behind, course, quarter, offered));
        Some(taken)
    }
}

/// A unit with a stack. It takes a window when it has none, and divides the newest window first.
pub(super) struct Stack {
    unit: Unit,
    windows: Vec<Work>,
}

impl Stack {
    pub fn new(unit: Unit) -> Stack {
        Stack { unit, windows: Vec::new() }
    }

    fn take(&mut self, behind: &mut [Stage], course: &Course, work: Work, offered: u64) -> u64 {
        let clock = self.unit.end().max(offered);
        let last = self.unit.last_level();
        self.windows.push(work);
        while let Some(work) = self.windows.pop() {
            let taken = self.unit.end().max(clock);
            self.unit.divide(course, work, taken, |quarter, offered| {
                if quarter.window.level == last {
                    return take(behind, course, quarter, offered);
                }
                self.windows.push(quarter);
                offered
            });
        }
        clock
    }
}

/// The pixel processor, which takes every window of one sample at once.
#[derive(Default)]
pub(super) struct Pixels {
    fragments: u64,
    idle: u64,
}

impl Pixels {
    /// Clocks of a fragment in the pixel processor and the video buffer.
    const LATENCY: u64 = 2;

    fn take(&mut self, course: &Course, work: Work, offered: u64) -> u64 {
        if course.search.covers(course.polygon(work), work.window) {
            self.fragments += 1;
            self.idle = offered + Pixels::LATENCY + 1;
        }
        offered
    }
}
