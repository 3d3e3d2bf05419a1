//! The paper's formulas: the windows of a polygon, and their times.
//!
//! Source: MPG-EQ1 to MPG-EQ6, MPG-PMAX, MPG-TREE, as facts A2 restores them. They are means over polygons of one area and one shape
//! at random places and angles (MPG-F3B). Results that follow from any times are in [`Stages`].

use super::rasters::Rasters;
use super::stages::Stages;
use serde::Serialize;
use std::f64::consts::PI;

/// The most polygons per t_e: four tests on level 1, and one more for the window that passes (MPG-PMAX).
pub const MAX_PERFORMANCE: f64 = 0.2;

/// Processing elements of a full quadtree of levels 1 to `m`, below 32, with one for each window. It has the same greatest performance (MPG-TREE).
///
/// ```
/// assert_eq!(tilewright_machines::quadtree::full_tree(10), 1_398_100);
/// ```
pub fn full_tree(m: u32) -> u64 {
    (1..=m).map(|level| 4_u64.pow(level)).sum()
}

/// The size and the form of a polygon.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Shape {
    /// Area in pixels, S.
    pub area: f64,
    /// Form factor, L: the perimeter over that of the circle of the same area; at least 1.
    pub form: f64,
}

impl Shape {
    /// A polygon as in the paper's examples: the form of a rectangle of 5:1, to four digits (MPG-L).
    pub fn paper(area: f64) -> Shape {
        Shape { area, form: 1.514 }
    }

    /// A rectangle with sides of `ratio` to 1.
    ///
    /// ```
    /// use tilewright_machines::quadtree::Shape;
    ///
    /// assert!((Shape::rectangle(7.0, 5.0).form - 1.514).abs() < 0.0005);
    /// ```
    pub fn rectangle(area: f64, ratio: f64) -> Shape {
        Shape { area, form: (ratio + 1.0) / (PI * ratio).sqrt() }
    }
}

impl Rasters {
    /// Width and height of a window of `level`, 1 to n, over the windows' spacing: alpha_i and beta_i (MPG-EQ2).
    pub fn relative_window(&self, level: u32) -> (f64, f64) {
        let scale = scale(self.levels, level);
        let relative =
            |aperture: u32, processors: u32| 1.0 + scale * (f64::from(aperture) / f64::from(processors) - 1.0);
        (relative(self.aperture.0, self.p), relative(self.aperture.1, self.q))
    }

    /// The upper bound of the windows of `level`, 0 to n, of a polygon in one video processor: w_i(S), the area of the polygon after a
    /// filter with a window as its aperture (MPG-EQ1). For level 0 it is 1, the whole screen.
    ///
    /// ```
    /// use tilewright_machines::quadtree::{Rasters, Shape};
    ///
    /// let matrix = Rasters::square(4, 10);
    /// assert_eq!(matrix.windows_of(Shape::paper(157.0), 0), 1.0);
    /// assert!((matrix.windows_of(Shape::paper(157.0), 5) - 1.31).abs() < 0.005);
    /// ```
    pub fn windows_of(&self, shape: Shape, level: u32) -> f64 {
        if level == 0 {
            return 1.0;
        }
        let (a, b) = self.relative_window(level);
        let scale = scale(self.levels, level);
        let share = shape.area / self.processors() as f64;
        scale * scale * share + scale * shape.form * ((a * a + b * b) * PI * share).sqrt() + a * b
    }

    /// Windows of the last level, a pixel each: w_n(S), which is the filtered polygon's area over the number of processors (MPG-EQ3).
    pub fn pixel_windows_of(&self, shape: Shape) -> f64 {
        self.filtered_area(shape) / self.processors() as f64
    }

    /// The area of a polygon after the filter, in pixels: S_f.
    fn filtered_area(&self, shape: Shape) -> f64 {
        shape.area + self.diagonal() * shape.form * (PI * shape.area).sqrt() + self.aperture_area()
    }

    /// S_k, the area at which polygons of the form `form` have a mean of one window on the last level. Above it, later levels have more
    /// windows than earlier ones; below it, fewer (MPG-EQ4). `None` if even a point has more.
    ///
    /// ```
    /// use tilewright_machines::quadtree::Rasters;
    ///
    /// let turning = Rasters::square(3, 10).turning_area(1.514).unwrap();
    /// assert!((turning - 23.3).abs() < 0.05);
    /// assert_eq!(Rasters::square(0, 10).turning_area(1.514), None);
    /// ```
    pub fn turning_area(&self, form: f64) -> Option<f64> {
        // A quadratic equation for the root of the area, S_f = pq.
        let b = self.diagonal() * form * PI.sqrt();
        let c = self.aperture_area() - self.processors() as f64;
        (c <= 0.0).then(|| (((b * b - 4.0 * c).sqrt() - b) / 2.0).powi(2))
    }

    /// The aperture's diagonal if the processors' rasters are stretched to squares: sqrt(a^2 q/p + b^2 p/q), in pixels.
    fn diagonal(&self) -> f64 {
        let (a, b) = (f64::from(self.aperture.0), f64::from(self.aperture.1));
        let stretch = f64::from(self.q) / f64::from(self.p);
        (a * a * stretch + b * b / stretch).sqrt()
    }

    /// The aperture's area in pixels, ab.
    fn aperture_area(&self) -> f64 {
        f64::from(self.aperture.0) * f64::from(self.aperture.1)
    }

    /// The upper bound of a polygon's time on each level, in t_e: t_i(S) = 4 w_(i-1) + w_i kp/ke. Here `ratio` is kp/ke, the parameters
    /// of a surface over the edges of a polygon (MPG-EQ5).
    pub fn stages_of(&self, shape: Shape, ratio: f64) -> Stages {
        let windows = |level| self.windows_of(shape, level);
        Stages::new((1..=self.levels).map(|level| 4.0 * windows(level - 1) + windows(level) * ratio).collect())
    }

    /// The upper bound of the whole work on a polygon, in t_e: T(S), by the sum over windows (MPG-EQ6, on the right).
    pub fn work_of(&self, shape: Shape, ratio: f64) -> f64 {
        let sum = |levels: std::ops::Range<u32>| levels.map(|level| self.windows_of(shape, level)).sum::<f64>();
        4.0 * sum(0..self.levels) + ratio * sum(1..self.levels + 1)
    }
}

/// The windows of a level over the pixels, along one axis: 2^(i-n).
fn scale(levels: u32, level: u32) -> f64 {
    0.5_f64.powi(levels as i32 - level as i32)
}

#[cfg(test)]
mod tests;
