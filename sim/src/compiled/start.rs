//! The memory of an engine at its start: where the words of memories stand, and what is not zero.

use std::ops::Range;

use super::Compiled;
use super::function::MemoryAt;
use super::layout::{Strips, Words};
use super::store::Store;
use crate::program::{Kind, Memory, Program, ValueId};
use crate::start::State;

impl State for Compiled {
    fn set(&mut self, id: ValueId, lanes: Range<u32>, limbs: &[u64]) {
        let place = self.places[id.index()].expect("what has a start is state");
        self.state.repeat_word(place.lane(lanes.start), place.bytes(), place.width, limbs, lanes.len());
    }

    fn set_words(&mut self, memory: u32, lanes: Range<u32>, addresses: Range<u32>, limbs: &[u64]) {
        let (MemoryAt { words, width, .. }, store) = &mut self.memories[memory as usize];
        let mut repeat = |lane, address, count| {
            store.repeat_word(words.at(lane, address), words.word, *width, limbs, count);
        };
        if words.together() {
            addresses.for_each(|address| repeat(lanes.start, address, lanes.len()));
        } else {
            lanes.for_each(|lane| repeat(lane, addresses.start, addresses.len()));
        }
    }
}

/// A memory full of zeros.
pub(super) fn memory(program: &Program, index: usize, memory: &Memory, strips: &Strips) -> (MemoryAt, Store) {
    let addresses: Vec<ValueId> = addresses(program, index, memory);
    let width = addresses.iter().map(|&id| program.value(id).width).max().unwrap_or(1);
    let together = memory.lanes > 1 && memory.width <= 64 && addresses.iter().all(|&id| is_common(program, id));
    let words = Words::of(memory, width, together, strips);
    let store = Store::new(words.size);
    let is_full = memory.depth as usize >= 1 << width;
    let at = MemoryAt { address: store.address() as usize, words, depth: memory.depth, width: memory.width, is_full };
    (at, store)
}

/// The addresses at which a memory is read and written.
fn addresses(program: &Program, index: usize, memory: &Memory) -> Vec<ValueId> {
    let synchronous = memory.reads.iter().map(|read| read.address);
    let written = memory.writes.iter().map(|write| write.address);
    let asynchronous = program.operations.iter().filter_map(|operation| match operation.kind {
        Kind::Read { memory, address } if memory as usize == index => Some(address),
        _ => None,
    });
    synchronous.chain(written).chain(asynchronous).collect()
}

/// Whether a value is the same in all lanes, and can be taken from one.
fn is_common(program: &Program, id: ValueId) -> bool {
    program.operations.iter().any(|operation| {
        let is_broadcast = matches!(operation.kind, Kind::Broadcast(of, _) if program.value(of).lanes == 1);
        operation.result == id && is_broadcast
    })
}
