//! How many samples a pixel has, and where they are.

use crate::error::SceneError;
use crate::size::{MAX_SIDE, Size};

/// Where the second of two passes has its samples: it moves all vertices by so many 1/16 of its pixels, half of one, along both axes.
pub const SECOND_SHIFT: [i32; 2] = [8, 8];

/// The samples of a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Samples {
    /// One, in its middle.
    #[default]
    One,
    /// Eight: two passes at twice the width and height, the second one moved by [`SECOND_SHIFT`], of each of which a pixel has
    /// 2 x 2 (facts E4). So the samples are those of ordinary frames, to the bit.
    Eight(Shading),
}

/// What of eight samples is shaded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shading {
    /// Each by itself: a colour is `floor((sum + 4) / 8)` of theirs.
    #[default]
    EachSample,
    /// What they have in common: [`Shader::shade_once`](super::Shader::shade_once).
    OncePerPixel,
}

impl Samples {
    /// The passes of a frame of `size` pixels: the size of each, and by how many 1/16 of its pixels it moves all vertices.
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
