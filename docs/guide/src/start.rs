//! Chapter 2: what registers hold at the start.

use tilewright_hdl::*;

block! {
    /// Three counters, of which a reset knows one.
    pub struct Start;
    out StartOut {
        /// After a reset it is 3.
        with_reset: bits(4),
        /// At power-on it is 3.
        with_initial: bits(4),
        /// Nobody knows.
        with_neither: bits(4),
    }
}

impl Start {
    fn build(&self, m: Module, (): ()) -> StartOut {
        def!(with_reset = m.reg(4).reset(3));
        def!(with_initial = m.reg(4).initial(3));
        def!(with_neither = m.reg(4));
        with_reset.next(with_reset + 1);
        with_initial.next(with_initial + 1);
        with_neither.next(with_neither + 1);
        StartOut { with_reset: *with_reset, with_initial: *with_initial, with_neither: *with_neither }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::Simulation;

    #[test]
    fn a_reset_sets_what_has_one() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Start)?.seeded(1);
        let wave = sim.record([sim.o.with_reset, sim.o.with_initial, sim.o.with_neither]);
        sim.run(2);
        sim.reset();
        sim.run(2);
        wave.expect(
            r"
            clk          |___/~\_/~\_/~\_/~\_/
            with_reset   | 3 | 4 | 5 | 3 | 4 |
            with_initial | 3 | 4 | 5 | 6 | 7 |
            with_neither | 6 | 7 | 8 | 9 | a |",
        );
        Ok(())
    }
}
