//! Records a run: the inputs and outputs before every edge.

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, MutexGuard};

use tilewright_hdl::recording::{Initial, Step};
use tilewright_hdl::{Bits, Recording};

use super::{Observer, View};
use crate::engine::program::{Port, Program, ValueId, hierarchy};
use crate::engine::{Engine, Word};
use crate::testbench::error::Error;

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

    /// Their values in a run; words at consecutive addresses are joined.
    fn initial(&self, view: &View, run: u32) -> Vec<Initial> {
        let (program, mut all) = (view.program, Vec::<(Word, Initial)>::new());
        for place in program.hierarchy.places(run) {
            let memories = &program.hierarchy.scope(place.scope).memories;
            let lanes = memories.iter().flat_map(|it| (0..it.2.lanes()).map(move |lane| (it, lane)));
            for ((name, memory, shape), lane) in lanes {
                let name = &format!("{name}{}", hierarchy::index(*shape, lane));
                let first = Word { memory: *memory, lane: place.lane * shape.lanes() + lane, address: 0 };
                let words = self.words();
                for word in words.range(first..=Word { address: u32::MAX, ..first }) {
                    let limbs = view.engine.word(word.memory, word.lane, word.address);
                    let bits = Bits::from_limbs(program.memories[word.memory as usize].width, &limbs);
                    match all.last_mut() {
                        Some((last, initial)) if Some(*word) == last.following() => {
                            initial.words.push(bits);
                            *last = *word;
                        }
                        _ => {
                            let path = program.hierarchy.path_in(place, name);
                            all.push((*word, Initial { path, address: word.address, words: vec![bits] }));
                        }
                    }
                }
            }
        }
        all.into_iter().map(|(_, initial)| initial).collect()
    }
}

impl Word {
    /// The word at the next address.
    fn following(self) -> Option<Word> {
        Some(Word { address: self.address.checked_add(1)?, ..self })
    }
}

/// A recording, which continues while the simulation runs.
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// let recorder = sim.recording();
/// sim.run(3);
/// let recording = recorder.take();
/// assert_eq!(recording.steps.iter().map(|step| step.time_ps).collect::<Vec<_>>(), [10_000, 20_000, 30_000]);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Recorder {
    recording: Arc<Mutex<Recording>>,
    /// The run of a batch.
    run: u32,
    poked: Poked,
}

impl Recorder {
    /// Records this run, which starts with these words poked.
    pub(crate) fn of(run: u32, poked: Poked) -> Recorder {
        Recorder { run, poked, ..Recorder::default() }
    }

    /// The recording so far; it continues empty.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let recorder = sim.recording();
    /// sim.run(3);
    /// assert_eq!(recorder.take().steps.len(), 3);
    /// sim.run(2);
    /// assert_eq!(recorder.take().steps.len(), 2);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn take(&self) -> Recording {
        std::mem::take(&mut self.recording.lock().expect("no panic while recording"))
    }
}

impl Observer for Recorder {
    fn sample(&mut self, view: &mut View) -> Result<(), Error> {
        let program = view.program;
        if view.since == 0 {
            self.recording.lock().expect("no panic while recording").initial = self.poked.initial(view, self.run);
        }
        let mut all =
            |ports: &[Port]| ports.iter().map(|port| bits(view.engine, program, port.value, self.run)).collect();
        let step = Step {
            time_ps: view.until,
            rising: view.rising.to_vec(),
            resets: (0..view.resets.len()).filter(|&clock| view.resets[clock]).collect(),
            inputs: all(&program.inputs),
            outputs: all(&program.outputs),
        };
        self.recording.lock().expect("no panic while recording").steps.push(step);
        Ok(())
    }
}

/// A value of a run.
fn bits(engine: &mut dyn Engine, program: &Program, id: ValueId, run: u32) -> Bits {
    let value = program.value(id);
    let start = run as usize * value.limbs();
    Bits::from_limbs(value.width, &engine.read(id)[start..start + value.limbs()])
}
