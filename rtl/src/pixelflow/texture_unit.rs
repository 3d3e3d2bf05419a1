//! The texture unit: looks up, for each pixel of a region, the texels around the point that the pixel requests
//! (PFL-SHADE, facts E4).
//!
//! ```text
//!                6 bytes of each chip         a chip per clock
//! registers ====>[ requests of a pixel ]--->[ looked up ]--->[ texture memory ]
//! registers <====[ texels of a pixel   ]<---[ collected ]<---'
//!               24 bytes of each chip
//! ```
//!
//! The port accesses a byte of one pixel of each chip per clock. A round has at least 30 clocks. In it the unit reads
//! the 6 bytes of a request for one pixel of each chip, and writes the 24 bytes of texels for an earlier pixel.
//! Meanwhile the memory looks up the pixel between the two, one chip per clock. With 32 chips a round is 32 clocks,
//! so the unit takes one clock per pixel:
//!
//! | clock of a round | port | texture memory |
//! |---|---|---|
//! | 0 to 5 | reads the request of pixel p: u, v, level, texture | looks up pixel p - 1 of each chip, |
//! | 6 to 29 | writes the texels of pixel p - 2 | from clock 0 on |
//!
//! | register | contents |
//! |---|---|
//! | 0, 1 | u, least significant byte first |
//! | 2, 3 | v |
//! | 4 | the coarser level |
//! | 5 | the texture |
//! | 8 + 3 (4 s + 2 y + x) + channel | texels, in the sequence of [`TextureMemory`] |
//!
//! Latency: a round for each pixel of a chip, and two more. With 128 x 64 pixels that is 8256 clocks, or 82.6 us. The
//! paper allows 95 us.

use super::registers::PortAccess;
use super::texture_memory::{Describe, TexelWrite, TextureMemory, TextureMemoryIn, TexturePlace};
use crate::prelude::*;

block! {
    /// Looks up texels for the requests in the texture registers of a region.
    pub struct TextureUnit {
        /// The number of chips of the node.
        pub chips: u32,
        /// The number of pixels of a chip.
        pub pixels: u32,
        /// The texture memory.
        pub memory: TextureMemory,
    }
    latency(self) = format!("{} clocks for a region", self.clocks());
    source = "Reducing Latency on PixelFlow, section 4 (PFL-SHADE)";
    in(self) TextureUnitIn {
        /// A texel that the geometry processors write.
        write: TexelWrite::widths(&self.memory),
        /// The location of a texture, from the geometry processors.
        describe: Describe::widths(&self.memory),
        /// For one clock: begin a region.
        start: bit(),
        /// The byte of each chip that the port addresses.
        seen: bits(8).of(row(self.chips)),
    }
    out(self) TextureUnitOut {
        /// The access to the texture registers.
        port: PortAccess = PortAccess {
            pixel: below(self.pixels),
            address: bits(6),
            writes: bit(),
            bytes: bits(8).of(row(self.chips)),
        },
        /// For one clock: all pixels have their texels.
        done: bit(),
    }
}

/// The number of bytes of a pixel's request.
const ASKED: u32 = 6;
/// The number of bytes of a pixel's texels.
const TEXELS: u32 = 24;
/// The register of the first texel.
const FIRST: u32 = 8;
/// The clock of a round in which the texels of the previous pixel are complete.
const COLLECTED: u32 = 3;

impl TextureUnit {
    /// The clocks of a round, in which a pixel of each chip is looked up.
    pub fn turn(&self) -> u32 {
        self.chips.max(ASKED + TEXELS)
    }

    /// The clocks for a region.
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
        m.assume(i.start.implies(!busy), "the texture unit begins only when it is done");
        busy.when(i.start, 1).when(ends, 0);
        clock.when(i.start | turn_ends, 0).otherwise(clock + 1);
        number.when(i.start, 0).when(turn_ends, number + 1);

        // Requests arrive a byte of each chip per clock, and leave a chip per clock.
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

        // Texels are collected a chip per clock, and written a byte of each chip per clock.
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
