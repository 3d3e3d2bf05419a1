//! Solutions of the exercises.

pub mod dimmer;
mod ticks_model;
