//! What a recorded run starts from, where that is neither a reset value, nor contents, nor zero.

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, MutexGuard};

use tilewright_circuit::Bits;
use tilewright_circuit::recording::Initial;

use super::View;
use crate::engine::Word;
use crate::engine::program::hierarchy::{self, Place, Role};
use crate::testbench::running::Running;

/// The memory words that were replaced before the first step.
#[derive(Debug, Clone, Default)]
pub(crate) struct Poked(Arc<Mutex<BTreeSet<Word>>>);

impl Poked {
    fn words(&self) -> MutexGuard<'_, BTreeSet<Word>> {
        self.0.lock().expect("no panic while poking")
    }

    pub fn add(&self, word: Word) {
        self.words().insert(word);
    }

    pub fn clear(&self) {
        self.words().clear();
    }
}

/// The start of a recorded run.
#[derive(Debug, Clone, Default)]
pub(crate) struct Start {
    poked: Poked,
    /// The registers and read data that do not start at zero, because of a seed or a recording; `None` if they do.
    filled: Option<Vec<Initial>>,
}

impl Start {
    /// The start of a run of this circuit, before its first step. Words may still be poked.
    pub fn of(circuit: &mut Running, run: u32) -> Start {
        let beginning = &circuit.engine.beginning;
        let is_other = beginning.seeds[run as usize] != 0 || !beginning.given.is_empty();
        Start { poked: circuit.poked.clone(), filled: is_other.then(|| filled(circuit, run)) }
    }

    /// All of it, just before the first step. Words at consecutive addresses are joined.
    pub fn initial(&self, view: &View, run: u32) -> Vec<Initial> {
        let mut all = self.filled.clone().unwrap_or_default();
        let hierarchy = &view.program.hierarchy;
        for place in hierarchy.places(run) {
            for (name, memory, shape) in &hierarchy.scope(place.scope).memories {
                for lane in 0..shape.lanes() {
                    let path = hierarchy.path_in(place, &format!("{name}{}", hierarchy::index(*shape, lane)));
                    let first = Word { memory: *memory, lane: place.lane * shape.lanes() + lane, address: 0 };
                    all.extend(self.words(view, first, &path));
                }
            }
        }
        all
    }

    /// Of a lane of a memory.
    fn words(&self, view: &View, first: Word, path: &str) -> Vec<Initial> {
        let memory = &view.program.memories[first.memory as usize];
        let addresses: Vec<u32> = match self.filled.is_some() && memory.is_unknown() {
            true => (0..memory.depth).collect(),
            false => {
                let words = self.poked.words();
                words.range(first..=Word { address: u32::MAX, ..first }).map(|word| word.address).collect()
            }
        };
        let mut all: Vec<Initial> = Vec::new();
        for address in addresses {
            let word = Bits::from_limbs(memory.width, &view.engine.word(first.memory, first.lane, address));
            match all.last_mut() {
                Some(last) if last.address + last.words.len() as u32 == address => last.words.push(word),
                _ => all.push(Initial { path: path.to_owned(), address, words: vec![word] }),
            }
        }
        all
    }
}

/// The values that a seed gives registers and read data.
fn filled(circuit: &mut Running, run: u32) -> Vec<Initial> {
    let program = circuit.program.clone();
    let starts_as_usual = program.registers.iter().filter(|it| it.initial.is_some() || it.reset.is_some());
    let usual: BTreeSet<_> = starts_as_usual.map(|register| register.value).collect();
    let mut all = Vec::new();
    for place @ Place { scope, lane, .. } in program.hierarchy.places(run) {
        let signals = program.hierarchy.scope(scope).signals.iter();
        let is_filled = |role, value| matches!(role, Role::Register | Role::ReadData) && !usual.contains(&value);
        for signal in signals.filter(|signal| is_filled(signal.role, signal.value)) {
            let lanes = signal.shape.lanes();
            for index in 0..lanes {
                let name = format!("{}{}", signal.name, hierarchy::index(signal.shape, index));
                let word = circuit.lane(signal.value, lane * lanes + index);
                all.push(Initial { path: program.hierarchy.path_in(place, &name), address: 0, words: vec![word] });
            }
        }
    }
    all
}
