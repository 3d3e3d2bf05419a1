//! The region-based machine of Table 1 (VC1-T1): the screen in m x n regions, drawn and merged one after another.
//!
//! The paper simulated it too; there is no circuit of it. A processing element does all of its geometry, with the classification of each
//! polygon by regions. Then it draws region after region into one of its b buffers. It may begin region r when region r - b is merged. A
//! region is merged T_m / (m n) after all have drawn it and the one before is merged.

use super::{Dealt, Model};
use crate::vc1::Clocks;

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

/// A frame of a region-based machine, which begins when the one before is merged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RegionFrame {
    /// By processing element: its clocks of geometry and of rasterization, and those in which it waited (`sync`), for a buffer or for the end
    /// of the frame.
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
    pub fn by_regions(&self, _machine: &Regions, _view: &Dealt) -> RegionFrame {
        todo!("under way")
    }
}
