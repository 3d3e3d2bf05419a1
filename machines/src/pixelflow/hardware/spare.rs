//! Simulated arrays for reuse: making a new one takes longer than a small frame.

use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tilewright_rtl::pixelflow::array::PixelArray;
use tilewright_sim::{EngineKind, Simulation};

use super::node::ArraySimulation;
use crate::error::Error;

/// Unused arrays of one size on one engine. Clones share them.
#[derive(Clone, Default)]
pub(in crate::pixelflow) struct Spare(Arc<Mutex<Arrays>>);

#[derive(Default)]
struct Arrays {
    /// The template of all arrays.
    first: Option<ArraySimulation>,
    free: Vec<ArraySimulation>,
}

impl Spare {
    /// An unused array, or a new one. It has to be reset.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn take(&self, array: &PixelArray, engine: EngineKind) -> Result<ArraySimulation, Error> {
        let mut arrays = self.lock();
        if let Some(spare) = arrays.free.pop() {
            return Ok(spare);
        }
        let first = match arrays.first.take() {
            Some(first) => first,
            None => Simulation::of(array)?.on(engine),
        };
        Ok(arrays.first.insert(first).another())
    }

    /// Returns an array for another frame.
    pub fn keep(&self, array: ArraySimulation) {
        self.lock().free.push(array);
    }

    fn lock(&self) -> MutexGuard<'_, Arrays> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl fmt::Debug for Spare {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Spare")
    }
}
