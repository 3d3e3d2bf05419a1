//! Packs lanes of one bit: up to 64 of them in a machine word.
//!
//! Such lanes are mostly used in logic, which words apply to all their bits at once. So registers and memories with
//! one bit a lane get a word for each 64 lanes, or for as many as are moved together. So do the values computed
//! between them. Whoever reads single lanes unpacks them.

mod choose;
mod making;
mod moved;
mod words;

use rustc_hash::FxHashMap;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Contents, Init};

use super::program::hierarchy::Signal;
use super::program::{
    Memory, Program, ReadPort, Readers, Register, Segment, Triggers, ValueId, WritePort, assign_to_clocks,
};
use choose::Choice;
use words::Words;

/// A program whose lanes of one bit are packed. Values keep their numbers; words come after them.
pub(crate) struct Packed {
    /// The program. The start values of its words are those of the original program.
    pub program: Program,
    /// The places of the bits.
    pub places: Places,
}

/// The places of the bits of lanes: if a word has `n` lanes, lane `i` is bit `i % n` of word `i / n`.
#[derive(Debug, Default)]
pub(crate) struct Places {
    /// For packed registers and packed read data: their words, and the lanes of each.
    pub states: FxHashMap<ValueId, (ValueId, u32)>,
    /// For packed memories: the lanes of a word.
    pub memories: FxHashMap<u32, u32>,
}

/// Packs the lanes of a program.
pub(crate) fn pack(program: Program) -> Packed {
    let choice = choose::choose(&program);
    if choice.values.is_empty() {
        return Packed { program, places: Places::default() };
    }
    let mut words = Words::new(program.circuit.clone(), &choice);
    words.add();
    let mut pack = Pack { from: &program, choice: &choice, words };
    let registers = program.registers.iter().map(|register| pack.register(register)).collect();
    let memories = (0..).zip(&program.memories).map(|(index, memory)| pack.memory(index, memory)).collect();
    let mut words = pack.words;
    words.unpack(program.circuit.ids());

    let mut states = FxHashMap::default();
    let mut packed = program.clone();
    (packed.registers, packed.memories) = (registers, memories);
    for (id, clock) in states_of(&program) {
        if let Some(&lanes) = choice.values.get(&id) {
            states.insert(id, (words.of(id, lanes), lanes));
            // It is computed now, by its readers.
            let schedule = &mut packed.schedule;
            schedule.slots[id.index()].1 = Some(schedule.segments.len() as u32);
            let (values, triggers) = (id.0..id.0 + 1, Triggers::state(clock as usize));
            schedule.segments.push(Segment { values, triggers, readers: Readers::NONE, needs: Vec::new() });
        }
    }
    packed.circuit = words.circuit;
    packed.schedule.slots.resize(packed.circuit.len(), (packed.schedule.storage, None));
    assign_to_clocks(&mut packed);
    name(&mut packed, &states);
    Packed { program: packed, places: Places { states, memories: choice.memories } }
}

/// Registers and the data of synchronous reads, each with its clock.
fn states_of(program: &Program) -> impl Iterator<Item = (ValueId, u32)> {
    let reads = program.memories.iter().flat_map(|memory| &memory.reads).map(|read| (read.value, read.clock));
    program.registers.iter().map(|register| (register.value, register.clock)).chain(reads)
}

/// Names words after their lanes.
fn name(program: &mut Program, states: &FxHashMap<ValueId, (ValueId, u32)>) {
    for scope in &mut program.hierarchy.scopes {
        for signal in std::mem::take(&mut scope.signals) {
            let words = states.get(&signal.value).map(|&(value, width)| Signal {
                name: format!("{}, {width} lanes a word", signal.name),
                value,
                width,
                ..signal.clone()
            });
            scope.signals.push(signal);
            scope.signals.extend(words);
        }
    }
}

struct Pack<'a> {
    from: &'a Program,
    choice: &'a Choice,
    words: Words<'a>,
}

impl Pack<'_> {
    /// The replacement of a register.
    fn register(&mut self, register: &Register) -> Register {
        let Some(&lanes) = self.choice.values.get(&register.value) else { return register.clone() };
        let words = &mut self.words;
        let (value, next) = (words.of(register.value, lanes), words.of(register.next, lanes));
        let all = self.from.circuit[register.value].lanes;
        let mut packed = Register {
            value,
            clock: register.clock,
            reset: register.reset.as_ref().map(|reset| packed_start(reset, all, lanes)),
            initial: None,
            enable: None,
            next,
            unit: register.unit,
        };
        if let Some(enable) = register.enable {
            match words.same(enable, lanes) {
                same @ Some(_) => packed.enable = same,
                None => packed.next = words.choose(enable, lanes, next, value),
            }
        }
        packed
    }

    /// The replacement of a memory.
    fn memory(&mut self, index: u32, memory: &Memory) -> Memory {
        let Some(&lanes) = self.choice.memories.get(&index) else { return memory.clone() };
        let words = &mut self.words;
        let same = |words: &mut Words, id: ValueId| words.same(id, lanes).expect("a packed memory has one address");
        let reads = memory.reads.iter().map(|read| ReadPort {
            clock: read.clock,
            address: same(words, read.address),
            enable: read.enable.map(|enable| same(words, enable)),
            value: words.of(read.value, lanes),
        });
        let reads = reads.collect();
        let writes = memory.writes.iter().map(|write| {
            let (address, data) = (same(words, write.address), words.of(write.data, lanes));
            // If only some lanes of a word are written, the others are written back unchanged.
            match words.same(write.enable, lanes) {
                Some(enable) => WritePort { clock: write.clock, enable, address, data },
                None => {
                    let old = words.word(index, address, memory.lanes / lanes, lanes);
                    let (enable, data) = (words.any(write.enable, lanes), words.choose(write.enable, lanes, data, old));
                    WritePort { clock: write.clock, enable, address, data }
                }
            }
        });
        let writes = writes.collect();
        let contents = match &memory.contents {
            Contents::Fill(bit) if bit.is_zero() => Contents::Fill(Bits::zero(lanes)),
            Contents::Fill(_) => Contents::Fill(Bits::ones(lanes)),
            _ => Contents::Unknown,
        };
        Memory {
            lanes: memory.lanes / lanes,
            depth: memory.depth,
            width: lanes,
            policy: memory.policy,
            contents,
            reads,
            writes,
            unit: memory.unit,
        }
    }
}

/// The start values of words, from those of their lanes.
fn packed_start(start: &Init, all: u32, lanes: u32) -> Init {
    match start {
        Init::Same(bit) if bit.is_zero() => Init::Same(Bits::zero(lanes)),
        Init::Same(_) => Init::Same(Bits::ones(lanes)),
        Init::Each(bits) => {
            let bit = |lane: u32| u64::from(!bits[lane as usize % bits.len()].is_zero());
            let word = |first: u32| (0..lanes).fold(0, |word, within| word | bit(first + within) << within);
            Init::Each((0..all).step_by(lanes as usize).map(|first| Bits::new(lanes, word(first))).collect())
        }
    }
}
