//! Jobs of nodes and network that run in parallel.

use std::collections::VecDeque;
use std::ops::Range;

use crate::error::Error;
use crate::pixelflow::costs::Ticks;
use crate::pixelflow::hardware::{Access, Node, Way, Words};
use crate::pixelflow::works::Works;

/// The receiver of words.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Target {
    /// That shader.
    Shader(usize),
    /// The node of the frame buffer.
    Holder,
}

/// Words that the network composes.
pub(super) struct Composition {
    pub turn: usize,
    pub target: Target,
    /// For each node with words, its place on the way and the words, sorted by place.
    pub own: Vec<(usize, Words)>,
    /// The place of the receiver.
    pub to: usize,
    /// Whether the node of each word is wanted.
    pub asks: bool,
    /// The tick of the first byte, if a pixel is followed.
    pub followed: Option<Ticks>,
}

/// The composed words.
pub(super) struct Composed {
    pub turn: usize,
    pub target: Target,
    pub words: Words,
    /// For each pixel, by chip and its number there, the place of the node with the received word, the first of several; empty if not wanted.
    pub winners: Vec<u16>,
}

/// A node that receives words.
pub(super) struct Worker {
    pub node: Node,
    /// Turns whose words arrive in known ticks.
    turns: VecDeque<usize>,
    /// Turns whose words are not known yet.
    left: usize,
    is_done: bool,
}

impl Worker {
    /// A node that receives the words of that number of turns.
    pub fn new(node: Node, turns: usize) -> Worker {
        Worker { node, turns: VecDeque::new(), left: turns, is_done: false }
    }

    /// Announces the words of its next turn.
    pub fn gets(&mut self, turn: usize, access: Access) {
        self.node.access(access);
        self.turns.push_back(turn);
        self.left -= 1;
    }

    /// Whether it has finished.
    pub fn is_done(&self) -> bool {
        self.is_done
    }

    /// Works on turns. Words may arrive while it works on the turn before, so it begins only when the next turn is known, too.
    fn go_on(&mut self, work: impl Fn(&mut Node, usize) -> Result<(), Error>) -> Result<(), Error> {
        let knows = 1 + usize::from(self.left > 0);
        while self.turns.len() >= knows {
            let Some(turn) = self.turns.pop_front() else { break };
            work(&mut self.node, turn)?;
        }
        if self.left == 0 && !self.is_done {
            self.is_done = true;
            self.node.finish()?;
        }
        Ok(())
    }
}

/// A job of a node or of the network.
pub(super) enum Job<'a> {
    /// The node of the frame buffer takes colours.
    Holds(&'a mut Worker),
    /// A shader makes colours.
    Shades(&'a mut Worker),
    /// The network composes words.
    Composes(&'a mut Way, Vec<Composition>, Vec<Composed>),
    /// A rasterizer of that number draws turns; the region of a pixel that is followed.
    Draws(&'a mut Node, usize, Range<usize>, Option<usize>),
}

impl Job<'_> {
    /// Does the job.
    pub fn run(&mut self, works: &Works) -> Result<(), Error> {
        match self {
            Job::Holds(holder) => holder.go_on(|node, turn| node.run(&works.storing(turn), &[])),
            Job::Shades(shader) => shader.go_on(|node, turn| node.run(works.shading(turn), &[])),
            Job::Composes(way, words, composed) => {
                for Composition { turn, target, own, to, asks, followed } in words {
                    let own: Vec<(usize, &Words)> = own.iter().map(|(place, words)| (*place, words)).collect();
                    let words = way.send(&own, *to, *followed)?;
                    let winners = if *asks { way.winners(&own, &words) } else { Vec::new() };
                    composed.push(Composed { turn: *turn, target: *target, words, winners });
                }
                Ok(())
            }
            Job::Draws(node, number, turns, region) => {
                let end = turns.end;
                turns.try_for_each(|turn| {
                    if region.is_some_and(|region| works.region(turn) == region) {
                        node.tell(works.primitives_of(*number, turn));
                    }
                    node.run(works.program(*number, turn), works.marks(*number, turn))
                })?;
                if end == works.turns() { node.finish() } else { Ok(()) }
            }
        }
    }
}
