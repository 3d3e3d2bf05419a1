//! Memories of the interpreter, and their ports.

use tilewright_circuit::limbs_for;

use super::Engine;
use crate::engine::program::{Memory, Value, ValueId};

/// The words of a page.
const PAGE: usize = 512;

/// The words of a memory: lane by lane, address by address. A page without any word but 0 is not there, so that large
/// memories cost nothing at the start.
#[derive(Debug, Clone)]
pub(super) struct Words {
    pages: Vec<Option<Box<Page>>>,
    zero: Vec<u64>,
    /// The words that a page has room for.
    room: usize,
    /// The words of a lane.
    depth: usize,
}

#[derive(Debug, Clone)]
struct Page {
    limbs: Vec<u64>,
    /// The words that may differ from the beginning: 64 of them to a number.
    written: [u64; PAGE / 64],
}

impl Words {
    /// All zero.
    pub fn zeros(memory: &Memory) -> Words {
        let depth = memory.depth as usize;
        let words = memory.lanes as usize * depth;
        let zero = vec![0; limbs_for(memory.width)];
        Words { pages: vec![None; words.div_ceil(PAGE)], zero, room: words.min(PAGE), depth }
    }

    /// A word.
    pub fn word(&self, lane: u32, address: u32) -> &[u64] {
        let (page, word) = self.place(lane, address);
        match &self.pages[page] {
            Some(page) => &page.limbs[word * self.zero.len()..][..self.zero.len()],
            None => &self.zero,
        }
    }

    /// Replaces a word; returns whether it changed.
    pub fn write(&mut self, lane: u32, address: u32, limbs: &[u64]) -> bool {
        let changes = self.word(lane, address) != limbs;
        if changes {
            let ((page, word), size, room) = (self.place(lane, address), self.zero.len(), self.room);
            let new = || Box::new(Page { limbs: vec![0; room * size], written: [0; PAGE / 64] });
            let page = self.pages[page].get_or_insert_with(new);
            page.limbs[word * size..][..size].copy_from_slice(limbs);
            page.written[word / 64] |= 1 << (word % 64);
        }
        changes
    }

    /// Takes the present words for those of the beginning.
    pub fn begin(&mut self) {
        self.pages.iter_mut().flatten().for_each(|page| page.written = [0; PAGE / 64]);
    }

    /// Calls `visit` with each word that may differ from the beginning: lane, address and limbs.
    pub fn for_each_written(&self, mut visit: impl FnMut(u32, u32, &[u64])) {
        let pages = self.pages.iter().enumerate();
        for (number, page) in pages.filter_map(|(number, page)| Some((number, page.as_ref()?))) {
            for word in (0..PAGE).filter(|word| page.written[word / 64] >> (word % 64) & 1 == 1) {
                let place = number * PAGE + word;
                let (lane, address) = ((place / self.depth) as u32, (place % self.depth) as u32);
                visit(lane, address, self.word(lane, address));
            }
        }
    }

    /// The page of a word, and its place there.
    fn place(&self, lane: u32, address: u32) -> (usize, usize) {
        let place = lane as usize * self.depth + address as usize;
        (place / PAGE, place % PAGE)
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

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use proptest::prelude::*;
    use tilewright_circuit::ir::{Contents, ReadUnderWrite};

    use super::*;

    /// Three lanes, whose words are in several pages; two limbs to a word.
    const LANES: u32 = 3;
    const DEPTH: u32 = 700;

    fn memory() -> Memory {
        let (reads, writes) = (Vec::new(), Vec::new());
        let (policy, contents) = (ReadUnderWrite::Old, Contents::Unknown);
        Memory { lanes: LANES, depth: DEPTH, width: 70, policy, contents, reads, writes, unit: None }
    }

    type Write = (u32, u32, [u64; 2]);

    fn writes() -> impl Strategy<Value = Vec<Write>> {
        prop::collection::vec((0..LANES, 0..DEPTH, [0..3_u64, 0..3_u64]), 0..200)
    }

    fn apply(words: &mut Words, model: &mut BTreeMap<(u32, u32), [u64; 2]>, writes: &[Write]) {
        for (lane, address, limbs) in writes {
            let before = model.insert((*lane, *address), *limbs).unwrap_or_default();
            assert_eq!(words.write(*lane, *address, limbs), before != *limbs);
        }
    }

    proptest! {
        /// Words are what was written last; those of the beginning are not listed unless they change.
        #[test]
        fn words_are_what_was_written_last(before in writes(), after in writes()) {
            let (mut words, mut model) = (Words::zeros(&memory()), BTreeMap::new());
            apply(&mut words, &mut model, &before);
            words.begin();
            let beginning = model.clone();
            apply(&mut words, &mut model, &after);
            let mut listed = BTreeMap::new();
            words.for_each_written(|lane, address, limbs| drop(listed.insert((lane, address), limbs.to_vec())));
            for (lane, address) in (0..LANES).flat_map(|lane| (0..DEPTH).map(move |address| (lane, address))) {
                let [now, begun] = [&model, &beginning].map(|words| words.get(&(lane, address)).copied().unwrap_or_default());
                prop_assert_eq!(words.word(lane, address), now);
                match listed.get(&(lane, address)) {
                    Some(limbs) => prop_assert_eq!(&limbs[..], now),
                    None => prop_assert_eq!(now, begun),
                }
            }
            prop_assert!(listed.keys().all(|place| after.iter().any(|(lane, address, _)| (*lane, *address) == *place)));
        }
    }
}
