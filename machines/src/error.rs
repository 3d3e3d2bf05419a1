//! The errors of machines, in whole sentences.

use tilewright_rtl::parameter::ParameterError;

/// Why there is no frame. `Display` gives the whole sentence.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The machine cannot be built as asked.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The cancellation flag was raised.
    #[error("the run was interrupted at {time} ps of simulated time, while the machine was {phase}")]
    Cancelled {
        /// The activity of the machine, such as `drawing`.
        phase: &'static str,
        /// Simulated picoseconds since the reset began.
        time: u64,
    },
    /// The run failed, and its waveform could not be completed either.
    #[error("{run}\n{trace}")]
    Untraced {
        /// Why the run failed.
        run: Box<Error>,
        /// Why the waveform failed.
        trace: tilewright_sim::Error,
    },
    /// The hardware differs from the model of its clocks.
    #[error(
        "internal error: in clock {clock} {signal} of {unit} is {seen}, and the model of its clocks expects {expected}; please report this"
    )]
    Differs {
        /// The part of the machine.
        unit: String,
        /// The signal that differs.
        signal: &'static str,
        /// The clock, counted from 0.
        clock: u64,
        /// The value in the hardware.
        seen: u64,
        /// The value in the model.
        expected: u64,
    },
    /// The display got a colour that differs from the frame buffer's.
    #[error("the display got a colour of pixel ({x}, {y}) that differs from the frame buffer's; please report this")]
    Displayed {
        /// Counted from the left.
        x: u32,
        /// Counted from the top.
        y: u32,
    },
    /// The hardware could not be simulated, or one of its assertions failed.
    #[error(transparent)]
    Simulation(#[from] tilewright_sim::Error),
}

impl Error {
    /// The result of a run, and of its traces, which ended after it.
    pub(crate) fn of_both<T>(ran: Result<T, Error>, traced: Result<(), tilewright_sim::Error>) -> Result<T, Error> {
        match (ran, traced) {
            (Err(run), Err(trace)) => Err(Error::Untraced { run: Box::new(run), trace }),
            (ran, traced) => ran.and_then(|done| Ok(traced.map(|()| done)?)),
        }
    }
}
