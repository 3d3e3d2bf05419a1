//! Runs a circuit cycle by cycle: engines, testbenches, waves.

mod lane;
mod limbs;
pub mod program;
mod reference;
