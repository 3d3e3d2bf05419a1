//! A frame: one 48-bit visibility word per pixel, row by row from the upper left.
//!
//! Source: facts E0. A blank pixel is (all-ones depth, background colour).

use crate::checksum::Fnv;
use crate::packet::{EMPTY_DEPTH, WORD_BITS};
use crate::size::Size;

/// A rendered frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    size: Size,
    /// One word per pixel, `z << 24 | r << 16 | g << 8 | b`; pixel (x, y) is at `y * width + x`. The length is `size.pixels()`.
    pub words: Vec<u64>,
}

/// The word of a pixel: `z << 24 | r << 16 | g << 8 | b`.
pub fn word(z: u32, rgb: [u8; 3]) -> u64 {
    let [r, g, b] = rgb.map(u64::from);
    u64::from(z) << 24 | r << 16 | g << 8 | b
}

/// The depth of a word.
pub fn depth_of(word: u64) -> u32 {
    (word >> 24) as u32 & EMPTY_DEPTH
}

/// Red, green and blue of a word.
pub fn rgb_of(word: u64) -> [u8; 3] {
    [(word >> 16) as u8, (word >> 8) as u8, word as u8]
}

/// The word of a pixel that nothing covers.
pub fn blank(background: [u8; 3]) -> u64 {
    word(EMPTY_DEPTH, background)
}

impl Frame {
    /// A frame of blank pixels.
    pub fn blank(size: Size, background: [u8; 3]) -> Frame {
        Frame { size, words: vec![blank(background); size.pixels()] }
    }

    /// A frame of the given words, row by row, or `None` unless there is exactly one word of 48 bits per pixel.
    pub fn from_words(size: Size, words: Vec<u64>) -> Option<Frame> {
        let fits = words.len() == size.pixels() && words.iter().all(|w| w >> WORD_BITS == 0);
        fits.then_some(Frame { size, words })
    }

    /// Width and height in pixels.
    pub fn size(&self) -> Size {
        self.size
    }

    /// Where pixel (x, y) stands in [`Frame::words`].
    pub fn index(&self, x: u32, y: u32) -> usize {
        y as usize * self.size.width() as usize + x as usize
    }

    /// The word of pixel (x, y).
    ///
    /// # Panics
    /// If the pixel is outside the frame, as indexing a slice does.
    pub fn word(&self, x: u32, y: u32) -> u64 {
        assert!(x < self.size.width(), "column {x} of a frame of {}", self.size);
        self.words[self.index(x, y)]
    }

    /// The depth of pixel (x, y); see [`Frame::word`].
    pub fn depth(&self, x: u32, y: u32) -> u32 {
        depth_of(self.word(x, y))
    }

    /// The colour of pixel (x, y); see [`Frame::word`].
    pub fn rgb(&self, x: u32, y: u32) -> [u8; 3] {
        rgb_of(self.word(x, y))
    }

    /// All colours, row by row, three bytes a pixel.
    pub fn rgb_bytes(&self) -> Vec<u8> {
        self.words.iter().flat_map(|&w| rgb_of(w)).collect()
    }

    /// A 64-bit checksum (FNV-1a) of size and words, to pin a frame in a test.
    pub fn checksum(&self) -> u64 {
        let mut sum = Fnv::new();
        sum.add(u64::from(self.size.width()));
        sum.add(u64::from(self.size.height()));
        self.words.iter().for_each(|&w| sum.add(w));
        sum.value()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_must_be_as_many_as_pixels_and_of_48_bits() {
        let size = Size::new(3, 2).expect("in range");
        assert!(Frame::from_words(size, vec![0; 5]).is_none());
        assert!(Frame::from_words(size, vec![0; 7]).is_none());
        assert!(Frame::from_words(size, vec![1 << 48; 6]).is_none());
        let frame = Frame::from_words(size, vec![word(0xab_cdef, [1, 2, 3]); 6]).expect("fits");
        assert_eq!((frame.depth(2, 1), frame.rgb(2, 1)), (0xab_cdef, [1, 2, 3]));
        assert_eq!(frame.rgb_bytes(), [1, 2, 3].repeat(6));
    }

    #[test]
    #[should_panic(expected = "column 3 of a frame of 3x2")]
    fn a_column_beyond_the_frame_is_not_the_next_row() {
        Frame::blank(Size::new(3, 2).expect("in range"), [0; 3]).word(3, 0);
    }
}
