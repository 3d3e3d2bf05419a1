//! The region-based machine of Table 1 (VC1-T1): the screen in m x n regions, drawn and merged one after another.
//!
//! The paper simulated it too; there is no circuit of it. A processing element does all of its geometry, with the classification of each
//! polygon by regions. Then it draws region after region into one of its b buffers. It may begin region r when region r - b is merged. A
//! region is merged T_m / (m n) after all have drawn it and the one before is merged.
//!
//! A packet is in the regions that its bounding box touches. Its area, clipping and set-up are charged in the first of them, and each row in
//! the first that has it, so what regions cost beside that are the constants of [`Regions`] alone.

use tilewright_rtl::clocks::MERGE;

use super::timing::PE_PERIOD;
use super::{Dealt, Model};
use crate::vc1::Clocks;
use crate::vc1::scan_conversion::{Pixels, Rows};

/// A region-based machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Regions {
    /// Regions side by side: m.
    pub columns: u32,
    /// Regions one below another: n.
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

/// A frame of a region-based machine, from its command on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RegionFrame {
    /// By processing element: its clocks of geometry and of rasterization, and those in which it waited (`sync`), for a buffer or for the last
    /// one to have drawn.
    pub processors: Vec<Clocks>,
    /// Simulated picoseconds until all regions are drawn by all.
    pub drawn: u64,
    /// Simulated picoseconds until the last region is merged.
    pub merged: u64,
}

impl Model {
    /// A frame of a view on a region-based machine of the same processing elements, costs, screen and T_m; no polygon is sent to all.
    ///
    /// # Panics
    /// There is no region, or no buffer.
    pub fn by_regions(&self, machine: &Regions, view: &Dealt) -> RegionFrame {
        assert!(machine.buffers > 0, "a region is drawn into a buffer");
        let count = (machine.columns * machine.rows) as usize;
        let merge_time = self.vc1.gfb().sequencer().merge_clocks() * MERGE.period.picoseconds() / count as u64;
        let work: Vec<Work> = (0..self.config.processors).map(|k| self.work_of(machine, view, k)).collect();
        let mut ends: Vec<u64> = work.iter().map(|work| work.geometry * PE_PERIOD).collect();
        let mut merged: Vec<u64> = Vec::with_capacity(count);
        for region in 0..count {
            let free = region.checked_sub(machine.buffers as usize).map_or(0, |before| merged[before]);
            for (end, work) in ends.iter_mut().zip(&work) {
                // It sees that a buffer is free at an edge of its clock.
                *end = (*end).max(free.next_multiple_of(PE_PERIOD)) + work.regions[region] * PE_PERIOD;
            }
            let drawn = ends.iter().copied().max().unwrap_or_default();
            merged.push(drawn.max(merged.last().copied().unwrap_or_default()) + merge_time);
        }
        let drawn = ends.into_iter().max().unwrap_or_default();
        let clocks = |work: Work| {
            let rasterization = work.regions.iter().sum();
            let sync = drawn / PE_PERIOD - work.geometry - rasterization;
            Clocks { geometry: work.geometry, rasterization, sync, ..Clocks::default() }
        };
        let merged = merged.last().copied().unwrap_or_default();
        RegionFrame { processors: work.into_iter().map(clocks).collect(), drawn, merged }
    }

    /// What a processing element has to do.
    fn work_of(&self, machine: &Regions, Dealt(view): &Dealt, processor: u32) -> Work {
        let (size, costs) = (self.config.size, &self.config.costs);
        let place = |at: u32, side: u32, parts: u32| at * parts / side;
        let (column, row) = (|x| place(x, size.width(), machine.columns), |y| place(y, size.height(), machine.rows));
        let number = |column: u32, row: u32| (row * machine.columns + column) as usize;
        let mut work = Work { geometry: 0, regions: vec![0; number(0, machine.rows)] };
        for polygon in view.polygons(processor) {
            work.geometry += costs.geometry(polygon) + machine.classify;
            let packets = &view.projection.triangles[polygon.packets.clone()];
            // What is off the screen is looked at before the first region.
            let first = packets.first().map_or(0, |packet| number(column(packet.bounds.left), row(packet.bounds.top)));
            work.regions[first] += costs.preparation(polygon);
            for packet in packets {
                let b = packet.bounds;
                let (left, top) = (column(b.left), row(b.top));
                work.regions[number(left, top)] += costs.set_up;
                for row in top..=row(b.bottom) {
                    for column in left..=column(b.right) {
                        let further = if (column, row) == (left, top) { 0 } else { machine.further };
                        work.regions[number(column, row)] += machine.region + further;
                    }
                }
                (b.top..=b.bottom).for_each(|y| work.regions[number(left, row(y))] += costs.row);
                for pixel in Pixels::of(packet, Rows::ALL) {
                    work.regions[number(column(pixel.x), row(pixel.y))] += costs.pixel;
                }
            }
        }
        work
    }
}

/// Clocks of a processing element.
struct Work {
    geometry: u64,
    /// By region.
    regions: Vec<u64>,
}

#[cfg(test)]
mod tests;
