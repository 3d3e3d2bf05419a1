//! Chapter 4: a transmitter with a parity bit.

use crate::uart::ticks::{BitTicks, BitTicksIn};
use tilewright_hdl::*;

codes! {
    /// What is on the line.
    pub enum Part {
        /// Nothing.
        Idle,
        /// The start bit.
        Start,
        /// A bit of the byte.
        Data,
        /// The bit that makes the number of ones even.
        Parity,
        /// The stop bit.
        Stop,
    }
}

block! {
    /// Sends bytes with a parity bit behind them.
    pub struct ParityTransmitter {
        /// How long a bit is.
        pub clocks_per_bit: u32,
    }
    in ParityTransmitterIn { send: bit(), data: bits(8) }
    out ParityTransmitterOut { line: bit(), busy: bit() }
}

impl ParityTransmitter {
    fn build(&self, m: Module, i: ParityTransmitterIn) -> ParityTransmitterOut {
        let ticks = BitTicks { clocks_per_bit: self.clocks_per_bit };
        def!(part = m.fsm(Part::Idle));
        def!(busy = !part.is(Part::Idle));
        def!(ticks = m.instance(&ticks, BitTicksIn { run: busy }));

        def!(place = m.reg(below(8)).reset(0));
        def!(next_bit = part.is(Part::Data) & ticks.last);
        let moves = part.next(|part| match part {
            Part::Idle => when(i.send, Part::Start),
            Part::Start => when(ticks.last, Part::Data),
            Part::Data => when(next_bit & place.eq(7), Part::Parity),
            Part::Parity => when(ticks.last, Part::Stop),
            Part::Stop => when(ticks.last, Part::Idle),
        });
        place.when(next_bit, place + 1);
        def!(rest = m.reg(8));
        rest.when(moves.leaves(Part::Idle), i.data).when(next_bit, rest >> 1);
        def!(odd = m.reg(bit()).when(moves.leaves(Part::Idle), i.data.parity()));

        def!(line = m.reg(bit()).reset(1));
        line.next(choose!(part, Part {
            Idle | Stop => 1,
            Start => 0,
            Data => rest.bit(0),
            Parity => odd,
        }));
        ParityTransmitterOut { line: *line, busy }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::Simulation;

    #[test]
    fn the_number_of_ones_is_even() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&ParityTransmitter { clocks_per_bit: 3 })?;
        for data in 0..256 {
            sim.drive(ParityTransmitterIn { send: 1, data });
            sim.step();
            sim.drive(ParityTransmitterIn { send: 0, data: 0 });
            let mut seen = 0;
            for place in 0..11 {
                sim.run(2);
                seen |= sim.get_u64(sim.o.line) << place;
                sim.step();
            }
            let parity = u64::from(data.count_ones() % 2);
            assert_eq!(seen, 1 << 10 | parity << 9 | data << 1);
        }
        Ok(())
    }
}
