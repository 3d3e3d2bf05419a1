//! Chapter 10: what holds of the queue and of the line, whatever comes in.

use super::queue::{ByteQueue, ByteQueueIn, Received};
use super::receiver::{Receiver, ReceiverIn};
use super::transmitter::{Transmitter, TransmitterIn};
use tilewright_hdl::*;

bundle! {
    /// What is done with a queue.
    pub struct QueueIn<T> {
        /// Puts `byte_in` into the queue.
        pub push: T,
        /// The byte.
        pub byte_in: Received<T>,
        /// Removes the oldest byte.
        pub pop: T,
    }
}

impl QueueIn<Width> {
    /// How wide they are.
    pub fn widths() -> QueueIn<Width> {
        QueueIn { push: bit(), byte_in: Received::widths(), pop: bit() }
    }
}

block! {
    /// A queue, and what is stated of its numbers.
    pub struct QueueCounts {
        /// How many bytes there is room for.
        pub depth: u32,
    }
    in QueueCountsIn {
        /// What is done with it.
        of: QueueIn = QueueIn::widths(),
    }
    out(self) QueueCountsOut {
        /// How many bytes there are.
        used: up_to(self.depth),
    }
}

impl QueueCounts {
    fn build(&self, m: Module, i: QueueCountsIn) -> QueueCountsOut {
        let QueueIn { push, byte_in, pop } = i.of;
        def!(queue = m.instance(&ByteQueue { depth: self.depth }, ByteQueueIn { push, byte_in, pop }));
        m.ignore(&queue.oldest);
        let used = queue.used;
        m.assert(used.le(self.depth), "there are no more bytes than there is room for");
        m.assert(queue.empty.eq(used.eq(0)), "it is empty when there is no byte");
        m.assert(queue.full.eq(used.eq(self.depth)), "it is full when there is no room");
        def!(grows = push & !queue.full & !(pop & !queue.empty));
        m.assert(m.past(grows).implies(used.eq(m.past(used) + 1)), "a push adds one byte");
        m.cover("it is full", queue.full);
        QueueCountsOut { used }
    }
}

block! {
    /// A queue of which one byte, picked at any time, comes out as it went in.
    pub struct QueueKeeps {
        /// How many bytes there is room for.
        pub depth: u32,
    }
    in QueueKeepsIn {
        /// What is done with it.
        of: QueueIn = QueueIn::widths(),
        /// Picks the byte that is pushed in this clock.
        pick: bit(),
    }
    out QueueKeepsOut {
        /// The picked byte is in the queue.
        waits: bit(),
    }
}

impl QueueKeeps {
    fn build(&self, m: Module, i: QueueKeepsIn) -> QueueKeepsOut {
        let QueueIn { push, byte_in, pop } = i.of;
        def!(queue = m.instance(&ByteQueue { depth: self.depth }, ByteQueueIn { push, byte_in, pop }));
        def!(pops = pop & !queue.empty);
        def!(waits = m.reg(bit()).reset(0));
        def!(picked = m.reg(Received::widths()));
        def!(before = m.reg(up_to(self.depth))); // bytes that come out before it
        def!(picks = i.pick & push & !queue.full & !waits);
        def!(leaves = waits & pops & before.eq(0));
        waits.when(picks, 1).when(leaves, 0);
        picked.when(picks, byte_in);
        before.when(picks, queue.used - pops.zext(before.width())).when(pops, before - 1);
        m.assert(leaves.implies(queue.oldest.pack().eq(picked.pack())), "a byte comes out as it went in");
        m.cover("a byte waits behind others", leaves & m.past(pops));
        QueueKeepsOut { waits: *waits }
    }
}

block! {
    /// A transmitter and a receiver on one line.
    pub struct Loopback {
        /// How long a bit is.
        pub clocks_per_bit: u32,
    }
    in LoopbackIn {
        /// Sends `data`.
        send: bit(),
        /// The byte.
        data: bits(8),
    }
    out LoopbackOut {
        /// A byte has been received.
        received: bit(),
    }
}

impl Loopback {
    fn build(&self, m: Module, i: LoopbackIn) -> LoopbackOut {
        let Loopback { clocks_per_bit } = *self;
        let inputs = TransmitterIn { send: i.send, data: i.data };
        def!(transmitter = m.instance(&Transmitter { clocks_per_bit }, inputs));
        def!(receiver = m.instance(&Receiver { clocks_per_bit }, ReceiverIn { rx: transmitter.line }));
        let byte = receiver.bytes.take_when(1);

        // The next byte may begin before the one before it has come out of the receiver.
        def!(sends = i.send & !transmitter.busy);
        def!(sent = m.reg(8));
        sent.when(sends, i.data);
        def!(earlier = m.reg(8).when(sends, *sent));
        def!(on_the_way = m.reg(up_to(2)).reset(0));
        on_the_way.when(sends & !byte.taken, on_the_way + 1).when(byte.taken & !sends, on_the_way - 1);
        def!(expected = mux(on_the_way.eq(2), earlier, sent));
        m.assert(byte.taken.implies(byte.data.eq(expected)), "what is received is what was sent");
        m.assert(byte.taken.implies(on_the_way.ne(0)), "nothing is received that was not sent");
        m.assert(byte.taken.implies(!byte.broken), "the stop bit is there");
        m.assert(!receiver.overrun, "nothing is lost");
        m.cover("a byte is received", byte.taken);
        LoopbackOut { received: byte.taken }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::Simulation;

    #[test]
    fn a_simulation_checks_it_too() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&QueueKeeps { depth: 4 })?.seeded(1);
        for clock in 0..1000u64 {
            let (push, pop) = (u64::from(clock * 7 % 5 > 1), u64::from(clock * 11 % 17 > clock / 64));
            let byte_in = Received { data: clock % 251, broken: clock % 3 / 2 };
            sim.drive(QueueKeepsIn { of: QueueIn { push, byte_in, pop }, pick: u64::from(clock % 13 == 0) });
            sim.step();
        }
        assert!(sim.covered("a byte waits behind others")? > 0);

        let mut sim = Simulation::of(&Loopback { clocks_per_bit: 4 })?.seeded(1);
        for data in 0..20 {
            sim.drive(LoopbackIn { send: 1, data: data * 13 });
            sim.run(41);
        }
        assert_eq!(sim.covered("a byte is received")?, 19);
        Ok(())
    }
}
