//! Chapter 0: a lamp that says when it is about to change.

use tilewright_hdl::*;

block! {
    /// A lamp that is on for some clocks, then off for as many.
    pub struct Changes { pub clocks: u32 }
    in ChangesIn { enable: bit() }
    out ChangesOut { lamp: bit(), changes: bit() }
}

impl Changes {
    fn build(&self, m: Module, i: ChangesIn) -> ChangesOut {
        def!(count = m.reg(below(self.clocks)).reset(0));
        def!(at_end = count.eq(self.clocks - 1));
        count.when(i.enable & at_end, 0).when(i.enable, count + 1);
        def!(lamp = m.reg(bit()).reset(0));
        lamp.when(i.enable & at_end, !lamp);
        ChangesOut { lamp: *lamp, changes: i.enable & at_end }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::Simulation;

    #[test]
    fn it_is_high_before_the_lamp_inverts() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Changes { clocks: 3 })?;
        let wave = sim.record(["count", "changes", "lamp"]);
        sim.set(sim.i.enable, 1);
        sim.run(8);
        wave.expect(
            r"
            clk     |___/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
            count   | 0 | 1 | 2 | 0 | 1 | 2 | 0 | 1 |
            changes |_______/~~~\_______/~~~\________
            lamp    |___________/~~~~~~~~~~~\________",
        );
        Ok(())
    }
}
