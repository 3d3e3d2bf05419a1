//! What the examples of this crate print.

use tilewright_hdl::{Module, bits, block};

block! {
    /// Gives each word a clock later.
    pub struct Delay;
    in DelayIn {
        /// What comes in.
        word: bits(8),
    }
    out DelayOut {
        /// What it was.
        late: bits(8),
    }
}

impl Delay {
    fn build(&self, m: Module, i: DelayIn) -> DelayOut {
        DelayOut { late: m.pipe("held", i.word) }
    }
}
