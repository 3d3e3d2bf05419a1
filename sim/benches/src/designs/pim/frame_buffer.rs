//! A virtual local frame buffer that draws patches at random, and is scanned at the same time.

use tilewright_hdl::{
    Bits, Mem, Module, ReadUnderWrite, Signal, bit, bits, block, cat, def, index_width, lit, mux, up_to,
};

use super::Pixel;
use crate::word::{below, xorshift};

/// The edge of a patch in pixels.
const EDGE: u32 = 4;
/// The width of a patch's page number; page 0 means none.
const PAGE: u32 = 13;

block! {
    /// A patch table, which gives patches their pages when they are first drawn into, and the image memory of those
    /// pages: a quarter as many as there are patches.
    pub struct FrameBuffer {
        /// Patches in a row of the screen, from 5.
        pub columns: u32,
        /// Rows of patches, from 2.
        pub rows: u32,
    }
    in(self) FrameBufferIn {
        rst: bit(),
        seed: bits(32),
        start_x: bits(self.x_width()),
    }
    out FrameBufferOut {
        /// The pixel found by the scan, one every clock.
        pixel: Pixel = _,
    }
}

impl FrameBuffer {
    fn build(&self, m: Module, i: FrameBufferIn) -> FrameBufferOut {
        let table = m.memory("patch_table", self.patches(), PAGE, ReadUnderWrite::Old).fill(Bits::zero(PAGE));
        def!(image = m.memory(self.pages() * EDGE * EDGE, 48, ReadUnderWrite::Old).fill(Bits::zero(48)));
        self.draw(m, &i, table, image);
        FrameBufferOut { pixel: self.scan(m, &i, table, image) }
    }

    /// The width of the screen in pixels.
    pub fn width(&self) -> u32 {
        EDGE * self.columns
    }

    /// The width of a pixel's position in a row.
    pub fn x_width(&self) -> u32 {
        index_width(self.width().into())
    }

    fn patches(&self) -> u32 {
        self.columns * self.rows
    }

    fn pages(&self) -> u32 {
        self.patches() / 4
    }

    /// A patch's number.
    fn patch(&self, column: Signal, row: Signal) -> Signal {
        let width = index_width(self.patches().into());
        let before = row.times(lit(up_to(self.columns), self.columns));
        before.trunc(width) + column.zext(width)
    }

    /// Scans the screen in raster order; 2 clocks from a position to its pixel.
    fn scan(&self, m: Module, i: &FrameBufferIn, table: Mem, image: Mem) -> Pixel {
        let height = EDGE * self.rows;
        let (x, y) = (m.reg("x", self.x_width()), m.reg("y", index_width(height.into())));
        def!(row_ends = x.eq(self.width() - 1));
        x.next(mux(i.rst, i.start_x, mux(row_ends, 0, x + 1)));
        y.enable(i.rst | row_ends).next(mux(i.rst | y.eq(height - 1), 0, y + 1));

        def!(page = table.read(self.patch(x.slice(2..x.width()), y.slice(2..y.width()))));
        def!(offset = m.pipe(cat![y.slice(0..2), x.slice(0..2)]));
        def!(word = image.read(self.address(page, offset)));
        def!(valid = m.pipe(page.ne(0)));
        Pixel { valid, rgb: word.slice(24..48), z: word.slice(0..24) }
    }

    /// The address of a page's pixel in the image memory.
    fn address(&self, page: Signal, pixel: Signal) -> Signal {
        cat![page, pixel].trunc(index_width(u64::from(self.pages() * EDGE * EDGE)))
    }

    /// Draws all pixels of a random patch, then of another. A patch without a page gets the next one while there are
    /// any.
    fn draw(&self, m: Module, i: &FrameBufferIn, table: Mem, image: Mem) {
        def!(random = m.reg(32));
        random.next(mux(i.rst, i.seed, xorshift(*random)));
        let bits = |low: u32, count: u32| random.slice(low..low + index_width(count.into()));
        let (column, row) = (bits(0, self.columns), bits(8, self.rows));
        let column = below(column, self.columns, (1 << column.width()) - self.columns);
        let row = below(row, self.rows, 1 << (row.width() - 1));

        // The pixel of the patch; the table is being read.
        def!(pixel = m.reg(4));
        pixel.next(mux(i.rst, 0, pixel + 1));
        def!(target = m.reg(index_width(self.patches().into())));
        target.enable(i.rst | pixel.all_ones()).next(mux(i.rst, 0, self.patch(column, row)));

        // The page is known, or is taken with the patch's first pixel.
        def!(looked_up = m.pipe(*target));
        def!(entry = table.read(target));
        def!(drawn = m.reg(4));
        drawn.next(mux(i.rst, 1, pixel));
        let depth = random.slice(8..32) ^ cat![random.slice(0..8), lit(16, 0)];
        let word = m.pipe("drawn_word", cat![random.slice(0..24), depth]);
        def!(next_page = m.reg(PAGE));
        let (page_before, draws_before) = (m.reg("page_before", PAGE), m.reg("draws_before", 1));
        def!(first = drawn.eq(0));
        def!(resident = entry.ne(0));
        def!(free = next_page.ne(self.pages()));
        def!(takes = first & !resident & free);
        def!(page_now = mux(first, mux(resident, entry, next_page), page_before));
        def!(draws = mux(first, resident | free, draws_before));
        next_page.enable(i.rst | takes).next(mux(i.rst, 1, next_page + 1));
        page_before.next(mux(i.rst, 0, page_now));
        draws_before.next(!i.rst & draws);
        table.write(takes, looked_up, next_page);
        image.write(draws, self.address(page_now, *drawn), word);
    }
}
