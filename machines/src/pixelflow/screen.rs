//! A screen in regions, each as large as an array.

use tilewright_scenes::{PixelBox, Size};

use super::packets::Corner;

/// The regions of a screen, counted from the upper left, line by line; the last ones may reach beyond it.
///
/// ```
/// use tilewright_machines::pixelflow::Screen;
/// use tilewright_scenes::Size;
///
/// let screen = Screen::new(Size::new(640, 512)?, [128, 64]);
/// assert_eq!((screen.count(), screen.corner(6).0), (40, [128, 64]));
/// # Ok::<(), tilewright_scenes::SceneError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Screen {
    size: Size,
    region: [u32; 2],
}

impl Screen {
    /// A screen of that size, with regions of so many pixels along x and y.
    pub fn new(size: Size, region: [u32; 2]) -> Screen {
        Screen { size, region }
    }

    fn columns(&self) -> u32 {
        self.size.width().div_ceil(self.region[0])
    }

    /// All regions.
    pub fn count(&self) -> usize {
        (self.columns() * self.size.height().div_ceil(self.region[1])) as usize
    }

    /// The upper left pixel of a region.
    pub fn corner(&self, region: usize) -> Corner {
        let number = region as u32;
        Corner([number % self.columns() * self.region[0], number / self.columns() * self.region[1]])
    }

    /// The regions that a box of pixels meets.
    pub fn of(&self, bounds: &PixelBox) -> Vec<usize> {
        if bounds.is_empty() {
            return Vec::new();
        }
        let [width, height] = self.region;
        let lines = bounds.top / height..=bounds.bottom / height;
        let columns = bounds.left / width..=bounds.right / width;
        let region = |line: u32, column: u32| (line * self.columns() + column) as usize;
        lines.flat_map(|line| columns.clone().map(move |column| region(line, column))).collect()
    }
}
