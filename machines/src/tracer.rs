//! A waveform of one of the units that a machine simulates one by one.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tilewright_hdl::{Block, Bundle, DefaultClock, Design, elaborate_at};
use tilewright_sim::{Simulation, Trace};

use crate::error::Error;
use crate::way::Apart;

/// A waveform of a unit that is simulated by itself, which a machine writes while it renders. Clones share it.
#[derive(Clone, Debug)]
pub struct Tracer {
    unit: String,
    state: Arc<Mutex<State>>,
}

#[derive(Debug)]
struct State {
    /// The waveform, until the unit is there.
    trace: Option<Trace>,
    header: Vec<u8>,
    /// The circuit of the unit, once it is there.
    design: Option<Design>,
}

impl Tracer {
    /// One of that unit.
    pub fn new(of: &Apart, trace: Trace) -> Tracer {
        let state = State { trace: Some(trace), header: Vec::new(), design: None };
        Tracer { unit: of.unit.clone(), state: Arc::new(Mutex::new(state)) }
    }

    /// The header of the waveform; empty if the machine has no such unit.
    pub fn header(&self) -> Vec<u8> {
        self.state().header.clone()
    }

    /// Takes the circuit that the waveform is of; `None` if the machine has no such unit.
    pub fn take_design(&self) -> Option<Design> {
        self.state().design.take()
    }

    /// Begins the waveform if that is the unit: a simulation of that block, at that clock.
    ///
    /// # Errors
    /// [`Error::Simulation`]: it cannot be written, or has no signals.
    pub(crate) fn attach<B: Block, I: Bundle, O: Bundle>(
        &self,
        unit: &str,
        (block, clock): (&B, impl Into<DefaultClock>),
        sim: &mut Simulation<I, O>,
    ) -> Result<(), Error> {
        let mut state = self.state();
        let Some(trace) = state.trace.take_if(|_| unit == self.unit) else { return Ok(()) };
        state.header = sim.trace_header(&trace)?;
        state.design = Some(elaborate_at(block, clock).map_err(tilewright_sim::Error::from)?);
        Ok(sim.trace(trace)?)
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
