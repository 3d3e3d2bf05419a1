//! The simulator: circuits on every engine, and what each pass makes of them.

mod circuits;
mod passes;
