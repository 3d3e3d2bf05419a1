//! The values of registers and memories before the first edge, for any engine.

use std::ops::Range;

use tilewright_circuit::ir::{Contents, Init};
use tilewright_circuit::{Bits, limbs_for, top_mask};

use crate::engine::program::hierarchy::Role;
use crate::engine::program::{Memory, Program, Register, ValueId};

/// What a circuit begins with where that is neither a reset value, nor contents, nor zero.
#[derive(Debug, Clone, Default)]
pub(crate) struct Beginning {
    /// The seed of each run; 0 means zeros.
    pub seeds: Vec<u64>,
    /// Values of registers and read data, in place of those of a seed.
    pub given: Vec<Given>,
}

impl Beginning {
    /// Of runs with these seeds.
    pub fn of(seeds: Vec<u64>) -> Beginning {
        Beginning { seeds, given: Vec::new() }
    }
}

/// The value of a lane of a register, or of read data.
#[derive(Debug, Clone)]
pub(crate) struct Given {
    pub value: ValueId,
    pub lane: u32,
    pub word: Bits,
}

/// State that is zero at first; only other values are set.
pub(crate) trait State {
    /// Sets the value of these lanes of a register, or of read data.
    fn set(&mut self, id: ValueId, lanes: Range<u32>, limbs: &[u64]);

    /// Sets the word of these lanes of a memory at each of these addresses.
    fn set_words(&mut self, memory: u32, lanes: Range<u32>, addresses: Range<u32>, limbs: &[u64]);
}

/// Sets registers to their values at power-on or after a reset, and memories to their contents. Everything else comes
/// from the seed of its run, or is zero if the seed is 0; values that are given replace all others.
pub(crate) fn start(program: &Program, Beginning { seeds, given }: &Beginning, state: &mut impl State) {
    for (index, memory) in (0..).zip(&program.memories) {
        fill_memory(index, memory, state);
    }
    for (run, &seed) in (0..).zip(seeds).filter(|(_, seed)| **seed != 0) {
        scatter(program, run, seed, state);
    }
    for register in &program.registers {
        let lanes = program.circuit[register.value].lanes;
        let is_zero = match (&register.initial, &register.reset) {
            (Some(value), _) | (None, Some(Init::Same(value))) => value.is_zero(),
            _ => false,
        };
        match &register.initial {
            _ if is_zero && seeds.iter().all(|&seed| seed == 0) => {}
            Some(value) => state.set(register.value, 0..lanes, value.limbs()),
            None => reset(program, register, state),
        }
    }
    for Given { value, lane, word } in given {
        state.set(*value, *lane..lane + 1, word.limbs());
    }
}

/// Sets a register to its value after a reset.
pub(crate) fn reset(program: &Program, register: &Register, state: &mut impl State) {
    let lanes = program.circuit[register.value].lanes;
    match &register.reset {
        None => {}
        Some(Init::Same(value)) => state.set(register.value, 0..lanes, value.limbs()),
        Some(Init::Each(values)) => {
            (0..lanes)
                .zip(values.iter().cycle())
                .for_each(|(lane, it)| state.set(register.value, lane..lane + 1, it.limbs()));
        }
    }
}

/// The contents of a memory.
fn fill_memory(index: u32, memory: &Memory, state: &mut impl State) {
    match &memory.contents {
        Contents::Unknown => {}
        Contents::Fill(word) if word.is_zero() => {}
        Contents::Fill(word) => state.set_words(index, 0..memory.lanes, 0..memory.depth, word.limbs()),
        Contents::Words(words) => fill_words(index, 0..memory.lanes, words, state),
        Contents::Each(lanes) => {
            (0..memory.lanes)
                .zip(lanes.iter().cycle())
                .for_each(|(lane, words)| fill_words(index, lane..lane + 1, words, state));
        }
    }
}

/// Words from address 0 in some lanes of a memory.
fn fill_words(index: u32, lanes: Range<u32>, words: &[Bits], state: &mut impl State) {
    for (address, word) in (0..).zip(words).filter(|(_, word)| !word.is_zero()) {
        state.set_words(index, lanes.clone(), address..address + 1, word.limbs());
    }
}

/// Fills registers, read data and unknown memories of a run with numbers that depend only on the seed and the name.
/// So an array starts alike whether it runs in lanes or unrolled.
fn scatter(program: &Program, run: u32, seed: u64, state: &mut impl State) {
    for place in program.hierarchy.places(run) {
        let scope = program.hierarchy.scope(place.scope);
        let path = |name: &str| hash(seed, &program.hierarchy.path_in(place, name));
        for signal in &scope.signals {
            if matches!(signal.role, Role::Register | Role::ReadData) {
                let (width, group) = (program.circuit[signal.value].width, signal.shape.lanes());
                for index in 0..group {
                    let lane = place.lane * group + index;
                    let key = path(&signal.name).wrapping_add(mix(u64::from(index)) * u64::from(index > 0));
                    state.set(signal.value, lane..lane + 1, &number(key, width));
                }
            }
        }
        for (name, index, shape) in &scope.memories {
            let memory = &program.memories[*index as usize];
            let group = shape.lanes();
            for lane in 0..group {
                let key = path(name).wrapping_add(mix(u64::from(lane)) * u64::from(lane > 0));
                scatter_memory(*index, memory, place.lane * group + lane, key, state);
            }
        }
    }
}

fn scatter_memory(index: u32, memory: &Memory, lane: u32, key: u64, state: &mut impl State) {
    if !memory.is_unknown() {
        return;
    }
    for address in 0..memory.depth {
        let word = number(mix(key ^ mix(u64::from(address))), memory.width);
        state.set_words(index, lane..lane + 1, address..address + 1, &word);
    }
}

/// A number of `width` bits drawn from `key`.
fn number(key: u64, width: u32) -> Vec<u64> {
    let mut limbs: Vec<u64> = (0..limbs_for(width) as u64).map(|i| mix(key.wrapping_add(i))).collect();
    *limbs.last_mut().expect("a value has a limb") &= top_mask(width);
    limbs
}

/// The finalizer of the SplitMix64 generator.
fn mix(seed: u64) -> u64 {
    let z = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The FNV-1a hash of a name, mixed with the seed.
pub(crate) fn hash(seed: u64, name: &str) -> u64 {
    let fnv = name
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3));
    mix(seed ^ mix(fnv))
}
