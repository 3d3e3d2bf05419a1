//! The code of the guide: each chapter's example, compiled and tested, for the chapter to quote.

pub mod blink;
pub mod counter;
pub mod memories;
pub mod mistakes;
pub mod operations;
pub mod solutions;
pub mod start;
pub mod stopwatch;
pub mod uart;
pub mod words;
