//! Values with lanes: circuits that have them, and what is checked of their lanes.

pub mod build;
mod large;
mod loops;
mod machines;
