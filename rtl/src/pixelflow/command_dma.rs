//! The command fetcher: reads a node's instructions from memory, frame by frame (PFL-NODE, facts E4).
//!
//! ```text
//! store ----------------------> [ memory ]
//!                                 ^    | an instruction a clock
//! frames ==>[ two ]==>[ next, left ]   v
//!     base, length                  [ offered ]==> instructions
//! ```
//!
//! The geometry processors write the instructions of frames. They give the base and the length of each frame. Up to two
//! frames wait, so that one is fetched while the next is written.
//!
//! Latency: 2 clocks from the acceptance of a frame to its first instruction, then an instruction in every clock while
//! the receiver is ready. Between frames one clock is lost.

use tilewright_blocks::StreamBlocks;

use super::instruction::Instruction;
use crate::prelude::*;

block! {
    /// Fetches the instructions of frames from memory.
    pub struct CommandDma {
        /// The capacity of the memory, in instructions.
        pub words: u32,
    }
    latency = "2 clocks from the acceptance of a frame to its first instruction, then one in every clock";
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NODE)";
    in(self) CommandDmaIn {
        /// A write by the geometry processors.
        store: Store::widths(self.words),
        /// The frames to fetch, one after another.
        frames: stream(Commands::widths(self.words)),
    }
    out CommandDmaOut {
        /// The instructions to the array.
        instructions: stream(Instruction),
        /// No frame waits, and no instruction is under way.
        idle: bit(),
    }
}

record! {
    /// A write to the instruction memory.
    pub struct Store(words: u32) {
        /// An instruction is written.
        writes: bit(),
        /// The address at which the instruction is written.
        address: below(words),
        /// The instruction that is written.
        instruction: Instruction,
    }

    /// The instructions of a frame.
    pub struct Commands(words: u32) {
        /// The address of the frame's first instruction.
        base: below(words),
        /// The number of the frame's instructions; addresses wrap at the end of the memory.
        length: up_to(words),
    }
}

impl CommandDma {
    /// The number of frames that may wait (PFL-NODE).
    pub const FRAMES: u32 = 2;

    fn build(&self, m: Module, i: CommandDmaIn) -> CommandDmaOut {
        def!(memory = m.memory(self.words, Instruction::widths(), ReadUnderWrite::Old));
        memory.write(i.store.writes, i.store.address, i.store.instruction);
        let frames = m.fifo("u_frames", CommandDma::FRAMES, i.frames);
        def!(left = m.reg(up_to(self.words)).reset(0));
        def!(next = m.reg(below(self.words)));
        let frame = frames.take_when(left.eq(0));

        // The next instruction is read when its predecessor is sent.
        def!(arrived = m.reg(bit()).reset(0));
        def!(reads = m.wire(bit()));
        let (instructions, sent) = m.offer(*arrived, memory.read_when(reads, next));
        reads.drive(left.ne(0) & (!arrived | sent));
        left.when(frame.taken, frame.length).when(reads, left - 1);
        next.when(frame.taken, frame.base).when(reads, mux(next.eq(self.words - 1), 0, next + 1));
        arrived.when(reads, 1).when(sent, 0);
        CommandDmaOut { instructions, idle: !frame.valid & left.eq(0) & !arrived }
    }
}

#[cfg(test)]
mod tests;
