//! A counter.

use tilewright_hdl::{Module, below, bit, block, def, mux};

block! {
    /// Counts the clocks with `enable` high, from 0 to `limit - 1`, and starts again.
    ///
    /// ```text
    /// restart --.    .-------.
    /// enable ---+--->| count |--+--> count
    ///           +1   '-------'  '--> wraps
    /// ```
    ///
    /// Latency 1 clock to `count`; `wraps` is valid in the same clock.
    ///
    /// ```
    /// use tilewright_blocks::Counter;
    /// let design = tilewright_hdl::elaborate(&Counter::new(10))?;
    /// assert_eq!(design.top().name, "counter_limit10");
    /// # Ok::<(), tilewright_hdl::Problems>(())
    /// ```
    pub struct Counter {
        limit: u64,
    }
    latency = "1 clock";
    in CounterIn {
        /// Restarts the count at 0, with priority over `enable`.
        restart: bit(),
        /// Counts this clock.
        enable: bit(),
    }
    out(self) CounterOut {
        /// The count.
        count: below(self.limit),
        /// The count goes from the last number to 0 at this edge.
        wraps: bit(),
    }
}

impl Counter {
    /// A counter from 0 to `limit - 1`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Counter, CounterIn};
    /// # tilewright_sim::example(|m| {
    /// def!(counter = m.instance(&Counter::new(12), CounterIn { restart: lit(1, 0), enable: lit(1, 1) }));
    /// m.assert(counter.count.lt(12), "0 to 11, in 4 bits");
    /// # });
    /// ```
    ///
    /// # Panics
    ///
    /// `limit` is 0.
    #[track_caller]
    pub fn new(limit: u64) -> Counter {
        assert!(limit > 0, "a counter of 0 numbers counts nothing");
        Counter { limit }
    }

    fn build(&self, m: Module, i: CounterIn) -> CounterOut {
        def!(count = m.reg(below(self.limit)).reset(0));
        def!(at_end = count.eq(self.limit - 1));
        count.when(i.restart, 0).when(i.enable, mux(at_end, 0, count + 1));
        CounterOut { count: *count, wraps: at_end & i.enable & !i.restart }
    }
}
