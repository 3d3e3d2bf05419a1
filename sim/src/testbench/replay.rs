//! Repeats a recorded run.

use tilewright_circuit::Bits;
use tilewright_circuit::recording::{Initial, Recording, Step};
use tilewright_hdl::Bundle;

use crate::engine::{Beginning, Given};
use crate::testbench::error::{Error, UnknownName};
use crate::testbench::lookup::{self, Found};
use crate::testbench::port::Port;
use crate::testbench::running::Running;
use crate::testbench::simulation::Simulation;

/// Why a recording is not of this circuit.
///
/// ```
/// # use tilewright_sim::{Error, Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// let recorder = sim.recording();
/// sim.run(3);
/// let mut recording = recorder.take();
/// recording.steps[2].outputs[0] = tilewright_hdl::Bits::new(8, 99);
/// let Err(Error::Unrepeated(differs)) = Simulation::of(&Counter)?.replay(&recording) else { panic!("it differs") };
/// assert!(differs.to_string().starts_with("the recording differs from the circuit at 30000 ps: `count` is "));
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the recording differs from the circuit at {time} ps: {what}")]
pub struct Unrepeated {
    /// The time of the step, in picoseconds.
    pub time: u64,
    /// What differs.
    pub what: String,
}

impl<I: Bundle, O: Bundle> Simulation<I, O> {
    /// The same circuit at time 0, where a recording starts; [`Simulation::replay`] repeats the recording. Inputs become
    /// zero, and a seed no longer matters.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?.seeded(7);
    /// let start = sim.peek("late")?; // it has no reset
    /// let recorder = sim.recording();
    /// sim.run(3);
    /// let mut again = Simulation::of(&Counter)?.starting_as(&recorder.take())?;
    /// assert_eq!(again.peek("late")?, start);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The recording starts with a value of something that the circuit does not have.
    ///
    /// # Panics
    ///
    /// Called after the first step, or with a trace attached.
    #[track_caller]
    pub fn starting_as(mut self, recording: &Recording) -> Result<Self, UnknownName> {
        self.circuit.start_as(&recording.initial)?;
        Ok(self)
    }

    /// Repeats a recording from time 0: its inputs and resets. Before each edge the outputs are compared.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let recorder = sim.recording();
    /// sim.set(sim.i.enable, 1);
    /// sim.run(3);
    /// let mut again = Simulation::of(&Counter)?;
    /// again.replay(&recorder.take())?;
    /// assert_eq!((again.time(), again.get_u64(again.o.count)), (30_000, 3));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Unrepeated`] if ports, times or outputs differ; or as [`Simulation::try_step`]. A run that ended at a
    /// failing assertion ends there again.
    pub fn replay(&mut self, recording: &Recording) -> Result<(), Error> {
        recording.steps.iter().try_for_each(|step| self.circuit.repeat_step(step))
    }
}

impl Running {
    /// Starts again, with these values.
    #[track_caller]
    fn start_as(&mut self, initial: &[Initial]) -> Result<(), UnknownName> {
        assert!(self.timeline.time() == 0, "a start can only be given before the first step");
        assert!(!self.is_observed(), "give the start before attaching a trace");
        let (mut given, mut memories) = (Vec::new(), Vec::new());
        for start in initial {
            match lookup::signal(&self.program.hierarchy, &start.path, 0) {
                Ok(Found { signal, lane }) => {
                    let words = start.words.iter();
                    given.extend(words.map(|word| Given { value: signal.value, lane, word: word.clone() }));
                }
                Err(_) => memories.push((lookup::memory(&self.program.hierarchy, &start.path, 0)?, start)),
            }
        }
        let seeds = vec![0; self.engine.beginning.seeds.len()];
        self.restart(self.engine.again(self.engine.chosen(), Beginning { seeds, given }));
        for (_, start) in memories {
            for (address, word) in (start.address..).zip(&start.words) {
                self.poke_word(&start.path, 0, address, word)?;
            }
        }
        Ok(())
    }

    /// Repeats a step of a recording.
    fn repeat_step(&mut self, step: &Step) -> Result<(), Error> {
        let (inputs, outputs) = (self.program.inputs.len(), self.program.outputs.len());
        let next = self.timeline.next_time().ok_or(Error::Late)?;
        let fits = (step.inputs.len(), step.outputs.len()) == (inputs, outputs)
            && step.resets.iter().all(|&clock| clock < self.resets.len());
        if !fits || next != step.time_ps {
            let what = format!("it has other ports or clocks, or an edge at {next} ps");
            return Err(Unrepeated { time: step.time_ps, what }.into());
        }
        for (index, value) in step.inputs.iter().enumerate() {
            self.set(Port { index: index as u32 }, value);
        }
        (0..self.resets.len()).for_each(|clock| self.set_reset(clock, step.resets.contains(&clock)));
        for (index, expected) in step.outputs.iter().enumerate() {
            let port = Port { index: (inputs + index) as u32 };
            let found: Bits = self.get(port, 0);
            if found != *expected {
                let name = &self.declared(port).name;
                let what = format!("`{name}` is {found:?}, and the recording has {expected:?}");
                return Err(Unrepeated { time: step.time_ps, what }.into());
            }
        }
        self.try_step()
    }
}
