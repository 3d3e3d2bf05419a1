//! A simulated unit beside an array, with the observer of a pixel that is followed.

use tilewright_rtl::pixelflow::ARRAY;
use tilewright_sim::{Bundle, Simulation};

use crate::error::Error;
use crate::pixelflow::costs::Ticks;
use crate::pixelflow::following::Observer;
use crate::way::Step;

/// A unit in simulation.
pub(in crate::pixelflow) struct Observed<I: Bundle, O: Bundle, F> {
    pub sim: Simulation<I, O>,
    /// Whether it works.
    pub is_busy: bool,
    pub observer: Option<Box<F>>,
}

impl<I: Bundle, O: Bundle, F: Observer<I, O>> Observed<I, O, F> {
    /// An idle unit that nobody observes.
    pub fn new(sim: Simulation<I, O>) -> Observed<I, O, F> {
        Observed { sim, is_busy: false, observer: None }
    }

    /// Follows a pixel.
    pub fn follow(&mut self, observer: F) {
        self.observer = Some(Box::new(observer));
    }

    /// Tells the observer the tick.
    pub fn now(&mut self, tick: Ticks) {
        if let Some(observer) = &mut self.observer {
            observer.now(tick);
        }
    }

    /// Takes the steps of the pixel.
    pub fn take_steps(&mut self) -> Vec<Step> {
        self.observer.as_mut().map(|observer| observer.told().take()).unwrap_or_default()
    }

    /// Simulates a clock in which it works, and ends if `is_done`.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn clock(&mut self, is_done: bool) -> Result<(), Error> {
        if let Some(observer) = &mut self.observer {
            observer.told().at(self.sim.time() + ARRAY.period.picoseconds());
            observer.look(&mut self.sim);
        }
        self.step()?;
        self.is_busy = !is_done;
        Ok(())
    }

    /// Simulates an edge.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn step(&mut self) -> Result<(), Error> {
        let stepped = self.sim.try_step().map_err(Error::from);
        if let (Err(error), Some(observer)) = (&stepped, &mut self.observer) {
            observer.fail(error);
        }
        stepped
    }
}
