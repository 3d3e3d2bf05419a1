//! The places of arrays' pixels on the screen.

use tilewright_rtl::pixelflow::fields::bank;
use tilewright_rtl::pixelflow::programs;

use super::Works;

impl Works {
    /// Pixels of an array.
    pub fn pixels_of_array(&self) -> usize {
        (self.array[0] * self.array[1]) as usize
    }

    /// Pixels of a chip: two lines.
    pub fn pixels_of_chip(&self) -> usize {
        2 * self.array[0] as usize
    }

    /// The chip of a pixel, counted chip by chip, and its number there.
    pub fn place_in_chip(&self, pixel: usize) -> (u32, usize) {
        let of_chip = self.pixels_of_chip();
        ((pixel / of_chip) as u32, pixel % of_chip)
    }

    /// The upper left corner of a region, in pixels that are drawn.
    pub fn corner(&self, region: usize) -> [u32; 2] {
        self.screen.place(region)
    }

    /// The primitive of each instruction of a rasterizer's program for a turn, if it is one's.
    pub fn primitives_of(&self, rasterizer: usize, turn: usize) -> Vec<Option<usize>> {
        let mut primitives = vec![None; self.programs[rasterizer][turn].len()];
        let starts = &self.starts[rasterizer][turn];
        for (number, (place, primitive)) in starts.iter().enumerate() {
            let end = starts.get(number + 1).map_or(self.drawn_until(rasterizer, turn), |(next, _)| *next);
            primitives[*place..end.max(*place)].fill(Some(*primitive));
        }
        primitives
    }

    /// The instruction after those of the last primitive of a turn: what follows tags the words, and gives them.
    fn drawn_until(&self, rasterizer: usize, turn: usize) -> usize {
        let behind = if self.is_shaded() { programs::covered(bank(0)).len() + 1 } else { 1 };
        self.programs[rasterizer][turn].len().saturating_sub(behind)
    }

    /// The number, in raster order, of the frame's pixel for a chip's pixel in a region, which may be one of its samples; `None` beyond the screen.
    pub fn pixel(&self, region: usize, chip: u32, pixel: usize) -> Option<usize> {
        let ([left, top], columns) = (self.screen.place(region), self.array[0]);
        let (x, y) = (left + pixel as u32 % columns, top + 2 * chip + pixel as u32 / columns);
        let size = self.screen.size();
        let shrinks = if self.is_side_by_side() { 2 } else { 1 };
        let is_there = x < size.width() && y < size.height();
        is_there.then(|| (y / shrinks * self.size().width() + x / shrinks) as usize)
    }
}
