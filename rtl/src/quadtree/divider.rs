//! The ports of blocks that divide windows: a raster processor, and each of its parts (MPG-RP).

use super::format::{Format, Work};
use super::tally::Tally;
use crate::prelude::*;

record! {
    /// The windows to divide.
    pub struct DividerIn(format: Format) {
        /// Windows with their polygons.
        works: stream(Work::widths(format)),
    }

    /// The results of the divisions.
    pub struct DividerOut(format: Format, levels: u32) {
        /// The parts of the windows that the polygon may cover; after the last division, single samples.
        parts: stream(Work::widths(format)),
        /// No window is under way.
        idle: bit(),
        /// The counters of each level, from the first.
        tally: [Tally; levels],
    }
}
