//! The record of a generator's run, the same for the model and for the hardware, so that they can be compared.

use crate::quadtree::stages::Stages;
use crate::quadtree::windows::Window;
use serde::Serialize;
use std::ops::AddAssign;
use tilewright_scenes::Polygon;

/// Packets in the sequence in which a geometry processor sends them.
///
/// ```
/// use tilewright_machines::quadtree::model::Packets;
///
/// let (polygons, pauses) = (Vec::new(), [0, 7]);
/// // The second packet is offered 8 clocks after the first was taken, the others as soon as possible.
/// let packets = Packets { polygons: &polygons, pauses: &pauses };
/// assert_eq!(packets.pause(1), 7);
/// assert_eq!(packets.pause(2), 0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Packets<'a> {
    /// The packets.
    pub polygons: &'a [Polygon],
    /// Clocks without an offer before each of them; missing pauses are 0.
    pub pauses: &'a [u64],
}

impl<'a> Packets<'a> {
    /// All packets without pauses.
    pub fn at_once(polygons: &'a [Polygon]) -> Packets<'a> {
        Packets { polygons, pauses: &[] }
    }

    /// Clocks without an offer before a packet.
    pub fn pause(&self, packet: usize) -> u64 {
        self.pauses.get(packet).copied().unwrap_or(0)
    }
}

/// The counters of a unit, in clocks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Clocks in which it worked.
    pub busy: u64,
    /// Clocks in which it had a result that was not taken.
    pub stalled: u64,
    /// Results.
    pub results: u64,
}

impl AddAssign for Counts {
    fn add_assign(&mut self, other: Counts) {
        self.busy += other.busy;
        self.stalled += other.stalled;
        self.results += other.results;
    }
}

/// The record of a video processor.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Processor {
    /// The set-up, and then the raster processor by level, from 1 to n.
    pub units: Vec<Counts>,
    /// Pixels that it drew; a pixel counts each time.
    pub fragments: u64,
}

/// The record of a generator's run. Clocks are counted from the first one in which the first packet could be offered.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Run {
    /// The clock in which each packet was taken from the geometry processor.
    pub taken: Vec<u64>,
    /// Clocks until the generator was idle.
    pub clocks: u64,
    /// The counters of the broadcast: packets that all have received, and clocks in which one waited for space in all queues.
    pub broadcast: Counts,
    /// The video processors, row by row of the matrix.
    pub processors: Vec<Processor>,
}

impl Run {
    /// Mean packets per clock over the run: the observed P of MPG-EQ8 and MPG-EQ9.
    pub fn rate(&self) -> f64 {
        self.taken.len() as f64 / self.clocks as f64
    }

    /// The mean share of the clocks in which the set-up worked, and that of each level, over all video processors. For a tree it is the sum
    /// over all its units, which may be above 1.
    pub fn load(&self) -> Vec<f64> {
        self.mean(|counts| counts.busy)
    }

    /// The same for the clocks in which a result waited.
    pub fn stalled(&self) -> Vec<f64> {
        self.mean(|counts| counts.stalled)
    }

    /// Mean number of windows of a packet in a video processor, for each level from 0 to n.
    pub fn windows(&self) -> Vec<f64> {
        let all = (self.taken.len() * self.processors.len()) as f64;
        self.sums(|counts| counts.results).map(|sum| sum as f64 / all).collect()
    }

    /// The mean working time for a packet in a video processor, for each level from 1 to n: t_i of MPG-EQ5, in t_e of that number of
    /// clocks.
    pub fn stages(&self, test: u32) -> Stages {
        let all = self.taken.len() as f64 * (u64::from(test) * self.processors.len() as u64) as f64;
        Stages::new(self.sums(|counts| counts.busy).skip(1).map(|sum| sum as f64 / all).collect())
    }

    /// The number of differences from another run: in the clocks, the clock of each packet, and all counters.
    pub fn differences(&self, other: &Run) -> u64 {
        let (mut one, mut other) = (self.numbers(), other.numbers());
        std::iter::from_fn(|| match (one.next(), other.next()) {
            (None, None) => None,
            (one, other) => Some(u64::from(one != other)),
        })
        .sum()
    }

    /// All of its numbers. Packets come last, so that one packet more or less is one difference.
    pub(super) fn numbers(&self) -> impl Iterator<Item = u64> {
        let of = |Counts { busy, stalled, results }: &Counts| [*busy, *stalled, *results];
        let of_processor = move |it: &Processor| it.units.iter().flat_map(of).chain([it.fragments]).collect::<Vec<_>>();
        let processors = self.processors.iter().flat_map(of_processor);
        [self.clocks].into_iter().chain(of(&self.broadcast)).chain(processors).chain(self.taken.iter().copied())
    }

    fn mean(&self, of: fn(&Counts) -> u64) -> Vec<f64> {
        let all = self.clocks as f64 * self.processors.len() as f64;
        self.sums(of).map(|sum| sum as f64 / all).collect()
    }

    /// A mean for each unit over all video processors.
    fn sums(&self, of: fn(&Counts) -> u64) -> impl Iterator<Item = u64> {
        let units = self.processors.first().map_or(0, |processor| processor.units.len());
        (0..units).map(move |unit| self.processors.iter().map(|processor| of(&processor.units[unit])).sum())
    }
}

/// A window in a unit.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Visit {
    /// 0 for the set-up; otherwise the level of the window's quarters.
    pub unit: u32,
    /// The number of its packet.
    pub packet: u32,
    /// The window that is divided; for the set-up, the one that it makes.
    pub window: Window,
    /// The clock in which it was taken; for the set-up, the one before its first.
    pub taken: u64,
    /// The clocks in which results were sent.
    pub sent: Vec<u64>,
    /// The last clock of the work on it.
    pub ended: u64,
}
