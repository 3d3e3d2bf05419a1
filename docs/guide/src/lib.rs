//! The code of the guide: each chapter's example, compiled and tested, for the chapter to quote.

pub mod blink;
pub mod book;
pub mod button;
pub mod cheat_sheet;
pub mod counter;
pub mod grammar;
mod looking;
pub mod memories;
pub mod mistakes;
pub mod nearer;
pub mod operations;
pub mod renderer;
pub mod resets;
pub mod response;
pub mod simd;
pub mod solutions;
pub mod start;
pub mod stopwatch;
mod traits;
mod translations;
pub mod uart;
pub mod words;
