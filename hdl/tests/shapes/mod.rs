//! Values with lanes: circuits that have them, and the checks of their lanes.

pub mod build;
mod large;
mod loops;
mod machines;
