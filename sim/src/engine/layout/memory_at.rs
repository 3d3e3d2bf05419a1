//! A memory as code sees it.

use super::Words;
use super::store::is_mask;
use crate::engine::strips::Extent;
use tilewright_circuit::top_mask;

/// A memory as code sees it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct MemoryAt {
    /// Its bank, by index, and its first byte there.
    pub bank: usize,
    pub first: usize,
    pub address: usize,
    /// If code runs for several units or simulations, the offset of the address in the data that moves with them.
    pub table: Option<usize>,
    pub words: Words,
    pub lanes: u32,
    pub depth: u32,
    pub width: u32,
    /// The word that zeros represent, up to 64 bits. Words are stored as their exclusive or with it, so that a memory
    /// that is full of one word at the start need not be written.
    pub blank: u64,
    /// Every address that can be expressed is within the depth.
    pub is_full: bool,
}

impl MemoryAt {
    /// The offset of a word in the bank.
    pub fn at(&self, lane: u32, address: u32) -> usize {
        self.first + self.words.at(lane, address)
    }

    /// The stored form of a word, or the word of a stored form.
    pub fn standing(&self, limbs: &[u64]) -> Vec<u64> {
        let mut limbs = limbs.to_vec();
        limbs[0] ^= self.blank;
        limbs
    }

    /// Its bank, from its first byte on.
    pub fn extent(&self) -> Extent {
        let (first, integer) = (self.first as i64, self.element());
        let most = if is_mask(self.words.word, self.width) { u64::MAX } else { top_mask(self.width.min(64)) };
        Extent { start: -first, end: self.words.size as i64 - first, integer, most, is_state: true }
    }

    /// Bits of the integers that a word consists of.
    pub fn element(&self) -> u32 {
        (self.words.word as u32 * 8).min(64)
    }
}
