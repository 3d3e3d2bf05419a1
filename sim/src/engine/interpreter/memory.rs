//! Memories of the interpreter, and their ports.

use tilewright_circuit::limbs_for;

use super::Engine;
use crate::engine::program::{Memory, Value, ValueId};

/// The words of a memory: lane by lane, address by address.
#[derive(Debug, Clone)]
pub(super) struct Words {
    limbs: Vec<u64>,
    /// Those that may differ from the beginning: 64 words to a number.
    written: Vec<u64>,
    /// The words of a lane.
    depth: usize,
    /// The limbs of a word.
    size: usize,
}

impl Words {
    /// All zero; the system provides only the pages that are written.
    pub fn zeros(memory: &Memory) -> Words {
        let (depth, size) = (memory.depth as usize, limbs_for(memory.width));
        let words = memory.lanes as usize * depth;
        Words { limbs: vec![0; words * size], written: vec![0; words.div_ceil(64)], depth, size }
    }

    /// A word.
    pub fn word(&self, lane: u32, address: u32) -> &[u64] {
        &self.limbs[self.place(lane, address) * self.size..][..self.size]
    }

    /// Replaces a word; returns whether it changed.
    pub fn write(&mut self, lane: u32, address: u32, limbs: &[u64]) -> bool {
        let place = self.place(lane, address);
        let word = &mut self.limbs[place * self.size..][..self.size];
        let changes = word != limbs;
        if changes {
            word.copy_from_slice(limbs);
            self.written[place / 64] |= 1 << (place % 64);
        }
        changes
    }

    /// Takes the present words for those of the beginning.
    pub fn begin(&mut self) {
        self.written.fill(0);
    }

    /// Calls `visit` with each word that may differ from the beginning: lane, address and limbs.
    pub fn for_each_written(&self, mut visit: impl FnMut(u32, u32, &[u64])) {
        for (index, &written) in self.written.iter().enumerate().filter(|(_, written)| **written != 0) {
            for bit in (0..64).filter(|bit| written >> bit & 1 == 1) {
                let place = index * 64 + bit;
                let (lane, address) = ((place / self.depth) as u32, (place % self.depth) as u32);
                visit(lane, address, self.word(lane, address));
            }
        }
    }

    fn place(&self, lane: u32, address: u32) -> usize {
        lane as usize * self.depth + address as usize
    }
}

/// The address in a lane of `value`, or `None` beyond the depth.
pub(super) fn address(memory: &Memory, value: Value, limbs: &[u64], lane: u32) -> Option<u32> {
    let start = value.offset + lane as usize * value.limbs();
    let (low, high) = limbs[start..start + value.limbs()].split_first().expect("a value has a limb");
    (high.iter().all(|&limb| limb == 0) && *low < u64::from(memory.depth)).then_some(*low as u32)
}

impl Engine {
    /// An asynchronous read in all lanes; zero beyond the depth.
    pub(super) fn read_memory(&mut self, result: ValueId, memory: u32, address: ValueId) {
        let (declared, words) = (&self.program.memories[memory as usize], &self.memories[memory as usize]);
        let (value, at) = (self.program.value(result), self.program.value(address));
        for lane in 0..value.lanes {
            let found = self::address(declared, at, &self.limbs, lane);
            let start = value.offset + lane as usize * value.limbs();
            let out = &mut self.limbs[start..start + value.limbs()];
            match found {
                Some(address) => out.copy_from_slice(words.word(lane, address)),
                None => out.fill(0),
            }
        }
    }

    /// Writes a port's word to the memory if enabled; returns whether any word changed.
    pub(super) fn write_memory(&mut self, memory: u32, port: u32) -> bool {
        let declared = &self.program.memories[memory as usize];
        let words = &mut self.memories[memory as usize];
        let port = &declared.writes[port as usize];
        let [enable, at, data] = [port.enable, port.address, port.data].map(|id| self.program.value(id));
        let mut changed = false;
        for lane in 0..declared.lanes {
            if self.limbs[enable.offset + lane as usize] == 0 {
                continue;
            }
            let Some(address) = address(declared, at, &self.limbs, lane) else { continue };
            let start = data.offset + lane as usize * data.limbs();
            changed |= words.write(lane, address, &self.limbs[start..start + data.limbs()]);
        }
        changed
    }
}
