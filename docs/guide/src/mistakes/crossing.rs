//! Chapter 9: a flag that another clock takes as it is.

use crate::uart::two_clocks::{LINE, SYSTEM};
use tilewright_hdl::*;

block! {
    /// Says on the system's clock what happened on the line's.
    pub struct Crossing;
    in CrossingIn { overrun: bit().on(LINE), code: bits(4).on(LINE) }
    out CrossingOut { lost: bit(), error: bit() }
}

impl Crossing {
    fn build(&self, m: Module, i: CrossingIn) -> CrossingOut {
        def!(overrun_held = m.on(LINE).reg(bit()).reset(0).when(i.overrun, 1));
        def!(lost = m.on(SYSTEM).pipe(*overrun_held));
        def!(error = m.on(SYSTEM).synchronize(i.code.ne(0)));
        CrossingOut { lost, error }
    }
}
