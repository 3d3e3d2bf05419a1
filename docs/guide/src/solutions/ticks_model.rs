//! Chapter 2: the ticks beside a model, for every short bit.

#[cfg(test)]
mod tests {
    use crate::uart::ticks::BitTicks;
    use tilewright_sim::Simulation;

    #[test]
    fn the_ticks_are_those_of_a_model() -> Result<(), tilewright_sim::Error> {
        for clocks_per_bit in 2..=9 {
            let mut sim = Simulation::of(&BitTicks { clocks_per_bit })?;
            let (mut clock, most) = (0, clocks_per_bit - 1);
            for number in 0..200 {
                let run = number % 31 > 4;
                sim.set(sim.i.run, run);
                let expected = [run && clock == most / 2, run && clock == most];
                assert_eq!([sim.o.middle, sim.o.last].map(|port| sim.get_u64(port) == 1), expected);
                clock = if !run || clock == most { 0 } else { clock + 1 };
                sim.step();
            }
        }
        Ok(())
    }
}
