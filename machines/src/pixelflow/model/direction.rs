//! A direction of the network: who is ready for its next word when.

use std::ops::Range;

use super::delays::Delays;
use crate::pixelflow::costs::Ticks;

/// A direction of the network. Nodes are counted along it.
pub(super) struct Direction {
    delays: Delays,
    /// Since when each node has nothing to do there.
    free: Vec<Ticks>,
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
        Direction { delays, free: vec![0; nodes] }
    }

    /// The first byte of a word would go then: all nodes are free and set up, and the last bank that one of them needs is given at that time.
    pub fn begin(&self, given: Ticks) -> Ticks {
        let Delays { job, set, go, .. } = self.delays;
        let free = self.free.iter().max().copied().unwrap_or(0);
        (free + job).max(given + self.delays.given) + set + go
    }

    /// Sends it from a node, for so long.
    pub fn send(&mut self, from: usize, given: Ticks, takes: Ticks) -> Passing {
        let begin = self.begin(given);
        let passing = Passing { at: begin..begin + takes, hop: self.delays.hop };
        for (number, free) in self.free.iter_mut().enumerate() {
            // Nothing comes to those before: they have done when all are ready.
            *free = number.checked_sub(from).map_or(begin, |behind| passing.behind(behind).end);
        }
        passing
    }
}
