//! The parts of an engine's memory that are not zero at its start.

use std::ops::Range;

use super::Compiled;
use crate::engine::program::ValueId;

impl Compiled {
    /// Sets these lanes of a register, or of read data, in the memory of code.
    pub(super) fn set_whole(&mut self, id: ValueId, lanes: Range<u32>, limbs: &[u64]) {
        let place = self.places[id.index()].expect("what has a start is state");
        self.state.repeat_word(place.lane(lanes.start), place.bytes(), place.width, limbs, lanes.len());
    }

    /// Sets the word of these lanes of a memory at each of these addresses in the memory of code.
    pub(super) fn set_whole_words(&mut self, memory: u32, lanes: Range<u32>, addresses: Range<u32>, limbs: &[u64]) {
        let at = self.memories[memory as usize];
        // Everything is zero so far.
        let limbs = &at.standing(limbs);
        if limbs.iter().all(|&limb| limb == 0) {
            return;
        }
        let store = &mut self.banks[at.bank];
        let mut repeat = |lane, address, count| {
            store.repeat_word(at.at(lane, address), at.words.word, at.width, limbs, count);
        };
        if at.words.together() {
            addresses.for_each(|address| repeat(lanes.start, address, lanes.len()));
        } else if at.words.address == at.words.word {
            lanes.for_each(|lane| repeat(lane, addresses.start, addresses.len()));
        } else {
            lanes.for_each(|lane| addresses.clone().for_each(|address| repeat(lane, address, 1)));
        }
    }
}
