//! The video buffer of a video processor: its pixels of two frames, one being drawn and one being shown (MPG-ARCH).
//!
//! ```text
//!           .-- bank 0 --.
//! draw ---->|  a read,   |      nearer: write
//!           |  a write   |
//! scan ---->|-- bank 1 --|----> word
//!           |            |      cleared: write
//!           '------------'
//! ```
//!
//! Each bank has one read and one write a clock; the write address is the read address of the previous clock. In the
//! bank being drawn, the word read is compared with the fragment. The smaller one, which is the nearer, is kept (facts
//! E0). In strict mode a fragment is kept only if its depth is smaller, so the first of equal depths stays. In the other
//! bank the word read is sent. A word of ones, the farthest, replaces it if the picture is cleared for the next frame.
//!
//! Latency: 2 clocks to draw, 1 to send; a fragment a clock, a word a clock.

use super::banks::{Addresses, Bank};
use super::format::Format;
use super::pixel::Fragment;
use crate::prelude::*;

block! {
    /// Stores the pixels of a video processor in two banks: keeps the nearer word in one, and sends the words of the
    /// other.
    pub struct VideoBuffer {
        /// The generator's format.
        pub format: Format,
    }
    latency = "2 clocks to draw, 1 clock to send";
    source = "sparse-raster quadtree generator, figure 1 (MPG-ARCH)";
    in(self) VideoBufferIn {
        /// A pixel to draw.
        draw: Fragment::widths(self.format),
        /// Depth alone is compared, and the first drawn of equal depths stays.
        strict: bit(),
        /// The number of the bank to draw in.
        back: bit(),
        /// The pixel of the other bank to send.
        scan: Scan::widths(self.format),
    }
    out(self) VideoBufferOut {
        /// The word sent to the video controller.
        word: bits(self.format.word()),
    }
}

record! {
    /// A pixel to send.
    pub struct Scan(format: Format) {
        /// A pixel is sent; while `enable` is low, the word sent stays until the banks are exchanged.
        enable: bit(),
        /// The pixel's column among those of the video processor.
        x: below(format.columns()),
        /// The pixel's line among those of the video processor.
        y: below(format.rows()),
        /// The pixel is cleared when it is read.
        clear: bit(),
    }
}

impl VideoBuffer {
    fn build(&self, m: Module, i: VideoBufferIn) -> VideoBufferOut {
        let (bits, colour) = (self.format.word(), 3 * self.format.precision().colour);
        let empty = lit(bits, (1_u64 << bits) - 1);
        let addresses = Addresses::of(self.format.columns(), self.format.rows());
        def!(drawn = addresses.at(i.draw.x, i.draw.y));
        def!(shown = addresses.at(i.scan.x, i.scan.y));
        let word = m.pipe_when(i.draw.valid, "drawn_word", i.draw.word);
        def!(sent_of = m.pipe_when(i.scan.enable, !i.back));

        let words = [0, 1].map(|number| {
            let name = |what: &str| format!("{what}{number}");
            let is_back = i.back.eq(number).named(&name("is_back"));
            let reads = mux(is_back, i.draw.valid, i.scan.enable).named(&name("reads"));
            let at = mux(is_back, drawn, shown).named(&name("address"));
            let bank = Bank { m, name: name("bank"), depth: addresses.depth(), word: bits };
            let (read, writer) = bank.read_when(self.format.banks(), reads, at);

            // The word written at that address a clock later; if the address is read at the same edge, the word is
            // forwarded.
            let writes = m.reg(&name("writes"), bit()).reset(0);
            writes.next(mux(is_back, i.draw.valid, i.scan.enable & i.scan.clear));
            let draws = m.pipe_when(reads, &name("draws"), is_back);
            let place = m.pipe_when(reads, &name("place"), at);
            let passes = m.reg(&name("passes"), bit());
            let passed = m.reg(&name("passed"), bits);
            let old = mux(passes, passed, read).named(&name("old"));
            let depth_of = |word: Signal| word.slice(colour..bits);
            let is_nearer = mux(i.strict, depth_of(word).lt(depth_of(old)), word.lt(old));
            let written = mux(draws, word, empty);
            let write = (writes & (!draws | is_nearer)).named(&name("write"));
            writer.write(write, place, written);
            passes.enable(reads).next(write & place.eq(at));
            passed.enable(reads).next(written);
            old
        });
        VideoBufferOut { word: mux(sent_of, words[1], words[0]) }
    }
}

#[cfg(test)]
mod tests;
