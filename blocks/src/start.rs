//! Blocks that work before there is a reset: their registers start with power-on values.

use tilewright_hdl::{Module, below, bit, block, def, mux, up_to};

block! {
    /// Asserts the reset of everything else for some clocks after power-on, and on request.
    ///
    /// ```text
    /// again -->[ left ]--> reset       clocks, clocks - 1 .. 1, 0
    /// ```
    ///
    /// Latency 1 clock. The block has no reset: its counter starts with the value that an FPGA loads.
    ///
    /// ```
    /// use tilewright_blocks::PowerOnReset;
    /// let mut sim = tilewright_sim::Simulation::of(&PowerOnReset::new(3))?;
    /// let mut reset = Vec::new();
    /// for _ in 0..5 {
    ///     reset.push(sim.get_u64(sim.o.reset));
    ///     sim.step();
    /// }
    /// assert_eq!(reset, [1, 1, 1, 0, 0]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct PowerOnReset {
        clocks: u64,
    }
    latency = "1 clock";
    in PowerOnResetIn {
        /// Requests a reset; synchronous to this clock.
        again: bit(),
    }
    out PowerOnResetOut {
        /// The reset.
        reset: bit(),
    }
}

impl PowerOnReset {
    /// A reset of `clocks` clocks.
    ///
    /// ```
    /// use tilewright_blocks::PowerOnReset;
    /// let design = tilewright_hdl::elaborate(&PowerOnReset::new(16))?;
    /// assert!(design.top().registers[0].initial.is_some());
    /// # Ok::<(), tilewright_hdl::Problems>(())
    /// ```
    ///
    /// # Panics
    ///
    /// `clocks` is 0.
    #[track_caller]
    pub fn new(clocks: u64) -> PowerOnReset {
        assert!(clocks > 0, "a reset of 0 clocks resets nothing");
        PowerOnReset { clocks }
    }

    fn build(&self, m: Module, i: PowerOnResetIn) -> PowerOnResetOut {
        def!(left = m.reg(up_to(self.clocks)).initial(self.clocks));
        def!(reset = left.ne(0));
        left.when(i.again, self.clocks).when(reset, left - 1);
        PowerOnResetOut { reset }
    }
}

block! {
    /// Is high for one clock of each period: the enable of logic that works more slowly than its clock.
    ///
    /// ```text
    /// restart -->[ count ]--> tick     0, 1 .. every - 1, 0
    /// ```
    ///
    /// The first tick is in the first clock after power-on or `restart`. The block needs no reset.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Ticks, TicksIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(tick = m.instance("u_ticks", &Ticks::new(3), TicksIn { restart: lit(1, 0) }).tick);
    /// # });
    /// assert_eq!(example.values("tick"), [1, 0, 0, 1, 0, 0, 1]);
    /// ```
    pub struct Ticks {
        every: u64,
    }
    latency = "1 clock";
    in TicksIn {
        /// The next clock has a tick, and a period begins with it.
        restart: bit(),
    }
    out TicksOut {
        /// High for one clock of each period.
        tick: bit(),
    }
}

impl Ticks {
    /// A tick in one of `every` clocks.
    ///
    /// ```
    /// use tilewright_blocks::Ticks;
    /// let bit_time = Ticks::new(50_000_000 / 115_200);
    /// assert_eq!(bit_time, Ticks::new(434));
    /// ```
    ///
    /// # Panics
    ///
    /// `every` is below 2.
    #[track_caller]
    pub fn new(every: u64) -> Ticks {
        assert!(every > 1, "a tick every {every} clocks: a period has 2 or more");
        Ticks { every }
    }

    fn build(&self, m: Module, i: TicksIn) -> TicksOut {
        def!(count = m.reg(below(self.every)).initial(0));
        def!(tick = count.eq(0));
        count.next(mux(i.restart | count.eq(self.every - 1), 0, count + 1));
        TicksOut { tick }
    }
}
