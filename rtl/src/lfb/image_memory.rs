//! The image memory: the second stage of the access pipeline draws into the front buffer, and the scan reads and clears
//! the back buffer (VC1-ACC, VC1-CLR1).
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
//! Latency and throughput: a drawn pixel takes 3 clocks (read, compare, write), and the next one may come in the last
//! of them. The first stage takes at least as long to find a page, so no handshake is needed. The scan gets a
//! word every clock, one clock after its address.
//!
//! The memory keeps the smaller word, which is the nearer one. A word read by the scan is cleared at once. So after a
//! whole scan the buffer is empty and ready for the processor.
//!
//! Both buffers share one memory; the lowest address bit selects the buffer. One port serves the processor. The other
//! serves the scan: it reads the old word and writes [`empty`] at the same edge.

use crate::prelude::*;

// The clocks of an access.
codes! { enum Stage2 { Idle, Read, Compare, Write } }

block! {
    /// Stores two buffers of pages of pixels: keeps the nearer word of each pixel drawn, and clears each word that it
    /// sends.
    pub struct ImageMemory {
        /// The number of pages in a buffer.
        pub pages: u32,
        /// The number of pixels in a page; with a power of two no word of the memory is wasted.
        pub page_pixels: u32,
    }
    ranges { pages: 2.., page_pixels: 2.. }
    latency = "3 clocks of the processor to draw, 1 clock of the merger to send";
    source = "VC-1, section 3.3, image memory (VC1-ACC, VC1-CLR1)";
    in(self) ImageMemoryIn {
        /// A pixel to draw, from the first stage, at least 3 clocks after the previous one.
        draw: pub struct Draw {
            /// There is a pixel to draw.
            valid: bit(),
            /// The page of the pixel's patch.
            page: below(self.pages),
            /// The pixel's place in the page.
            offset: below(self.page_pixels),
            /// The word of the pixel: depth above colour.
            word: bits(WORD),
        }.on(PE),
        /// The buffer to draw into.
        front: bit().on(PE),
        /// A pixel to send to the merger, from the scan counter by way of the patch table.
        send: pub struct SendPixel {
            /// The scan advances; while it is low, the word sent does not change.
            enable: bit(),
            /// The pixel has a page; if not, the empty word is sent, which is all ones.
            resident: bit(),
            /// The page of the pixel's patch.
            page: below(self.pages),
            /// The pixel's place in the page.
            offset: below(self.page_pixels),
            /// The buffer to read and clear.
            buffer: bit(),
        }.on(MERGE),
    }
    out ImageMemoryOut {
        /// No pixel is under way.
        idle: bit(),
        /// The word sent to the merger.
        sent: bits(WORD),
    }
}

impl ImageMemory {
    fn build(&self, m: Module, i: ImageMemoryIn) -> ImageMemoryOut {
        use Stage2::*;
        let (pe, merge) = (m.on(PE), m.on(MERGE));
        let count = 2 * self.pages * self.page_pixels.next_power_of_two();
        def!(words = m.memory(count, WORD, ReadUnderWrite::Old).true_dual_port().fill(empty()));

        def!(stage2 = pe.fsm(Idle));
        let moves = stage2.next(|state| match state {
            Idle => when(i.draw.valid, Read),
            Read => goto(Compare),
            Compare => goto(Write),
            Write => when(i.draw.valid, Read).or_else(Idle),
        });
        def!(begins = moves.enters(Read));
        pe.assume(
            i.draw.valid.implies(begins),
            "a pixel comes only when the second stage is idle or in its last clock",
        );

        def!(drawn_address = pe.pipe_when(begins, cat![i.draw.page, i.draw.offset, i.front]));
        def!(drawn_word = pe.pipe_when(begins, i.draw.word));
        def!(old_word = words.on(PE).read_when(stage2.is(Read), drawn_address));
        def!(nearer = pe.pipe_when(stage2.is(Compare), drawn_word.lt(old_word)));
        words.on(PE).write(stage2.is(Write) & nearer, drawn_address, drawn_word);

        def!(send_address = cat![i.send.page, i.send.offset, i.send.buffer]);
        def!(take = i.send.enable & i.send.resident);
        def!(taken_word = words.on(MERGE).read_when(take, send_address));
        words.on(MERGE).write(take, send_address, empty());
        def!(resident = merge.reg(1).reset(0).when(i.send.enable, i.send.resident));
        ImageMemoryOut { idle: stage2.is(Idle), sent: mux(resident, taken_word, empty()) }
    }
}

#[cfg(test)]
mod tests;
