//! Words of memories in a waveform file.
//!
//! An engine has no notes about words, so each is read after every edge at which its memory may change. A file without
//! words pays nothing.

use super::changes::Id;
use super::vcd_header::{VariableKind, WordVariable};
use crate::engine::program::{Program, Triggers};
use crate::engine::{Engine, Word};

/// The most words of a file.
pub(crate) const MOST_WORDS: u64 = 4096;

/// The words of a file as last taken.
pub(super) struct Words {
    words: Vec<Shown>,
    /// The limbs of one word after another.
    limbs: Vec<u64>,
    /// Whether they have ever been taken.
    are_known: bool,
}

/// A word of a file.
struct Shown {
    id: Id,
    kind: VariableKind,
    word: Word,
    /// Where its limbs begin, and where they end.
    start: usize,
    end: usize,
    /// What may change it.
    triggers: Triggers,
    has_changed: bool,
}

impl Words {
    /// The words of a header.
    pub fn new(program: &Program, words: Vec<WordVariable>) -> Words {
        let mut end = 0;
        let shown = words.into_iter().map(|WordVariable { id, kind, word }| {
            let memory = &program.memories[word.memory as usize];
            let clocks = memory.writes.iter().map(|write| Triggers::state(write.clock as usize));
            let start = end;
            end += tilewright_circuit::limbs_for(memory.width);
            // The first time, all are taken.
            Shown {
                id,
                kind,
                word,
                start,
                end,
                triggers: clocks.fold(Triggers::NONE, Triggers::with),
                has_changed: true,
            }
        });
        let words = shown.collect();
        Words { words, limbs: vec![0; end], are_known: false }
    }

    /// Takes the words that these triggers may change; the first time, all words.
    pub fn take(&mut self, engine: &dyn Engine, changed: Triggers) {
        let are_known = std::mem::replace(&mut self.are_known, true);
        for shown in self.words.iter_mut().filter(|shown| !are_known || shown.triggers.meet(changed)) {
            let Word { memory, lane, address } = shown.word;
            let (old, new) = (&mut self.limbs[shown.start..shown.end], engine.word(memory, lane, address));
            if *old != new[..] {
                old.copy_from_slice(&new);
                shown.has_changed = true;
            }
        }
    }

    /// All words as last taken.
    pub fn limbs(&self) -> &[u64] {
        &self.limbs
    }

    /// Restores the words of an earlier [`Words::limbs`].
    pub fn go_to(&mut self, limbs: &[u64]) {
        for shown in &mut self.words {
            let range = shown.start..shown.end;
            shown.has_changed |= self.limbs[range.clone()] != limbs[range];
        }
        self.limbs.copy_from_slice(limbs);
    }

    /// Visits the words that have changed since the last visit, with their limbs.
    pub fn visit_changed(&mut self, mut visit: impl FnMut(Id, &VariableKind, &[u64])) {
        for shown in &mut self.words {
            if std::mem::take(&mut shown.has_changed) {
                visit(shown.id, &shown.kind, &self.limbs[shown.start..shown.end]);
            }
        }
    }
}
