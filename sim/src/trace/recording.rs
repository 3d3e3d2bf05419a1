//! Records a run: what goes in and comes out before every edge.

use std::sync::{Arc, Mutex};

use tilewright_hdl::recording::Step;
use tilewright_hdl::{Bits, Recording};

use super::{Observer, View};
use crate::engine::Engine;
use crate::error::Error;
use crate::program::{Port, Program, ValueId};

/// A recording that goes on while the simulation runs.
#[derive(Debug, Clone, Default)]
pub struct Recorder {
    recording: Arc<Mutex<Recording>>,
    /// Of a batch.
    run: u32,
}

impl Recorder {
    /// Records that run.
    pub(crate) fn of(run: u32) -> Recorder {
        Recorder { run, ..Recorder::default() }
    }

    /// What was recorded so far; the recording goes on with nothing.
    pub fn take(&self) -> Recording {
        std::mem::take(&mut self.recording.lock().expect("no panic while recording"))
    }
}

impl Observer for Recorder {
    fn sample(&mut self, view: &mut View) -> Result<(), Error> {
        let program = view.program;
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
