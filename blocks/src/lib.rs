//! Blocks that every design needs, for streams of any payload ([`Stream`](tilewright_hdl::Stream)).
//!
//! Use the blocks of streams through [`StreamBlocks`]: its methods take a stream of any signal or record and return
//! one:
//!
//! ```
//! use tilewright_blocks::{Slice, StreamBlocks, Turns};
//! use tilewright_hdl::*;
//!
//! bundle! {
//!     /// A pixel to draw.
//!     pub struct Pixel<T> { pub x: T, pub y: T, pub last: T }
//! }
//!
//! block! {
//!     /// Mixes two sources, each behind a queue.
//!     struct Mixer;
//!     in MixerIn {
//!         left: stream(Pixel { x: bits(10), y: bits(9), last: bit() }),
//!         right: stream(Pixel { x: bits(10), y: bits(9), last: bit() }),
//!     }
//!     out MixerOut { pixels: stream(Pixel = _) }
//! }
//!
//! impl Mixer {
//!     fn build(&self, m: Module, i: MixerIn) -> MixerOut {
//!         let left = m.fifo("u_left", 16, i.left);
//!         let right = m.fifo("u_right", 16, i.right);
//!         let mixed = m.arbiter("u_arbiter", Turns::RoundRobin, [left, right]);
//!         MixerOut { pixels: m.slice("u_slice", Slice::Both, mixed) }
//!     }
//! }
//!
//! let design = elaborate(&Mixer)?;
//! # assert_eq!(design.modules().len(), 4);
//! # Ok::<(), Problems>(())
//! ```
//!
//! In the examples `m` is the module of a block that the simulator runs. `example.values("count")` lists the values of
//! `count` just before each of the first edges.
//!
//! | block | what it does | latency | no combinational path |
//! |---|---|---|---|
//! | [`Fifo`] in [`Storage::Registers`] | a queue | 1 | any |
//! | [`Fifo`] in [`Storage::BlockRam`] | a queue | 2 | any |
//! | [`Lifo`] | a stack | 1 | any |
//! | [`DualClockFifo`] | a queue from one clock to another | 3 read clocks, or 4 if the edges coincide | any |
//! | [`RegisterSlice`], [`Slice::Forward`] | cuts `valid` and the payload | 1 | from `into` to `out` |
//! | [`RegisterSlice`], [`Slice::Backward`] | cuts `ready` | 0 | from `out` to `into` |
//! | [`RegisterSlice`], [`Slice::Both`] | cuts both: a skid buffer | 1 | any |
//! | [`Fork`] | one stream to several receivers | 0 | from a `ready` to a `valid` |
//! | [`StreamBlocks::join`], [`Join`] | two streams to one | 0 | from a `ready` to a `valid` |
//! | [`StreamBlocks::split_by`], [`Split`] | one stream to one of several receivers | 0 | from a `ready` to a `valid` |
//! | [`Arbiter`] | several streams to one, round robin or by priority | 0 | from `ready` to `valid` |
//! | [`Narrow`] | splits words into parts | 0 | from `ready` to `valid` |
//! | [`Widen`] | joins parts into words | 1 from the last | from `into` to `out` |
//! | [`ToAxiStream`], [`FromAxiStream`] | packets of bytes to and from AXI4-Stream | 1 from the last, 2 | from `into` to `out` |
//! | [`Divider`], [`SquareRoot`], [`SineCosine`] | quotients, roots and points of a circle | a clock for each bit | from `into` to `out` |
//! | [`SpiMaster`] | words to and from a slave on four lines | 2 half periods for each bit, and 1 clock | from `into` to `out`, and all pins |
//! | [`SdramController`], [`SdramOnPads`] | a memory chip with four banks, its rows and refreshes | CL + 4 on an open row | any, and all pins |
//! | [`SpiFlashReader`] | bytes of a flash memory on SPI | 5 or 6 bytes of SPI, and 1 clock | any |
//! | [`I2cMaster`] | bytes to and from slaves on two lines, with other masters | 9 bits of I2C, and 1 clock | from `commands` to `answers`, and all pins |
//! | [`AxiLiteRegisters`] | registers behind AXI4-Lite | 1 | any |
//! | [`Ram`] | a memory that is written byte by byte | 1 | any |
//! | [`DualClockRam`] | the same, written on one clock and read on another | 1 read clock | any |
//! | [`VectorRegisters`] | registers that are written lane by lane | 0 to read | from the write ports to the read values |
//! | [`Multiplier`], [`Shifter`] | pipelines with an enable | a clock for each stage | any |
//! | [`MultiplyAccumulate`] | several sums of products | 2 | any |
//! | [`Minimum`], [`PipelinedMinimum`] | the least of many numbers, and its index | 0, a clock for each level | -, any |
//! | [`BoxFilter`] | the sums of three by three cells, as a function [`window_sums`] | 1 | any |
//! | [`Rotator`], [`FromDecimal`], [`SevenSegment`] | a rotated word, decimal digits as a number, a digit on a display | 1 | any |
//! | [`Crc`], [`Quadrature`] | a check of a message, the position of a knob | 1, 2 | any |
//! | [`VideoTiming`], [`TmdsEncoder`] | positions and sync pulses of a screen, a colour as symbols of DVI | 1, 2 | any |
//! | [`Debouncer`] | a switch without its bounces | 2 clocks, and those that a level lasts | any |
//! | [`PowerOnReset`], [`Ticks`] | a reset after power-on, an enable once in each period | 1 | any |
//! | [`ResetSynchronizer`] | the synchronous release of an asynchronous reset | 0 to assert, 2 to release | |
//! | [`Counter`], [`UpDownCounter`], [`ShiftRegister`], [`Lfsr`] | counters, a shift register, a pseudo-random sequence | 1 | from inputs to outputs, except for [`Counter`]'s `wraps` and [`UpDownCounter`]'s `next` |
//! | [`CountOnes`] | the number of ones, as a function [`count_ones`] | 0 | |
//! | [`Quantizer`] | a rounded and saturated number, as functions [`round`] and [`saturate`] | 1 | any |
//! | [`Decoder`], [`Encoder`], [`PriorityEncoder`] | one-hot codes, as functions [`one_hot`], [`index_of`], [`first`] and [`first_index`] | 0 | |

mod arbiter;
mod axi_lite;
mod axi_stream;
pub mod catalog;
mod convert;
mod count_ones;
mod counter;
mod crc;
mod debouncer;
mod decimal;
mod divider;
mod dual_clock;
mod encode;
mod fifo;
mod fork;
mod i2c;
mod i2c_command;
mod join;
mod lfsr;
mod lifo;
mod minimum;
mod multiplier;
mod multiply_accumulate;
mod ports;
mod quadrature;
mod ram;
mod reset_synchronizer;
mod rotator;
mod rounding;
mod sdram;
mod shift;
mod shifter;
mod sine;
mod slice;
mod spi;
mod spi_flash;
mod split;
mod square_root;
mod start;
mod streams;
mod tmds;
mod up_down;
mod vector_registers;
mod video_timing;
mod window;

pub use arbiter::{Arbiter, ArbiterIn, Turns};
pub use axi_lite::{
    AxiLiteAddress, AxiLiteAnswer, AxiLiteData, AxiLiteRegisters, AxiLiteRegistersIn, AxiLiteRegistersOut, AxiLiteWord,
    AxiResponse,
};
pub use axi_stream::{
    AxiBeat, FromAxiStream, FromAxiStreamIn, FromAxiStreamOut, PacketByte, ToAxiStream, ToAxiStreamIn, ToAxiStreamOut,
};
pub use convert::{Narrow, Widen};
pub use count_ones::{CountOnes, CountOnesIn, CountOnesOut, count_ones};
pub use counter::{Counter, CounterIn, CounterOut};
pub use crc::{BitOrder, Crc, CrcIn, CrcOut};
pub use debouncer::{Debouncer, DebouncerIn, DebouncerOut};
pub use decimal::{FromDecimal, FromDecimalIn, FromDecimalOut, SevenSegment, SevenSegmentIn, SevenSegmentOut};
pub use divider::{Divider, DividerIn, DividerOut, Operands, Quotient};
pub use dual_clock::DualClockFifo;
pub use encode::{
    Decoder, DecoderIn, DecoderOut, Encoder, EncoderIn, EncoderOut, PriorityEncoder, PriorityEncoderIn,
    PriorityEncoderOut, first, first_index, index_of, one_hot,
};
pub use fifo::{Fifo, Storage};
pub use fork::{Fork, ForkOut};
pub use i2c::{I2cMaster, I2cMasterIn, I2cMasterOut, I2cMode};
pub use i2c_command::{I2cAction, I2cAnswer, I2cCommand, I2cResult};
pub use join::{Join, JoinIn};
pub use lfsr::{Lfsr, LfsrIn, LfsrOut};
pub use lifo::Lifo;
pub use minimum::{Minimum, MinimumIn, MinimumOut, PipelinedMinimum, PipelinedMinimumIn, PipelinedMinimumOut};
pub use multiplier::{Multiplier, MultiplierIn, MultiplierOut};
pub use multiply_accumulate::{MultiplyAccumulate, MultiplyAccumulateIn, MultiplyAccumulateOut};
pub use ports::{StreamIn, StreamOut};
pub use quadrature::{Quadrature, QuadratureIn, QuadratureOut, Turn};
pub use ram::{DualClockRam, DualClockRamIn, DualClockRamOut, Ram, RamIn, RamOut};
pub use reset_synchronizer::{ResetSynchronizer, ResetSynchronizerOut};
pub use rotator::{Rotator, RotatorIn, RotatorOut};
pub use rounding::{Quantizer, QuantizerIn, QuantizerOut, Ties, round, saturate};
pub use sdram::{
    SdramController, SdramControllerIn, SdramControllerOut, SdramOnPads, SdramOnPadsIn, SdramOnPadsOut, SdramPins,
    SdramRequest,
};
pub use shift::{ShiftRegister, ShiftRegisterIn, ShiftRegisterOut};
pub use shifter::{Shifter, ShifterIn, ShifterOut, Shifting};
pub use sine::{OnCircle, SineCosine, SineCosineOut};
pub use slice::{RegisterSlice, Slice};
pub use spi::{SpiMaster, SpiMasterIn, SpiMasterOut, SpiWord};
pub use spi_flash::{FlashRead, SpiFlashReader, SpiFlashReaderIn, SpiFlashReaderOut};
pub use split::{Addressed, Split, SplitIn, SplitOut};
pub use square_root::{Root, SquareRoot, SquareRootOut};
pub use start::{PowerOnReset, PowerOnResetIn, PowerOnResetOut, Ticks, TicksIn, TicksOut};
pub use streams::StreamBlocks;
pub use tmds::{TmdsEncoder, TmdsEncoderIn, TmdsEncoderOut};
pub use up_down::{UpDownCounter, UpDownCounterIn, UpDownCounterOut};
pub use vector_registers::{VectorRegisters, VectorRegistersIn, VectorRegistersOut};
pub use video_timing::{Scan, VideoTiming, VideoTimingIn, VideoTimingOut};
pub use window::{BoxFilter, BoxFilterIn, BoxFilterOut, window_sums};
