//! Records a run: what goes in and comes out before every edge.

use std::sync::{Arc, Mutex};

use tilewright_hdl::recording::Step;
use tilewright_hdl::{Bits, Recording};

use super::{Observer, View};
use crate::error::Error;
use crate::program::{Port, Program, ValueId};

/// A recording that goes on while the simulation runs.
#[derive(Debug, Clone, Default)]
pub struct Recorder(Arc<Mutex<Recording>>);

impl Recorder {
    /// What was recorded so far; the recording goes on with nothing.
    pub fn take(&self) -> Recording {
        std::mem::take(&mut self.0.lock().expect("no panic while recording"))
    }
}

impl Observer for Recorder {
    fn sample(&mut self, view: &mut View) -> Result<(), Error> {
        let program = view.program;
        let mut all = |ports: &[Port]| ports.iter().map(|port| bits(view.engine, program, port.value)).collect();
        let step = Step {
            time_ps: view.until,
            rising: view.rising.to_vec(),
            resets: (0..view.resets.len()).filter(|&clock| view.resets[clock]).collect(),
            inputs: all(&program.inputs),
            outputs: all(&program.outputs),
        };
        self.0.lock().expect("no panic while recording").steps.push(step);
        Ok(())
    }
}

/// A value of one lane.
fn bits(engine: &mut dyn crate::engine::Engine, program: &Program, id: ValueId) -> Bits {
    Bits::from_limbs(program.value(id).width, engine.read(id))
}
