//! A front end that makes instructions while others are executed.

use std::collections::HashSet;

use super::Works;
use crate::pixelflow::costs::Ticks;

/// A place in a program, and the tick from which on the instructions there are available.
pub(in crate::pixelflow) type Mark = (usize, Ticks);

impl Works {
    /// The front end of each rasterizer begins to make instructions in a tick, and takes this time for each primitive, in the sequence in which they are first needed.
    pub(super) fn make_one_by_one(&mut self, begin: impl Fn(&Works, usize) -> Ticks, each: Ticks) {
        for rasterizer in 0..self.shares() {
            let mut made = begin(self, rasterizer);
            let mut seen = HashSet::new();
            for (marks, starts) in self.marks[rasterizer].iter_mut().zip(&self.starts[rasterizer]) {
                // They are stored for other samples and other regions.
                for (place, _) in starts.iter().filter(|(_, primitive)| seen.insert(*primitive)) {
                    made += each;
                    marks.push((*place, made));
                }
            }
            self.made = self.made.max(made);
        }
    }
}
