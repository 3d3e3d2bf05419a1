//! Chapter 1: a register that nothing drives.

use tilewright_hdl::*;

block! {
    /// Ought to count.
    pub struct Undriven;
    in UndrivenIn { enable: bit() }
    out UndrivenOut { count: bits(4) }
}

impl Undriven {
    fn build(&self, m: Module, _: UndrivenIn) -> UndrivenOut {
        def!(count = m.reg(4).reset(0));
        UndrivenOut { count: *count }
    }
}
