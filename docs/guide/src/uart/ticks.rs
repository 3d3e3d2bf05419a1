//! Chapters 1 and 2: where a bit on the line ends, and where its middle is.

use tilewright_hdl::*;

block! {
    /// Divides time on a serial line into bits.
    pub struct BitTicks {
        /// How long a bit is.
        pub clocks_per_bit: u32,
    }
    ranges {
        /// The middle of a bit is not its end.
        clocks_per_bit: 2..,
    }
    in BitTicksIn {
        /// Bits follow each other while this is high; the first begins when it rises.
        run: bit(),
    }
    out BitTicksOut {
        /// The middle of a bit.
        middle: bit(),
        /// The last clock of a bit.
        last: bit(),
    }
}

impl BitTicks {
    fn build(&self, m: Module, i: BitTicksIn) -> BitTicksOut {
        let most = self.clocks_per_bit - 1;
        def!(clock = m.reg(below(self.clocks_per_bit)).reset(0));
        def!(at_end = clock.eq(most));
        clock.when(!i.run | at_end, 0).otherwise(clock + 1);
        BitTicksOut { middle: i.run & clock.eq(most / 2), last: i.run & at_end }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::Simulation;

    #[test]
    fn a_bit_has_a_middle_and_an_end() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&BitTicks { clocks_per_bit: 4 })?;
        let wave = sim.record(["run", "clock", "middle", "last"]);
        sim.set(sim.i.run, 1);
        sim.run(6);
        sim.set(sim.i.run, 0);
        sim.run(2);
        sim.set(sim.i.run, 1);
        sim.run(4);
        wave.expect(
            r"
            clk    |___/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
            run    |~~~~~~~~~~~~~~~~~~~~~~~\_______/~~~~~~~~~~~~~~~~
            clock  | 0 | 1 | 2 | 3 | 0 | 1 | 2 | 0     | 1 | 2 | 3 |
            middle |___/~~~\___________/~~~\___________/~~~\________
            last   |___________/~~~\___________________________/~~~~",
        );
        Ok(())
    }

    #[test]
    fn each_clock_is_what_it_should_be() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&BitTicks { clocks_per_bit: 4 })?;
        //              run, middle, last
        for (clock, (run, middle, last)) in
            [(0, 0, 0), (1, 0, 0), (1, 1, 0), (1, 0, 0), (1, 0, 1), (1, 0, 0), (0, 0, 0), (1, 0, 0), (1, 1, 0)]
                .into_iter()
                .enumerate()
        {
            sim.drive(BitTicksIn { run });
            assert_eq!(sim.read_u64(), BitTicksOut { middle, last }, "in clock {clock}");
            sim.step();
        }
        Ok(())
    }
}
