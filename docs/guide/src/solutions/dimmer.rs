//! Chapter 1: a lamp that is dimmed by how long it is on.

use tilewright_hdl::*;

block! {
    /// A lamp that is on for `level` clocks of every 16.
    pub struct Dimmer;
    in DimmerIn {
        /// How bright: 0 is dark.
        level: bits(4),
    }
    out DimmerOut {
        /// The lamp.
        lamp: bit(),
    }
}

impl Dimmer {
    fn build(&self, m: Module, i: DimmerIn) -> DimmerOut {
        def!(count = m.reg(4).reset(0));
        count.next(count + 1);
        DimmerOut { lamp: count.lt(i.level) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::Simulation;

    #[test]
    fn it_is_on_for_as_many_clocks_as_its_level() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Dimmer)?;
        for level in 0..16 {
            sim.set(sim.i.level, level);
            let mut on = 0;
            for _ in 0..16 {
                on += sim.get_u64(sim.o.lamp);
                sim.step();
            }
            assert_eq!(on, level);
        }
        Ok(())
    }
}
