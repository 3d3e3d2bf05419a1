//! The windows of a packet in a video processor: a plain model of the hardware's counters.
//!
//! Source: MPG-WIN, MPG-EQ5; facts B and E2 (the test of edges and of bounds). A window of level l is a square of 2^(n-l) x 2^(n-l)
//! samples of the processor's raster. Its extent has the pixels from its first sample to its last, and half of the aperture on each side. The
//! window passes if each edge function is at least 0 somewhere in the extent, and if the extent meets the packet's bounds along both axes.
//! The model computes products directly, without increments, so that a reader can check it.

use super::rasters::Rasters;
use serde::Serialize;
use std::ops::AddAssign;
use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::quadtree::coverage_test::Test;
use tilewright_scenes::{Edge, Packet, PixelBox};

/// The costs of tests and windows, in clocks (MPG-EQ5).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
pub struct Costs {
    /// A coverage test of one subwindow, t_e.
    pub test: u64,
    /// Each window that passes, t_e kp/ke: a clock for each parameter of the surface.
    pub window: u64,
}

impl Costs {
    /// The costs for a polygon of ke `edges` and kp `parameters`; depth and three colours are 4 parameters.
    ///
    /// ```
    /// use tilewright_machines::quadtree::{Costs, Test};
    ///
    /// assert_eq!(Costs::new(Test::Serial, 4, 4), Costs { test: 4, window: 4 });
    /// assert_eq!(Costs::new(Test::Parallel, 4, 4), Costs { test: 1, window: 4 });
    /// ```
    pub fn new(test: Test, edges: u64, parameters: u64) -> Costs {
        let test = match test {
            Test::Serial => edges,
            Test::Parallel => 1,
        };
        Costs { test, window: parameters }
    }
}

/// Counted windows, of one packet in one processor, or of many.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Windows {
    /// Windows that passed, by level from 0 to n; the root passes without a test.
    pub passed: Vec<u64>,
    /// Pixels that are covered: windows of level n that pass the exact test, without an aperture.
    pub fragments: u64,
}

impl Windows {
    /// No windows yet, for a matrix of `levels` levels.
    pub fn none(levels: u32) -> Windows {
        Windows { passed: vec![0; levels as usize + 1], fragments: 0 }
    }

    /// Coverage tests of each level, from level 1 to n: four for each window of the level above.
    pub fn tests(&self) -> impl Iterator<Item = u64> {
        self.passed.iter().rev().skip(1).rev().map(|windows| 4 * windows)
    }

    /// Busy clocks of each level, from level 1 to n: its tests, and the windows that pass (MPG-EQ5).
    pub fn busy(&self, costs: Costs) -> impl Iterator<Item = u64> {
        self.tests().zip(&self.passed[1..]).map(move |(tests, passed)| tests * costs.test + passed * costs.window)
    }
}

impl AddAssign<&Windows> for Windows {
    fn add_assign(&mut self, other: &Windows) {
        self.passed.iter_mut().zip(&other.passed).for_each(|(sum, windows)| *sum += windows);
        self.fragments += other.fragments;
    }
}

/// The recursive search of a matrix' processors for the pixels of packets.
///
/// ```
/// use tilewright_machines::quadtree::{Costs, Rasters, Search, Test};
/// use tilewright_scenes::{ScreenVertex, Size, set_up};
///
/// // The upper left half of the square of pixels 2 to 5, in the processor of even columns and rows of 8x8 pixels.
/// let at = |x: i32, y: i32| ScreenVertex { x: 16 * x, y: 16 * y, z: 1, rgb: [0; 3] };
/// let packet = set_up(&[at(2, 2), at(6, 2), at(2, 6)], Size::new(8, 8)?).unwrap();
/// let search = Search::new(Rasters { p: 2, q: 2, levels: 2, aperture: (0, 0) })?;
/// let windows = search.windows(&packet, (0, 0));
/// // Three of the four quarters pass, with one sample each: pixels (2, 2), (4, 2) and (2, 4).
/// assert_eq!((windows.passed.as_slice(), windows.fragments), (&[1, 3, 3][..], 3));
/// assert_eq!(windows.tests().collect::<Vec<_>>(), [4, 12]);
/// let busy = windows.busy(Costs::new(Test::Serial, 3, 4));
/// assert_eq!(busy.collect::<Vec<_>>(), [4 * 3 + 3 * 4, 12 * 3 + 3 * 4]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Search {
    matrix: Rasters,
}

impl Search {
    /// The search of a matrix' processors.
    ///
    /// # Errors
    /// As [`Rasters::check`].
    pub fn new(matrix: Rasters) -> Result<Search, ParameterError> {
        matrix.check().map(|()| Search { matrix })
    }

    /// The matrix.
    pub fn matrix(&self) -> &Rasters {
        &self.matrix
    }

    /// All processors, row by row.
    pub fn processors(&self) -> impl Iterator<Item = (u32, u32)> + use<> {
        let Rasters { p, q, .. } = self.matrix;
        (0..q).flat_map(move |j| (0..p).map(move |i| (i, j)))
    }

    /// The windows of `packet` in processor (i, j), i below p and j below q.
    pub fn windows<E: AsRef<[Edge]>>(&self, packet: &Packet<E>, processor: (u32, u32)) -> Windows {
        let mut windows = Windows::none(self.matrix.levels);
        self.add_windows(packet, self.root(processor), &mut windows);
        windows
    }

    /// The windows of `packet` in all processors together.
    pub fn all_windows<E: AsRef<[Edge]>>(&self, packet: &Packet<E>) -> Windows {
        let mut windows = Windows::none(self.matrix.levels);
        self.processors().for_each(|processor| self.add_windows(packet, self.root(processor), &mut windows));
        windows
    }

    /// The window of all samples of processor (i, j), i below p and j below q: level 0, which passes without a test.
    pub fn root(&self, (i, j): (u32, u32)) -> Window {
        Window { level: 0, x: i, y: j }
    }

    /// The quarters of a window that pass: upper left, upper right, lower left, lower right, in the sequence of the hardware's tests. A window
    /// of the last level has none.
    ///
    /// ```
    /// use tilewright_machines::quadtree::{Rasters, Search, Window};
    /// use tilewright_scenes::{ScreenVertex, Size, set_up};
    ///
    /// let at = |x: i32, y: i32| ScreenVertex { x: 16 * x, y: 16 * y, z: 1, rgb: [0; 3] };
    /// let packet = set_up(&[at(4, 0), at(8, 0), at(4, 4)], Size::new(8, 8)?).unwrap();
    /// let search = Search::new(Rasters { p: 1, q: 1, levels: 3, aperture: (0, 0) })?;
    /// let upper_right = Window { level: 1, x: 4, y: 0 };
    /// assert_eq!(search.quarters(&packet, search.root((0, 0))), [None, Some(upper_right), None, None]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn quarters<E: AsRef<[Edge]>>(&self, packet: &Packet<E>, window: Window) -> [Option<Window>; 4] {
        let level = window.level + 1;
        if level > self.matrix.levels {
            return [None; 4];
        }
        let (width, height) = self.matrix.spacing(level);
        let samples = (i64::from(width - self.matrix.p), i64::from(height - self.matrix.q));
        [(0, 0), (width, 0), (0, height), (width, height)].map(|(dx, dy)| {
            let quarter = Window { level, x: window.x + dx, y: window.y + dy };
            passes(packet, &quarter.extent(samples, self.matrix.aperture)).then_some(quarter)
        })
    }

    /// Whether the pixel of a window of the last level is covered: the exact test, without an aperture.
    pub fn covers<E: AsRef<[Edge]>>(&self, packet: &Packet<E>, window: Window) -> bool {
        passes(packet, &window.extent((0, 0), (0, 0)))
    }

    fn add_windows<E: AsRef<[Edge]>>(&self, packet: &Packet<E>, window: Window, counted: &mut Windows) {
        counted.passed[window.level as usize] += 1;
        if window.level == self.matrix.levels {
            counted.fragments += u64::from(self.covers(packet, window));
        }
        for quarter in self.quarters(packet, window).into_iter().flatten() {
            self.add_windows(packet, quarter, counted);
        }
    }
}

/// The coverage test: whether no edge and no bound excludes the whole extent.
fn passes<E: AsRef<[Edge]>>(packet: &Packet<E>, extent: &Extent) -> bool {
    extent.meets(packet.bounds) && packet.edges.as_ref().iter().all(|edge| extent.greatest(edge) >= 0)
}

/// A window of a processor's raster.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
pub struct Window {
    /// The number of divisions of the raster, from 0 to n.
    pub level: u32,
    /// The column of its first sample's pixel.
    pub x: u32,
    /// The row of its first sample's pixel.
    pub y: u32,
}

impl Window {
    fn extent(self, (width, height): (i64, i64), aperture: (u32, u32)) -> Extent {
        Extent { x: self.x.into(), y: self.y.into(), width, height, aperture }
    }
}

/// The pixels of a window.
#[derive(Clone, Copy)]
struct Extent {
    /// The pixel of the first sample.
    x: i64,
    y: i64,
    /// The distance to the pixel of the last sample.
    width: i64,
    height: i64,
    /// The aperture, half of which is outside of the samples on each side.
    aperture: (u32, u32),
}

impl Extent {
    /// The greatest value of an edge function over the extent: at the corner that the signs of its steps choose.
    fn greatest(&self, edge: &Edge) -> i64 {
        let (a, b) = (i64::from(edge.a), i64::from(edge.b));
        let at_corner = a * self.x + a.max(0) * self.width + b * self.y + b.max(0) * self.height + i64::from(edge.c);
        at_corner + (a.abs() * i64::from(self.aperture.0) + b.abs() * i64::from(self.aperture.1)) / 2
    }

    /// Whether the extent meets the bounds along both axes. Empty bounds are a line between two pixels; an extent with both pixels meets
    /// it.
    fn meets(&self, bounds: PixelBox) -> bool {
        let meets = |first: i64, length: i64, aperture: u32, least: u32, greatest: u32| {
            let grown = i64::from(aperture / 2);
            first + length + grown >= least.into() && first - grown <= greatest.into()
        };
        meets(self.x, self.width, self.aperture.0, bounds.left, bounds.right)
            && meets(self.y, self.height, self.aperture.1, bounds.top, bounds.bottom)
    }
}

#[cfg(test)]
mod tests;
