//! The size of a screen, in pixels: at most 2048 x 2048, since vertices are 16-bit numbers of 1/16 pixel (facts E0).

use crate::error::SceneError;
use std::fmt;

/// The largest width and height of a screen, in pixels (facts E0: the guard band is +-2048 pixels).
pub const MAX_SIDE: u32 = 2048;

/// Width and height of a screen in pixels, each between 1 and [`MAX_SIDE`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Size {
    width: u32,
    height: u32,
}

impl Size {
    /// The VC-1's screen, 640 x 480 (VC1-TM).
    pub const VGA: Size = Size { width: 640, height: 480 };

    /// A size of `width` x `height` pixels.
    ///
    /// # Errors
    /// [`SceneError::Size`] if a side is zero or above [`MAX_SIDE`].
    pub fn new(width: u32, height: u32) -> Result<Size, SceneError> {
        let side = 1..=MAX_SIDE;
        if side.contains(&width) && side.contains(&height) {
            Ok(Size { width, height })
        } else {
            Err(SceneError::Size { width: width.into(), height: height.into() })
        }
    }

    /// Pixels in a row.
    pub fn width(self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(self) -> u32 {
        self.height
    }

    /// Pixels in all.
    pub fn pixels(self) -> usize {
        self.width as usize * self.height as usize
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.width, self.height)
    }
}
