//! What a generator did with packets: the same of the model and of the hardware, so that they can be compared.

use crate::quadtree::stages::Stages;
use crate::quadtree::windows::Window;
use serde::Serialize;
use std::ops::AddAssign;
use tilewright_scenes::Polygon;

/// Packets in the order in which a geometry processor sends them.
///
/// ```
/// use tilewright_machines::quadtree::model::Packets;
///
/// let (polygons, pauses) = (Vec::new(), [0, 7]);
/// // The second one is offered 8 clocks after the first was taken, the others as soon as they can be.
/// let packets = Packets { polygons: &polygons, pauses: &pauses };
/// assert_eq!(packets.pause(1), 7);
/// assert_eq!(packets.pause(2), 0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Packets<'a> {
    /// What is sent.
    pub polygons: &'a [Polygon],
    /// Clocks in which nothing is offered, before each of them; those that are missing are 0.
    pub pauses: &'a [u64],
}

impl<'a> Packets<'a> {
    /// All packets without pauses.
    pub fn at_once(polygons: &'a [Polygon]) -> Packets<'a> {
        Packets { polygons, pauses: &[] }
    }

    /// Clocks in which nothing is offered before a packet.
    pub fn pause(&self, packet: usize) -> u64 {
        self.pauses.get(packet).copied().unwrap_or(0)
    }
}

/// What a unit did, in clocks.
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

/// What a video processor did.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Processor {
    /// The set-up, and then the raster processor by level, from 1 to n.
    pub units: Vec<Counts>,
    /// Pixels that it drew, each as often as it did.
    pub fragments: u64,
}

/// What a generator did with packets. Clocks are counted from the first on in which the first packet could be offered.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Run {
    /// The clock in which each packet was taken from the geometry processor.
    pub taken: Vec<u64>,
    /// Clocks until the generator was idle.
    pub clocks: u64,
    /// What the broadcast did: packets that all have, and clocks in which one waited until all had room.
    pub broadcast: Counts,
    /// The video processors, row by row of the matrix.
    pub processors: Vec<Processor>,
}

impl Run {
    /// Packets in a clock, on the mean over the run: P of MPG-EQ8 and MPG-EQ9 as it came about.
    pub fn rate(&self) -> f64 {
        self.taken.len() as f64 / self.clocks as f64
    }

    /// The set-up's part of the clocks in which it worked, and that of each level, on the mean over all video processors. Of a tree it
    /// is that of all its units together, and so may be above 1.
    pub fn load(&self) -> Vec<f64> {
        self.mean(|counts| counts.busy)
    }

    /// The same of the clocks in which a result waited.
    pub fn stalled(&self) -> Vec<f64> {
        self.mean(|counts| counts.stalled)
    }

    /// Windows of each level, from 0 to n, that a packet has in a video processor, on the mean.
    pub fn windows(&self) -> Vec<f64> {
        let all = (self.taken.len() * self.processors.len()) as f64;
        self.sums(|counts| counts.results).map(|sum| sum as f64 / all).collect()
    }

    /// The time of work on a packet on each level, from 1 to n, in a video processor, on the mean: t_i of MPG-EQ5, in t_e of so many
    /// clocks.
    pub fn stages(&self, test: u32) -> Stages {
        let all = self.taken.len() as f64 * (u64::from(test) * self.processors.len() as u64) as f64;
        Stages::new(self.sums(|counts| counts.busy).skip(1).map(|sum| sum as f64 / all).collect())
    }

    /// How many numbers are not those of another run: the clocks, the clock of each packet, and all counters.
    pub fn differences(&self, other: &Run) -> u64 {
        let (mut one, mut other) = (self.numbers(), other.numbers());
        std::iter::from_fn(|| match (one.next(), other.next()) {
            (None, None) => None,
            (one, other) => Some(u64::from(one != other)),
        })
        .sum()
    }

    /// All of its numbers, packets last, so that one more or less of these is one difference.
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

    /// Of each unit, over all video processors.
    fn sums(&self, of: fn(&Counts) -> u64) -> impl Iterator<Item = u64> {
        let units = self.processors.first().map_or(0, |processor| processor.units.len());
        (0..units).map(move |unit| self.processors.iter().map(|processor| of(&processor.units[unit])).sum())
    }
}

/// A window in a unit.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Visit {
    /// 0 is the set-up; else the level of the window's quarters.
    pub unit: u32,
    /// The number of its packet.
    pub packet: u32,
    /// The window that is divided; of the set-up, the one that it makes.
    pub window: Window,
    /// The clock in which it was taken; of the set-up, the one before its first.
    pub taken: u64,
    /// The clocks in which results went.
    pub sent: Vec<u64>,
    /// The last clock of the work on it.
    pub ended: u64,
}
