//! Whether a frame is the golden image.

use crate::shell::output::Output;
use crate::shell::place::beside;
use crate::shell::{Failure, terminal};
use serde::Serialize;
use std::fmt;
use std::path::Path;
use tilewright_scenes::{Comparison, Frame, SceneError, Size, compare, compare_colours};

/// What a frame is compared with.
pub enum Golden {
    /// The software rasterizer's frame: depth and colour.
    Rendered(Frame),
    /// A picture: colour alone.
    Picture(Frame),
}

impl Golden {
    /// The picture in that file, or without one the software rasterizer's frame, which `draw` makes.
    ///
    /// # Errors
    /// The file cannot be read, or is of another size than the frame; those of `draw`.
    pub fn new(
        file: Option<&Path>,
        size: Size,
        draw: impl FnOnce() -> Result<Frame, Failure>,
    ) -> Result<Golden, Failure> {
        let Some(path) = file else { return draw().map(Golden::Rendered) };
        let picture = Frame::read_png(path)?;
        if picture.size() != size {
            return Err(SceneError::File {
                path: path.to_owned(),
                problem: format!("holds {} pixels, the frame {size}", picture.size()),
                remedy: format!("pass --size {}, or name another picture", picture.size()),
            }
            .into());
        }
        Ok(Golden::Picture(picture))
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
    /// Depth above colour, 12 hexadecimal digits; against a picture, which has no depth, the colour's 6 alone.
    frame: String,
    golden: String,
}

impl Verdict {
    /// How many pixels differ; where the sizes do, all of the frame's count as one.
    pub fn differing(&self) -> u64 {
        self.differing.max(u64::from(!self.identical))
    }

    fn of(comparison: &Comparison) -> Verdict {
        let identical = comparison.is_equal();
        let digits = |word: u64| match comparison.colours_alone {
            true => format!("{:06x}", word & 0xff_ffff),
            false => format!("{word:012x}"),
        };
        let first =
            comparison.first.map(|it| Pixel { x: it.x, y: it.y, frame: digits(it.left), golden: digits(it.right) });
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

/// What the difference picture's name ends in instead of the frame's `png`.
pub const DIFFERENCE: &str = "difference.png";

/// Writes the picture of the differences beside the frame; without one, removes what an earlier run left there. A file that is
/// no picture stays. What fails is a warning alone: the verdict matters more.
pub fn leave_difference(frame: &Path, picture: Option<&Frame>) {
    let Some(path) = beside(frame, DIFFERENCE) else { return };
    let name = path.display();
    let is_there = path.is_file();
    let is_ours = is_there && Frame::read_png(&path).is_ok();
    match picture {
        Some(_) if is_there && !is_ours => {
            terminal::warn(&format!("{name} is no picture and stays as it is: remove it to see the differences there"));
        }
        Some(picture) => {
            let written = Output::at(&path).and_then(|output| output.write(&picture.to_png()));
            written.unwrap_or_else(|failure| failure.sentences().for_each(terminal::warn));
        }
        None if is_ours => match std::fs::remove_file(&path) {
            Ok(()) => terminal::talk(&format!("removed {name}")),
            Err(_) => terminal::warn(&format!("{name} is of an earlier run and cannot be removed: remove it")),
        },
        None => {}
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
