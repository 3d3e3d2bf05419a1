//! Runs a circuit cycle by cycle: engines, testbenches, waves.

mod attach;
mod error;
mod lane;
mod limbs;
mod lookup;
mod port;
pub mod program;
mod reference;
mod run;
mod simulation;
mod start;
mod timeline;
mod trace;

pub use attach::Probe;
pub use error::{Error, UnknownName, Violation};
pub use port::{IntoValue, Port};
pub use simulation::Simulation;
pub use trace::{Recording, Step, Vcd, Wave};
