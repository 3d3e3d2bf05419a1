//! Fields of an interlaced display: every second line of a frame.

use crate::error::SceneError;
use crate::frame::Frame;
use crate::size::Size;

/// A field of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Field {
    /// Lines 0, 2, 4 ..
    Even,
    /// Lines 1, 3, 5 ..
    Odd,
}

impl Field {
    /// Its first line.
    pub fn first_line(self) -> u32 {
        match self {
            Field::Even => 0,
            Field::Odd => 1,
        }
    }

    /// The size of this field of a frame of `size` pixels.
    ///
    /// ```
    /// use tilewright_scenes::{Field, Size};
    ///
    /// let size = Size::new(640, 511)?;
    /// assert_eq!((Field::Even.size(size)?.height(), Field::Odd.size(size)?.height()), (256, 255));
    /// # Ok::<(), tilewright_scenes::SceneError>(())
    /// ```
    ///
    /// # Errors
    /// [`SceneError::Invalid`] if the frame has no such line.
    pub fn size(self, size: Size) -> Result<Size, SceneError> {
        let lines = size.height().saturating_sub(self.first_line()).div_ceil(2);
        Size::new(size.width(), lines).map_err(|_| {
            let problem = format!("a frame of {size} pixels has no odd lines");
            SceneError::invalid(problem, "give a height of 2 or more, or take the even field")
        })
    }

    /// Its lines of a frame.
    ///
    /// ```
    /// use tilewright_scenes::{Field, Frame, Size};
    ///
    /// let mut frame = Frame::blank(Size::new(2, 3)?, [0; 3]);
    /// frame.words = vec![0, 1, 10, 11, 20, 21];
    /// assert_eq!(Field::Even.lines(&frame)?.words, [0, 1, 20, 21]);
    /// assert_eq!(Field::Odd.lines(&frame)?.words, [10, 11]);
    /// # Ok::<(), tilewright_scenes::SceneError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Field::size`].
    pub fn lines(self, frame: &Frame) -> Result<Frame, SceneError> {
        let size = self.size(frame.size())?;
        let width = size.width() as usize;
        let mut field = Frame::blank(size, [0; 3]);
        let lines = frame.words.chunks_exact(width).skip(self.first_line() as usize).step_by(2);
        field.words.chunks_exact_mut(width).zip(lines).for_each(|(to, from)| to.copy_from_slice(from));
        Ok(field)
    }
}
