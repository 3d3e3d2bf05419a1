//! Compares two frames: where they first differ, in how many pixels, and a picture of the difference.

use crate::frame::{Frame, depth_of, rgb_of, word};
use crate::packet::EMPTY_DEPTH;
use crate::size::Size;
use std::fmt;

/// The first pixel, row by row from the upper left, at which two frames differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Column.
    pub x: u32,
    /// Row.
    pub y: u32,
    /// The left frame's word.
    pub left: u64,
    /// The right frame's word.
    pub right: u64,
}

/// The result of [`compare`]. `Display` is a sentence for a person.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Comparison {
    /// The sizes of the left and the right frame; if they differ, no pixel was compared.
    pub sizes: [Size; 2],
    /// How many pixels differ.
    pub differing: u64,
    /// How many of them differ in colour; the others differ only in depth.
    pub in_colour: u64,
    /// Whether depths were left out, as for a picture, which has none.
    pub colours_alone: bool,
    /// The first pixel that differs.
    pub first: Option<Difference>,
    /// The difference picture, see [`Comparison::picture`].
    picture: Option<Frame>,
}

/// Compares two frames, depth and colour.
pub fn compare(left: &Frame, right: &Frame) -> Comparison {
    compare_under(left, right, u64::MAX)
}

/// Compares the colours of two frames; for frames read from a PNG file, which has no depths.
pub fn compare_colours(left: &Frame, right: &Frame) -> Comparison {
    compare_under(left, right, COLOUR)
}

/// The colour's bits of a word.
const COLOUR: u64 = 0xff_ffff;

fn compare_under(left: &Frame, right: &Frame, mask: u64) -> Comparison {
    let mut found = Comparison {
        sizes: [left.size(), right.size()],
        differing: 0,
        in_colour: 0,
        colours_alone: mask == COLOUR,
        first: None,
        picture: None,
    };
    if !found.same_size() {
        return found;
    }
    let mut picture = Frame::blank(left.size(), [0; 3]);
    let width = left.size().width() as usize;
    for (i, (&l, &r)) in left.words.iter().zip(&right.words).enumerate() {
        let (x, y) = ((i % width) as u32, (i / width) as u32);
        let differs = (l ^ r) & mask != 0;
        let in_colour = rgb_of(l) != rgb_of(r);
        let shown = match (differs, in_colour) {
            // The left frame at a quarter of its brightness shows the position of a difference.
            (false, _) => rgb_of(l).map(|c| c / 4),
            (true, false) => [0, 160, 255],
            (true, true) => [255, 64, 32],
        };
        picture.words[i] = word(EMPTY_DEPTH, shown);
        if differs {
            found.differing += 1;
            found.in_colour += u64::from(in_colour);
            found.first.get_or_insert(Difference { x, y, left: l, right: r });
        }
    }
    found.picture = Some(picture);
    found
}

impl Comparison {
    /// Whether the frames are the same, size and all.
    pub fn is_equal(&self) -> bool {
        self.same_size() && self.differing == 0
    }

    /// A picture of the differences, or `None` if the sizes differ. Red pixels differ in colour and blue ones only in
    /// depth; elsewhere it is a dark copy of the left frame. Write it with [`Frame::write_png`].
    pub fn picture(&self) -> Option<&Frame> {
        self.picture.as_ref()
    }

    fn same_size(&self) -> bool {
        self.sizes[0] == self.sizes[1]
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [left, right] = self.sizes;
        if !self.same_size() {
            return write!(f, "the frames differ in size: {left} and {right} pixels");
        }
        let Some(first) = self.first else {
            return write!(f, "all {} pixels are equal", left.pixels());
        };
        write!(f, "{} of {} pixels differ", self.differing, left.pixels())?;
        if !self.colours_alone {
            write!(f, ", {} of them in colour", self.in_colour)?;
        }
        let [one, other] = [first.left, first.right].map(|word| match self.colours_alone {
            true => Colour(word).to_string(),
            false => format!("z {:#08x} {}", depth_of(word), Colour(word)),
        });
        write!(f, "; the first is ({}, {}): {one} against {other}", first.x, first.y)
    }
}

/// A word's colour for a person.
struct Colour(u64);

impl fmt::Display for Colour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [r, g, b] = rgb_of(self.0);
        write!(f, "rgb #{r:02x}{g:02x}{b:02x}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::SceneError;

    fn pair() -> Result<(Frame, Frame), SceneError> {
        let left = Frame::blank(Size::new(5, 4)?, [8, 16, 24]);
        let mut right = left.clone();
        right.words[2 * 5 + 3] = word(0x1234, [1, 2, 255]);
        right.words[3 * 5] = word(77, [8, 16, 24]);
        Ok((left, right))
    }

    #[test]
    fn names_the_first_differing_pixel() -> Result<(), SceneError> {
        let (left, right) = pair()?;
        let found = compare(&left, &right);
        assert!(!found.is_equal());
        assert_eq!(
            found.to_string(),
            "2 of 20 pixels differ, 1 of them in colour; the first is (3, 2): \
             z 0xffffff rgb #081018 against z 0x001234 rgb #0102ff"
        );
        let picture = found.picture().expect("sizes are equal");
        assert_eq!(
            [picture.rgb(3, 2), picture.rgb(0, 3), picture.rgb(0, 0)],
            [[255, 64, 32], [0, 160, 255], [2, 4, 6]]
        );
        Ok(())
    }

    #[test]
    fn colours_can_be_compared_alone() -> Result<(), SceneError> {
        let (left, right) = pair()?;
        assert_eq!(
            compare_colours(&left, &right).to_string(),
            "1 of 20 pixels differ; the first is (3, 2): rgb #081018 against rgb #0102ff"
        );
        Ok(())
    }

    #[test]
    fn equal_frames_and_unequal_sizes_are_told_apart() -> Result<(), SceneError> {
        let (left, _) = pair()?;
        assert_eq!(compare(&left, &left).to_string(), "all 20 pixels are equal");
        let other = Frame::blank(Size::new(4, 5)?, [0; 3]);
        let found = compare(&left, &other);
        assert!(!found.is_equal() && found.picture().is_none());
        assert_eq!(found.to_string(), "the frames differ in size: 5x4 and 4x5 pixels");
        Ok(())
    }
}
