//! The simulator: circuits on every engine, and the effect of each pass on them.

mod circuits;
mod passes;
