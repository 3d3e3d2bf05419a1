//! Chapter 10: the middle of a bit is not its end.

use crate::uart::ticks::{BitTicks, BitTicksIn};
use tilewright_hdl::*;

block! {
    /// Ticks, and what is stated of them.
    pub struct Apart { pub clocks_per_bit: u32 }
    in ApartIn { run: bit() }
    out ApartOut { middle: bit(), last: bit() }
}

impl Apart {
    fn build(&self, m: Module, i: ApartIn) -> ApartOut {
        let ticks = BitTicks { clocks_per_bit: self.clocks_per_bit };
        def!(ticks = m.instance(&ticks, BitTicksIn { run: i.run }));
        m.assert(!(ticks.middle & ticks.last), "the middle of a bit is not its end");
        ApartOut { middle: ticks.middle, last: ticks.last }
    }
}
