//! The network sequencer: decides what a node does with each word that passes, and which byte of which bank it uses
//! (PFL-NET, PFL-SETUP, facts E4).
//!
//! ```text
//! jobs ==>[ mode, bank, bytes ]---> mode, bank, address, first
//!              |       ^
//!              v       | has the array given the bank?
//!         set-up, ready ---> all nodes ---> go ---> sends, for the node that loads
//!                                                     |
//! pixel, advances ------------------------------------'---> the last byte of the last pixel: done
//! ```
//!
//! A job is one word of each pixel of a region. The most significant byte of all pixels is sent first, then the next
//! byte of all. Byte j of n is at address n - 1 - j of the bank. So a word is a number with its least significant byte
//! at the lowest address, which the pixels process first.
//!
//! The network never waits, so no node may send before all are set up. Every node has a job for each word, even if it
//! only forwards the word. A node is ready when it has the bank and its set-up is over. The loading node starts when
//! all are ready. The set-up time depends on the number of nodes. The paper does not give it (PFL-SETUP), so it is a
//! parameter. No byte reaches the nodes before the loading one: their jobs have no bytes, and end when all are ready.
//!
//! Latency: a node with its bank is ready 3 clocks and the set-up after it takes a job. The first byte is sent in the
//! clock after `go`, then one in every clock. The next job is taken in the clock after the last byte.

use super::compositor::Mode;
use super::controller::BANKS;
use crate::prelude::*;

block! {
    /// Schedules the words of a direction of the network.
    pub struct NetworkSequencer {
        /// The number of pixels of a chip.
        pub pixels: u32,
        /// The set-up before a word, in clocks.
        pub setup: u32,
    }
    latency(self) = format!("{} clocks from taking a job to ready, if the bank is given", 3 + self.setup);
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NET, PFL-SETUP)";
    in(self) NetworkSequencerIn {
        /// The jobs, one for each word.
        jobs: stream(Job),
        /// The banks that the array has given: a bit for each.
        given: bits(BANKS),
        /// All nodes are ready.
        go: bit(),
        /// The current pixel of each chip.
        pixel: below(self.pixels),
        /// A byte of the current pixel is transferred.
        advances: bit(),
    }
    out NetworkSequencerOut {
        /// The mode of the port: a [`Mode`].
        mode: one_of::<Mode>(),
        /// The node sends a byte of each chip.
        sends: bit(),
        /// The byte is the first of its word.
        first: bit(),
        /// The bank, if the job needs one: a bit for each.
        bank: bits(BANKS),
        /// The address of the byte in the bank.
        address: below(NetworkSequencer::BYTES),
        /// The node is ready for its word.
        ready: bit(),
        /// For one clock: the network is done with a bank; a bit for each.
        done: bits(BANKS),
        /// The node has no job.
        idle: bit(),
    }
}

record! {
    /// A job of a node for the words of a region.
    pub struct Job {
        /// The mode of the node for the word: a [`Mode`].
        mode: one_of::<Mode>(),
        /// The bank of the word, unless the node forwards.
        bank: below(BANKS),
        /// The bytes of the word, 1 to 32; or 0 before the node that loads, where the mode has to be [`Mode::Forward`].
        bytes: up_to(NetworkSequencer::BYTES),
    }
}

codes! {
    /// The progress of a job.
    enum Phase {
        /// There is no job.
        Idle,
        /// The job waits for its bank.
        Bank,
        /// The set-up runs.
        SetUp,
        /// The node is ready, and follows the bytes that arrive; to load, it waits for all nodes.
        Ready,
        /// The node sends.
        Sends,
    }
}

impl NetworkSequencer {
    /// The bytes of a bank.
    pub const BYTES: u32 = 32;

    fn build(&self, m: Module, i: NetworkSequencerIn) -> NetworkSequencerOut {
        def!(phase = m.fsm(Phase::Idle));
        let next = i.jobs.take_when(phase.is(Phase::Idle));
        let mode = m.reg("job_mode", one_of::<Mode>()).reset(Mode::Forward);
        def!(bank = m.reg(bits(BANKS)).reset(0));
        def!(address = m.reg(below(NetworkSequencer::BYTES)));
        def!(first = m.reg(bit()));
        def!(empty = m.reg(bit()));

        def!(has_bank = (*bank & !i.given).eq(0));
        def!(waited = m.reg(up_to(self.setup.max(1))));
        waited.when(phase.is(Phase::Bank), 0).otherwise(waited + 1);
        def!(byte_ends = i.advances & i.pixel.eq(self.pixels - 1));
        def!(word_ends = byte_ends & address.eq(0));
        def!(begins = mode.is(Mode::Load) & i.go);
        def!(is_over = word_ends | (empty & i.go));
        let moves = phase.next(|phase| match phase {
            Phase::Idle => when(next.valid, Phase::Bank),
            Phase::Bank => when(has_bank, Phase::SetUp),
            Phase::SetUp => when(waited.eq(self.setup), Phase::Ready),
            Phase::Ready => when(begins, Phase::Sends).or_when(is_over, Phase::Idle),
            Phase::Sends => when(word_ends, Phase::Idle),
        });
        def!(ends = moves.enters(Phase::Idle));

        def!(needs = mux(next.mode.is(Mode::Forward), 0, cat![next.bank, !next.bank]));
        mode.when(next.taken, next.mode).when(ends, Mode::Forward);
        bank.when(next.taken, needs).when(ends, 0);
        address.when(next.taken, (next.bytes - 1).low()).when(byte_ends, address - 1);
        first.when(next.taken, 1).when(byte_ends, 0);
        empty.when(next.taken, next.bytes.eq(0));

        def!(ready = phase.is(Phase::Ready));
        def!(sends = phase.is(Phase::Sends));
        let state = |holds: Signal, message| m.assume(next.taken.implies(holds), message);
        state(next.bytes.le(NetworkSequencer::BYTES), "a word has at most 32 bytes");
        state(next.bytes.ne(0) | next.mode.is(Mode::Forward), "a job of no bytes forwards");
        m.assume(i.advances.implies(ready | sends), "a word comes only when the node is ready for it");
        let done = mux(ends, *bank, 0);
        // Until the node is ready, the mode has no meaning.
        let mode = mux(ready | sends, *mode, Mode::Forward);
        NetworkSequencerOut {
            mode,
            sends,
            first: *first,
            bank: *bank,
            address: *address,
            ready,
            done,
            idle: phase.is(Phase::Idle) & !next.valid,
        }
    }
}

#[cfg(test)]
mod tests;
