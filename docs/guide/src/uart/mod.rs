//! The UART that grows from chapter to chapter.

pub mod echo;
pub mod far_end;
pub mod placed;
pub mod proved;
pub mod queue;
pub mod receiver;
pub mod sender;
pub mod ticks;
pub mod transmitter;
pub mod two_clocks;
