//! Whether a frame is the golden image.

use crate::shell::output::Output;
use crate::shell::place::beside;
use crate::shell::{Failure, terminal};
use serde::Serialize;
use std::fmt;
use std::path::Path;
use tilewright_scenes::{Comparison, Frame, SceneError, Size, compare, compare_colours};

/// The reference that a frame is compared with.
pub enum Golden {
    /// The software rasterizer's frame: depth and colour.
    Rendered(Frame),
    /// A picture: colour alone.
    Picture(Frame),
}

impl Golden {
    /// The picture in that file, or without a file the software rasterizer's frame, which `draw` makes.
    ///
    /// # Errors
    /// The file cannot be read, or has another size than the frame; an error of `draw`.
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
                problem: format!("has {} pixels, and the frame has {size}", picture.size()),
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

/// The result of a comparison with the golden image.
#[derive(Serialize)]
pub struct Verdict {
    /// Whether size and all pixels are equal.
    pub identical: bool,
    /// The number of pixels that differ; `None` if the sizes differ.
    differing: u64,
    /// The first pixel that differs, row by row from the upper left.
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
    /// Depth above colour, 12 hexadecimal digits; for a picture, which has no depth, the 6 digits of the colour.
    frame: String,
    golden: String,
}

impl Verdict {
    /// The number of pixels that differ; if the sizes differ, the whole frame counts as one.
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

/// The extension of the difference picture, instead of the frame's `png`.
pub const DIFFERENCE: &str = "difference.png";

/// Writes the picture of the differences beside the frame; without differences, removes that of an earlier run. A file that is
/// not a picture stays. Failures are warnings only: the verdict matters more.
pub fn leave_difference(frame: &Path, picture: Option<&Frame>) {
    let Some(path) = beside(frame, DIFFERENCE) else { return };
    let name = path.display();
    let is_there = path.is_file();
    let is_ours = is_there && Frame::read_png(&path).is_ok();
    match picture {
        Some(_) if is_there && !is_ours => {
            terminal::warn(&format!("{name} is not a picture and is kept: remove it to see the differences there"));
        }
        Some(picture) => {
            let written = Output::at(&path).and_then(|output| output.write(&picture.to_png()));
            written.unwrap_or_else(|failure| failure.sentences().for_each(terminal::warn));
        }
        None if is_ours => match std::fs::remove_file(&path) {
            Ok(()) => terminal::talk(&format!("removed {name}")),
            Err(_) => terminal::warn(&format!(
                "{name} was written by an earlier run and cannot be removed: remove it by hand"
            )),
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
