//! A counter in both directions.

use tilewright_hdl::{Module, arms, below, bit, block, def, select};

block! {
    /// Counts up and down, and wraps in both directions between 0 and the last number.
    ///
    /// ```text
    ///             .-------.
    /// restart --->|       |
    ///      up --->| +1 -1 |=+==[count]==+==> count
    ///    down --->|       | |           |
    ///             '-------' '===========|==> next
    ///                 ^                 |
    ///                 '================='
    /// ```
    ///
    /// Latency 1 clock. `next` is the value of `count` after this clock's edge, for the address of a memory that is
    /// read at that edge.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{UpDownCounter, UpDownCounterIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(turns = m.reg(1).reset(1));
    /// turns.next(0);
    /// let moves = UpDownCounterIn { restart: lit(1, 0), up: *turns, down: !turns };
    /// def!(counter = m.instance(&UpDownCounter::new(10), moves));
    /// def!(count = counter.count);
    /// def!(next = counter.next);
    /// # });
    /// assert_eq!(example.values("count"), [0, 1, 0, 9, 8]);
    /// assert_eq!(example.values("next"), [1, 0, 9, 8, 7]);
    /// ```
    pub struct UpDownCounter {
        limit: u64,
    }
    latency = "1 clock to `count`, none to `next`";
    in UpDownCounterIn {
        /// Restarts the count at 0, with priority over `up` and `down`.
        restart: bit(),
        /// Counts up by one, unless `down` is high, too.
        up: bit(),
        /// Counts down by one, unless `up` is high, too.
        down: bit(),
    }
    out(self) UpDownCounterOut {
        /// The count.
        count: below(self.limit),
        /// The count after the edge.
        next: below(self.limit),
    }
}

impl UpDownCounter {
    /// A counter from 0 to `limit - 1`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::UpDownCounter;
    ///
    /// assert_eq!(UpDownCounter::new(100).name(), "up_down_counter_limit100");
    /// ```
    ///
    /// # Panics
    ///
    /// `limit` is below 2.
    #[track_caller]
    pub fn new(limit: u64) -> UpDownCounter {
        assert!(limit > 1, "a counter of {limit} numbers has no two directions: it has 2 or more");
        UpDownCounter { limit }
    }

    fn build(&self, m: Module, i: UpDownCounterIn) -> UpDownCounterOut {
        let last = self.limit - 1;
        def!(count = m.reg(below(self.limit)).reset(0));
        def!(rises = i.up & !i.down);
        def!(falls = i.down & !i.up);
        let arms = arms![
            i.restart => 0,
            rises & count.eq(last) => 0,
            rises => count + 1,
            falls & count.eq(0) => last,
            falls => count - 1,
        ];
        def!(next = select(arms, *count));
        count.next(next);
        UpDownCounterOut { count: *count, next }
    }
}
