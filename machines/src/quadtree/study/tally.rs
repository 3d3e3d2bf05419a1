//! Sums over the rectangles of a sample, in integers, and their means.

use super::super::rasters::Rasters;
use super::super::stages::Stages;
use super::super::windows::Search;
use super::{Costs, EDGES, PARAMETERS};
use crate::mean::{Mean, Sum};
use tilewright_rtl::quadtree::coverage_test::Test;
use tilewright_scenes::Polygon;
use tilewright_scenes::packet::SUBPIXELS;

/// The sums over all processors of a matrix.
pub(super) struct Tally {
    polygons: u64,
    doubled_areas: u64,
    /// By level, from 0 to n.
    windows: Vec<Sum>,
    fragments: Sum,
    /// Clocks by level, from 1 to n.
    busy: Vec<u64>,
}

impl Tally {
    pub(super) fn none(levels: u32) -> Tally {
        let levels = levels as usize;
        let windows = vec![Sum::default(); levels + 1];
        Tally { polygons: 0, doubled_areas: 0, windows, fragments: Sum::default(), busy: vec![0; levels] }
    }

    /// Counts the processors' work on a rectangle.
    pub(super) fn count(&mut self, search: &Search, packet: &Polygon) {
        let windows = search.all_windows(packet);
        self.polygons += 1;
        self.doubled_areas += packet.area2.unsigned_abs();
        self.windows.iter_mut().zip(&windows.passed).for_each(|(sum, &passed)| sum.add(passed.into()));
        self.fragments.add(windows.fragments.into());
        let busy = windows.busy(Costs::new(Test::Serial, EDGES, PARAMETERS));
        self.busy.iter_mut().zip(busy).for_each(|(sum, clocks)| *sum += clocks);
    }

    /// Adds the sums of another thread.
    pub(super) fn add(&mut self, other: &Tally) {
        self.polygons += other.polygons;
        self.doubled_areas += other.doubled_areas;
        self.windows.iter_mut().zip(&other.windows).for_each(|(sum, &windows)| sum.add(windows));
        self.fragments.add(other.fragments);
        self.busy.iter_mut().zip(&other.busy).for_each(|(sum, clocks)| *sum += clocks);
    }

    /// The rectangles' mean area in pixels.
    pub(super) fn area(&self) -> f64 {
        self.doubled_areas as f64 / (self.polygons as f64 * f64::from(2 * SUBPIXELS * SUBPIXELS))
    }

    /// Windows of each level, from 0 to n, in one processor.
    pub(super) fn windows(&self, matrix: &Rasters) -> Vec<Mean> {
        self.windows.iter().map(|sum| self.mean(*sum, matrix)).collect()
    }

    /// Covered pixels in one processor.
    pub(super) fn fragments(&self, matrix: &Rasters) -> Mean {
        self.mean(self.fragments, matrix)
    }

    fn mean(&self, sum: Sum, matrix: &Rasters) -> Mean {
        sum.mean(self.polygons, matrix.processors() as f64)
    }

    /// The times of each level in one processor, in tests of a serial unit.
    pub(super) fn stages(&self, matrix: &Rasters) -> Stages {
        let tests = Costs::new(Test::Serial, EDGES, PARAMETERS).test * matrix.processors();
        let unit = self.polygons as f64 * tests as f64;
        Stages::new(self.busy.iter().map(|clocks| *clocks as f64 / unit).collect())
    }
}
