//! Pins of an iCE40 with a register in the pin.

use tilewright_hdl::{Bits, Foreign, Module, bit, block};

block! {
    /// A pin that sends a bit, from the clock's edge on.
    pub struct Pad;
    foreign = Foreign::module("SB_IO").parameter("PIN_TYPE", Bits::new(6, 0b01_0101)).clock("OUTPUT_CLK").capitals();
    in PadIn {
        /// The bit.
        d_out_0: bit(),
    }
    out PadOut {
        /// The pin.
        package_pin: bit(),
    }
}

impl Pad {
    fn build(&self, m: Module, i: PadIn) -> PadOut {
        PadOut { package_pin: m.pipe("sent", i.d_out_0) }
    }
}

block! {
    /// A pin that sends two bits in each clock: the first one while the clock is high. So it can send a clock.
    ///
    /// The model shows the first bit in its output, and the second one in its register `second`.
    pub struct ClockPad;
    foreign = Foreign::module("SB_IO").parameter("PIN_TYPE", Bits::new(6, 0b01_0001)).clock("OUTPUT_CLK").capitals();
    in ClockPadIn {
        /// The first bit.
        d_out_0: bit(),
        /// The second bit.
        d_out_1: bit(),
    }
    out ClockPadOut {
        /// The pin.
        package_pin: bit(),
    }
}

impl ClockPad {
    fn build(&self, m: Module, i: ClockPadIn) -> ClockPadOut {
        let _ = m.pipe("second", i.d_out_1);
        ClockPadOut { package_pin: m.pipe("first", i.d_out_0) }
    }
}
