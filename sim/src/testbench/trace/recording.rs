//! Records a run: the inputs and outputs before every edge.

use std::sync::{Arc, Mutex};

use tilewright_circuit::recording::Step;
use tilewright_circuit::{Bits, Recording};

use super::{Observer, Start, View};
use crate::engine::Engine;
use crate::engine::program::{Port, Program, ValueId};
use crate::testbench::error::Error;

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
    start: Start,
}

impl Recorder {
    /// Records this run, which starts so.
    pub(crate) fn of(run: u32, start: Start) -> Recorder {
        Recorder { run, start, ..Recorder::default() }
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
            self.recording.lock().expect("no panic while recording").initial = self.start.initial(view, self.run);
        }
        let mut all =
            |ports: &[Port]| ports.iter().map(|port| bits(&mut **view.engine, program, port.value, self.run)).collect();
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
