//! Chapter 6: what comes in goes out again.

use super::receiver::{Receiver, ReceiverIn};
use super::sender::{Sender, SenderIn};
use tilewright_blocks::StreamBlocks;
use tilewright_hdl::*;

block! {
    /// Sends each byte back that it receives.
    pub struct Echo {
        /// How long a bit is.
        pub clocks_per_bit: u32,
        /// How many bytes may wait.
        pub depth: u32,
    }
    in EchoIn {
        /// The line from the other side.
        rx: bit(),
    }
    out EchoOut {
        /// The line to the other side.
        tx: bit(),
        /// A byte is lost.
        overrun: bit(),
    }
}

impl Echo {
    fn build(&self, m: Module, i: EchoIn) -> EchoOut {
        let Echo { clocks_per_bit, depth } = *self;
        def!(receiver = m.instance(&Receiver { clocks_per_bit }, ReceiverIn { rx: i.rx }));
        let queued = m.fifo("u_queue", depth, receiver.bytes);
        let bytes = queued.with(queued.data);
        def!(sender = m.instance(&Sender { clocks_per_bit }, SenderIn { bytes }));
        EchoOut { tx: sender.line, overrun: receiver.overrun }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::uart::far_end;
    use tilewright_sim::{Simulation, monitor};

    #[test]
    fn what_goes_in_comes_out() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Echo { clocks_per_bit: 16, depth: 4 })?.seeded(1);
        sim.set(sim.i.rx, 1);
        sim.reset();
        let (i, o) = (sim.i, sim.o);
        let t = &sim.testbench();
        let text = *b"Tilewright";
        let talks = async {
            for byte in text {
                far_end::sends(t, i.rx, byte, 16).await;
            }
        };
        let listens = async {
            for byte in text {
                assert_eq!(far_end::receives(t, o.tx, 16).await, byte);
            }
        };
        let nothing_is_lost = async {
            loop {
                t.step().await;
                assert_eq!(t.get_u64(o.overrun), 0, "at {} ps", t.time());
            }
        };
        t.run((talks, listens, monitor(nothing_is_lost)));
        Ok(())
    }
}
