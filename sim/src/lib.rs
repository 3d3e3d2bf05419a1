//! Runs a circuit cycle by cycle: engines, testbenches, waves.

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

pub use error::{Error, UnknownName, Violation};
pub use port::{IntoValue, Port};
pub use simulation::{Probe, Simulation};
pub use trace::{Recording, Step, Wave};
