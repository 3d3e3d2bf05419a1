//! The cursor, which the host writes into each displayed frame (VC1-HOSTP).

use tilewright_scenes::frame::word;
use tilewright_scenes::{Frame, Size};

/// The place of the cursor.
///
/// ```
/// use tilewright_machines::vc1::Cursor;
/// use tilewright_scenes::{Frame, Size};
///
/// let mut frame = Frame::blank(Size::new(16, 16)?, [9; 3]);
/// Cursor { x: 10, y: 3 }.draw(&mut frame);
/// assert_eq!([frame.rgb(9, 3), frame.rgb(10, 3), frame.rgb(15, 10), frame.rgb(15, 11)], [[9; 3], [255; 3], [255; 3], [9; 3]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cursor {
    /// Its left edge, in pixels from the left.
    pub x: u32,
    /// Its upper edge, in pixels from the top.
    pub y: u32,
}

impl Cursor {
    /// Its side in pixels. It is clipped at the borders of the screen.
    pub const EDGE: u32 = 8;

    /// Its words on a screen of that size, white and in front of everything, each with the number of its pixel in raster order.
    pub(crate) fn words(self, size: Size) -> impl Iterator<Item = (u32, u64)> {
        let columns = self.x..size.width().min(self.x + Cursor::EDGE);
        let rows = self.y..size.height().min(self.y + Cursor::EDGE);
        rows.flat_map(move |y| columns.clone().map(move |x| (y * size.width() + x, word(0, [255; 3]))))
    }

    /// Draws it over a picture.
    pub fn draw(self, frame: &mut Frame) {
        let size = frame.size();
        self.words(size).for_each(|(pixel, word)| frame.words[pixel as usize] = word);
    }
}
