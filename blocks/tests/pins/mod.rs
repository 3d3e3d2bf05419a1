//! The blocks at the pins of a chip.

mod debouncer;
pub mod i2c;
pub mod sdram;
mod spi;
pub mod spi_flash;
mod tmds;
mod video_timing;
