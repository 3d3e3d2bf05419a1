//! A counter.

use tilewright_hdl::ir::About;
use tilewright_hdl::{Block, Module, Width, below, bit, bundle, mux, net};

bundle! {
    /// The inputs of a [`Counter`].
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Counter, CounterIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// let go = m.reg("go", 2).reset(0);
    /// go.next(go + 1);
    /// let counter = m.instance("u_counter", &Counter::new(10), CounterIn { restart: go.eq(3), enable: lit(1, 1) });
    /// net!(count = counter.count);
    /// # });
    /// assert_eq!(example.values("count"), [0, 1, 2, 3, 0, 1]);
    /// ```
    pub struct CounterIn<T> {
        /// It starts at 0 again; wins over `enable`.
        pub restart: T,
        /// It counts.
        pub enable: T,
    }

    /// The outputs of a [`Counter`].
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Counter, CounterIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// let low = m.instance("u_low", &Counter::new(3), CounterIn { restart: lit(1, 0), enable: lit(1, 1) });
    /// // One more wherever the other wraps.
    /// let high = m.instance("u_high", &Counter::new(10), CounterIn { restart: lit(1, 0), enable: low.wraps });
    /// net!(digits = cat!(high.count, low.count.zext(4)));
    /// # });
    /// assert_eq!(example.values("digits"), [0x00, 0x01, 0x02, 0x10, 0x11, 0x12, 0x20]);
    /// ```
    pub struct CounterOut<T> {
        /// How far it is.
        pub count: T,
        /// It counts from the last number to 0 at this edge.
        pub wraps: T,
    }
}

/// Counts from 0 to `limit - 1` and starts again.
///
/// ```text
/// restart --.    .-------.
/// enable ---+--->| count |--+--> count
///           +1   '-------'  '--> wraps
/// ```
///
/// Latency 1 clock to `count`; `wraps` is of the same clock.
///
/// ```
/// use tilewright_blocks::Counter;
/// let design = tilewright_hdl::elaborate(&Counter::new(10))?;
/// assert_eq!(design.top().name, "counter_limit10");
/// # Ok::<(), tilewright_hdl::Problems>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Counter {
    limit: u64,
}

impl Counter {
    /// A counter of so many numbers.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Counter, CounterIn};
    /// # tilewright_sim::example(|m| {
    /// let counter = m.instance("u_counter", &Counter::new(12), CounterIn { restart: lit(1, 0), enable: lit(1, 1) });
    /// m.assert(counter.count.lt(12), "0 to 11, in 4 bits");
    /// # });
    /// ```
    ///
    /// # Panics
    ///
    /// There is no number.
    #[track_caller]
    pub fn new(limit: u64) -> Counter {
        assert!(limit > 0, "a counter of 0 numbers counts nothing");
        Counter { limit }
    }
}

impl Block for Counter {
    type In = CounterIn;
    type Out = CounterOut;

    fn inputs(&self) -> CounterIn<Width> {
        CounterIn { restart: bit(), enable: bit() }
    }

    fn build(&self, m: Module, i: CounterIn) -> CounterOut {
        let count = m.reg("count", below(self.limit)).reset(0);
        net!(at_end = count.eq(self.limit - 1));
        count.when(i.restart, 0).when(i.enable, mux(at_end, 0, count + 1));
        CounterOut { count: count.value(), wraps: at_end & i.enable & !i.restart }
    }

    fn about(&self) -> About {
        About {
            summary: "Counts the clocks with `enable` high and starts again at a limit.".into(),
            latency: "1 clock".into(),
            ..About::default()
        }
    }
}
