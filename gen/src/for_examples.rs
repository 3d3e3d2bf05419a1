//! Blocks that the examples of this crate print.

use tilewright_hdl::{Module, bits, block};

block! {
    /// Delays each word by a clock.
    pub struct Delay;
    in DelayIn {
        /// The input.
        word: bits(8),
    }
    out DelayOut {
        /// The previous input.
        late: bits(8),
    }
}

impl Delay {
    fn build(&self, m: Module, i: DelayIn) -> DelayOut {
        DelayOut { late: m.pipe("held", i.word) }
    }
}
