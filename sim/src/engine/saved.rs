//! The state of a circuit as plain numbers, the same on every engine.

use std::sync::Arc;

use tilewright_circuit::limbs_for;

use crate::engine::Engine;
use crate::engine::program::{Kind, Memory, Program, ValueId};
use crate::engine::start::hash;

/// The limbs of a page of memory: states that follow one another share the pages that are the same.
const PAGE: usize = 512;

/// All that a circuit does not compute: inputs, registers, read data and the words of memories.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Saved {
    /// The inputs, registers and read data in the sequence of their ids, lane by lane.
    values: Vec<Arc<[u64]>>,
    /// The words of each memory, lane by lane, address by address.
    memories: Vec<Vec<Arc<[u64]>>>,
}

impl Saved {
    /// The present state. It shares equal pages with an earlier one.
    pub fn of(program: &Program, engine: &mut dyn Engine, before: Option<&Saved>) -> Saved {
        let values = values(program, engine);
        let mut words = Vec::new();
        let memories = (0..program.memories.len() as u32).map(|index| {
            words.clear();
            engine.all_words(program, index, &mut words);
            pages(&words, before.map(|before| &before.memories[index as usize][..]))
        });
        let memories = memories.collect();
        Saved { values: pages(&values, before.map(|before| &before.values[..])), memories }
    }

    /// The present state but for the words of memories, which [`Engine::restore`] leaves alone then.
    pub fn without_words(program: &Program, engine: &mut dyn Engine) -> Saved {
        Saved { values: pages(&values(program, engine), None), memories: Vec::new() }
    }

    /// A state of these limbs: as many as [`Saved::limbs`] gives.
    pub fn from_limbs(program: &Program, mut limbs: &[u64]) -> Saved {
        let mut take = |count: usize| {
            let (these, rest) = limbs.split_at(count);
            limbs = rest;
            pages(these, None)
        };
        let values = take(states(program).map(|(_, limbs)| limbs).sum());
        let memories = program.memories.iter().map(|memory| take(size(memory))).collect();
        Saved { values, memories }
    }

    /// All limbs: of the values, then of each memory.
    pub fn limbs(&self) -> impl Iterator<Item = u64> {
        self.pages().flat_map(|page| page.iter().copied())
    }

    fn pages(&self) -> impl Iterator<Item = &Arc<[u64]>> {
        self.values.iter().chain(self.memories.iter().flatten())
    }

    /// Calls `visit` with each lane of each input, register and read data.
    pub fn for_each_lane(&self, program: &Program, mut visit: impl FnMut(ValueId, u32, &[u64])) {
        let mut limbs = Limbs::of(&self.values);
        for (id, _) in states(program) {
            let cell = &program.circuit[id];
            (0..cell.lanes).for_each(|lane| visit(id, lane, limbs.next(limbs_for(cell.width))));
        }
    }

    /// Calls `visit` with each word of each memory: memory, lane, address and limbs.
    pub fn for_each_word(&self, program: &Program, mut visit: impl FnMut(u32, u32, u32, &[u64])) {
        for (index, (memory, pages)) in (0..).zip(program.memories.iter().zip(&self.memories)) {
            let mut limbs = Limbs::of(pages);
            for lane in 0..memory.lanes {
                for address in 0..memory.depth {
                    visit(index, lane, address, limbs.next(limbs_for(memory.width)));
                }
            }
        }
    }

    /// Calls `value` and `word` with what differs from another state of the program, and with its limbs in both.
    pub fn for_each_difference(
        &self,
        other: &Saved,
        program: &Program,
        mut value: impl FnMut(ValueId, u32, [&[u64]; 2]),
        mut word: impl FnMut(u32, u32, u32, [&[u64]; 2]),
    ) {
        let mut values = Limbs::of(&other.values);
        self.for_each_lane(program, |id, lane, limbs| {
            let other = values.next(limbs.len());
            if limbs != other {
                value(id, lane, [limbs, other]);
            }
        });
        let mut memories: Vec<Limbs> = other.memories.iter().map(|pages| Limbs::of(pages)).collect();
        self.for_each_word(program, |memory, lane, address, limbs| {
            let other = memories[memory as usize].next(limbs.len());
            if limbs != other {
                word(memory, lane, address, [limbs, other]);
            }
        });
    }

    /// The bytes that it takes beside an earlier state, whose pages it may share.
    pub fn bytes_beside(&self, before: Option<&Saved>) -> usize {
        let own = self.pages().map(|page| size_of_val(&page[..])).sum::<usize>();
        let shared = before.map_or(0, |before| {
            let both = self.pages().zip(before.pages()).filter(|(page, other)| Arc::ptr_eq(page, other));
            both.map(|(page, _)| size_of_val(&page[..])).sum()
        });
        own - shared + self.pages().count() * size_of::<Arc<[u64]>>()
    }
}

/// How many limbs the state of a program has.
pub(crate) fn state_limbs(program: &Program) -> usize {
    states(program).map(|(_, limbs)| limbs).sum::<usize>() + program.memories.iter().map(size).sum::<usize>()
}

/// Says how wide each number of a state is, and calls `visit` with that in their sequence: the width of a limb's
/// number, for each limb.
pub(crate) fn for_each_width(program: &Program, mut visit: impl FnMut(u32)) {
    let mut number = |width: u32, count: usize| {
        for _ in 0..count {
            (0..limbs_for(width) as u32).for_each(|limb| visit((width - 64 * limb).min(64)));
        }
    };
    for (id, _) in states(program) {
        let cell = &program.circuit[id];
        number(cell.width, cell.lanes as usize);
    }
    for memory in &program.memories {
        number(memory.width, memory.lanes as usize * memory.depth as usize);
    }
}

/// A number that programs with the same state, by name and by shape, have in common.
pub(crate) fn fingerprint(program: &Program) -> u64 {
    let mut form = String::new();
    for scope in &program.hierarchy.scopes {
        let signals = scope.signals.iter().filter(|signal| program.is_state(signal.value));
        signals.for_each(|signal| form += &format!("{} {} {};", signal.name, signal.value.0, signal.width));
        scope.memories.iter().for_each(|(name, index, _)| form += &format!("{name} {index};"));
        form += &format!("{} {} {}\n", scope.name, scope.module, scope.lanes);
    }
    states(program).for_each(|(id, limbs)| form += &format!("{} {limbs} ", id.0));
    program.memories.iter().for_each(|it| form += &format!("{} {} {} ", it.lanes, it.depth, it.width));
    program.clocks.iter().for_each(|clock| form += &format!("{} {} ", clock.name, clock.period));
    hash(0, &form)
}

/// The inputs, registers and read data, with the number of limbs of each.
fn states(program: &Program) -> impl Iterator<Item = (ValueId, usize)> {
    let is_state = |(_, kind): &(_, &Kind)| **kind == Kind::State;
    let cells = program.circuit.cells().map(|(id, cell)| (id, &cell.kind)).filter(is_state);
    cells.map(|(id, _)| (id, program.circuit[id].lanes as usize * limbs_for(program.circuit[id].width)))
}

/// The present limbs of the inputs, registers and read data.
fn values(program: &Program, engine: &mut dyn Engine) -> Vec<u64> {
    let mut values = Vec::new();
    for (id, _) in states(program) {
        values.extend_from_slice(engine.read(id));
    }
    values
}

/// The number of limbs of a memory.
fn size(memory: &Memory) -> usize {
    memory.lanes as usize * memory.depth as usize * limbs_for(memory.width)
}

/// These limbs in pages; where a page is equal to the one before, it is that one.
fn pages(limbs: &[u64], before: Option<&[Arc<[u64]>]>) -> Vec<Arc<[u64]>> {
    let page = |(index, page): (usize, &[u64])| match before.map(|before| &before[index]) {
        Some(same) if **same == *page => same.clone(),
        _ => page.into(),
    };
    limbs.chunks(PAGE).enumerate().map(page).collect()
}

/// Reads limbs of pages in sequence.
struct Limbs<'a> {
    pages: &'a [Arc<[u64]>],
    at: usize,
    /// A number across two pages.
    joined: Vec<u64>,
}

impl Limbs<'_> {
    fn of(pages: &[Arc<[u64]>]) -> Limbs<'_> {
        Limbs { pages, at: 0, joined: Vec::new() }
    }

    /// The next `count` limbs.
    fn next(&mut self, count: usize) -> &[u64] {
        let (page, first) = (self.at / PAGE, self.at % PAGE);
        self.at += count;
        if first + count <= self.pages[page].len() {
            return &self.pages[page][first..first + count];
        }
        self.joined.clear();
        let rest = self.pages[page..].iter().flat_map(|page| page.iter().copied());
        self.joined.extend(rest.skip(first).take(count));
        &self.joined
    }
}
