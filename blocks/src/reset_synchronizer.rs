//! The synchronous release of an asynchronous reset.

use tilewright_hdl::{Clock, Module, bit, block, lit};

block! {
    /// Passes on an asynchronous reset: it becomes active at once, and is released at an edge of its clock.
    ///
    /// ```text
    /// rst_n ----------+---------------.      sets both registers while it is low
    ///                 v               v
    /// 0 -------->[ reset_meta ]-->[ reset ]--> reset
    /// ```
    ///
    /// A register that sees its reset released just at an edge may take either value, and others may take it a clock
    /// later. So a reset from a pin goes through this block first, and what it resets takes its `reset`. If the release
    /// meets an edge, `reset_meta` settles while `reset` still resets.
    ///
    /// Latency 0 clocks from the assertion, 2 clocks from the release. Both registers have the attribute `ASYNC_REG`.
    ///
    /// ```
    /// use tilewright_blocks::ResetSynchronizer;
    /// use tilewright_hdl::{Clock, Period, Reset};
    /// const BOARD: Clock = Clock::new("board", Period::ns(20)).reset(Reset::AsynchronousLow);
    ///
    /// let mut sim = tilewright_sim::Simulation::of(&ResetSynchronizer::new(BOARD))?;
    /// sim.run(5);
    /// assert_eq!(sim.get(sim.o.reset), 0);
    /// sim.set_reset(BOARD, true); // `board_rst_n` is low
    /// assert_eq!(sim.get(sim.o.reset), 1);
    /// sim.step();
    /// sim.set_reset(BOARD, false);
    /// let mut reset = Vec::new();
    /// for _ in 0..4 {
    ///     reset.push(sim.get_u64(sim.o.reset));
    ///     sim.step();
    /// }
    /// assert_eq!(reset, [1, 1, 0, 0]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct ResetSynchronizer {
        clock: Clock,
    }
    latency = "0 clocks from the assertion, 2 from the release";
    out ResetSynchronizerOut {
        /// The reset, active high.
        reset: bit(),
    }
}

impl ResetSynchronizer {
    /// For the reset of this clock.
    ///
    /// ```
    /// use tilewright_blocks::ResetSynchronizer;
    /// use tilewright_hdl::{Clock, Period, Reset, elaborate};
    /// let clock = Clock::new("board", Period::ns(20)).reset(Reset::Asynchronous);
    /// let design = elaborate(&ResetSynchronizer::new(clock))?;
    /// assert!(design.top().registers.iter().all(|register| register.is_synchronizer));
    /// # Ok::<(), tilewright_hdl::Problems>(())
    /// ```
    ///
    /// # Panics
    ///
    /// The clock's reset is not asynchronous.
    #[track_caller]
    pub fn new(clock: Clock) -> ResetSynchronizer {
        assert!(
            clock.reset.is_asynchronous(),
            "clock `{}` has no asynchronous reset to synchronize: declare it with `.reset(Reset::AsynchronousLow)`",
            clock.name
        );
        ResetSynchronizer { clock }
    }

    fn build(&self, m: Module, _: ()) -> ResetSynchronizerOut {
        ResetSynchronizerOut { reset: m.on(self.clock).synchronize_from(true, "reset", lit(1, 0)) }
    }
}
