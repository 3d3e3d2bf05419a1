//! Plays a scenario.

use std::ops::ControlFlow;

use tilewright_hdl::{Bundle, Scenario};

use crate::testbench::error::Error;
use crate::testbench::simulation::Simulation;

impl<I: Bundle, O: Bundle> Simulation<I, O> {
    /// Resets the circuit and plays a scenario to its end.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// use tilewright_hdl::{DEFAULT_PERIOD, Script};
    /// # use tilewright_sim::for_examples::CounterIn;
    ///
    /// let mut script = Script::new(&Counter, DEFAULT_PERIOD);
    /// script.hold(&CounterIn { enable: 1 }, 5);
    /// let scenario = script.finish("counts to 5");
    ///
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.play(&scenario)?;
    /// assert_eq!(sim.get(sim.o.count), 5);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The scenario is for another block; or as [`Simulation::try_step`].
    pub fn play(&mut self, scenario: &Scenario) -> Result<(), Error> {
        self.play_watched(scenario, u64::MAX, |_, _| ControlFlow::Continue(())).map(|_| ())
    }

    /// Like [`Simulation::play`], but calls `watch` every `slice` picoseconds and before every event. `watch` gets
    /// the fraction of the scenario played so far, from 0 to 1, and may stop it.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// use std::ops::ControlFlow;
    /// # use tilewright_hdl::{DEFAULT_PERIOD, Script};
    /// # use tilewright_sim::for_examples::CounterIn;
    /// # let mut script = Script::new(&Counter, DEFAULT_PERIOD);
    /// # script.hold(&CounterIn { enable: 1 }, 100);
    /// # let scenario = script.finish("counts to 100");
    /// # let mut sim = Simulation::of(&Counter)?;
    ///
    /// let ended = sim.play_watched(&scenario, 10_000, |_, played| match played < 0.5 {
    ///     true => ControlFlow::Continue(()),
    ///     false => ControlFlow::Break(()),
    /// })?;
    /// assert!(ended.is_break() && sim.get_u64(sim.o.count).abs_diff(50) <= 1);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Simulation::play`].
    pub fn play_watched(
        &mut self,
        scenario: &Scenario,
        slice: u64,
        mut watch: impl FnMut(&mut Self, f64) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, Error> {
        self.try_reset()?;
        let (start, mut now) = (self.time(), 0);
        let changes = scenario.events.iter().map(|event| (event.at_ps, Some(event)));
        for (until, event) in changes.chain([(scenario.end_ps, None)]) {
            while now < until {
                now = until.min(now.saturating_add(slice));
                self.try_run_to(start + now)?;
                if watch(self, now as f64 / scenario.end_ps as f64).is_break() {
                    return Ok(ControlFlow::Break(()));
                }
            }
            if let Some(event) = event {
                let port = self.port(&event.input)?;
                self.set(port, &event.value);
            }
        }
        Ok(ControlFlow::Continue(()))
    }
}
