//! Gives out the stored triangles: it reads a frame's packets from block RAM, and each goes to its processor.
//!
//! ```text
//!            .-----.  words   .-----------.
//! address -->| ROM |=========>| 29 words  |==> packet, valid for one processor
//!            '-----'          '-----------'
//! ```
//!
//! Latency: a packet takes 30 clocks to read, and waits until its processor is free.

use super::format::{LAST, PROCESSOR, WORD_BITS, WORDS};
use super::scene::Turning;
use tilewright_hdl::{
    Module, ReadUnderWrite, Reg, Signal, bit, bits, block, codes, constants, def, index_width, mux, row, up_to, when,
};

codes! {
    /// The parts of a frame.
    enum Part { Idle, Read, Give, Given }
}

block! {
    /// Reads the packets of a frame and gives them to the processors.
    pub struct Dispatcher {
        /// The stored scene.
        pub scene: Turning,
        /// The number of processors.
        pub processors: u32,
    }
    ranges { processors: 1..=8 }
    latency = "30 clocks to read a packet";
    in(self) DispatcherIn {
        /// All processors may draw.
        begins: bit(),
        /// All have drawn the frame.
        ends: bit(),
        /// For each processor: it takes a packet.
        free: bit().of(row(self.processors)),
    }
    out(self) DispatcherOut {
        /// For each processor: there is a packet.
        valid: bit().of(row(self.processors)),
        /// The words of the packet.
        words: [bits(WORD_BITS); WORDS],
        /// All packets of the frame have been given out.
        given: bit(),
    }
}

impl Dispatcher {
    fn build(&self, m: Module, i: DispatcherIn) -> DispatcherOut {
        use Part::*;
        let stored = self.scene.words();
        let depth = stored.len() as u32;
        def!(packets = m.memory(depth, WORD_BITS, ReadUnderWrite::Any).words(stored.iter().copied()));
        def!(address = m.reg(index_width(depth.into())).reset(0));

        def!(part = m.fsm(Idle));
        def!(read = m.reg(up_to(WORDS)).reset(0));
        def!(reads = part.is(Read) & read.ne(WORDS));
        def!(all_read = part.is(Read) & read.eq(WORDS));
        read.when(all_read, 0).when(reads, read + 1);
        address.when(reads, mux(address.eq(depth - 1), 0, address + 1));
        let word = packets.read_when(reads, *address);

        // A word arrives one clock after its address, and moves all others up.
        def!(arrives = m.reg(bit()).reset(0));
        arrives.next(reads);
        let kept: Vec<Reg> = (0..WORDS).map(|place| m.reg(&format!("word{place}"), bits(WORD_BITS))).collect();
        let words: Vec<Signal> = kept.iter().map(|word| **word).collect();
        for (place, kept) in kept.iter().enumerate() {
            kept.when(*arrives, words.get(place + 1).copied().unwrap_or(word));
        }
        def!(numbers = constants(bits(3).of(row(self.processors)), |lane| lane));
        def!(chosen = numbers.eq(PROCESSOR.of(&words)));
        def!(valid = chosen & part.is(Give));
        def!(taken = (valid & i.free).or_all());
        def!(last_taken = taken & LAST.of(&words));
        part.next(|part| match part {
            Idle => when(i.begins, Read),
            Read => when(all_read, Give),
            Give => when(last_taken, Given).or_when(taken, Read),
            Given => when(i.ends, Idle),
        });
        m.assert(part.is(Give).implies(chosen.or_all()), "a packet is for a processor that exists");
        DispatcherOut { valid, words, given: part.is(Given) }
    }
}
