//! The texture memory: reads the eight texels around a point on two levels of a texture, a point per clock (PFL-SHADE,
//! facts E4).
//!
//! ```text
//!               .-------------.        .------------------------.     .------------------.
//! texture ----->| base, finest|------->| level, level + 1:      |     | 8 banks: parities |
//! u, v, level ->[             ]------->| left, right, below,    |---->| of level, row and |--> 8 texels
//!               '-------------'        | above                  |     | column            |
//!                                      '------------------------'     '------------------'
//! ```
//!
//! A texture is stored at all of its levels. Level l has 2^l x 2^l texels, and repeats on all sides. The four texels
//! around a point are neighbours, so their columns and rows have all combinations of parities. Of two successive levels
//! one is even. So no two of the eight texels are in the same bank, and all are read at once. A texture has the same
//! base in all banks; a level is stored behind all coarser ones of the same parity.
//!
//! The coordinate in texels is `floor(u 2^level / 2^8) - 2^7` in 1/2^8, because the colour of a texel is that of its
//! centre. A level finer than the finest is replaced by the finest one.
//!
//! Latency: 3 clocks; a point per clock.

use crate::delays::mark_delays;
use crate::prelude::*;

block! {
    /// Reads the texels around a point of a texture on two levels.
    pub struct TextureMemory {
        /// The number of texels of a bank.
        pub texels: u32,
        /// The number of textures.
        pub textures: u32,
    }
    latency = "3 clocks; a point per clock";
    source = "Reducing Latency on PixelFlow, section 4 (PFL-SHADE)";
    in(self) TextureMemoryIn {
        /// A texel that the geometry processors write.
        write: TexelWrite::widths(self),
        /// The location of a texture, from the geometry processors.
        describe: Describe::widths(self),
        /// The point to look up.
        request: pub struct TexturePlace {
            /// There is a point to look up.
            valid: bit(),
            /// The distance from the left, in 1/2^16 of the texture.
            u: bits(16),
            /// The distance from the bottom, in 1/2^16 of the texture.
            v: bits(16),
            /// The coarser of the two levels.
            level: bits(8),
            /// The number of the texture.
            texture: bits(8),
        },
    }
    out TextureMemoryOut {
        /// The texels of a point are at the output.
        valid: bit(),
        /// Texel 4 s + 2 y + x is on level `level + s`: on the right if x is 1, and above if y is 1.
        texels: bits(24).of(row(8)),
    }
}

record! {
    /// A write of a texel.
    pub struct TexelWrite(memory: &TextureMemory) {
        /// A texel is written.
        valid: bit(),
        /// The texel's bank: the parity of the level, then of the row, then of the column.
        bank: bits(3),
        /// The texel's address in its bank.
        address: below(memory.texels),
        /// The texel, red in the lowest byte, then green, then blue.
        texel: bits(24),
    }

    /// The location of a texture.
    pub struct Describe(memory: &TextureMemory) {
        /// The location of a texture is written.
        valid: bit(),
        /// The number of the texture.
        texture: below(memory.textures),
        /// The texture's first address in each bank.
        base: below(memory.texels),
        /// The texture's finest level.
        finest: up_to(TextureMemory::FINEST),
    }
}

/// The location of a texel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TexelAddress {
    /// The bank: the parity of the level, then of the row, then of the column.
    pub bank: u64,
    /// The texel's address in its bank.
    pub address: u64,
}

impl TextureMemory {
    /// The finest level that a texture may have.
    pub const FINEST: u32 = 10;

    /// The location of texel (i, j), column and row, on a level of a texture with this base.
    ///
    /// ```
    /// use tilewright_rtl::pixelflow::texture_memory::TextureMemory;
    /// // Levels 0 and 2 are in the same four banks, and level 0 has one texel.
    /// let place = TextureMemory::place(100, 2, 3, 1);
    /// assert_eq!((place.bank, place.address), (0b0_1_1, 100 + 1 + 1));
    /// ```
    pub fn place(base: u64, level: u32, i: u64, j: u64) -> TexelAddress {
        let bank = u64::from(level % 2) << 2 | (j & 1) << 1 | i & 1;
        TexelAddress { bank, address: base + TextureMemory::offset(level) + ((j >> 1) << level >> 1) + (i >> 1) }
    }

    /// The number of addresses of a bank that a texture with this finest level takes.
    pub fn size(finest: u32) -> u64 {
        TextureMemory::offset(finest + 2)
    }

    /// The address of a level relative to the texture's base.
    fn offset(level: u32) -> u64 {
        let size = |level: u32| if level == 0 { 1 } else { 1 << (2 * (level - 1)) };
        (level % 2..level).step_by(2).map(size).sum()
    }

    fn build(&self, m: Module, i: TextureMemoryIn) -> TextureMemoryOut {
        let valid = mark_delays(m, "valid", 3, i.request.valid)[3];
        // First clock: the texture's description.
        let widths = Describe::widths(self);
        let [base, finest] = [("bases", widths.base, i.describe.base), ("finests", widths.finest, i.describe.finest)]
            .map(|(name, width, written)| {
                let table = m.memory(name, self.textures, width, ReadUnderWrite::Old);
                table.write(i.describe.valid, i.describe.texture, written);
                table.read(i.request.texture.trunc(widths.texture))
            });
        let [u, v] = [("u", i.request.u), ("v", i.request.v)].map(|(name, part)| m.pipe(name, part));
        def!(level = m.pipe(i.request.level).zext(9));

        // Second clock: the two levels, and the columns and rows on each.
        def!(base = m.pipe(base));
        let around = |sought: Signal| {
            let level = mux(sought.lt(finest.zext(9)), sought.low(), finest);
            let ([left, right], [below, above]) = (neighbours(u, level), neighbours(v, level));
            Side { level, left, right, below, above }
        };
        def!(coarser = m.pipe(around(level)));
        def!(finer = m.pipe(around(level + 1)));

        // Third clock: each bank reads a texel of the level with its parity.
        let banks = stack(self.addresses(base, coarser, finer).into_iter().zip(0..).map(|(address, bank)| {
            let memory = m.memory(&format!("bank{bank}"), self.texels, 24, ReadUnderWrite::Old);
            memory.write(i.write.valid & i.write.bank.eq(bank), i.write.address, i.write.texel);
            memory.read(address)
        }));
        def!(from = m.pipe(stack([coarser.banks(), finer.banks()].concat())));
        TextureMemoryOut { valid, texels: banks.to_rows(8).columns().pick(from) }
    }

    /// The address of the texel in each bank.
    fn addresses(&self, base: Signal, coarser: Side, finer: Side) -> Vec<Signal> {
        let wide = bits(2 * TextureMemory::FINEST + 1);
        let offsets = constants(wide.of(row(TextureMemory::FINEST + 1)), TextureMemory::offset);
        let with_parity = |parity: u32, [one, other]: [Signal; 2]| mux(one.bit(0).eq(parity), one, other) >> 1;
        let mut addresses = Vec::new();
        for (parity, name) in [(0, "even"), (1, "odd")] {
            let side = mux(coarser.level.bit(0).eq(parity), coarser, finer).named(name);
            let level = offsets.pick(side.level);
            let lines = [0, 1].map(|parity| {
                let number = with_parity(parity, [side.below, side.above]);
                (level + ((number.zext(wide) << side.level) >> 1)).named(&format!("{name}_line{parity}"))
            });
            let columns = [0, 1].map(|parity| {
                let number = with_parity(parity, [side.left, side.right]);
                number.zext(wide).named(&format!("{name}_column{parity}"))
            });
            for line in lines {
                addresses.extend(columns.map(|column| base + fitting(line + column, base.width())));
            }
        }
        addresses
    }
}

/// A number in `width` bits: truncated, or extended with zeros.
pub(super) fn fitting(number: Signal, width: u32) -> Signal {
    if width > number.width() { number.zext(width) } else { number.trunc(width) }
}

bundle! {
    /// A level, and the columns and rows around a point on it.
    struct Side<T> { level: T, left: T, right: T, below: T, above: T }
}

impl Side {
    /// The banks of the four texels: left and right below, then left and right above.
    fn banks(&self) -> [Signal; 4] {
        let Side { level, left, right, below, above } = *self;
        [(below, left), (below, right), (above, left), (above, right)]
            .map(|(row, column)| cat![level.bit(0), row.bit(0), column.bit(0)])
    }
}

/// The numbers of the two texels around a point along one axis.
fn neighbours(part: Signal, level: Signal) -> [Signal; 2] {
    let number = bits(TextureMemory::FINEST);
    let wide = bits(16 + TextureMemory::FINEST);
    let place = ((part.zext(wide) << level) >> 8) - (1 << 7);
    let last = (lit(TextureMemory::FINEST + 1, 1) << level) - 1;
    let last = last.trunc(number);
    let low = place.part(8, TextureMemory::FINEST) & last;
    [low, (low + 1) & last]
}

#[cfg(test)]
pub(super) mod tests;
