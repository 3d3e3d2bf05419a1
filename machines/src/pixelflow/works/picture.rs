//! The picture on display.

use tilewright_scenes::Frame;

use super::Works;
use crate::pixelflow::hardware::Words;

/// The greatest depth, for pixels without a known depth.
const FAR: u64 = 0xff_ffff;

impl Works {
    /// The frame: the displayed colours, line by line, and the depths of each region's words, if they have depths.
    pub fn picture(&self, shown: &[[u8; 3]], came: &[Words]) -> Frame {
        let width = self.size().width();
        let word = |(number, colour): (usize, &[u8; 3])| {
            let (x, y) = (number as u32 % width, number as u32 / width);
            let depth = if came.is_empty() { FAR } else { self.depth(came, x, y) };
            tilewright_scenes::frame::word(depth as u32, *colour)
        };
        let words = shown.iter().enumerate().map(word).collect();
        Frame::from_words(self.size(), words).expect("there is a word of each pixel")
    }

    /// The depth of a pixel: the first three bytes of its word.
    fn depth(&self, came: &[Words], x: u32, y: u32) -> u64 {
        let [width, height] = self.array;
        let across = self.size().width().div_ceil(width);
        let (region, x, y) = (y / height * across + x / width, x % width, y % height);
        let (chip, pixel, pixels) = (y / 2, (y % 2 * width + x) as usize, 2 * width as usize);
        (0..3).fold(0, |depth, byte| depth << 8 | came[region as usize].byte(pixel + byte * pixels, chip))
    }
}
