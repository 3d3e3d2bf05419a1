//! Splits words wider than a machine register into the fields that they consist of.
//!
//! A queue of records stores a word that is assembled from fields and taken apart into the same fields; nothing reads
//! the whole word. So a register or memory of such words becomes one for each field, or for each row of lanes that
//! was packed into the word. A reader of the whole word assembles it.

mod extract;
mod layout;

use rustc_hash::FxHashMap;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Contents, Init};

use super::program::hierarchy::Signal;
use super::program::{
    Cell, Kind, Memory, Program, ReadPort, Readers, Register, Segment, Triggers, ValueId, WritePort, assign_to_clocks,
};
use extract::Extract;
use layout::Layout;

/// The widest word that is not split.
const WIDE: u32 = 64;

/// Bits of a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Piece {
    /// The first.
    pub low: u32,
    /// How many.
    pub width: u32,
    /// As this many lanes, the first in the lowest bits.
    pub lanes: u32,
}

impl Piece {
    /// The whole word.
    fn all(width: u32) -> Piece {
        Piece { low: 0, width, lanes: 1 }
    }

    /// The bits of a lane.
    pub fn each(self) -> u32 {
        self.width / self.lanes
    }

    /// A lane of it.
    pub fn of_lane(self, lane: u32, word: &Bits) -> Bits {
        let first = self.low + lane * self.each();
        word.slice(first..first + self.each())
    }
}

/// The storage of a piece of a word: a register by its value, or a memory by index, with as many lanes as the piece
/// for each lane of the word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Part<T> {
    pub of: T,
    pub piece: Piece,
}

/// A program whose wide words are split. Values keep their numbers; parts come after them.
pub(crate) struct Fields {
    /// The program. The start values of its parts are those of the original program.
    pub program: Program,
    /// The replacements of the original state.
    pub parts: Parts,
}

/// The parts of words.
#[derive(Debug, Default)]
pub(crate) struct Parts {
    /// The parts of split registers and of split read data.
    pub registers: FxHashMap<ValueId, Vec<Part<ValueId>>>,
    /// For each memory of the original program: its parts, of which there may be one.
    pub memories: Vec<Vec<Part<u32>>>,
}

/// Splits the words of a program.
pub(crate) fn split(program: &Program) -> Fields {
    let whole = |(index, memory): (u32, &Memory)| vec![Part { of: index, piece: Piece::all(memory.width) }];
    let memories = (0..).zip(&program.memories).map(whole).collect();
    let parts = Parts { registers: FxHashMap::default(), memories };
    let mut fields = Fields { program: program.clone(), parts };
    let is_wide = |width: u32| width > WIDE;
    let widths = program.registers.iter().map(|register| program.circuit[register.value].width);
    let mut widths = widths.chain(program.memories.iter().map(|memory| memory.width));
    if program.passes.fields && widths.any(is_wide) {
        Split::new(program, &mut fields).run();
    }
    fields
}

/// The split in progress.
struct Split<'a> {
    from: &'a Program,
    layout: Layout<'a>,
    extract: Extract,
    fields: &'a mut Fields,
}

impl<'a> Split<'a> {
    fn new(from: &'a Program, fields: &'a mut Fields) -> Split<'a> {
        let layout = Layout::of(from);
        let is_split = from.circuit.ids().map(|id| is_split(&layout.value(id))).collect();
        let extract = Extract::new(from.circuit.clone(), is_split);
        Split { from, layout, extract, fields }
    }

    fn run(mut self) {
        self.number_memories();
        let reads = self.from.memories.iter().flat_map(|memory| &memory.reads);
        let state = self.from.registers.iter().map(|register| (register.value, register.clock));
        for (id, clock) in state.chain(reads.map(|read| (read.value, read.clock))) {
            self.state(id, clock);
        }
        self.from.circuit.ids().for_each(|id| self.read(id));
        self.from.circuit.ids().for_each(|id| self.use_of_word(id));
        let registers = self.from.registers.iter().flat_map(|register| self.register(register)).collect();
        let memories = (0..self.from.memories.len()).flat_map(|index| self.memory(index)).collect();
        self.name();
        let Split { extract, fields, .. } = self;
        let program = &mut fields.program;
        program.schedule.slots.resize(extract.circuit.len(), (program.schedule.storage, None));
        (program.circuit, program.registers, program.memories) = (extract.circuit, registers, memories);
        assign_to_clocks(program);
    }

    /// Assigns the numbers of the memories.
    fn number_memories(&mut self) {
        let mut next = 0;
        for (index, parts) in self.fields.parts.memories.iter_mut().enumerate() {
            let pieces = self.layout.memory(index).into_iter();
            *parts = (next..).zip(pieces).map(|(of, piece)| Part { of, piece }).collect();
            next += parts.len() as u32;
        }
    }

    /// Gives parts to a register, or to the data of a read.
    fn state(&mut self, id: ValueId, clock: u32) {
        let pieces = self.layout.value(id);
        if !is_split(&pieces) {
            return;
        }
        let (lanes, loc) = (self.from.circuit[id].lanes, self.from.circuit.loc(id));
        let circuit = &mut self.extract.circuit;
        let state =
            |piece: Piece| (piece, circuit.push(Cell::new(Kind::State, lanes * piece.lanes, piece.each()), loc));
        let parts: Vec<(Piece, ValueId)> = pieces.into_iter().map(state).collect();
        let word = self.extract.join(id, &parts);
        self.extract.circuit.set_kind(id, word);
        self.fields.parts.registers.insert(id, parts.into_iter().map(|(piece, of)| Part { of, piece }).collect());
        // It is computed now, by its readers.
        let schedule = &mut self.fields.program.schedule;
        schedule.slots[id.index()].1 = Some(schedule.segments.len() as u32);
        let triggers = Triggers::state(clock as usize);
        schedule.segments.push(Segment { values: id.0..id.0 + 1, triggers, readers: Readers::NONE, needs: Vec::new() });
    }

    /// Makes a value that is the word of a memory read its parts.
    fn read(&mut self, id: ValueId) {
        let Cell { kind: Kind::Read { memory, address }, lanes, .. } = self.from.circuit[id] else { return };
        let loc = self.from.circuit.loc(id);
        let parts = self.fields.parts.memories[memory as usize].clone();
        if let [Part { of: memory, piece: Piece { lanes: 1, .. } }] = parts[..] {
            return self.extract.circuit.set_kind(id, Kind::Read { memory, address });
        }
        let mut words = Vec::new();
        for Part { of: memory, piece } in parts {
            let address = self.extract.repeat(address, piece.lanes);
            let cell = Cell::new(Kind::Read { memory, address }, lanes * piece.lanes, piece.each());
            words.push((piece, self.extract.circuit.push(cell, loc)));
        }
        let word = self.extract.join(id, &words);
        self.extract.circuit.set_kind(id, word);
    }

    /// Makes a value that is part of a word use the word's sources.
    fn use_of_word(&mut self, id: ValueId) {
        let Cell { ref kind, width, .. } = self.from.circuit[id];
        let (of, piece) = match *kind {
            Kind::Slice(of, low) if self.from.circuit[of].width > WIDE => (of, Piece { low, width, lanes: 1 }),
            Kind::Unpack { of, axis } if axis.inner == 1 => {
                (of, Piece { low: 0, width: width * axis.count, lanes: axis.count })
            }
            _ => return,
        };
        let part = self.extract.part(of, piece);
        if self.extract.circuit[part].kind != *kind && part != id {
            self.extract.circuit.set_kind(id, Kind::Alias(part));
        }
    }

    /// The replacements of a register.
    fn register(&mut self, register: &Register) -> Vec<Register> {
        let Some(parts) = self.fields.parts.registers.get(&register.value) else { return vec![register.clone()] };
        let part = |&Part { of, piece }: &Part<ValueId>| Register {
            value: of,
            clock: register.clock,
            reset: register.reset.as_ref().map(|reset| part_of_start(reset, piece)),
            initial: None,
            enable: register.enable.map(|enable| self.extract.repeat(enable, piece.lanes)),
            next: self.extract.part(register.next, piece),
            unit: register.unit,
        };
        parts.iter().map(part).collect()
    }

    /// The replacements of a memory.
    fn memory(&mut self, index: usize) -> Vec<Memory> {
        let memory = &self.from.memories[index];
        let parts = self.fields.parts.memories[index].clone();
        (0..).zip(&parts).map(|(number, part)| self.part_of_memory(memory, number, part.piece)).collect()
    }

    fn part_of_memory(&mut self, memory: &Memory, number: usize, piece: Piece) -> Memory {
        let extract = &mut self.extract;
        let reads = memory.reads.iter().map(|read| ReadPort {
            clock: read.clock,
            address: extract.repeat(read.address, piece.lanes),
            enable: read.enable.map(|enable| extract.repeat(enable, piece.lanes)),
            value: self.fields.parts.registers.get(&read.value).map_or(read.value, |parts| parts[number].of),
        });
        let reads = reads.collect();
        let writes = memory.writes.iter().map(|write| WritePort {
            clock: write.clock,
            enable: extract.repeat(write.enable, piece.lanes),
            address: extract.repeat(write.address, piece.lanes),
            data: extract.part(write.data, piece),
        });
        let writes = writes.collect();
        let contents = match &memory.contents {
            Contents::Fill(word) => {
                let same = |lane| piece.of_lane(lane, word) == piece.of_lane(0, word);
                let is_same = (0..piece.lanes).all(same);
                if is_same { Contents::Fill(piece.of_lane(0, word)) } else { Contents::Unknown }
            }
            contents if piece == Piece::all(memory.width) => contents.clone(),
            _ => Contents::Unknown,
        };
        let Memory { depth, policy, unit, .. } = *memory;
        Memory { lanes: memory.lanes * piece.lanes, depth, width: piece.each(), policy, contents, reads, writes, unit }
    }

    /// Names the parts after their words.
    fn name(&mut self) {
        let part_name = |name: &str, piece: Piece, parts: usize| match parts {
            1 => name.to_owned(),
            _ => format!("{name}[{}:{}]", piece.low + piece.width - 1, piece.low),
        };
        for scope in &mut self.fields.program.hierarchy.scopes {
            for signal in std::mem::take(&mut scope.signals) {
                let parts = self.fields.parts.registers.get(&signal.value).into_iter().flatten();
                let named = parts.map(|part| {
                    let name = format!("{}[{}:{}]", signal.name, part.piece.low + part.piece.width - 1, part.piece.low);
                    Signal { name, value: part.of, width: part.piece.each(), ..signal.clone() }
                });
                let named: Vec<_> = named.collect();
                scope.signals.push(signal);
                scope.signals.extend(named);
            }
            for (name, index, shape) in std::mem::take(&mut scope.memories) {
                let parts = &self.fields.parts.memories[index as usize];
                let named = parts.iter().map(|part| (part_name(&name, part.piece, parts.len()), part.of, shape));
                scope.memories.extend(named);
            }
        }
    }
}

/// Whether these are more than one part, or lanes.
fn is_split(pieces: &[Piece]) -> bool {
    pieces.len() > 1 || pieces[0].lanes > 1
}

/// The part of a register's start value.
fn part_of_start(start: &Init, piece: Piece) -> Init {
    let lanes = |word: &Bits| (0..piece.lanes).map(|lane| piece.of_lane(lane, word)).collect::<Vec<_>>();
    let each = match start {
        Init::Same(word) => lanes(word),
        Init::Each(words) => words.iter().flat_map(lanes).collect(),
    };
    if each.iter().all(|it| *it == each[0]) { Init::Same(each[0].clone()) } else { Init::Each(each) }
}
