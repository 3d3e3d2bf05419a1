//! Split words, seen as whole words.

use std::ops::Range;

use tilewright_circuit::{Bits, limbs_for, top_mask};

use super::Compiled;
use crate::engine::fields::Part;
use crate::engine::program::{Memory, ValueId};
use crate::engine::start::State;

impl Compiled {
    /// A word of a memory of the description.
    pub(super) fn word_of_parts(&self, memory: u32, lane: u32, address: u32) -> Vec<u64> {
        let mut parts = Vec::new();
        for &Part { of, piece } in &self.parts.memories[memory as usize] {
            for within in 0..piece.lanes {
                let part = self.stored(of, lane * piece.lanes + within, address);
                parts.push(Bits::from_limbs(piece.each(), &part));
            }
        }
        Bits::join(&parts).limbs().to_vec()
    }

    /// A word of up to 64 bits of a memory of the description. Only wider ones are split.
    pub(super) fn short_word_of_parts(&self, memory: u32, lane: u32, address: u32) -> u64 {
        let parts = &self.parts.memories[memory as usize];
        debug_assert_eq!(parts.len(), 1);
        let mut word = [0];
        self.read_stored(parts[0].of, lane, address, &mut word);
        word[0]
    }

    /// Appends all words of a memory of the description, whose lanes have so many of this width.
    pub(super) fn all_words_of_parts(&self, memory: u32, declared: &Memory, out: &mut Vec<u64>) {
        let (first, limbs) = (out.len(), limbs_for(declared.width));
        out.resize(first + declared.lanes as usize * declared.depth as usize * limbs, 0);
        let mut low = 0;
        for &Part { of, piece } in &self.parts.memories[memory as usize] {
            for within in 0..piece.lanes {
                let mut words = out[first..].chunks_exact_mut(limbs);
                let mut part = vec![0; limbs_for(piece.each())];
                for lane in 0..declared.lanes {
                    for (address, word) in (0..declared.depth).zip(&mut words) {
                        self.read_stored(of, lane * piece.lanes + within, address, &mut part);
                        put_bits(word, low, &part);
                    }
                }
                low += piece.each();
            }
        }
    }

    /// Reads a lane's word of a memory that code uses.
    fn read_stored(&self, memory: u32, lane: u32, address: u32, limbs: &mut [u64]) {
        let lanes = self.bits.memories.get(&memory).copied();
        let at = self.memories[memory as usize];
        let place = at.at(lane / lanes.unwrap_or(1), address);
        self.banks[at.bank].get_word(place, at.words.word, at.width, limbs);
        limbs[0] ^= at.blank;
        if let Some(lanes) = lanes {
            limbs[0] = limbs[0] >> (lane % lanes) & 1;
        }
    }

    /// Replaces a word of a memory of the description.
    pub(super) fn set_word_in_parts(&mut self, memory: u32, lane: u32, address: u32, limbs: &[u64]) {
        for part in self.parts.memories[memory as usize].clone() {
            for (lane, limbs) in lanes(part, lane..lane + 1, limbs) {
                self.store(part.of, lane.start, address, &limbs);
            }
        }
    }

    /// A lane's word of a memory that code uses.
    fn stored(&self, memory: u32, lane: u32, address: u32) -> Vec<u64> {
        match self.bits.memories.get(&memory) {
            Some(&lanes) => vec![self.whole(memory, lane / lanes, address)[0] >> (lane % lanes) & 1],
            None => self.whole(memory, lane, address),
        }
    }

    /// Replaces a lane's word of a memory that code uses.
    fn store(&mut self, memory: u32, lane: u32, address: u32, limbs: &[u64]) {
        match self.bits.memories.get(&memory) {
            Some(&lanes) => self.set_bits(memory, lane..lane + 1, lanes, address, limbs[0]),
            None => self.set_whole_word(memory, lane, address, limbs),
        }
    }

    /// Sets this bit of these lanes of a memory whose words have several lanes.
    fn set_bits(&mut self, memory: u32, range: Range<u32>, lanes: u32, address: u32, bit: u64) {
        for (word, mask) in words(range, lanes) {
            let old = self.whole(memory, word, address)[0];
            self.set_whole_word(memory, word, address, &[old & !mask | mask & bit.wrapping_neg()]);
        }
    }

    fn whole(&self, memory: u32, lane: u32, address: u32) -> Vec<u64> {
        let at = self.memories[memory as usize];
        let mut limbs = vec![0; limbs_for(at.width)];
        self.banks[at.bank].get_word(at.at(lane, address), at.words.word, at.width, &mut limbs);
        at.standing(&limbs)
    }

    fn set_whole_word(&mut self, memory: u32, lane: u32, address: u32, limbs: &[u64]) {
        let at = self.memories[memory as usize];
        self.banks[at.bank].put_word(at.at(lane, address), at.words.word, at.width, &at.standing(limbs));
    }

    /// Sets these lanes of a register, or read data, that code uses.
    fn set_lanes(&mut self, id: ValueId, range: Range<u32>, limbs: &[u64]) {
        let Some(&(packed, lanes)) = self.bits.states.get(&id) else { return self.set_whole(id, range, limbs) };
        let place = self.places[packed.index()].expect("what has a start is state");
        for (word, mask) in words(range, lanes) {
            let set = self.state.number(place, word) & !mask | mask & limbs[0].wrapping_neg();
            self.state.put_word(place.lane(word), place.bytes(), place.width, &[set]);
        }
    }
}

impl State for Compiled {
    fn set(&mut self, id: ValueId, range: Range<u32>, limbs: &[u64]) {
        let Some(parts) = self.parts.registers.get(&id).cloned() else { return self.set_lanes(id, range, limbs) };
        for part in parts {
            for (range, limbs) in lanes(part, range.clone(), limbs) {
                self.set_lanes(part.of, range, &limbs);
            }
        }
    }

    fn set_words(&mut self, memory: u32, range: Range<u32>, addresses: Range<u32>, limbs: &[u64]) {
        for part in self.parts.memories[memory as usize].clone() {
            for (range, limbs) in lanes(part, range.clone(), limbs) {
                match self.bits.memories.get(&part.of) {
                    None => self.set_whole_words(part.of, range, addresses.clone(), &limbs),
                    Some(&lanes) => addresses
                        .clone()
                        .for_each(|address| self.set_bits(part.of, range.clone(), lanes, address, limbs[0])),
                }
            }
        }
    }
}

/// Sets bits from `low` on, which are zero, to those of `part`.
fn put_bits(word: &mut [u64], low: u32, part: &[u64]) {
    let (first, shift) = (low as usize / 64, low % 64);
    for (index, &limb) in part.iter().enumerate() {
        word[first + index] |= limb << shift;
        if shift > 0 && limb >> (64 - shift) != 0 {
            word[first + index + 1] |= limb >> (64 - shift);
        }
    }
}

/// The words in which these lanes are packed, `lanes` in each, with the lanes' bits.
fn words(range: Range<u32>, lanes: u32) -> impl Iterator<Item = (u32, u64)> {
    (range.start / lanes..range.end.div_ceil(lanes)).map(move |word| {
        let first = range.start.saturating_sub(word * lanes);
        let end = (range.end - word * lanes).min(lanes);
        (word, top_mask(end) & u64::MAX << first)
    })
}

/// The lanes of a part for these identical words, with their values.
fn lanes<T>(part: Part<T>, words: Range<u32>, limbs: &[u64]) -> Vec<(Range<u32>, Vec<u64>)> {
    let piece = part.piece;
    let word = Bits::from_limbs(limbs.len() as u32 * 64, limbs);
    let of_lane = |lane| piece.of_lane(lane, &word).limbs().to_vec();
    if piece.lanes == 1 {
        return vec![(words, of_lane(0))];
    }
    let each: Vec<Vec<u64>> = (0..piece.lanes).map(of_lane).collect();
    let all = words.flat_map(|word| (0..).zip(&each).map(move |(lane, limbs)| (word * piece.lanes + lane, limbs)));
    all.map(|(lane, limbs)| (lane..lane + 1, limbs.clone())).collect()
}
