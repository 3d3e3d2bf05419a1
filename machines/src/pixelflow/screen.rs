//! A screen in regions of the size of an array.

use tilewright_rtl::parameter::ParameterError;
use tilewright_scenes::{Field, PixelBox, Size};

use super::packets::Corner;

/// The samples of a picture that are drawn: every `step`-th column and line from `first` on (x and y).
///
/// Edges and planes are exact integers and affine in x and y, and so are those of the samples. For them `A x + B y + C` is
/// `(step_x A) x' + (step_y B) y' + C'`, bit for bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pattern {
    /// The first one.
    pub first: [u32; 2],
    /// The step to the next along x and y.
    pub step: [u32; 2],
}

impl Pattern {
    /// All samples.
    pub const ALL: Pattern = Pattern { first: [0, 0], step: [1, 1] };

    /// Every second line.
    pub fn field(field: Field) -> Pattern {
        Pattern { first: [0, field.first_line()], step: [1, 2] }
    }

    /// A subset of these samples.
    ///
    /// ```
    /// use tilewright_machines::pixelflow::Pattern;
    /// use tilewright_scenes::Field;
    ///
    /// // The lower right sample of four, of pixels on odd lines.
    /// let sample = Pattern { first: [1, 1], step: [2, 2] };
    /// assert_eq!(sample.of(Pattern::field(Field::Odd)), Pattern { first: [1, 3], step: [2, 4] });
    /// ```
    pub fn of(self, some: Pattern) -> Pattern {
        let axis = |i: usize| (self.first[i] + self.step[i] * some.first[i], self.step[i] * some.step[i]);
        let [(x, step_x), (y, step_y)] = [axis(0), axis(1)];
        Pattern { first: [x, y], step: [step_x, step_y] }
    }

    /// The number of their columns and lines in a picture.
    fn sides(self, picture: Size) -> [u32; 2] {
        let sides = [picture.width(), picture.height()];
        [0, 1].map(|i| sides[i].saturating_sub(self.first[i]).div_ceil(self.step[i]))
    }
}

/// The regions of a screen, counted line by line from the upper left. Regions at the borders may extend beyond it.
///
/// ```
/// use tilewright_machines::pixelflow::{Pattern, Screen};
/// use tilewright_scenes::{Field, Size};
///
/// let size = Size::new(640, 512)?;
/// let screen = Screen::new(size, [128, 64]);
/// assert_eq!((screen.count(), screen.corner(6).at), (40, [128, 64]));
/// let field = Screen::sampled(size, Pattern::field(Field::Odd), [128, 64])?;
/// assert_eq!((field.count(), field.corner(6).at), (20, [128, 129]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Screen {
    size: Size,
    region: [u32; 2],
    pattern: Pattern,
}

impl Screen {
    /// A screen of that size, with regions of `array` pixels along x and y.
    pub fn new(size: Size, region: [u32; 2]) -> Screen {
        Screen { size, region, pattern: Pattern::ALL }
    }

    /// A screen of some of a picture's samples.
    ///
    /// # Errors
    /// The picture has no such sample.
    pub fn sampled(picture: Size, pattern: Pattern, region: [u32; 2]) -> Result<Screen, ParameterError> {
        let [width, height] = pattern.sides(picture);
        let none =
            |_| ParameterError(format!("a picture of {picture} pixels has no line or column {:?}", pattern.first));
        Ok(Screen { size: Size::new(width, height).map_err(none)?, region, pattern })
    }

    /// Pixels along x and y.
    pub fn size(&self) -> Size {
        self.size
    }

    fn columns(&self) -> u32 {
        self.size.width().div_ceil(self.region[0])
    }

    /// All regions.
    pub fn count(&self) -> usize {
        (self.columns() * self.size.height().div_ceil(self.region[1])) as usize
    }

    /// The upper left pixel of a region, on this screen.
    pub fn place(&self, region: usize) -> [u32; 2] {
        let number = region as u32;
        [number % self.columns() * self.region[0], number / self.columns() * self.region[1]]
    }

    /// The upper left pixel of a region, in the picture.
    pub fn corner(&self, region: usize) -> Corner {
        let first = Pattern { first: self.place(region), step: [1, 1] };
        let Pattern { first, step } = self.pattern.of(first);
        Corner { at: first, step }
    }

    /// The regions that have samples in a box of the picture's pixels.
    pub fn of(&self, bounds: &PixelBox) -> Vec<usize> {
        let [Some([left, right]), Some([top, bottom])] =
            [self.within(0, bounds.left, bounds.right), self.within(1, bounds.top, bounds.bottom)]
        else {
            return Vec::new();
        };
        let [width, height] = self.region;
        let lines = top / height..=bottom / height;
        let columns = left / width..=right / width;
        let region = |line: u32, column: u32| (line * self.columns() + column) as usize;
        lines.flat_map(|line| columns.clone().map(move |column| region(line, column))).collect()
    }

    /// The first and the last sample along an axis from one pixel of the picture to another, if there is any.
    fn within(&self, axis: usize, from: u32, to: u32) -> Option<[u32; 2]> {
        let (first, step) = (self.pattern.first[axis], self.pattern.step[axis]);
        let least = from.saturating_sub(first).div_ceil(step);
        let greatest = to.checked_sub(first)? / step;
        (least <= greatest).then_some([least, greatest])
    }
}

#[cfg(test)]
mod tests;
