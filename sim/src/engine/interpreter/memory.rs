//! Memory ports of the interpreter.

use std::ops::Range;

use tilewright_circuit::limbs_for;

use super::Engine;
use crate::engine::program::{Memory, Value, ValueId};

/// The range of a word among the limbs of its memory.
pub(super) fn word(memory: &Memory, lane: u32, address: u32) -> Range<usize> {
    let size = limbs_for(memory.width);
    let start = (lane as usize * memory.depth as usize + address as usize) * size;
    start..start + size
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
                Some(address) => out.copy_from_slice(&words[word(declared, lane, address)]),
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
            let new = &self.limbs[start..start + data.limbs()];
            let old = &mut words[word(declared, lane, address)];
            if old != new {
                old.copy_from_slice(new);
                changed = true;
            }
        }
        changed
    }
}
