//! What a frame took.

use serde::Serialize;

use super::config::Config;
use super::costs::{Ticks, milliseconds, ticks};
use super::model::Done;
use super::works::Works;

/// What a frame took.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Nodes, with the one that holds the frame.
    pub nodes: u32,
    /// Those that rasterized.
    pub rasterizers: usize,
    /// Those that shaded.
    pub shaders: usize,
    /// Pixels of an array along x and y.
    pub array: [u32; 2],
    /// Primitives, and of these how many were drawn in a region, over all regions.
    pub primitives: usize,
    /// Likewise.
    pub drawn: usize,
    /// The front end of the rasterizer with most primitives, by the paper's cost of each, in ticks: behind it the others begin.
    pub front: Ticks,
    /// Clocks in which each rasterizer's array had an instruction.
    pub busy: Vec<u64>,
    /// When each region was where, in ticks of 5 ns after the front end.
    pub turns: Vec<Done>,
}

impl Report {
    pub(super) fn new(config: &Config, works: &Works, turns: Vec<Done>, busy: Vec<u64>) -> Report {
        let costs = &config.costs;
        let transforms = if works.is_shaded() { costs.transform } else { costs.transform_plain };
        let most = works.primitives.iter().copied().max().unwrap_or(0) as f64;
        Report {
            nodes: config.nodes,
            rasterizers: works.shares(),
            shaders: if works.is_shaded() { config.shaders as usize } else { 0 },
            array: config.array,
            primitives: works.primitives.iter().sum(),
            drawn: works.drawn.iter().sum(),
            front: ticks(costs.overhead + transforms * most),
            busy,
            turns,
        }
    }

    /// Ticks from the first instruction to the last region in the frame buffer.
    pub fn ticks(&self) -> Ticks {
        self.turns.last().map_or(0, |last| last.loaded.end)
    }

    /// The same in milliseconds.
    pub fn back(&self) -> f64 {
        milliseconds(self.ticks())
    }
}
