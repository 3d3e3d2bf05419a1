//! Chapter 6: the transmitter behind a stream.

use super::transmitter::{Transmitter, TransmitterIn};
use tilewright_hdl::*;

block! {
    /// Sends the bytes of a stream.
    pub struct Sender {
        /// How long a bit is.
        pub clocks_per_bit: u32,
    }
    in SenderIn {
        /// What goes out.
        bytes: stream(bits(8)),
    }
    out SenderOut {
        /// The line.
        line: bit(),
    }
}

impl Sender {
    fn build(&self, m: Module, i: SenderIn) -> SenderOut {
        let transmitter = Transmitter { clocks_per_bit: self.clocks_per_bit };
        def!(busy = m.wire(bit()));
        let byte = i.bytes.take_when(!busy);
        def!(transmitter = m.instance(&transmitter, TransmitterIn { send: byte.taken, data: *byte }));
        busy.drive(transmitter.busy);
        SenderOut { line: transmitter.line }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::uart::far_end;
    use tilewright_sim::{Pauses, Simulation};

    #[test]
    fn bytes_go_out_whenever_they_come() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Sender { clocks_per_bit: 4 })?.seeded(1);
        sim.reset();
        let (i, o) = (sim.i, sim.o);
        let t = &sim.testbench();
        let listens = async {
            for byte in *b"abc" {
                assert_eq!(far_end::receives(t, o.line, 4).await, byte);
            }
        };
        t.run((t.send_all(i.bytes, *b"abc", Pauses::percent(90, 1)), listens));
        Ok(())
    }
}
