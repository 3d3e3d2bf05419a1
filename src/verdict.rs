//! Whether a frame is the golden image.

use serde::Serialize;
use std::fmt;
use std::path::Path;
use tilewright_scenes::{Comparison, Frame, Projection, Scene, SceneError, compare, compare_colours, golden};

/// What a frame is compared with.
pub enum Golden {
    /// The software rasterizer's frame: depth and colour.
    Rendered(Frame),
    /// A picture: colour alone.
    Picture(Frame),
}

impl Golden {
    /// The picture in that file, or without one the software rasterizer's frame.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn new(file: Option<&Path>, scene: &Scene, projection: &Projection) -> Result<Golden, SceneError> {
        Ok(match file {
            Some(path) => Golden::Picture(Frame::read_png(path)?),
            None => Golden::Rendered(golden::render(projection.size, &projection.triangles, scene.background)),
        })
    }

    /// Compares a frame.
    pub fn judge(&self, frame: &Frame) -> Verdict {
        let comparison = match self {
            Golden::Rendered(golden) => compare(frame, golden),
            Golden::Picture(golden) => compare_colours(frame, golden),
        };
        Verdict::of(&comparison)
    }
}

/// What a comparison with the golden image gave.
#[derive(Serialize)]
pub struct Verdict {
    /// Whether size and all pixels are equal.
    pub identical: bool,
    /// How many pixels differ; none if the sizes do.
    differing: u64,
    /// The first that does, row by row from the upper left.
    first: Option<Pixel>,
    #[serde(skip)]
    sentence: String,
    /// A picture of the differences.
    #[serde(skip)]
    pub picture: Option<Frame>,
}

/// A pixel that differs.
#[derive(Serialize)]
struct Pixel {
    x: u32,
    y: u32,
    /// Depth above colour, 12 hexadecimal digits.
    frame: String,
    golden: String,
}

impl Verdict {
    fn of(comparison: &Comparison) -> Verdict {
        let identical = comparison.is_equal();
        let first = comparison.first.map(|it| Pixel {
            x: it.x,
            y: it.y,
            frame: format!("{:012x}", it.left),
            golden: format!("{:012x}", it.right),
        });
        let picture = if identical { None } else { comparison.picture().cloned() };
        Verdict { identical, differing: comparison.differing, first, sentence: comparison.to_string(), picture }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.identical {
            true => write!(f, "identical to the golden image"),
            false => write!(f, "NOT identical to the golden image: {}", self.sentence),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depth_counts_unless_the_golden_image_is_a_picture() -> Result<(), SceneError> {
        let golden = Frame::blank(tilewright_scenes::Size::new(4, 3)?, [9; 3]);
        let mut frame = golden.clone();
        frame.words[5] ^= 1 << 30;
        assert!(Golden::Picture(golden.clone()).judge(&frame).identical);
        let verdict = Golden::Rendered(golden).judge(&frame);
        assert!(!verdict.identical && verdict.picture.is_some());
        assert_eq!(verdict.first.map(|it| (it.x, it.y)), Some((1, 1)));
        Ok(())
    }
}
