//! Chapter 6: bits on a line as a stream of bytes.

use super::queue::Received;
use super::ticks::{BitTicks, BitTicksIn};
use super::transmitter::Phase;
use tilewright_hdl::*;

block! {
    /// Receives bytes. It looks at the line in the middle of each bit, which it counts from the edge that begins the start bit.
    pub struct Receiver {
        /// How long a bit is.
        pub clocks_per_bit: u32,
    }
    ranges {
        /// The line is seen two clocks late.
        clocks_per_bit: 4..,
    }
    latency = "3 clocks from the middle of the stop bit";
    in ReceiverIn {
        /// The line, which knows nothing of the clock.
        rx: bit(),
    }
    out ReceiverOut {
        /// What comes in.
        bytes: stream(Received),
        /// A byte is lost, as the one before has not been taken.
        overrun: bit(),
    }
}

impl Receiver {
    fn build(&self, m: Module, i: ReceiverIn) -> ReceiverOut {
        let Receiver { clocks_per_bit } = *self;
        def!(line = m.synchronize_from(true, i.rx));
        def!(phase = m.fsm(Phase::Idle));
        def!(ticks = m.instance(&BitTicks { clocks_per_bit }, BitTicksIn { run: !phase.is(Phase::Idle) }));
        def!(place = m.reg(below(8)).reset(0));
        let moves = phase.next(|phase| match phase {
            Phase::Idle => when(!line, Phase::Start),
            // A start bit whose middle is high is none.
            Phase::Start => when(ticks.middle & line, Phase::Idle).or_when(ticks.last, Phase::Data),
            Phase::Data => when(ticks.last & place.eq(7), Phase::Stop),
            Phase::Stop => when(ticks.middle, Phase::Idle),
        });
        place.when(phase.is(Phase::Data) & ticks.last, place + 1);
        def!(data = m.reg(8));
        data.when(phase.is(Phase::Data) & ticks.middle, cat![line, data.slice(1..8)]);

        def!(full = m.reg(bit()).reset(0));
        def!(held = m.reg(Received::widths()));
        let (bytes, sent) = m.offer(full, *held);
        def!(ends = moves.leaves(Phase::Stop));
        def!(overrun = ends & full & !sent);
        held.when(ends & !overrun, Received { data: *data, broken: !line });
        full.when(ends, 1).when(sent, 0);
        ReceiverOut { bytes, overrun }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::uart::far_end;
    use tilewright_sim::{Simulation, monitor};

    #[test]
    fn a_byte_comes_in_bit_by_bit() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Receiver { clocks_per_bit: 4 })?;
        sim.set(sim.i.rx, 1);
        sim.run(2);
        let wave =
            sim.record(["rx", "phase", "u_ticks.middle", "data", "bytes_valid", "bytes_data"]).cycles("clk", 31..44);
        let (i, o) = (sim.i, sim.o);
        let t = &sim.testbench();
        let (received, ()) = t.run((t.receive(o.bytes), far_end::sends(t, i.rx, 0x53, 4)));
        assert_eq!(received, Received { data: 0x53, broken: 0 });
        wave.expect(r"
            clk            |~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/
            rx             |~~~~~~~~~~~~~~~~~~~~\___________________________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
            phase          | Data                                                                | Stop        | Idle |
            u_ticks.middle |____________________/~~~~~~\____________________/~~~~~~\____________________/~~~~~~\_______
            data           | 4c                        | a6                        | 53                               |
            bytes_valid    |___________________________________________________________________________________/~~~~~~~
            bytes_data     | 0                                                                                 | 53   |");
        Ok(())
    }

    #[test]
    fn what_is_wrong_on_the_line_is_seen() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Receiver { clocks_per_bit: 8 })?;
        sim.set(sim.i.rx, 1);
        sim.reset();
        let (i, o) = (sim.i, sim.o);
        let t = &sim.testbench();
        let mut overruns = 0;
        let far_end_talks = async {
            // A glitch is no start bit.
            t.set(i.rx, 0);
            t.wait(2).await;
            t.set(i.rx, 1);
            t.wait(30).await;
            // Nobody takes the first byte in time, so the second is lost.
            far_end::sends(t, i.rx, 0x33, 8).await;
            far_end::sends(t, i.rx, 0x44, 8).await;
            assert_eq!(t.receive(o.bytes).await, Received { data: 0x33, broken: 0 });
            // No stop bit: the line is low for ten bits.
            t.set(i.rx, 0);
            t.wait(80).await;
            t.set(i.rx, 1);
            assert_eq!(t.receive(o.bytes).await, Received { data: 0, broken: 1 });
        };
        let counts = async {
            loop {
                t.step().await;
                overruns += t.get_u64(o.overrun);
            }
        };
        t.run((far_end_talks, monitor(counts)));
        assert_eq!(overruns, 1);
        Ok(())
    }
}
