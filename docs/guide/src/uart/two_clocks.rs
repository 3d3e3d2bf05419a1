//! Chapter 9: an echo whose line has a clock of its own.

use super::queue::Received;
use super::receiver::{Receiver, ReceiverIn};
use super::sender::{Sender, SenderIn};
use crate::solutions::shout::{Shout, ShoutIn};
use tilewright_blocks::StreamBlocks;
use tilewright_hdl::*;

/// The clock of the line: 12 MHz, nearly.
pub const LINE: Clock = Clock::new("line", Period::ps(83_334));
/// The clock of everything else: 50 MHz.
pub const SYSTEM: Clock = Clock::new("system", Period::ns(20));

block! {
    /// Sends bytes back as capitals, which another clock makes of them.
    pub struct ShoutingEcho {
        /// How long a bit is, in clocks of the line.
        pub clocks_per_bit: u32,
    }
    in ShoutingEchoIn {
        /// The line from the other side.
        rx: bit().on(LINE),
    }
    out ShoutingEchoOut {
        /// The line to the other side.
        tx: bit(),
        /// A byte was lost since the reset, on the system's clock.
        lost: bit(),
    }
}

impl ShoutingEcho {
    fn build(&self, m: Module, i: ShoutingEchoIn) -> ShoutingEchoOut {
        let ShoutingEcho { clocks_per_bit } = *self;
        let (line, system) = (m.on(LINE), m.on(SYSTEM));

        def!(receiver = line.instance(&Receiver { clocks_per_bit }, ReceiverIn { rx: i.rx }));
        let received = m.cross_by_fifo("u_in", 4, (LINE, SYSTEM), receiver.bytes);
        let Received { data, .. } = *received;
        def!(shout = system.instance(&Shout, ShoutIn { bytes: received.with(data) }));
        let bytes = m.cross_by_fifo("u_out", 4, (SYSTEM, LINE), shout.shouted);
        def!(sender = line.instance(&Sender { clocks_per_bit }, SenderIn { bytes }));

        let overrun = line.reg("overrun", bit()).reset(0).when(receiver.overrun, 1);
        let lost = system.synchronize("lost_seen", *overrun);
        ShoutingEchoOut { tx: sender.line, lost }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::uart::far_end;
    use tilewright_sim::Simulation;

    #[test]
    fn capitals_come_back() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&ShoutingEcho { clocks_per_bit: 13 })?.seeded(1);
        sim.set(sim.i.rx, 1);
        sim.reset();
        let (i, o) = (sim.i, sim.o);
        let t = &sim.testbench();
        let line = &t.on("line");
        let talks = async {
            for byte in *b"two clocks" {
                far_end::sends(line, i.rx, byte, 13).await;
            }
        };
        let listens = async {
            for byte in *b"TWO CLOCKS" {
                assert_eq!(far_end::receives(line, o.tx, 13).await, byte);
            }
        };
        t.run((talks, listens));
        assert_eq!(sim.get(sim.o.lost), 0);
        Ok(())
    }
}
