//! All regions in the pixels' memory at once. Nothing is sorted, and the frame is composed when it is completely drawn.
//!
//! Several samples are drawn one after another. The node of the frame buffer adds them up in its own pixels, 6 bytes in each of 40 regions. With
//! the last sample it writes the frame's memory.

use serde::Serialize;
use std::ops::Range;

use super::after;
use crate::pixelflow::costs::Ticks;
use crate::pixelflow::workload::{Place, Workload};

/// A frame of that system.
#[derive(Clone, Debug)]
pub struct Resident<'a> {
    /// The primitives.
    pub workload: &'a Workload,
    /// The time before a node's first primitive.
    pub overhead: Ticks,
    /// The front end's time for a primitive, just before it is first drawn.
    pub transforms: Ticks,
    /// Samples of a pixel, one after another.
    pub samples: usize,
    /// Words of a region on the network, with their set-up.
    pub composes: Ticks,
    /// Loading a region into the frame buffer's memory.
    pub loads: Ticks,
}

/// The times of one sample of all pixels.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Pass {
    /// When each rasterizer had drawn it.
    pub rasterized: Vec<Ticks>,
    /// When all regions were on the network.
    pub composed: Range<Ticks>,
    /// When the node of the frame buffer had the last region, and for the last pass, had written it.
    pub loaded: Ticks,
}

impl Resident<'_> {
    /// Runs the frame. Returns the passes.
    ///
    /// ```
    /// use tilewright_machines::pixelflow::{Resident, Workload};
    ///
    /// // Two regions with three primitives each, which take the front end longer than the array.
    /// let workload = Workload::balanced(4, 2, 3, 10);
    /// let frame = Resident { workload: &workload, overhead: 7, transforms: 12, samples: 2, composes: 20, loads: 30 };
    /// let [first, last] = <[_; 2]>::try_from(frame.run()).unwrap();
    /// assert_eq!((first.rasterized[0], first.composed), (7 + 6 * 12 + 10, 89..129));
    /// // Again from memory, when the pixels are free.
    /// assert_eq!((last.rasterized[0], last.composed), (129 + 6 * 10, 189..229));
    /// assert_eq!(last.loaded, 189 + 20 + 2 * 30);
    /// ```
    pub fn run(&self) -> Vec<Pass> {
        let first = self.workload.shares.iter().map(|share| {
            let (mut made, mut time) = (self.overhead, 0);
            for places in share.iter() {
                made += self.transforms;
                time = made.max(time) + all(places);
            }
            time.max(made)
        });
        let mut rasterized: Vec<Ticks> = first.collect();
        let drawn: Vec<Ticks> = self.workload.shares.iter().map(|share| share.iter().map(all).sum::<Ticks>()).collect();
        let mut written = 0;
        (0..self.samples)
            .map(|pass| {
                let loads = if pass + 1 == self.samples { self.loads } else { 0 };
                let begin = rasterized.iter().copied().max().unwrap_or(0);
                let mut network = begin;
                for _ in 0..self.workload.regions {
                    network += self.composes;
                    written = after([network, written], loads).end;
                }
                let next = drawn.iter().map(|drawn| network + drawn).collect();
                let rasterized = std::mem::replace(&mut rasterized, next);
                Pass { rasterized, composed: begin..network, loaded: written }
            })
            .collect()
    }
}

/// A primitive in all its regions.
fn all(places: &[Place]) -> Ticks {
    places.iter().map(|place| place.draws).sum()
}
