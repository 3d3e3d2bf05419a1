//! The texture unit: for one pixel of a region after another, gets the texels around the place that the pixel asks for
//! (PFL-SHADE, facts E4).
//!
//! ```text
//!                6 bytes of each chip         a chip a clock
//! registers ====>[ requests of a pixel ]--->[ looked up ]--->[ texture memory ]
//! registers <====[ texels of a pixel   ]<---[ collected ]<---'
//!               24 bytes of each chip
//! ```
//!
//! The registers' port accesses a byte of one pixel of each chip a clock. A round has at least 30 clocks. In it the
//! unit reads the 6 bytes of a request of one pixel of each chip. It writes the 24 bytes of texels for an earlier
//! pixel. Meanwhile the memory looks up the pixel between the two, a chip a clock. With 32 chips a round is 32 clocks,
//! so each pixel takes one:
//!
//! | clock of a round | port | |
//! |---|---|---|
//! | 0 to 5 | reads the request of pixel p: u, v, level, texture | pixel p - 1 of each chip is looked up, |
//! | 6 to 29 | writes the texels of pixel p - 2 | from the first clock on |
//!
//! | register | |
//! |---|---|
//! | 0, 1 | u, little end first |
//! | 2, 3 | v |
//! | 4 | the coarser level |
//! | 5 | the texture |
//! | 8 + 3 (4 s + 2 y + x) + channel | texels, in the sequence of [`TextureMemory`] |
//!
//! Latency: a round for each pixel of a chip, and two more. With 128 x 64 pixels that is 8256 clocks, 82.6 us of the 95
//! that the paper allows.

use super::registers::PortAccess;
use super::texture_memory::{Describe, TexelWrite, TextureMemory, TextureMemoryIn, TexturePlace};
use crate::prelude::*;

block! {
    /// Serves the texture registers of a region.
    pub struct TextureUnit {
        /// The number of chips of the node.
        pub chips: u32,
        /// The number of pixels of a chip.
        pub pixels: u32,
        /// Its memory.
        pub memory: TextureMemory,
    }
    latency(self) = format!("{} clocks for a region", self.clocks());
    source = "Reducing Latency on PixelFlow, section 4 (PFL-SHADE)";
    in(self) TextureUnitIn {
        /// The texel that the geometry processors write.
        write: TexelWrite::widths(&self.memory),
        /// Where the geometry processors say that a texture is.
        describe: Describe::widths(&self.memory),
        /// The texture unit begins.
        start: bit(),
        /// A byte of each chip, at the place that the port says.
        seen: bits(8).of(row(self.chips)),
    }
    out(self) TextureUnitOut {
        /// To the texture registers.
        port: PortAccess = PortAccess {
            pixel: below(self.pixels),
            address: bits(6),
            writes: bit(),
            bytes: bits(8).of(row(self.chips)),
        },
        /// All pixels have their texels.
        done: bit(),
    }
}

/// The bytes of a pixel's request.
const ASKED: u32 = 6;
/// The bytes of its texels.
const TEXELS: u32 = 24;
/// The register with the first of them.
const FIRST: u32 = 8;
/// The clock of a round in which the texels of the previous pixel are complete.
const COLLECTED: u32 = 3;

impl TextureUnit {
    /// Clocks of a round, in which a pixel of each chip is looked up.
    pub fn turn(&self) -> u32 {
        self.chips.max(ASKED + TEXELS)
    }

    /// Clocks for a region.
    pub fn clocks(&self) -> u64 {
        u64::from(self.turn()) * u64::from(self.pixels + 2)
    }

    fn build(&self, m: Module, i: TextureUnitIn) -> TextureUnitOut {
        let (chips, pixels, turn) = (self.chips, self.pixels, self.turn());
        def!(busy = m.reg(bit()).reset(0));
        def!(clock = m.reg(up_to(turn)));
        let number = m.reg("turn", up_to(pixels + 1));
        def!(turn_ends = busy & clock.eq(turn - 1));
        def!(ends = turn_ends & number.eq(pixels + 1));
        m.assume(i.start.implies(!busy), "the texture unit begins when it has done");
        busy.when(i.start, 1).when(ends, 0);
        clock.when(i.start | turn_ends, 0).otherwise(clock + 1);
        number.when(i.start, 0).when(turn_ends, number + 1);

        // The requests enter at the top, and leave a chip a clock.
        def!(reads = busy & number.lt(pixels) & clock.lt(ASKED));
        def!(asked = m.reg(bits(8 * ASKED).of(row(chips))));
        asked.when(reads, cat![i.seen, asked.slice(8..8 * ASKED)]);
        def!(sought = m.reg(bits(8 * ASKED).of(row(chips))));
        sought.when(turn_ends, *asked).otherwise(sought.following(0));
        def!(seeks = busy & number.ne(0) & number.le(pixels) & clock.lt(chips));
        let first = sought.lane(0);
        let byte = |at: u32| first.part(8 * at, 8);
        let request = TexturePlace {
            valid: seeks,
            u: first.part(0, 16),
            v: first.part(16, 16),
            level: byte(4),
            texture: byte(5),
        };
        let TextureUnitIn { write, describe, .. } = i;
        def!(memory = m.instance(&self.memory, TextureMemoryIn { write, describe, request }));

        // Texels are collected a chip a clock, and written a byte a clock.
        def!(collected = m.reg(bits(8 * TEXELS).of(row(chips))));
        collected.when(memory.valid, collected.following(memory.texels.pack()));
        def!(writes = busy & number.ge(2) & clock.ge(ASKED) & clock.lt(ASKED + TEXELS));
        def!(given = m.reg(bits(8 * TEXELS).of(row(chips))));
        given.when(clock.eq(COLLECTED), *collected).when(writes, *given >> 8);

        let pixel = mux(reads, *number, number - 2).trunc(below(pixels));
        let address = mux(reads, clock.zext(bits(8)), clock.zext(bits(8)) + (FIRST - ASKED)).trunc(6);
        TextureUnitOut { port: PortAccess { pixel, address, writes, bytes: given.slice(0..8) }, done: ends }
    }
}

#[cfg(test)]
mod tests;
