//! A direction of the network: who is ready for its next word when.

use std::ops::Range;

use super::delays::Delays;
use crate::pixelflow::costs::Ticks;

/// A direction of the network. Nodes are counted along it.
pub(super) struct Direction {
    delays: Delays,
    nodes: usize,
    /// Since when no node has anything to do there. The last one has its bytes last, and nothing comes to those before the one that loads.
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
    /// So many nodes behind the one that loads.
    pub fn behind(&self, nodes: usize) -> Range<Ticks> {
        let later = self.hop * nodes as Ticks;
        self.at.start + later..self.at.end + later
    }
}

impl Direction {
    pub fn new(delays: Delays, nodes: usize) -> Direction {
        Direction { delays, nodes, free: 0 }
    }

    /// The first byte of a word would go then: all nodes are free and set up, and the last bank that one of them needs is given at that time.
    pub fn begin(&self, given: Ticks) -> Ticks {
        let Delays { job, set, go, .. } = self.delays;
        (self.free + job).max(given + self.delays.given) + set + go
    }

    /// Sends it from a node, for so long.
    pub fn send(&mut self, from: usize, given: Ticks, takes: Ticks) -> Passing {
        let begin = self.begin(given);
        let passing = Passing { at: begin..begin + takes, hop: self.delays.hop };
        self.free = passing.behind(self.nodes - 1 - from).end;
        passing
    }
}
