//! Chapter 0: a lamp that blinks.

use tilewright_hdl::*;

block! {
    /// A lamp that is on for some clocks, then off for as many.
    pub struct Blink {
        /// How many clocks it is on.
        pub clocks: u32,
    }
    in BlinkIn {
        /// The lamp blinks while this is high.
        enable: bit(),
    }
    out BlinkOut {
        /// The lamp.
        lamp: bit(),
    }
}

impl Blink {
    fn build(&self, m: Module, i: BlinkIn) -> BlinkOut {
        def!(count = m.reg(below(self.clocks)).reset(0));
        def!(at_end = count.eq(self.clocks - 1));
        count.when(i.enable & at_end, 0).when(i.enable, count + 1);
        def!(lamp = m.reg(bit()).reset(0));
        lamp.when(i.enable & at_end, !lamp);
        BlinkOut { lamp: *lamp }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::{Simulation, Vcd};

    #[test]
    fn the_lamp_blinks() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Blink { clocks: 3 })?;
        sim.trace(Vcd::to(std::env::temp_dir().join("blink.vcd")))?;
        let wave = sim.record(["enable", "count", "lamp"]);
        sim.set(sim.i.enable, 1);
        sim.run(8);
        sim.finish()?;
        wave.expect(
            r"
            clk    |___/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
            enable |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
            count  | 0 | 1 | 2 | 0 | 1 | 2 | 0 | 1 |
            lamp   |___________/~~~~~~~~~~~\________",
        );
        Ok(())
    }

    #[test]
    fn the_verilog_is_written() -> Result<(), Box<dyn std::error::Error>> {
        let design = elaborate(&Blink { clocks: 6_000_000 })?;
        for file in tilewright_gen::verilog(&design) {
            std::fs::write(std::env::temp_dir().join(&file.name), &file.text)?;
        }
        Ok(())
    }
}
