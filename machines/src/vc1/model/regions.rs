//! The region-based machine of Table 1 (VC1-T1): the screen in m x n regions, drawn and merged one after another.
//!
//! The paper simulated it too; there is no circuit of it. A processing element does all of its geometry, with the classification of each
//! polygon by regions. Then it draws region after region into one of its b buffers. It may begin region r when region r - b is merged. A
//! region is merged T_m / (m n) after all have drawn it and the one before is merged.
//!
//! A packet is in the regions that the bounding box of its vertices touches, because a processing element classifies before set-up. Its area,
//! clipping and set-up count in the first of them, and each row in the first region of its line. The only other costs of regions are the
//! constants of [`Regions`].
//!
//! Frames of a still view follow each other: a processing element that has drawn its last region begins with the geometry of the next frame.

use std::ops::RangeInclusive;

use tilewright_rtl::clocks::MERGE;
use tilewright_scenes::packet::SUBPIXELS;
use tilewright_scenes::{PixelBox, ScreenVertex, Size};

use super::timing::PE_PERIOD;
use super::{Dealt, Model};
use crate::vc1::Clocks;
use crate::vc1::scan_conversion::{Pixels, Rows};

/// A region-based machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Regions {
    /// Regions in a row: m.
    pub columns: u32,
    /// Regions in a column: n.
    pub rows: u32,
    /// Buffers of a region in each processing element: b, at least 1.
    pub buffers: u32,
    /// Clocks of a polygon's classification by regions, beside its geometry.
    pub classify: u64,
    /// Clocks for each region of a packet.
    pub region: u64,
    /// Clocks for each region of a packet beyond its first.
    pub further: u64,
}

/// The times of a frame of a still view on a region-based machine, as means over the intervals from frame 3 to frame 15.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RegionFrame {
    /// By processing element, its clocks of geometry and of rasterization. In the remaining clocks it waits for a buffer (`sync`).
    pub processors: Vec<Clocks>,
    /// Simulated picoseconds from frame to frame.
    pub interval: u64,
}

/// The frames between which intervals are counted. Frames before the first one fill the buffers.
const FRAMES: RangeInclusive<usize> = 3..=15;

impl Model {
    /// The times of a still view on a region-based machine with the same processing elements, costs, screen and T_m. No polygon is sent to all.
    /// A processing element that has drawn its last region begins with the geometry of the next frame.
    ///
    /// # Panics
    /// There is no region, or no buffer.
    pub fn by_regions(&self, machine: &Regions, view: &Dealt) -> RegionFrame {
        assert!(machine.buffers > 0, "a region is drawn into a buffer");
        let count = (machine.columns * machine.rows) as usize;
        let merge_time = self.vc1.gfb().sequencer().merge_clocks() * MERGE.period.picoseconds() / count as u64;
        let work: Vec<Work> = (0..self.config.processors).map(|k| self.work_of(machine, view, k)).collect();
        let mut ends = vec![0; work.len()];
        let mut merged: Vec<u64> = Vec::new();
        for region in 0..count * FRAMES.end() {
            let free = region.checked_sub(machine.buffers as usize).map_or(0, |before| merged[before]);
            for (end, work) in ends.iter_mut().zip(&work) {
                let geometry = if region % count == 0 { work.geometry * PE_PERIOD } else { 0 };
                // It sees that a buffer is free at an edge of its clock.
                let begin = (*end + geometry).max(free.next_multiple_of(PE_PERIOD));
                *end = begin + work.regions[region % count] * PE_PERIOD;
            }
            let drawn = ends.iter().copied().max().unwrap_or_default();
            merged.push(drawn.max(merged.last().copied().unwrap_or_default()) + merge_time);
        }
        let [first, last] = [FRAMES.start(), FRAMES.end()].map(|frame| merged[count * frame - 1]);
        let interval = (last - first) / (FRAMES.end() - FRAMES.start()) as u64;
        let clocks = |work: Work| {
            let rasterization = work.regions.iter().sum();
            let sync = (interval / PE_PERIOD).saturating_sub(work.geometry + rasterization);
            Clocks { geometry: work.geometry, rasterization, sync, ..Clocks::default() }
        };
        RegionFrame { processors: work.into_iter().map(clocks).collect(), interval }
    }

    /// The work of a processing element.
    fn work_of(&self, machine: &Regions, Dealt(view): &Dealt, processor: u32) -> Work {
        let (size, costs) = (self.config.size, &self.config.costs);
        let place = |at: u32, side: u32, parts: u32| at * parts / side;
        let (column, row) = (|x| place(x, size.width(), machine.columns), |y| place(y, size.height(), machine.rows));
        let number = |column: u32, row: u32| (row * machine.columns + column) as usize;
        let mut work = Work { geometry: 0, regions: vec![0; number(0, machine.rows)] };
        for polygon in view.polygons(processor) {
            work.geometry += costs.geometry(polygon) + machine.classify;
            // Polygons off the screen count before the first region.
            let mut preparation = Some(costs.preparation(polygon));
            for index in polygon.packets.clone() {
                let (packet, b) = (&view.projection.triangles[index], box_of(&view.projection.vertices[index], size));
                let (left, top) = (column(b.left), row(b.top));
                work.regions[number(left, top)] += costs.set_up + preparation.take().unwrap_or_default();
                for row in top..=row(b.bottom) {
                    for column in left..=column(b.right) {
                        let further = if (column, row) == (left, top) { 0 } else { machine.further };
                        work.regions[number(column, row)] += machine.region + further;
                    }
                }
                let rows = packet.bounds.top..=packet.bounds.bottom;
                rows.for_each(|y| work.regions[number(left, row(y))] += costs.row);
                for pixel in Pixels::of(packet, Rows::ALL) {
                    work.regions[number(column(pixel.x), row(pixel.y))] += costs.pixel;
                }
            }
            work.regions[0] += preparation.unwrap_or_default();
        }
        work
    }
}

/// The pixels of the screen in which the bounding box of three vertices lies.
fn box_of(vertices: &[ScreenVertex; 3], size: Size) -> PixelBox {
    let span = |positions: [i32; 3], side: u32| {
        let [least, most] = [positions.iter().min(), positions.iter().max()].map(|it| it.copied().unwrap_or_default());
        [least, most].map(|it| it.div_euclid(SUBPIXELS).clamp(0, side as i32 - 1) as u32)
    };
    let [left, right] = span(vertices.map(|it| it.x), size.width());
    let [top, bottom] = span(vertices.map(|it| it.y), size.height());
    PixelBox { left, right, top, bottom }
}

/// Clocks of a processing element.
struct Work {
    geometry: u64,
    /// By region.
    regions: Vec<u64>,
}

#[cfg(test)]
mod tests;
