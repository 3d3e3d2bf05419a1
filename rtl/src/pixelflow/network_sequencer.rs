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
//! at the lowest address, as the pixels process it.
//!
//! The network never waits, so no node may send before all are set up. Every node has a job for each word, even if it
//! only forwards it. A node is ready when it has the bank and its set-up is over; the loading node starts when all are
//! ready. The set-up time depends on the number of nodes. The paper leaves it out (PFL-SETUP), so it is a parameter.
//! The nodes before the loading one get nothing: each has a job of no bytes, which ends when all are ready.
//!
//! Latency: a job becomes ready 3 clocks and the set-up after it is taken, if it has its bank. The first byte goes in
//! the clock behind `go`, then one a clock. The next job is taken in the clock behind the last byte.

use super::compositor::Mode;
use super::controller::BANKS;
use crate::prelude::*;

block! {
    /// Schedules the words of a direction of the network.
    pub struct NetworkSequencer {
        /// Pixels of a chip.
        pub pixels: u32,
        /// Clocks of the set-up before a word.
        pub setup: u32,
    }
    latency(self) = format!("{} clocks from a job to ready, if it has its bank", 3 + self.setup);
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NET, PFL-SETUP)";
    in(self) NetworkSequencerIn {
        /// The jobs, one for each word.
        jobs: stream(Job),
        /// Banks that the array has given: a bit for each.
        given: bits(BANKS),
        /// All nodes are ready.
        go: bit(),
        /// The current pixel of each chip.
        pixel: below(self.pixels),
        /// A byte of the pixel goes.
        advances: bit(),
    }
    out NetworkSequencerOut {
        /// The mode of the port: a [`Mode`].
        mode: one_of::<Mode>(),
        /// A byte of the node goes.
        sends: bit(),
        /// The byte is the first of its word.
        first: bit(),
        /// The bank, if the job needs one: a bit for each.
        bank: bits(BANKS),
        /// The byte of the bank.
        address: below(NetworkSequencer::BYTES),
        /// The node is set for its word.
        ready: bit(),
        /// The network is done with a bank: a bit for each.
        done: bits(BANKS),
        /// There is no job.
        idle: bit(),
    }
}

record! {
    /// A job of a node for the words of a region.
    pub struct Job {
        /// The mode of the node for the word: a [`Mode`].
        mode: one_of::<Mode>(),
        /// The bank that the word is in, unless the node forwards.
        bank: below(BANKS),
        /// Bytes of a word, 1 to 32; none at a node before the one that loads, which has to be a [`Mode::Forward`].
        bytes: up_to(NetworkSequencer::BYTES),
    }
}

codes! {
    /// The progress of a job.
    enum Phase {
        /// There is no job.
        Idle,
        /// It waits for its bank.
        Bank,
        /// It is set up.
        SetUp,
        /// The node is ready and follows the bytes that arrive; if it loads, it waits for all nodes.
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
        m.assume(i.advances.implies(ready | sends), "a word comes when the node is ready for it");
        let done = mux(ends, *bank, 0);
        // Until it is ready, its mode has no meaning.
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
