//! The player: sends the stored packets of a step to the machine, in place of its geometry processor.

use tilewright_hdl::{Bits, Module, below, bit, bits, block, cat, def, up_to};
use tilewright_rtl::quadtree::format::{Format, Packet};

use super::store::Store;

block! {
    /// Sends the packets of one step after another, and begins with the first one again after the last.
    ///
    /// ```text
    ///        .-------.  words   .---------------.
    /// go --->| store |=========>| parts of one  |====> packets
    ///        '-------'          | packet        |
    ///                           '---------------'
    /// ```
    ///
    /// A packet takes a clock for each of its words, and one more.
    pub struct Player {
        /// The machine's format.
        pub format: Format,
        /// The packets.
        pub store: Store,
    }
    in PlayerIn {
        /// High for one clock to send the packets of the next step; only if the previous ones are sent.
        go: bit(),
    }
    out(self) PlayerOut {
        /// The packets.
        packets: stream(Packet::widths(self.format)),
        /// All packets of the step are sent.
        done: bit(),
    }
}

impl Player {
    fn build(&self, m: Module, i: PlayerIn) -> PlayerOut {
        let (store, parts) = (&self.store, self.store.words_of_packet());
        let words = m.rom("words", bits(store.word()), store.words().iter().map(Bits::clone));
        let count = store.words().len() as u32;

        def!(loads = m.reg(bit()).reset(0));
        def!(offers = m.reg(bit()).reset(0));
        def!(part = m.reg(up_to(parts)).reset(0));
        def!(at = m.reg(below(count)).reset(0));
        def!(reads = loads & part.ne(parts));
        def!(word = words.read_when(reads, *at));
        at.when(reads & at.eq(count - 1), 0).when(reads, at + 1);
        def!(arrives = m.reg(bit()).reset(0));
        arrives.next(reads);
        def!(packet = m.reg(bits(parts * store.word())));
        packet.when(arrives, cat![word, packet].slice(store.word()..(parts + 1) * store.word()));

        let (fields, is_last) = store.packet(*packet);
        let (packets, sent) = m.offer(offers, fields);
        def!(is_loaded = loads & part.eq(parts));
        def!(ends = sent & is_last);
        m.assume(i.go.implies(!loads & !offers), "a step begins when the previous one is sent");
        loads.when(i.go | (sent & !is_last), 1).when(is_loaded, 0);
        part.when(i.go | sent, 0).when(reads, part + 1);
        offers.when(is_loaded, 1).when(sent, 0);
        def!(done = m.reg(bit()).reset(1));
        done.when(i.go, 0).when(ends, 1);
        PlayerOut { packets, done: *done }
    }
}
