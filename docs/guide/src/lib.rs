//! The code of the guide: each chapter's example, compiled and tested, for the chapter to quote.

pub mod blink;
pub mod cheat_sheet;
pub mod counter;
pub mod grammar;
pub mod memories;
pub mod mistakes;
pub mod nearer;
pub mod operations;
pub mod simd;
pub mod solutions;
pub mod start;
pub mod stopwatch;
mod traits;
pub mod uart;
pub mod words;
