//! The blocks of the library by name, with their parameters and scenarios.

mod axi;
mod codes;
mod many;
mod memories;
mod numbers;
mod pins;
mod small;
mod streams;
mod video;

use tilewright_hdl::catalog::Entry;

/// Every block: first those of streams, then the others.
///
/// ```
/// use tilewright_blocks::catalog::ENTRIES;
/// let fifo = ENTRIES.iter().find(|entry| entry.name == "fifo").unwrap();
/// let design = fifo.design(&fifo.values([("depth", 5)])?)?;
/// assert_eq!(design.top().name, "fifo_depth5_width8_storage_registers");
/// # Ok::<(), tilewright_hdl::catalog::CatalogError>(())
/// ```
pub const ENTRIES: &[Entry] = &[
    streams::FIFO,
    streams::BLOCK_RAM_FIFO,
    streams::DUAL_CLOCK_FIFO,
    streams::LIFO,
    streams::FORWARD_SLICE,
    streams::BACKWARD_SLICE,
    streams::SKID_BUFFER,
    streams::FORK,
    streams::JOIN,
    streams::SPLIT,
    streams::ROUND_ROBIN_ARBITER,
    streams::PRIORITY_ARBITER,
    streams::NARROW,
    streams::WIDEN,
    axi::AXI_LITE_REGISTERS,
    axi::TO_AXI_STREAM,
    axi::FROM_AXI_STREAM,
    small::COUNTER,
    small::UP_DOWN_COUNTER,
    small::SHIFT_REGISTER,
    small::LFSR,
    small::QUADRATURE,
    small::POWER_ON_RESET,
    small::RESET_SYNCHRONIZER,
    small::TICKS,
    pins::DEBOUNCER,
    pins::SPI_MASTER,
    pins::SDRAM_CONTROLLER,
    pins::SPI_FLASH_READER,
    pins::I2C_MASTER,
    video::VIDEO_TIMING,
    video::TMDS_ENCODER,
    codes::DECODER,
    codes::ENCODER,
    codes::PRIORITY_ENCODER,
    codes::COUNT_ONES,
    codes::FROM_DECIMAL,
    codes::SEVEN_SEGMENT,
    memories::RAM,
    memories::DUAL_CLOCK_RAM,
    memories::VECTOR_REGISTERS,
    numbers::MULTIPLIER,
    numbers::MULTIPLY_ACCUMULATE,
    numbers::SHIFTER,
    numbers::ROTATOR,
    numbers::QUANTIZER,
    numbers::DIVIDER,
    numbers::SQUARE_ROOT,
    numbers::SINE_COSINE,
    numbers::CRC,
    many::MINIMUM,
    many::PIPELINED_MINIMUM,
    many::BOX_FILTER,
];
