//! What registers and memories hold before the first edge.

use tilewright_hdl::ir::Contents;
use tilewright_hdl::{limbs_for, top_mask};

use super::Engine;
use crate::program::hierarchy::{Place, Role};

impl Engine {
    /// Sets registers to their reset values, memories to their contents, and the rest from the seed of its run.
    pub(super) fn start(&mut self, seeds: &[u64]) {
        let program = self.program.clone();
        for memory in &program.memories {
            let limbs = limbs_for(memory.width);
            let mut lane = vec![0; memory.depth as usize * limbs];
            match &memory.contents {
                Contents::Unknown => {}
                Contents::Fill(word) => lane.chunks_exact_mut(limbs).for_each(|at| at.copy_from_slice(word.limbs())),
                Contents::Words(words) => {
                    lane.chunks_exact_mut(limbs).zip(words).for_each(|(at, word)| at.copy_from_slice(word.limbs()));
                }
            }
            self.memories.push(lane.repeat(memory.lanes as usize));
        }
        for (run, &seed) in (0..).zip(seeds).filter(|(_, seed)| **seed != 0) {
            self.scatter(run, seed);
        }
        for register in &program.registers {
            if let Some(reset) = &register.reset {
                let value = program.value(register.value);
                self.limbs[value.range()]
                    .chunks_exact_mut(value.limbs())
                    .for_each(|at| at.copy_from_slice(reset.limbs()));
            }
        }
    }

    /// Fills registers, read data and unknown memories of a run with numbers that depend on the seed and the name alone, so
    /// that an array starts the same whether it runs in lanes or unrolled.
    fn scatter(&mut self, run: u32, seed: u64) {
        let program = self.program.clone();
        for place in program.hierarchy.places(run) {
            let scope = program.hierarchy.scope(place.scope);
            let path = |name: &str| hash(seed, &program.hierarchy.path_in(place, name));
            for signal in &scope.signals {
                if matches!(signal.role, Role::Register | Role::ReadData) {
                    let value = program.value(signal.value);
                    let start = value.offset + place.lane as usize * value.limbs();
                    fill(&mut self.limbs[start..start + value.limbs()], path(&signal.name), value.width);
                }
            }
            for (name, index) in &scope.memories {
                self.scatter_memory(*index, place, path(name));
            }
        }
    }

    fn scatter_memory(&mut self, index: u32, place: Place, key: u64) {
        let memory = &self.program.memories[index as usize];
        if memory.contents != Contents::Unknown {
            return;
        }
        let size = limbs_for(memory.width);
        let start = place.lane as usize * memory.depth as usize * size;
        let words = &mut self.memories[index as usize][start..start + memory.depth as usize * size];
        for (address, word) in words.chunks_exact_mut(size).enumerate() {
            fill(word, mix(key ^ mix(address as u64)), memory.width);
        }
    }
}

/// A number of `width` bits drawn from `key`.
fn fill(limbs: &mut [u64], key: u64, width: u32) {
    for (i, limb) in limbs.iter_mut().enumerate() {
        *limb = mix(key.wrapping_add(i as u64));
    }
    *limbs.last_mut().expect("a value has a limb") &= top_mask(width);
}

/// The finalizer of the SplitMix64 generator.
fn mix(seed: u64) -> u64 {
    let z = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The FNV-1a hash of a name, mixed with the seed.
fn hash(seed: u64, name: &str) -> u64 {
    let fnv = name
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3));
    mix(seed ^ mix(fnv))
}
