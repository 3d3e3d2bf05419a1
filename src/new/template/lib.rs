//! A block of hardware, with a test for each clock. Replace it by your own.

use tilewright_hdl::*;

block! {
    /// Counts from 0 to `limit - 1` and starts again.
    pub struct Counter {
        /// How many numbers there are.
        pub limit: u64,
    }
    ranges(self) { limit: 2..=1 << 20 }
    in CounterIn {
        /// The counter goes on.
        enable: bit(),
    }
    out(self) CounterOut {
        /// The number.
        count: below(self.limit),
        /// The next number is 0.
        wraps: bit(),
    }
}

impl Counter {
    fn build(&self, m: Module, i: CounterIn) -> CounterOut {
        def!(count = m.reg(below(self.limit)).reset(0));
        def!(at_end = count.eq(self.limit - 1));
        count.when(i.enable, mux(at_end, 0, count + 1));
        CounterOut { count: *count, wraps: at_end & i.enable }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::{Error, Simulation};

    #[test]
    fn it_counts_while_it_is_enabled() -> Result<(), Error> {
        let mut sim = Simulation::of(&Counter { limit: 3 })?;
        let wave = sim.record([sim.i.enable, sim.o.count, sim.o.wraps]);
        for (enable, count) in [(1, 0), (1, 1), (0, 2), (1, 2), (1, 0)] {
            // What is driven before an edge decides what the edge does.
            sim.drive(CounterIn { enable });
            assert_eq!(sim.get(sim.o.count), count);
            sim.step();
        }
        wave.expect(
            r"
            clk    |___/~\_/~\_/~\_/~\_/
            enable |~~~~~~~\___/~~~~~~~~
            count  | 0 | 1 | 2     | 0 |
            wraps  |___________/~~~\____
            ",
        );
        Ok(())
    }
}
