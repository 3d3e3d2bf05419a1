//! A running frame, turn by turn. Nodes and network wait for each other at the nodes' banks.

use std::collections::VecDeque;
use std::ops::Range;

use super::delays::Delays;
use super::direction::{Direction, Passing};
use super::{Arrays, Done, Shading, Turn};
use crate::pixelflow::costs::Ticks;

/// The times of a shader for a region.
pub(super) struct Shaded {
    /// From its first access to the words until its colours are given.
    pub at: Range<Ticks>,
    /// When the network gets its bank again, for the next words.
    pub next_word: Ticks,
}

/// The times of the frame buffer's node for a region.
pub(super) struct Stored {
    /// When its memory is written.
    pub at: Range<Ticks>,
    /// When the network gets its bank again.
    pub given: Ticks,
}

/// The times at which the nodes gave the banks of a turn.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(in crate::pixelflow) struct Given {
    /// Each rasterizer's bank with its words.
    pub words: Vec<Ticks>,
    /// The shader's bank for the next words.
    pub next_word: Ticks,
    /// The bank of the frame buffer's node of this turn, for another turn.
    pub stored: Ticks,
}

/// The times until which units are busy.
#[derive(Clone, Copy, Default)]
struct Banks {
    /// The ends of the last two uses of a pair of banks. A bank is free again when the use before the last has ended.
    ends: [Ticks; 2],
}

impl Banks {
    /// The time at which a bank is free.
    fn free(&self) -> Ticks {
        self.ends[0]
    }

    fn used_until(&mut self, end: Ticks) {
        self.ends = [self.ends[1], end];
    }
}

/// The banks of a shader.
struct Shader {
    /// The time from which on the network may bring words.
    word: Ticks,
    /// The time at which colours were sent.
    sent: Ticks,
}

/// A running frame. Its nodes are that of the frame buffer, then rasterizers, then shaders.
pub(super) struct Run<'a, A> {
    pub arrays: A,
    turns: &'a [Turn],
    nodes: usize,
    rasterizers: Vec<Banks>,
    shaders: Vec<Shader>,
    /// The directions from the frame buffer to the last shader, and back; both are one if all words share the wires.
    forth: Direction,
    back: Option<Direction>,
    /// The banks of the frame buffer's node.
    store: Banks,
    /// The times of each turn, and those at which its banks were given.
    pub done: Vec<Done>,
    pub given: Vec<Given>,
    /// Turns whose colours are not sent yet.
    waiting: VecDeque<usize>,
}

impl<'a, A: Arrays> Run<'a, A> {
    pub fn new(mut arrays: A, delays: Delays, turns: &'a [Turn], one_way: bool) -> Run<'a, A> {
        let [rasterizers, shaders] = arrays.counts();
        let nodes = 1 + rasterizers + shaders;
        let shaders = arrays.first_words().into_iter().map(|word| Shader { word, sent: 0 });
        Run {
            turns,
            nodes,
            rasterizers: vec![Banks::default(); rasterizers],
            shaders: shaders.collect(),
            forth: Direction::new(delays, nodes),
            back: (!one_way).then(|| Direction::new(delays, nodes)),
            store: Banks { ends: arrays.first_stores() },
            done: Vec::with_capacity(turns.len()),
            given: Vec::with_capacity(turns.len()),
            waiting: VecDeque::new(),
            arrays,
        }
    }

    /// The time at which each shader first gives its bank for words.
    pub fn first_words(&self) -> Vec<Ticks> {
        self.shaders.iter().map(|shader| shader.word).collect()
    }

    /// The times at which the node of the frame buffer first gives each of its banks.
    pub fn first_stores(&self) -> [Ticks; 2] {
        self.store.ends
    }

    /// Runs to the end.
    pub fn run(mut self) -> Self {
        for number in 0..self.turns.len() {
            self.turn(number);
        }
        while self.send_first(None) {}
        self
    }

    fn turn(&mut self, number: usize) {
        let turn = &self.turns[number];
        let free: Vec<Ticks> = self.rasterizers.iter().map(Banks::free).collect();
        let given = self.arrays.draw(number, turn, &free);
        let rasterized = given.iter().max().copied().unwrap_or(0);
        self.given.push(Given { words: given, ..Given::default() });
        self.done.push(Done { rasterized, composed: 0..0, shaded: 0..0, sent: 0..0, loaded: 0..0 });
        match turn.shades {
            Some(shading) => self.compose_and_shade(number, &shading, rasterized),
            None => self.compose_and_store(number, rasterized),
        }
    }

    /// Sends words forth to a shader.
    fn compose_and_shade(&mut self, number: usize, shading: &Shading, rasterized: Ticks) {
        let ready = rasterized.max(self.shaders[shading.shader].word);
        // Colours that are ready go first.
        while self.send_first(Some(self.forth.begin(ready))) {}
        let (first, target) = (1, 1 + self.rasterizers.len() + shading.shader);
        let words = self.forth.send(first, ready, self.turns[number].composes);
        for (behind, banks) in self.rasterizers.iter_mut().enumerate() {
            banks.used_until(words.behind(behind).end);
        }
        let shader = &mut self.shaders[shading.shader];
        let shaded = self.arrays.shade(number, shading, words.behind(target - first).end, shader.sent);
        shader.word = shaded.next_word;
        self.given[number].next_word = shaded.next_word;
        self.done[number].composed = words.at;
        self.done[number].shaded = shaded.at;
        self.waiting.push_back(number);
        if self.back.is_some() {
            self.send_first(None);
        }
    }

    /// Sends words back to the node of the frame buffer.
    fn compose_and_store(&mut self, number: usize, rasterized: Ticks) {
        let words = self.send_back(self.rasterizers.len(), rasterized, self.turns[number].composes);
        for (behind, banks) in self.rasterizers.iter_mut().rev().enumerate() {
            banks.used_until(words.behind(behind).end);
        }
        let arrived = words.behind(self.rasterizers.len()).end;
        let done = &mut self.done[number];
        (done.composed, done.shaded, done.sent) = (words.at, arrived..arrived, arrived..arrived);
        self.load(number, arrived);
    }

    /// Sends a word back from a node to the first one, when that has a bank.
    fn send_back(&mut self, from: usize, given: Ticks, takes: Ticks) -> Passing {
        let (from, given) = (self.nodes - 1 - from, given.max(self.store.free()));
        self.back.as_mut().unwrap_or(&mut self.forth).send(from, given, takes)
    }

    /// Sends the first waiting colours, if they are ready by that time. Returns whether they were.
    fn send_first(&mut self, by: Option<Ticks>) -> bool {
        let is_there = |&number: &usize| by.is_none_or(|by| self.done[number].shaded.end <= by);
        let Some(number) = self.waiting.front().copied().filter(is_there) else { return false };
        self.waiting.pop_front();
        let ended = self.done[number].shaded.end;
        let shading = self.turns[number].shades.expect("what is not shaded does not wait");
        if shading.sends == 0 {
            let done = &mut self.done[number];
            (done.sent, done.loaded) = (ended..ended, ended..ended);
            return true;
        }
        let from = 1 + self.rasterizers.len() + shading.shader;
        let colours = self.send_back(from, ended, shading.sends);
        self.shaders[shading.shader].sent = colours.at.end;
        self.load(number, colours.behind(from).end);
        self.done[number].sent = colours.at;
        true
    }

    fn load(&mut self, number: usize, arrived: Ticks) {
        let turn = &self.turns[number];
        let stored = self.arrays.load(number, turn, arrived);
        self.store.used_until(stored.given);
        self.given[number].stored = stored.given;
        self.done[number].loaded = stored.at;
    }
}
