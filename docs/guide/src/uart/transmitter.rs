//! Chapter 4: a byte as bits on a line.

use super::ticks::{BitTicks, BitTicksIn};
use tilewright_hdl::*;

codes! {
    /// What is on the line.
    pub enum Phase {
        /// Nothing.
        Idle,
        /// The start bit.
        Start,
        /// A bit of the byte.
        Data,
        /// The stop bit.
        Stop,
    }
}

block! {
    /// Sends a byte: a start bit, which is low, eight data bits, the least significant first, and a stop bit, which is high.
    pub struct Transmitter {
        /// How long a bit is.
        pub clocks_per_bit: u32,
    }
    in TransmitterIn {
        /// Sends `data`, unless another one is being sent.
        send: bit(),
        /// The byte.
        data: bits(8),
    }
    out TransmitterOut {
        /// The line; high while nothing is sent.
        line: bit(),
        /// A byte is being sent.
        busy: bit(),
    }
}

impl Transmitter {
    fn build(&self, m: Module, i: TransmitterIn) -> TransmitterOut {
        let Transmitter { clocks_per_bit } = *self;
        def!(phase = m.fsm(Phase::Idle));
        def!(busy = !phase.is(Phase::Idle));
        def!(ticks = m.instance(&BitTicks { clocks_per_bit }, BitTicksIn { run: busy }));

        def!(place = m.reg(below(8)).reset(0));
        def!(next_bit = phase.is(Phase::Data) & ticks.last);
        let moves = phase.next(|phase| match phase {
            Phase::Idle => when(i.send, Phase::Start),
            Phase::Start => when(ticks.last, Phase::Data),
            Phase::Data => when(next_bit & place.eq(7), Phase::Stop),
            Phase::Stop => when(ticks.last, Phase::Idle),
        });
        place.when(next_bit, place + 1);
        def!(rest = m.reg(8));
        rest.when(moves.leaves(Phase::Idle), i.data).when(next_bit, rest >> 1);

        def!(line = m.reg(bit()).reset(1));
        line.next(choose!(phase, Phase {
            Idle | Stop => 1,
            Start => 0,
            Data => rest.bit(0),
        }));
        TransmitterOut { line: *line, busy }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::Simulation;

    #[test]
    fn a_byte_goes_out_bit_by_bit() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Transmitter { clocks_per_bit: 2 })?;
        let wave = sim.record(["send", "phase", "place", "line"]);
        sim.drive(TransmitterIn { send: 1, data: 0x53 });
        sim.step();
        sim.drive(TransmitterIn { send: 0, data: 0 });
        sim.run(21);
        wave.expect(
            r"
            clk   |______/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/
            send  |~~~~~~\___________________________________________________________________________________________
            phase | Idle | Start       | Data                                                                       |
            place | 0                                | 1           | 2           | 3           | 4           | 5    |
            line  |~~~~~~~~~~~~~\_____________/~~~~~~~~~~~~~~~~~~~~~~~~~~~\___________________________/~~~~~~~~~~~~~~

            clk   |~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/
            send  |________________________________________________________
            phase | Data                             | Stop        | Idle |
            place | 5    | 6           | 7           | 0                  |
            line  |_____________/~~~~~~~~~~~~~\_____________/~~~~~~~~~~~~~~",
        );
        Ok(())
    }

    #[test]
    fn every_byte_comes_out_as_it_went_in() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Transmitter { clocks_per_bit: 3 })?;
        for data in 0..256 {
            sim.drive(TransmitterIn { send: 1, data });
            sim.step();
            sim.drive(TransmitterIn { send: 0, data: 0 });
            let mut seen = 0;
            for place in 0..10 {
                sim.run(2); // the second clock of the bit
                seen |= sim.get_u64(sim.o.line) << place;
                sim.step();
            }
            assert_eq!(seen, 1 << 9 | data << 1, "start bit, byte and stop bit");
        }
        Ok(())
    }
}
