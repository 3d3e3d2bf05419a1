//! What nodes and network do side by side.

use std::collections::VecDeque;
use std::ops::Range;

use crate::error::Error;
use crate::pixelflow::hardware::{Access, Node, Way, Words};
use crate::pixelflow::works::Works;

/// To whom words go.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Target {
    /// That shader.
    Shader(usize),
    /// The holder of the frame.
    Holder,
}

/// Words that the network composes.
pub(super) struct Composition {
    pub turn: usize,
    pub target: Target,
    /// Of each node that has some, its place on the way, and they; in the order of places.
    pub own: Vec<(usize, Words)>,
    /// The place that gets what comes of them.
    pub to: usize,
    /// Whether it is to be known whose words they are.
    pub asks: bool,
}

/// What came of them.
pub(super) struct Composed {
    pub turn: usize,
    pub target: Target,
    pub words: Words,
    /// Of each pixel, by chip and there by its number, who has the word that came: the first of them in the order of places; nothing if it is not asked for.
    pub winners: Vec<u16>,
}

/// A node to which words come.
pub(super) struct Worker {
    pub node: Node,
    /// Turns whose words come in ticks that it knows.
    turns: VecDeque<usize>,
    /// Turns whose words it does not know yet.
    left: usize,
    is_done: bool,
}

impl Worker {
    /// One that gets the words of so many turns.
    pub fn new(node: Node, turns: usize) -> Worker {
        Worker { node, turns: VecDeque::new(), left: turns, is_done: false }
    }

    /// Those of its next turn will come.
    pub fn gets(&mut self, turn: usize, access: Access) {
        self.node.access(access);
        self.turns.push_back(turn);
        self.left -= 1;
    }

    /// Whether it has done all that it has to.
    pub fn is_done(&self) -> bool {
        self.is_done
    }

    /// Works on turns. Words may come while it works on those before, so it begins when it knows the next ones, too.
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

/// What one of them has to do.
pub(super) enum Job<'a> {
    /// The holder of the frame takes colours.
    Holds(&'a mut Worker),
    /// A shader makes some.
    Shades(&'a mut Worker),
    /// The network composes words.
    Composes(&'a mut Way, Vec<Composition>, Vec<Composed>),
    /// A rasterizer draws turns; its number.
    Draws(&'a mut Node, usize, Range<usize>),
}

impl Job<'_> {
    /// Does it.
    pub fn run(&mut self, works: &Works) -> Result<(), Error> {
        match self {
            Job::Holds(holder) => holder.go_on(|node, turn| node.run(&works.storing(turn), &[])),
            Job::Shades(shader) => shader.go_on(|node, turn| node.run(works.shading(turn), &[])),
            Job::Composes(way, words, composed) => {
                for Composition { turn, target, own, to, asks } in words {
                    let own: Vec<(usize, &Words)> = own.iter().map(|(place, words)| (*place, words)).collect();
                    let words = way.send(&own, *to)?;
                    let winners = if *asks { way.winners(&own, &words) } else { Vec::new() };
                    composed.push(Composed { turn: *turn, target: *target, words, winners });
                }
                Ok(())
            }
            Job::Draws(node, number, turns) => {
                let end = turns.end;
                turns.try_for_each(|turn| node.run(works.program(*number, turn), works.marks(*number, turn)))?;
                if end == works.turns() { node.finish() } else { Ok(()) }
            }
        }
    }
}
