//! Values with lanes: circuits that have them, and what is checked of their lanes.

mod build;
mod large;
mod loops;
mod machines;
