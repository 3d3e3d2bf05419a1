//! All results: counts, runs, losses, frames.

use super::SIZES;
use super::frames::{self, Drawn};
use crate::reproduce::effort::Effort;
use crate::shell::Failure;
use tilewright_machines::quadtree::Point;
use tilewright_machines::quadtree::model::{Measured, Outcome, SweepPoint, WindowSizes};
use tilewright_machines::{Error, Watch};
use tilewright_report::Origin;

/// All results of the page.
pub struct Found {
    pub counted: Counted,
    pub window_sizes: Vec<WindowSizes>,
    pub ran: Ran,
    pub coupled: Coupled,
    pub frames: Vec<Drawn>,
}

impl Found {
    /// Counts, runs and draws; `None` if interrupted.
    pub fn all(effort: Effort, watch: &mut Watch) -> Result<Option<Found>, Failure> {
        let seed = effort.seed;
        let Some(points) = effort.study().run(watch).map_err(Error::from)? else { return Ok(None) };
        let Some(window_sizes) = WindowSizes::measure(10, &SIZES, watch)? else { return Ok(None) };
        let Some(outcomes) = effort.trials().run(watch)? else { return Ok(None) };
        let Some(by_packets) = effort.sweep().run(watch).map_err(Error::from)? else { return Ok(None) };
        let Some(by_windows) = effort.window_sweep().run(watch).map_err(Error::from)? else { return Ok(None) };
        let frames = frames::drawn(effort, watch)?;
        Ok(Some(Found {
            counted: Counted { points, seed },
            window_sizes,
            ran: Ran { outcomes, seed },
            coupled: Coupled { by_packets, by_windows, seed },
            frames,
        }))
    }
}

/// The results of the plain count of windows, and its seed.
pub struct Counted {
    points: Vec<Point>,
    seed: u64,
}

impl Counted {
    pub fn origin(&self) -> Origin {
        Origin::count([self.seed])
    }

    /// The points of the matrix of 2^k x 2^k, by area.
    pub fn of(&self, k: u32) -> impl Iterator<Item = &Point> {
        self.points.iter().filter(move |point| point.matrix.p == 1 << k)
    }

    /// The point of a matrix and an area.
    pub fn at(&self, k: u32, area: f64) -> &Point {
        self.of(k).find(|point| point.sample.area == area).expect("the study has that area")
    }

    /// The areas, each once.
    pub fn areas(&self) -> impl Iterator<Item = f64> {
        self.of(0).map(|point| point.sample.area)
    }

    /// The greatest relative error of the rectangles' mean area, as their corners are snapped.
    pub fn snapping(&self) -> f64 {
        self.of(0).map(|point| (point.area / point.sample.area - 1.0).abs()).fold(0.0, f64::max)
    }
}

/// The runs on the transaction-level model, some of them also on the hardware.
pub struct Ran {
    pub outcomes: Vec<Outcome>,
    seed: u64,
}

impl Ran {
    pub fn model(&self) -> Origin {
        Origin::model([self.seed])
    }

    pub fn rtl(&self) -> Origin {
        Origin::rtl([self.seed])
    }

    fn of(&self, k: u32) -> impl Iterator<Item = &Outcome> {
        self.outcomes.iter().filter(move |outcome| outcome.matrix.p == 1 << k)
    }

    /// A quantity of the matrix of 2^k x 2^k by area, on the model.
    pub fn on_model(&self, k: u32, of: impl Fn(&Measured) -> f64) -> Vec<(f64, f64)> {
        self.of(k).map(|outcome| (outcome.sample.area, of(&outcome.model))).collect()
    }

    /// The same on the hardware.
    pub fn on_hardware(&self, k: u32, of: impl Fn(&Measured) -> f64) -> Vec<(f64, f64)> {
        let point = |outcome: &Outcome| Some((outcome.sample.area, of(&outcome.hardware.as_ref()?.measured)));
        self.of(k).filter_map(point).collect()
    }
}

/// The loss with queues of some depths.
pub struct Coupled {
    by_packets: Vec<SweepPoint>,
    by_windows: Vec<SweepPoint>,
    seed: u64,
}

impl Coupled {
    pub fn origin(&self) -> Origin {
        Origin::model([self.seed])
    }

    /// The areas, each once.
    pub fn areas(&self) -> Vec<f64> {
        let mut areas: Vec<f64> = self.by_packets.iter().map(|point| point.sample.area).collect();
        areas.dedup();
        areas
    }

    /// The loss of a matrix by the depth of its packet queues.
    pub fn loss(&self, k: u32, form: &str, area: f64) -> Vec<(f64, f64)> {
        let is_it = |it: &&SweepPoint| it.matrix.p == 1 << k && it.form == form && it.sample.area == area;
        let by_depth = self.by_packets.iter().filter(is_it).flat_map(|point| &point.by_depth);
        by_depth.map(|it| (f64::from(it.packets), it.loss)).collect()
    }

    /// The mean share of the clocks in which the slowest level of the pipes is idle, by the depth of their window queues.
    pub fn idling(&self, k: u32) -> Vec<(f64, f64)> {
        let points = self.by_windows.iter().filter(|it| it.matrix.p == 1 << k);
        let idling = |point: &SweepPoint| {
            let slowest = point.by_depth[0].load.iter().skip(1).copied().fold(0.0, f64::max);
            (f64::from(point.windows), 1.0 - slowest)
        };
        points.map(idling).collect()
    }
}
