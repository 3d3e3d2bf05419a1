//! A frame that runs, turn by turn: nodes wait for the network, and it for them, at their banks.

use std::collections::VecDeque;
use std::ops::Range;

use super::delays::Delays;
use super::direction::{Direction, Passing};
use super::{Arrays, Done, Shading, Turn};
use crate::pixelflow::costs::Ticks;

/// What a shader did with a region.
pub(super) struct Shaded {
    /// From its first look at the words until its colours are given.
    pub at: Range<Ticks>,
    /// Its bank is the network's again, for the next words.
    pub next_word: Ticks,
}

/// What the holder of the frame did with a region.
pub(super) struct Stored {
    /// While its memory is written.
    pub at: Range<Ticks>,
    /// Its bank is the network's again.
    pub given: Ticks,
}

/// When the nodes gave the banks of a turn.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(in crate::pixelflow) struct Given {
    /// Each rasterizer its words.
    pub words: Vec<Ticks>,
    /// The shader its bank for the next ones.
    pub next_word: Ticks,
    /// The holder of the frame its bank of this turn for another one.
    pub stored: Ticks,
}

/// Who is busy until when.
#[derive(Clone, Copy, Default)]
struct Banks {
    /// The ends of the last two uses of what follows: a bank is free again when the one before the last has ended.
    ends: [Ticks; 2],
}

impl Banks {
    /// When there is one.
    fn free(&self) -> Ticks {
        self.ends[0]
    }

    fn used_until(&mut self, end: Ticks) {
        self.ends = [self.ends[1], end];
    }
}

/// The banks of a shader.
struct Shader {
    /// When the network may bring words.
    word: Ticks,
    /// When colours were sent.
    sent: Ticks,
}

/// A frame that runs. Its nodes are the holder of the frame, then rasterizers, then shaders.
pub(super) struct Run<'a, A> {
    pub arrays: A,
    turns: &'a [Turn],
    nodes: usize,
    rasterizers: Vec<Banks>,
    shaders: Vec<Shader>,
    /// From the holder of the frame to the last shader, and back; both are one if all words share the wires.
    forth: Direction,
    back: Option<Direction>,
    /// The banks of the holder of the frame.
    store: Banks,
    /// When each turn was where, and when its banks were given.
    pub done: Vec<Done>,
    pub given: Vec<Given>,
    /// Turns whose colours are not yet sent.
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

    /// When each shader gives its bank for words first.
    pub fn first_words(&self) -> Vec<Ticks> {
        self.shaders.iter().map(|shader| shader.word).collect()
    }

    /// When the holder of the frame gives each of its banks first.
    pub fn first_stores(&self) -> [Ticks; 2] {
        self.store.ends
    }

    /// Lets it run to its end.
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

    /// Words go forth, to a shader.
    fn compose_and_shade(&mut self, number: usize, shading: &Shading, rasterized: Ticks) {
        let ready = rasterized.max(self.shaders[shading.shader].word);
        // Colours that are there go first.
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

    /// Words go back, to the holder of the frame.
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

    /// A word goes back from a node to the first one, when that has a bank.
    fn send_back(&mut self, from: usize, given: Ticks, takes: Ticks) -> Passing {
        let (from, given) = (self.nodes - 1 - from, given.max(self.store.free()));
        self.back.as_mut().unwrap_or(&mut self.forth).send(from, given, takes)
    }

    /// Sends the colours that wait first, if they are there by that time; tells whether they were.
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
