//! Solutions of the exercises.

#![allow(missing_docs, reason = "the exercises say what the ports are")]

pub mod apart;
pub mod changes;
pub mod dimmer;
pub mod life;
pub mod parity;
pub mod pulse;
pub mod saturate;
pub mod shout;
pub mod stack;
mod ticks_model;
pub mod valid;
