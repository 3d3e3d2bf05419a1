//! A direction of the network: the times at which nodes are ready for the next word.

use std::ops::Range;

use super::delays::Delays;
use crate::pixelflow::costs::Ticks;

/// A direction of the network. Nodes are counted along it.
pub(super) struct Direction {
    delays: Delays,
    nodes: usize,
    /// The time since when all nodes are free. The last node gets its bytes last, and nodes before the loading one get none.
    free: Ticks,
}

/// A word that passes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Passing {
    /// At the node that loads it.
    pub at: Range<Ticks>,
    hop: Ticks,
}

impl Passing {
    /// The distance in nodes from the loading one.
    pub fn behind(&self, nodes: usize) -> Range<Ticks> {
        let later = self.hop * nodes as Ticks;
        self.at.start + later..self.at.end + later
    }
}

impl Direction {
    pub fn new(delays: Delays, nodes: usize) -> Direction {
        Direction { delays, nodes, free: 0 }
    }

    /// The time at which the first byte of a word can go. All nodes are free and set up, and the last bank that they need is given at `given`.
    pub fn begin(&self, given: Ticks) -> Ticks {
        let Delays { job, set, go, .. } = self.delays;
        (self.free + job).max(given + self.delays.given) + set + go
    }

    /// Sends a word from a node, for that time.
    pub fn send(&mut self, from: usize, given: Ticks, takes: Ticks) -> Passing {
        let begin = self.begin(given);
        let passing = Passing { at: begin..begin + takes, hop: self.delays.hop };
        self.free = passing.behind(self.nodes - 1 - from).end;
        passing
    }
}
