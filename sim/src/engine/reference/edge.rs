//! An instant at which clocks rise: everything samples, then everything changes.

use tilewright_circuit::ir::ReadUnderWrite;
use tilewright_circuit::top_mask;

use super::Engine;
use crate::engine::Word;
use crate::engine::program::{Program, ReadPort, ValueId};

/// The new value of one lane of an object at an edge.
struct Taken<T> {
    at: T,
    lane: u32,
    limbs: Vec<u64>,
}

impl Engine {
    /// Executes the edge of these clocks.
    pub(super) fn edge(&mut self, rising: &[usize]) {
        self.settle();
        let program = self.program.clone();
        let mut values = Vec::new();
        let mut words = Vec::new();
        for &clock in rising {
            self.sample_registers(&program, clock, &mut values);
            self.sample_reads(&program, clock, rising, &mut values);
            self.sample_writes(&program, clock, &mut words);
        }
        for Taken { at, lane, limbs } in values {
            let limbs_a_lane = limbs.len();
            self.values[at.index()][lane as usize * limbs_a_lane..][..limbs_a_lane].copy_from_slice(&limbs);
        }
        for Taken { at: Word { memory, lane, address }, limbs, .. } in words {
            let place = self.place(memory, lane, address);
            self.memories[memory as usize][place].copy_from_slice(&limbs);
            self.written.push(Word { memory, lane, address });
        }
        self.is_stale = true;
    }

    fn sample_registers(&self, program: &Program, clock: usize, taken: &mut Vec<Taken<ValueId>>) {
        for &index in &program.clocks[clock].registers {
            let register = &program.registers[index as usize];
            for lane in 0..program.circuit[register.value].lanes {
                let limbs = match register.reset(lane) {
                    Some(reset) if self.resets[clock] => reset,
                    _ if self.holds(register.enable, lane) => self.number(register.next, lane).limbs,
                    _ => continue,
                };
                taken.push(Taken { at: register.value, lane, limbs: limbs.to_vec() });
            }
        }
    }

    fn sample_reads(&self, program: &Program, clock: usize, rising: &[usize], taken: &mut Vec<Taken<ValueId>>) {
        for &(memory, port) in &program.clocks[clock].reads {
            let read = &program.memories[memory as usize].reads[port as usize];
            for lane in (0..program.memories[memory as usize].lanes).filter(|&lane| self.holds(read.enable, lane)) {
                let mut limbs = self.read_word(memory, lane, self.number(read.address, lane));
                if self.is_written(program, memory, lane, read, rising) {
                    limbs.iter_mut().for_each(|limb| *limb = !*limb);
                    *limbs.last_mut().expect("a word has a limb") &= top_mask(program.circuit[read.value].width);
                }
                taken.push(Taken { at: read.value, lane, limbs });
            }
        }
    }

    /// Whether the word that is read is also written at this instant, and that changes the result.
    fn is_written(&self, program: &Program, memory: u32, lane: u32, read: &ReadPort, rising: &[usize]) -> bool {
        let declared = &program.memories[memory as usize];
        let address = self.address(memory, lane, read.address);
        let mut writes = declared.writes.iter().filter(|write| rising.contains(&(write.clock as usize)));
        declared.policy == ReadUnderWrite::Any
            && address.is_some()
            && writes.any(|write| {
                self.holds(Some(write.enable), lane) && self.address(memory, lane, write.address) == address
            })
    }

    fn sample_writes(&self, program: &Program, clock: usize, taken: &mut Vec<Taken<Word>>) {
        for &(memory, port) in &program.clocks[clock].writes {
            let write = &program.memories[memory as usize].writes[port as usize];
            for lane in
                (0..program.memories[memory as usize].lanes).filter(|&lane| self.holds(Some(write.enable), lane))
            {
                if let Some(address) = self.address(memory, lane, write.address) {
                    let at = Word { memory, lane, address };
                    taken.push(Taken { at, lane, limbs: self.number(write.data, lane).limbs.to_vec() });
                }
            }
        }
    }
}
