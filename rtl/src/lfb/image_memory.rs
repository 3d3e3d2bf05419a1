//! The image memory, with the second stage of the access pipeline on its front side, and read-and-clear on its back
//! side (VC1-ACC, VC1-CLR1).
//!
//! ```text
//! draw --> address --------.   .--------------.                  .------.
//!      '-> word ---.       +-->| image memory |--- old word ---->|      |
//!                  |       |   | front, back  |                  |  <   |-- nearer: write
//!                  '-------|-->|              |    .-- word ---->|      |
//!                          |   '--------------'    |             '------'
//! send --------------------'     ^ EMPTY   '-------|-----------> word
//! ```
//!
//! Latency and throughput: a drawn pixel takes 3 clocks (read, compare, write), and the next one is accepted in the last
//! of them. The scan gets a word one clock after its address, a word a clock.
//!
//! The word kept is the smaller one, which is the nearer. What the scan has read is cleared at once, so that after a whole
//! scan the buffer is empty and ready for the processor.
//!
//! Both buffers are one memory, whose lowest address bit tells them apart: a port for the processor, a port for the
//! scan, which takes the old word and leaves [`empty`] at the same edge.

use crate::prelude::*;

codes! {
    /// The clocks of an access.
    enum Stage2 { Idle, Read, Compare, Write }
}

block! {
    /// Holds two buffers of pages of pixels: keeps the nearer word of each pixel drawn, and clears what it sends.
    pub struct ImageMemory {
        /// The number of pages in a buffer.
        pub pages: u32,
        /// The number of pixels in a page, a power of two.
        pub page_pixels: u32,
    }
    latency = "3 clocks of the processor to draw, 1 clock of the merger to send";
    source = "VC-1, section 3.3, image memory (VC1-ACC, VC1-CLR1)";
    in(self) ImageMemoryIn {
        /// A pixel to draw, from the first stage.
        draw: pub struct Draw {
            /// There is one.
            valid: bit(),
            /// Its page.
            page: below(self.pages),
            /// The pixel's place in the page.
            offset: below(self.page_pixels),
            /// Depth above colour.
            word: bits(WORD),
        }.on(PE),
        /// The buffer to draw into.
        front: bit().on(PE),
        /// A pixel to send to the merger, from the scan counter by way of the patch table.
        send: pub struct SendPixel {
            /// The scan advances; where it is low the word sent stays.
            enable: bit(),
            /// The pixel has a page; if not, [`empty`] is sent.
            resident: bit(),
            /// Its page.
            page: below(self.pages),
            /// The pixel's place in the page.
            offset: below(self.page_pixels),
            /// The buffer to read and clear.
            buffer: bit(),
        }.on(MERGE),
    }
    out ImageMemoryOut {
        /// A pixel is accepted at this edge.
        ready: bit(),
        /// No pixel is under way.
        idle: bit(),
        /// The word sent.
        sent: bits(WORD),
    }
}

impl ImageMemory {
    fn build(&self, m: Module, i: ImageMemoryIn) -> ImageMemoryOut {
        let words = 2 * self.pages * self.page_pixels;
        let memory = m.memory("words", words, WORD, ReadUnderWrite::Old).true_dual_port().fill(empty());

        let front = m.on(PE);
        let stage = front.fsm("stage2", Stage2::Idle);
        def!(can_accept = stage.is(Stage2::Idle) | stage.is(Stage2::Write));
        def!(accept = i.draw.valid & can_accept);
        front.assume(i.draw.valid.implies(can_accept), "the second stage ends before the first has a page again");
        stage.next(|state| match state {
            Stage2::Idle => when(accept, Stage2::Read),
            Stage2::Read => goto(Stage2::Compare),
            Stage2::Compare => goto(Stage2::Write),
            Stage2::Write => when(accept, Stage2::Read).or_else(Stage2::Idle),
        });

        let address = front.pipe_when(accept, "drawn_address", cat!(i.draw.page, i.draw.offset, i.front));
        let word = front.pipe_when(accept, "drawn_word", i.draw.word);
        def!(old_word = memory.on(PE).read_when(stage.is(Stage2::Read), address));
        def!(nearer = front.pipe_when(stage.is(Stage2::Compare), word.lt(old_word)));
        memory.on(PE).write(stage.is(Stage2::Write) & nearer, address, word);

        def!(send_address = cat!(i.send.page, i.send.offset, i.send.buffer));
        def!(take = i.send.enable & i.send.resident);
        def!(taken_word = memory.on(MERGE).read_when(take, send_address));
        memory.on(MERGE).write(take, send_address, empty());
        def!(resident = m.on(MERGE).reg(1).reset(0).when(i.send.enable, i.send.resident));
        ImageMemoryOut { ready: can_accept, idle: stage.is(Stage2::Idle), sent: mux(resident, taken_word, empty()) }
    }
}

#[cfg(test)]
mod tests;
