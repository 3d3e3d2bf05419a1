//! The blocks at the pins of a chip.

mod debouncer;
mod dvi;
mod sdram;
mod spi;
mod tmds;
mod video_timing;
