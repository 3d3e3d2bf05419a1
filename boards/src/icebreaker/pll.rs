//! The PLL of an iCE40.

use super::{MACHINE, OSCILLATOR, PIXEL};
use tilewright_hdl::{Bits, Foreign, Module, bit, block, def, up_to};

block! {
    /// The PLL of an iCE40 at the pin of the oscillator. It makes 25.125 MHz of 12 MHz, and passes the 12 MHz on. Its own
    /// oscillator runs at 804 MHz.
    ///
    /// The model locks after some clocks.
    pub struct PixelPll;
    foreign = Foreign::module("SB_PLL40_2_PAD")
        .parameter("FEEDBACK_PATH", "SIMPLE")
        .parameter("PLLOUT_SELECT_PORTB", "GENCLK")
        .parameter("DIVR", Bits::new(4, 0))
        .parameter("DIVF", Bits::new(7, 66))
        .parameter("DIVQ", Bits::new(3, 5))
        .parameter("FILTER_RANGE", Bits::new(3, 1))
        .clock_of(OSCILLATOR, "PACKAGEPIN")
        .makes(MACHINE, "PLLOUTGLOBALA")
        .makes(PIXEL, "PLLOUTGLOBALB")
        .capitals();
    in PixelPllIn {
        /// Low resets the PLL.
        resetb: bit(),
        /// Passes the oscillator's clock on.
        bypass: bit(),
    }
    out PixelPllOut {
        /// The clocks are stable.
        lock: bit(),
    }
}

impl PixelPll {
    fn build(&self, m: Module, i: PixelPllIn) -> PixelPllOut {
        m.ignore(&i);
        let m = m.on(OSCILLATOR);
        def!(clocks = m.reg(up_to(7)).initial(0));
        clocks.when(clocks.ne(7), clocks + 1);
        def!(locked = m.reg(bit()).initial(0));
        locked.next(clocks.eq(7));
        PixelPllOut { lock: *locked }
    }
}
