//! What can keep a machine from rendering a frame, in whole sentences.

use tilewright_rtl::parameter::ParameterError;

/// Why there is no frame. `Display` is the whole sentence.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The machine cannot be built as asked.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The cancellation flag was raised.
    #[error("the run was interrupted at {time} ps of simulated time, while the machine was {phase}")]
    Cancelled {
        /// What the machine did, such as `drawing`.
        phase: &'static str,
        /// Simulated picoseconds since the reset began.
        time: u64,
    },
    /// The run failed, and its waveform could not be written to the end either.
    #[error("{run}\n{trace}")]
    Untraced {
        /// Why the run failed.
        run: Box<Error>,
        /// Why the waveform did.
        trace: tilewright_sim::Error,
    },
    /// The hardware and the model of its clocks, which has to be the same, are not.
    #[error(
        "internal error: in clock {clock} {signal} of {unit} is {seen}, but {expected} by the model of its clocks; please report this"
    )]
    Differs {
        /// The part of the machine.
        unit: String,
        /// What differs.
        signal: &'static str,
        /// The clock, counted from 0.
        clock: u64,
        /// What the hardware has.
        seen: u64,
        /// What the model has.
        expected: u64,
    },
    /// The display got another colour than the frame buffer has.
    #[error("the display got another colour of pixel ({x}, {y}) than the frame buffer has; please report this")]
    Displayed {
        /// Counted from the left.
        x: u32,
        /// Counted from the top.
        y: u32,
    },
    /// The hardware could not be simulated, or an assertion of it does not hold.
    #[error(transparent)]
    Simulation(#[from] tilewright_sim::Error),
}

impl Error {
    /// What came of a run and of its traces, which have been ended after it.
    pub(crate) fn of_both<T>(ran: Result<T, Error>, traced: Result<(), tilewright_sim::Error>) -> Result<T, Error> {
        match (ran, traced) {
            (Err(run), Err(trace)) => Err(Error::Untraced { run: Box::new(run), trace }),
            (ran, traced) => ran.and_then(|done| Ok(traced.map(|()| done)?)),
        }
    }
}
