//! Chapter 1: a counter, before it becomes the UART's first block.

use tilewright_hdl::*;

block! {
    /// Counts from 0 to `limit - 1` and starts again.
    pub struct Counter {
        /// How many numbers it has.
        pub limit: u32,
    }
    in CounterIn {
        /// It counts.
        enable: bit(),
    }
    out(self) CounterOut {
        /// The number.
        count: below(self.limit),
        /// The last number, with `enable` high: 0 comes next.
        wraps: bit(),
    }
}

impl Counter {
    fn build(&self, m: Module, i: CounterIn) -> CounterOut {
        def!(count = m.reg(below(self.limit)).reset(0));
        def!(at_end = count.eq(self.limit - 1));
        count.when(i.enable, mux(at_end, 0, count + 1));
        CounterOut { count: *count, wraps: i.enable & at_end }
    }
}
