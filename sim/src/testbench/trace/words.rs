//! Words of memories in a waveform file.
//!
//! An engine has no notes about words. So the write ports tell before an edge which words it may change, and only those
//! are read after it. A file without words pays nothing.

use std::ops::Range;

use super::View;
use super::changes::Id;
use super::vcd_header::{VariableKind, WordVariable};
use crate::engine::program::{Memory, Program, Triggers, ValueId, WritePort};
use crate::engine::{Engine, Word};

/// The most words of a file.
pub(crate) const MOST_WORDS: u64 = 4096;

/// The values that tell which of these words an edge may change.
pub(crate) fn watched(program: &Program, words: &[WordVariable]) -> Vec<ValueId> {
    let mut memories: Vec<u32> = words.iter().map(|it| it.word.memory).collect();
    memories.dedup();
    let writes = memories.into_iter().flat_map(|memory| &program.memories[memory as usize].writes);
    writes.flat_map(|write| [write.enable, write.address]).collect()
}

/// The words of a file as last taken.
pub(super) struct Words {
    words: Vec<Shown>,
    /// The words of each lane of a memory, which are adjacent.
    lanes: Vec<Range<usize>>,
    /// The limbs of one word after another.
    limbs: Vec<u64>,
    /// The words that the edge after the last sample may have changed; `None` if any may be another one.
    due: Option<Vec<usize>>,
    /// The words that have changed since the last visit.
    changed: Vec<usize>,
}

/// A word of a file.
struct Shown {
    id: Id,
    kind: VariableKind,
    word: Word,
    /// Where its limbs begin, and where they end.
    start: usize,
    end: usize,
    has_changed: bool,
}

impl Words {
    /// The words of a header.
    pub fn new(program: &Program, words: Vec<WordVariable>) -> Words {
        let mut end = 0;
        let shown = words.into_iter().map(|WordVariable { id, kind, word }| {
            let start = end;
            end += tilewright_circuit::limbs_for(program.memories[word.memory as usize].width);
            // The first time, all are taken.
            Shown { id, kind, word, start, end, has_changed: true }
        });
        let words: Vec<Shown> = shown.collect();
        let mut lanes = Vec::new();
        for lane in words.chunk_by(|a, b| (a.word.memory, a.word.lane) == (b.word.memory, b.word.lane)) {
            let first = lanes.last().map_or(0, |last: &Range<usize>| last.end);
            lanes.push(first..first + lane.len());
        }
        let changed = (0..words.len()).collect();
        Words { words, lanes, limbs: vec![0; end], due: None, changed }
    }

    /// Takes the words that may have changed since the last sample; the first time, all words.
    pub fn take(&mut self, view: &mut View) {
        // A poke or a jump in time says that everything may have changed.
        match self.due.take().filter(|_| view.changed != Triggers::ALL) {
            Some(due) => due.into_iter().for_each(|index| self.take_word(&**view.engine, index)),
            None => (0..self.words.len()).for_each(|index| self.take_word(&**view.engine, index)),
        }
        self.due = Some(self.written(view));
    }

    /// Tells that an instant is not sampled.
    pub fn leave(&mut self) {
        self.due = None;
    }

    fn take_word(&mut self, engine: &dyn Engine, index: usize) {
        let shown = &self.words[index];
        let Word { memory, lane, address } = shown.word;
        match &mut self.limbs[shown.start..shown.end] {
            [limb] => {
                let new = engine.short_word(memory, lane, address);
                if std::mem::replace(limb, new) != new {
                    self.mark(index);
                }
            }
            old => {
                let new = engine.word(memory, lane, address);
                if *old != new[..] {
                    old.copy_from_slice(&new);
                    self.mark(index);
                }
            }
        }
    }

    fn mark(&mut self, index: usize) {
        if !std::mem::replace(&mut self.words[index].has_changed, true) {
            self.changed.push(index);
        }
    }

    /// The words that the coming edge may change.
    fn written(&self, view: &mut View) -> Vec<usize> {
        let mut written = Vec::new();
        for lane in &self.lanes {
            let Word { memory, lane: number, .. } = self.words[lane.start].word;
            let memory = &view.program.memories[memory as usize];
            for write in memory.writes.iter().filter(|write| view.rising.contains(&(write.clock as usize))) {
                match addressed(view, memory, write, number) {
                    Addressed::Nothing => {}
                    Addressed::Any => written.extend(lane.clone()),
                    Addressed::Word(address) => {
                        let place = self.words[lane.clone()].binary_search_by_key(&address, |it| it.word.address);
                        written.extend(place.map(|place| lane.start + place));
                    }
                }
            }
        }
        written
    }

    /// All words as last taken.
    pub fn limbs(&self) -> &[u64] {
        &self.limbs
    }

    /// Restores the words of an earlier [`Words::limbs`].
    pub fn go_to(&mut self, limbs: &[u64]) {
        for index in 0..self.words.len() {
            let range = self.words[index].start..self.words[index].end;
            if self.limbs[range.clone()] != limbs[range] {
                self.mark(index);
            }
        }
        self.limbs.copy_from_slice(limbs);
    }

    /// Visits the words that have changed since the last visit, with their limbs.
    pub fn visit_changed(&mut self, mut visit: impl FnMut(Id, &VariableKind, &[u64])) {
        self.changed.sort_unstable();
        for index in self.changed.drain(..) {
            let shown = &mut self.words[index];
            shown.has_changed = false;
            visit(shown.id, &shown.kind, &self.limbs[shown.start..shown.end]);
        }
    }
}

/// What a write port may change at an edge.
enum Addressed {
    Nothing,
    Word(u32),
    Any,
}

fn addressed(view: &mut View, memory: &Memory, write: &WritePort, lane: u32) -> Addressed {
    let is_one_limb = |id| view.program.value(id).width <= u64::BITS;
    if view.engine.number(write.enable, lane) == 0 {
        return Addressed::Nothing;
    }
    if !is_one_limb(write.address) {
        return Addressed::Any;
    }
    match u32::try_from(view.engine.number(write.address, lane)) {
        Ok(address) if address < memory.depth => Addressed::Word(address),
        _ => Addressed::Nothing,
    }
}
