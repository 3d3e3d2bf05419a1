//! The picture, of what came of each region.

use tilewright_scenes::Frame;

use super::Works;
use crate::pixelflow::hardware::Words;

impl Works {
    /// The frame, of what came of each region.
    pub fn picture(&self, came: &[Words]) -> Frame {
        let size = self.size();
        let mut words = vec![0; size.pixels()];
        let (width, height) = (size.width(), size.height());
        let pixels = 2 * self.array[0] as usize;
        for (region, came) in came.iter().enumerate() {
            let [left, top] = self.screen.place(region);
            for (y, x) in (0..self.array[1]).flat_map(|y| (0..self.array[0]).map(move |x| (y, x))) {
                if left + x >= width || top + y >= height {
                    continue;
                }
                let (chip, pixel) = (y / 2, (y % 2 * self.array[0] + x) as usize);
                let bytes = came[pixel..].iter().step_by(pixels).map(|lanes| byte(lanes, chip));
                words[((top + y) * width + left + x) as usize] = self.word(bytes);
            }
        }
        Frame::from_words(size, words).expect("there is a word of each pixel")
    }

    /// A pixel of its bytes: depth, a zero and a colour, or a colour alone, which is as far as can be.
    fn word(&self, bytes: impl Iterator<Item = u64>) -> u64 {
        let number = bytes.fold(0, |number, byte| number << 8 | byte);
        match self.is_shaded() || self.adds() {
            true => 0xff_ffff << 24 | number,
            false => number >> 32 << 24 | number & 0xff_ffff,
        }
    }
}

/// A byte of a row.
fn byte(lanes: &tilewright_sim::Bits, lane: u32) -> u64 {
    let lane = lane as usize;
    lanes.limbs()[lane / 8] >> (8 * (lane % 8)) & 0xff
}
