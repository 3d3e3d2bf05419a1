//! The UART that grows from chapter to chapter.

pub mod ticks;
pub mod transmitter;
