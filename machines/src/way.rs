//! The way of a pixel through a machine: the primitives that reached it, and what each unit did with them, beside what it should have done.
//!
//! A machine with a [`Follower`] finds it while it renders. Without one, nothing is kept of a pixel.

use std::sync::{Arc, Mutex, PoisonError};

/// A pixel that is asked about, and the place for its way through the last frame that a machine rendered. Clones share it.
#[derive(Clone, Debug)]
pub struct Follower {
    /// The column and the row, from the upper left corner.
    pub pixel: [u32; 2],
    way: Arc<Mutex<Option<Way>>>,
}

impl Follower {
    /// One of that column and row.
    pub fn new(pixel: [u32; 2]) -> Follower {
        Follower { pixel, way: Arc::default() }
    }

    /// Takes the way of the pixel through the last frame.
    pub fn take(&self) -> Option<Way> {
        self.way.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    pub(crate) fn put(&self, way: Way) {
        *self.way.lock().unwrap_or_else(PoisonError::into_inner) = Some(way);
    }
}

/// The way of a pixel through a machine.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Way {
    /// The primitives that cover the pixel in the golden image or in the machine, in the sequence of submission.
    pub primitives: Vec<Primitive>,
    /// What units did for the pixel, by time.
    pub steps: Vec<Step>,
}

/// A primitive that reached the pixel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Primitive {
    /// Its number in the sequence of submission.
    pub number: usize,
    /// Its name, such as `triangle 12`.
    pub name: String,
    /// The word that the golden image draws for it; `None` if it does not cover the pixel there.
    pub golden: Option<u64>,
    /// The word that the machine drew for it; `None` if it drew none.
    pub hardware: Option<u64>,
    /// Whether it is the one that the golden image shows.
    pub wins: bool,
}

/// What a unit did for the pixel at an edge of its clock.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// The number of the primitive, if it is about one alone.
    pub primitive: Option<usize>,
    /// The unit, such as `merging unit 3`.
    pub unit: String,
    /// The block of the catalogue that the unit is, such as `merging-unit`.
    pub block: &'static str,
    /// What it did, such as `compares two pixels and passes the nearer one`.
    pub does: String,
    /// The name of its clock.
    pub clock: String,
    /// The number of that clock's edge.
    pub cycle: u64,
    /// The time in picoseconds from the beginning of the run.
    pub time: u64,
    /// The net whose value it is, as a waveform names it.
    pub net: Option<String>,
    /// The values of the step.
    pub values: Vec<Compared>,
    /// Where the step is simulated, if units are simulated one by one.
    pub apart: Option<Apart>,
}

/// A unit that is simulated by itself, at some time of its simulation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Apart {
    /// The unit, such as `rasterizer 3`.
    pub unit: String,
    /// The time in picoseconds. Clocks in which nothing happens may be left out, so it is not the time of the machine.
    pub time: u64,
}

/// A value of the hardware beside the one that a plain model gives for the same inputs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Compared {
    /// What it is, such as `depth`.
    pub what: &'static str,
    /// The hardware's, as it is shown.
    pub hardware: String,
    /// The model's, as it is shown; `None` if there is nothing to compare it with.
    pub golden: Option<String>,
}

impl Compared {
    /// Whether the hardware's value is another one than the model's.
    pub fn differs(&self) -> bool {
        self.golden.as_ref().is_some_and(|golden| *golden != self.hardware)
    }
}

impl Step {
    /// Whether one of its values is another one than the model's.
    pub fn differs(&self) -> bool {
        self.values.iter().any(Compared::differs)
    }
}

impl Way {
    /// The first step in time that differs.
    pub fn first_difference(&self) -> Option<&Step> {
        self.steps.iter().filter(|step| step.differs()).min_by_key(|step| step.time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(time: u64, hardware: &str, golden: Option<&str>) -> Step {
        let values =
            vec![Compared { what: "depth", hardware: hardware.to_owned(), golden: golden.map(ToOwned::to_owned) }];
        let (unit, does, clock) = ("PE 3".to_owned(), "draws".to_owned(), "clk".to_owned());
        Step { primitive: None, unit, block: "pe", does, clock, cycle: time / 10, time, net: None, values, apart: None }
    }

    #[test]
    fn the_first_difference_is_the_earliest() {
        let steps =
            vec![step(10, "1", Some("1")), step(20, "7", None), step(40, "2", Some("3")), step(30, "4", Some("5"))];
        let way = Way { primitives: Vec::new(), steps };
        assert_eq!(way.first_difference().map(|step| step.time), Some(30));
        assert_eq!(Way::default().first_difference(), None);
    }
}
