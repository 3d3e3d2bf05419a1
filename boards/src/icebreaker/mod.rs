//! The iCEBreaker: a board with a Lattice iCE40 UltraPlus 5K, an oscillator of 12 MHz, and a DVI PMOD of 12 bits.
//!
//! The PMOD has a chip that makes DVI of parallel colours. It takes them where its clock rises.

mod pads;
mod pll;

use crate::picture::Picture;
use crate::screen::{Screen, ScreenIn};
pub use pads::{ClockPad, ClockPadIn, ClockPadOut, Pad, PadIn, PadOut};
pub use pll::{PixelPll, PixelPllIn, PixelPllOut};
use tilewright_hdl::{Clock, Module, Period, Reset, Signal, bit, bits, def, lit, record};

/// The board's oscillator, which only the PLL has.
pub const OSCILLATOR: Clock = Clock::new("oscillator", Period::ps(83_334)).reset(Reset::PowerOn);

/// The oscillator's clock behind the PLL, for a machine.
pub const MACHINE: Clock = Clock::new("machine", Period::ps(83_334)).reset(Reset::PowerOn);

/// The clock of the pixels, 25.125 MHz: 640 x 480 at 59.8 Hz.
pub const PIXEL: Clock = Clock::new("pixel", Period::ps(39_800)).reset(Reset::PowerOn);

/// The pins, as [`Pins::read`](tilewright_gen::Pins::read) takes them.
pub const PINS: &str = include_str!("../../icebreaker.pins");

/// What loads a bitstream.
pub const LOADER: &str = "iceprog";

record! {
    /// The pins of the PMOD.
    pub struct Pmod {
        /// Red.
        red: bits(4),
        /// Green.
        green: bits(4),
        /// Blue.
        blue: bits(4),
        /// A pixel is visible.
        active: bit(),
        /// The sync pulse of lines.
        hsync: bit(),
        /// The sync pulse of frames.
        vsync: bit(),
        /// The clock, which rises in the middle of a pixel. In the model it stays low.
        dvi_clk: bit(),
    }
}

/// Shows a screen on the PMOD: describes the PLL, the screen and the pads in the top `m`. Each colour has the upper four
/// of its eight bits.
pub fn show<P: Picture>(m: Module, screen: &Screen<P>) -> Pmod {
    let pixel = m.on(PIXEL);
    def!(pll = m.instance(&PixelPll, PixelPllIn { resetb: lit(1, 1), bypass: lit(1, 0) }));
    def!(locked = pixel.synchronize(pll.lock));
    def!(screen = pixel.instance(screen, ScreenIn { runs: locked }));
    let upper = |name: &str, colour: Signal| {
        let bits = colour.part(4, 4).unpack(4);
        pixel.array(name, 4, &Pad, |_| PadIn { d_out_0: bits }).package_pin.pack()
    };
    let pad = |name: &str, level: Signal| pixel.instance(name, &Pad, PadIn { d_out_0: level }).package_pin;
    let clock = ClockPadIn { d_out_0: lit(1, 0), d_out_1: lit(1, 1) };
    Pmod {
        red: upper("u_red", screen.colour.red),
        green: upper("u_green", screen.colour.green),
        blue: upper("u_blue", screen.colour.blue),
        active: pad("u_active", screen.active),
        hsync: pad("u_hsync", screen.hsync),
        vsync: pad("u_vsync", screen.vsync),
        dvi_clk: pixel.instance("u_clock", &ClockPad, clock).package_pin,
    }
}
