//! A queue in time: its words, each with its clock.

use std::collections::VecDeque;

/// A queue of limited size. A word that is put in at clock t can be taken at t + 1, and its space can be filled one clock later.
pub(super) struct Queue<T> {
    depth: usize,
    words: VecDeque<(T, u64)>,
}

impl<T: Copy> Queue<T> {
    pub fn new(depth: usize) -> Queue<T> {
        Queue { depth, words: VecDeque::new() }
    }

    pub fn len(&self) -> usize {
        self.words.len()
    }

    pub fn depth(&self) -> usize {
        self.depth
    }

    pub fn is_full(&self) -> bool {
        self.len() == self.depth
    }

    /// Puts a word in, in that clock.
    pub fn push(&mut self, word: T, clock: u64) {
        self.words.push_back((word, clock));
    }

    /// The oldest word, and the clock in which it was put in.
    pub fn oldest(&self) -> Option<(T, u64)> {
        self.words.front().copied()
    }

    /// Takes the oldest word.
    pub fn pop(&mut self) -> Option<(T, u64)> {
        self.words.pop_front()
    }
}
