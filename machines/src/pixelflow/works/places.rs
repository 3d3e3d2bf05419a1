//! The places of arrays' pixels on the screen.

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
