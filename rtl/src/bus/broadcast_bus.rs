//! The broadcast bus: carries packets from the host, or from any processor, to all processors (VC1-NET, VC1-APR).
//!
//! ```text
//! senders.0 ========>.-------.                          .--[ queue ]====> received.0
//! senders.1 ========>| round |                          |
//!    ..              | robin |====>[ word, 6 clocks ]===+--[ queue ]====> received.1
//! senders.n-1 ======>|       |            ^             |     ..
//! senders.n, host ==>'-------'            |             '--[ queue ]====> received.n-1
//!                                         '--- room in all of them
//! ```
//!
//! # Protocol
//!
//! A packet is a sequence of words from one sender; `last` ends it. The bus serves the senders round robin, one packet
//! at a time, starting after the sender it served last. So a packet waits for at most n others. While a sender pauses
//! within its packet, the bus waits for it.
//!
//! A word occupies the bus for `word_clocks` clocks. It then enters the receive queues of all processors at once,
//! including the sender's own. If a queue is full, the word stays on the bus, so the slowest processor sets the pace of
//! all. A processor must receive while it sends: its own full queue would block its own packet.
//!
//! # Latency and throughput
//!
//! A word taken from its sender in clock 0 appears at the processors in clock `word_clocks + 1`. The bus takes the next
//! word, of the same packet or another, in clock `word_clocks`. With 6 clocks of 25 ns the bus carries 26.7 Mbyte/s.
//!
//! # Detecting that everything has arrived
//!
//! A word that has left its sender is either on the bus, where `idle` is low, or in a queue, where `empty` is low.
//! There is no clock between the two. So when `idle` and a processor's `empty` are both high, that processor has
//! received every packet sent. Words that senders still offer do not count; each sender knows about its own.

use tilewright_blocks::{Fifo, Storage, StreamIn};

use crate::prelude::*;

record! {
    /// A word of a packet.
    pub struct BusWord {
        /// A word of the packet.
        word: bits(32),
        /// The word is the last of its packet.
        last: bit(),
    }
}

block! {
    /// Carries packets from the host or any processor to all processors, word by word.
    pub struct BroadcastBus {
        /// The number of processors.
        pub processors: u32,
        /// The capacity of each receive queue, in words.
        pub queue: u32,
        /// The number of clocks that a word occupies the bus.
        pub word_clocks: u32,
    }
    ranges {
        processors: 1..=256,
        queue: 2..,
        word_clocks: 1..,
    }
    latency(self) = format!("a word every {} clocks, shown 1 clock later", self.word_clocks);
    source = "VC-1, section 3.1, broadcast bus (VC1-NET, VC1-APR)";
    in(self) BroadcastBusIn {
        /// The packets of each processor, then those of the host.
        senders: [stream(BusWord); self.processors + 1],
    }
    out(self) BroadcastBusOut {
        /// All packets, for each processor.
        received: [stream(BusWord); self.processors],
        /// No word is on the bus, and every packet that has begun is complete.
        idle: bit(),
        /// The processors that have taken all words that left the bus.
        empty: bit().of(row(self.processors)),
    }
}

impl BroadcastBus {
    /// The capacity of a VC-1 receive queue in words. The paper does not give it; this is our choice.
    pub const QUEUE: u32 = 64;
    /// The processor clocks that a word takes in the VC-1: 26.7 of 27 Mbyte/s (VC1-NET).
    pub const WORD_CLOCKS: u32 = 6;

    /// The bus of a VC-1 with `processors` processors.
    pub fn vc1(processors: u32) -> BroadcastBus {
        BroadcastBus { processors, queue: BroadcastBus::QUEUE, word_clocks: BroadcastBus::WORD_CLOCKS }
    }

    fn build(&self, m: Module, i: BroadcastBusIn) -> BroadcastBusOut {
        let BroadcastBus { processors, queue, word_clocks } = *self;
        let senders = processors + 1;
        def!(number = constants(below(senders).of(row(senders)), |sender| sender));

        // The sender to serve: within a packet its sender, otherwise the next sender after the last one.
        let offered = stack(i.senders);
        def!(open = m.reg(bit()).reset(0));
        def!(sender = m.reg(below(senders)).reset(processors));
        def!(requests = offered.valid & (!open | number.eq(*sender)));
        def!(rank = cat![!requests, number.le(*sender), number]);
        def!(next = rank.minimum().trunc(below(senders)));
        def!(on_bus = m.reg(bit()).reset(0));
        def!(delivers = m.wire(bit()));
        def!(free = !on_bus | *delivers);
        def!(takes = free & requests.or_all());
        let taken = offered.take_when(requests & number.eq(next) & free);
        let next_word = taken.payload.map(|field| field.pick(next));
        sender.when(takes, next);
        open.when(takes, !next_word.last);

        // The bus: a word stays here from the edge at which it is taken to the edge at which it enters the queues.
        def!(word = m.pipe_when(takes, next_word));
        on_bus.when(takes, 1).when(*delivers, 0);
        def!(clocks_left = m.reg(below(word_clocks)));
        clocks_left.when(takes, word_clocks - 1).when(clocks_left.ne(0), clocks_left - 1);
        def!(arrived = on_bus & clocks_left.eq(0));

        // The queues: all get the same words, and each processor empties its own at its own pace.
        let each = row(processors);
        let (copies, entered) = m.offer(delivers.of(each), cat![word.word, word.last].of(each));
        def!(room = copies.ready.and_all());
        delivers.drive(arrived & room);
        let fifo = Fifo::new(queue, copies.width(), Storage::Registers);
        let queues = m.array("u_queue", processors, &fifo, |_| StreamIn { into: copies }).out;
        def!(empty = !queues.valid);
        def!(leaves = queues.valid & queues.ready);
        let received = queues.lanes().iter().map(|queue| queue.unpacked(&word)).collect();

        // No word is lost, duplicated or changed: a word taken and not yet received is on the bus or in the queue.
        // These counters serve the assertions alone.
        let stays = on_bus & m.stable(word.word) & m.stable(word.last);
        m.assert(m.past(on_bus & !delivers).implies(stays), "a word stays on the bus until it goes to the queues");
        m.assert(entered.and_all().eq(entered.or_all()), "a word goes to all queues or to none");
        let count = up_to(queue + 1);
        def!(sent = m.reg(count).reset(0));
        sent.next(sent + taken.taken.zext(count).sum());
        def!(seen = m.reg(count.of(each)).reset(0));
        seen.when(leaves, seen + 1);
        def!(queued = sent - seen - on_bus.zext(count));
        m.assert(queued.le(queue), "the words taken and not yet received fit in the queue");
        m.assert(empty.eq(queued.eq(0)), "a processor whose queue is empty has received all that left the bus");

        // No word interrupts another packet, and every packet is served.
        m.assert((taken.taken & *open).implies(number.eq(*sender)), "no word comes between those of another packet");
        m.assert(m.past(takes).implies(open.eq(!word.last)), "a packet is open until its last word");
        def!(others = m.reg(up_to(senders).of(row(senders))).reset(0));
        others.when(!offered.valid | taken.taken, 0).when(offered.valid & takes & !open, others + 1);
        m.assert(others.le(processors), "a packet waits for at most one packet of each other sender");

        m.cover("a full queue stalls the bus", arrived & !room);
        m.cover("a sender pauses within its packet", *open & free & !takes);
        m.cover("a sender waits for the packet of another", (offered.valid & *open & number.ne(*sender)).or_all());
        m.cover("all senders wait", !open & !free & offered.valid.and_all());
        m.cover("a packet follows another without a pause", *delivers & takes & !open);
        BroadcastBusOut { received, idle: !on_bus & !open, empty }
    }
}

#[cfg(test)]
mod tests;
