//! The number and the positions of a pixel's samples.

use crate::error::SceneError;
use crate::size::{MAX_SIDE, Size};

/// The position of the second pass's samples: it moves all vertices along both axes by half of one of its pixels, in
/// 1/16 pixel.
pub const SECOND_SHIFT: [i32; 2] = [8, 8];

/// The samples of a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Samples {
    /// One, in the pixel's middle.
    #[default]
    One,
    /// Eight: two passes at twice the width and height, the second one moved by [`SECOND_SHIFT`]. A pixel has 2 x 2
    /// samples of each (facts E4). So the samples are exactly those of ordinary frames.
    Eight(Shading),
}

/// What is shaded of eight samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shading {
    /// Each sample by itself: the colour is `floor((sum + 4) / 8)` of theirs.
    #[default]
    EachSample,
    /// Their common surface: [`Shader::shade_once`](super::Shader::shade_once).
    OncePerPixel,
}

impl Samples {
    /// The passes of a frame of `size` pixels: each pass's size, and the distance in 1/16 of its pixels by which it
    /// moves all vertices.
    ///
    /// ```
    /// use tilewright_scenes::Size;
    /// use tilewright_scenes::deferred::{Samples, Shading};
    ///
    /// let size = Size::new(320, 240)?;
    /// assert_eq!(Samples::One.passes(size)?, [(size, [0, 0])]);
    /// let doubled = Size::new(640, 480)?;
    /// assert_eq!(Samples::Eight(Shading::EachSample).passes(size)?, [(doubled, [0, 0]), (doubled, [8, 8])]);
    /// # Ok::<(), tilewright_scenes::SceneError>(())
    /// ```
    ///
    /// # Errors
    /// [`SceneError::Invalid`] if a doubled side is above [`MAX_SIDE`].
    pub fn passes(self, size: Size) -> Result<Vec<(Size, [i32; 2])>, SceneError> {
        if self == Samples::One {
            return Ok(vec![(size, [0, 0])]);
        }
        let doubled = Size::new(2 * size.width(), 2 * size.height()).map_err(|_| {
            SceneError::invalid(
                format!("a frame of {size} pixels with 8 samples each is too large"),
                format!("give a width and a height up to {}, or one sample", MAX_SIDE / 2),
            )
        })?;
        Ok(vec![(doubled, [0, 0]), (doubled, SECOND_SHIFT)])
    }
}
