//! Drivers and observers of a running circuit: simulations, batches of runs, ports, waves and recordings.

mod attach;
mod batch;
mod cause;
mod checkpoint;
mod condition;
mod covers;
mod error;
mod example;
#[doc(hidden)]
pub mod for_examples;
mod instants;
mod lookup;
mod nets;
mod past;
mod peek;
mod play;
mod port;
mod port_lanes;
mod port_order;
mod processes;
mod replay;
mod resting;
mod run;
mod running;
mod simulation;
mod timeline;
mod trace;
mod values;

pub use attach::Probe;
pub use batch::Batch;
pub use cause::{Cause, End, Limits, Part};
pub use checkpoint::{Checkpoint, CheckpointError, StateDifference};
pub use condition::Condition;
pub use covers::Covered;
pub use error::{Error, UnknownName, Violation};
#[doc(hidden)]
pub use example::{Traced, example, traced};
pub use nets::{Memory, Nets};
pub use past::Unremembered;
pub use port::{IntoValue, Port};
pub use processes::{Answer, Monitor, Pauses, Process, Processes, Testbench, monitor};
pub use replay::Unrepeated;
pub use simulation::Simulation;
pub use trace::{Fst, Message, Messages, Recorder, Trace, Vcd, Wave, WaveLine, WaveLines, WaveRadix};
