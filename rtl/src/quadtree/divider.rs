//! The ports of blocks that divide windows: a raster processor, and each of its parts (MPG-RP).

use super::format::Work;
use super::tally::Tally;
use crate::prelude::*;

bundle! {
    /// The windows to divide.
    pub struct DividerIn<T> {
        /// Windows with their polygons.
        pub works: Stream<Work<T>, T>,
    }

    /// The results of the divisions.
    pub struct DividerOut<T> {
        /// The parts of the windows that the polygon may cover; divided to the end, the leaves.
        pub parts: Stream<Work<T>, T>,
        /// No window is under way.
        pub idle: T,
        /// The counters of each level, from the first.
        pub tally: Vec<Tally<T>>,
    }
}
