//! Pins of an ECP5 that send two bits in a clock.

use super::SERIAL;
use tilewright_hdl::{Foreign, Module, bit, block, cat, def};

block! {
    /// A pin of an ECP5 that sends two bits in each clock: the first one while the clock is high.
    ///
    /// The model shows the first bit in its output, and both in its register `sent`, the second one above.
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
        def!(sent = m.pipe(cat![i.d1, i.d0]));
        DoubleRateOut { q: sent.bit(0) }
    }
}
