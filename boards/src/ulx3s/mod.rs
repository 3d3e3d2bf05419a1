//! The ULX3S: a board with a Lattice ECP5, an oscillator of 25 MHz and a socket for DVI or HDMI.

mod pads;
mod pll;

use crate::dvi::{DviSender, DviSenderIn};
use crate::picture::Picture;
use crate::screen::{Screen, ScreenIn};
pub use pads::{DoubleRate, DoubleRateIn, DoubleRateOut};
pub use pll::{CorePll, MachinePll, PllIn, PllOut, SerialPll, SlowPll, at_rest};
use tilewright_hdl::{Clock, Module, Period, Reset, Signal, bit, def, lit, record, row};

/// The board's oscillator, which is also the clock of the pixels: 640 x 480 at 59.5 Hz.
pub const PIXEL: Clock = Clock::new("pixel", Period::ns(40)).reset(Reset::PowerOn);

/// The clock of the serial lines, which send a bit at each of its edges.
pub const SERIAL: Clock = Clock::new("serial", Period::ns(8)).reset(Reset::PowerOn);

/// The clock of a machine that is slower than its picture, which leaves the placer room for the serial lines.
pub const SLOW: Clock = Clock::new("slow", Period::ns(60)).reset(Reset::PowerOn);

/// The clock of a design without a picture.
pub const CORE: Clock = Clock::new("core", Period::ps(12_500)).reset(Reset::PowerOn);

/// The pins, as [`Pins::read`](tilewright_gen::Pins::read) takes them.
pub const PINS: &str = include_str!("../../ulx3s.pins");

/// What loads a bitstream onto the board, until it is switched off.
pub const LOADER: &str = "openFPGALoader --board ulx3s";

record! {
    /// The pins of a top with a picture.
    pub struct Socket {
        /// Blue, green, red and the clock.
        tmds: bit().of(row(4)),
        /// All PLLs have locked.
        locked: bit(),
    }
}

/// Shows a screen on the board's socket: describes the PLL of the lines, the screen, the sender and the pads in the
/// top `m`. `clocks` are high once the other clocks of the picture run.
pub fn show<P: Picture>(m: Module, screen: &Screen<P>, clocks: &[Signal]) -> Socket {
    let (pixel, serial) = (m.on(PIXEL), m.on(SERIAL));
    def!(pll = m.instance(&SerialPll, at_rest()));
    let synchronized = (0..).zip(clocks).map(|(number, lock)| pixel.synchronize(&format!("locked{number}"), *lock));
    let all_locked = synchronized.fold(pixel.synchronize("serial_locked", pll.lock), |all, lock| all & lock);
    // A register, because pictures take it to their clocks.
    def!(locked = pixel.reg(bit()).reset(0));
    locked.next(all_locked);
    let locked = *locked;
    def!(screen = pixel.instance(screen, ScreenIn { runs: locked }));
    let sender = DviSender { pixel: PIXEL, serial: SERIAL };
    def!(sender = m.instance(&sender, DviSenderIn { shown: screen, runs: locked }));
    let into = DoubleRateIn { rst: lit(1, 0), d0: sender.first, d1: sender.second };
    def!(tmds = serial.array(4, &DoubleRate, |_| into));
    Socket { tmds: tmds.q, locked }
}
