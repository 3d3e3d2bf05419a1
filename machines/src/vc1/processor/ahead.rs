//! Steps of many clocks at once, for the model of a processing element. None of them matters to the bus or to others.

use super::{Access, Class, Now, Phase, Processor, Task};

/// A polygon that all draw, in the queues.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shared {
    /// The number of its first word on the bus.
    pub first: u64,
    pub sender: u32,
    /// Its rows.
    pub top: u32,
    pub bottom: u32,
    /// The edge at which its last word arrived in the queues.
    pub came: u64,
}

impl Processor {
    /// Whether its next actions do not matter to others: its word waits for the bus, or only polygons of others remain in its frame.
    pub fn is_unseen(&self) -> bool {
        let receives =
            matches!(self.tasks[..], [Task::Frames(Phase::Drawn)] | [Task::Frames(Phase::Drawn), Task::Receive { .. }]);
        self.offered.is_some() || receives
    }

    /// Whether it only sets up a received polygon, because it has no row of it and did not send it.
    pub fn skips(&self, polygon: &Shared) -> bool {
        let rows = self.settings.rows().count(polygon.top, polygon.bottom);
        // Without clocks for that it would look at its queue at once.
        polygon.sender != self.settings.number && rows == 0 && self.settings.costs.set_up > 0
    }

    /// Receives at once the rest of a polygon that it [skips](Processor::skips), in this number of clocks. It waits in the clocks that it does not
    /// need.
    pub fn skip_ahead(&mut self, receives: u64, clocks: u64) {
        self.tally.clocks.receiving += receives;
        self.tally.clocks.bus += clocks - receives;
        self.tasks.pop();
        self.tasks.push(Task::SetUp { clocks: self.settings.costs.set_up });
        self.go_on();
    }

    /// Whether another pixel or entry of the same task follows, so that the bus does not matter to it.
    pub fn is_by_itself(&self) -> bool {
        match self.now {
            Now::Computing(_, _, None | Some(Access::Clear(_) | Access::Draw(_)))
            | Now::Accessing(Access::Clear(_) | Access::Draw(_)) => match self.tasks.last() {
                Some(Task::Scan(scan)) => scan.has_pixel(),
                Some(Task::Clear { patch }) => *patch < self.settings.patches,
                _ => false,
            },
            _ => false,
        }
    }

    /// Clears this number of entries at once, before one that is cleared later. The local frame buffer takes an entry every `every` clocks, and
    /// the processing element waits for it.
    pub fn clear_ahead(&mut self, entries: u32, every: u64) {
        let (Now::Computing(_, _, Some(Access::Clear(next))) | Now::Accessing(Access::Clear(next))) = &mut self.now
        else {
            unreachable!("it clears");
        };
        let Some(Task::Clear { patch }) = self.tasks.last_mut() else { unreachable!("an entry is cleared by a task") };
        *next += entries;
        *patch += entries;
        let (entries, cost) = (u64::from(entries), self.settings.costs.clear);
        self.tally.clocks.clearing += entries * cost;
        self.tally.clocks.stalled += entries * (every - cost);
    }

    /// Clocks from a word to the next one, if that has arrived.
    pub fn receive_clocks(&self) -> u64 {
        self.settings.costs.receive
    }

    /// Receives at once this number of words, which are available and not the last of their packet. The clocks count until the last of these is
    /// taken.
    pub fn receive_ahead(&mut self, words: u64, clocks: u64) {
        let left = if let Now::Computing(left, ..) = self.now { left } else { 0 };
        let every = self.settings.costs.receive;
        let works = left + 1 + (words - 1) * every;
        self.tally.clocks.receiving += works;
        self.tally.clocks.bus += clocks - works;
        self.compute(every - 1, Class::Receiving, Some(Access::Receive));
    }
}
