//! Pins of an ECP5 that send two bits in a clock.

use super::SERIAL;
use tilewright_hdl::{Foreign, Module, bit, block};

block! {
    /// A pin of an ECP5 that sends two bits in each clock: the first one while the clock is high.
    ///
    /// The model shows the first bit in its output, and the second one in its register `second`.
    pub struct DoubleRate;
    foreign = Foreign::module("ODDRX1F").clock_of(SERIAL, "SCLK").capitals();
    in DoubleRateIn {
        /// Resets the pin.
        rst: bit(),
        /// The first bit.
        d0: bit(),
        /// The second bit.
        d1: bit(),
    }
    out DoubleRateOut {
        /// The pin.
        q: bit(),
    }
}

impl DoubleRate {
    fn build(&self, m: Module, i: DoubleRateIn) -> DoubleRateOut {
        let m = m.on(SERIAL);
        m.ignore(&i.rst);
        let _ = m.pipe("second", i.d1);
        DoubleRateOut { q: m.pipe("first", i.d0) }
    }
}
