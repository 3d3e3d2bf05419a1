//! Arrays in simulation that have drawn a frame: to make one anew takes longer than a small frame.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use tilewright_rtl::pixelflow::array::PixelArray;
use tilewright_sim::{EngineKind, Simulation};

use super::node::ArraySimulation;
use crate::error::Error;

/// Arrays of one size on one engine that nobody uses; copies of it are the same ones.
#[derive(Clone, Default)]
pub(in crate::pixelflow) struct Spare(Arc<Mutex<Vec<ArraySimulation>>>);

impl Spare {
    /// One of them, or a new one; it has to be reset.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn take(&self, array: &PixelArray, engine: EngineKind) -> Result<ArraySimulation, Error> {
        let spare = self.0.lock().unwrap_or_else(PoisonError::into_inner).pop();
        spare.map_or_else(|| Ok(Simulation::of(array)?.on(engine)), Ok)
    }

    /// Another frame may use it.
    pub fn keep(&self, array: ArraySimulation) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(array);
    }
}

impl fmt::Debug for Spare {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Spare")
    }
}
