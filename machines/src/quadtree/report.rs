//! The report of a frame: windows, tests and clocks, the same in every run.

use serde::Serialize;
use tilewright_rtl::quadtree::raster::{Form, Part};

use super::config::Built;

mod text;

/// The report of a frame. All numbers are counted in the simulated machine, and none depends on the computer that runs it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The machine.
    pub machine: Built,
    /// Packets that were sent.
    pub packets: u64,
    /// Drawn pixels; a pixel counts each time.
    pub fragments: u64,
    /// Clocks in which a packet of the broadcast waited for space in all video processors.
    pub broadcast_stalls: u64,
    /// The set-up, then the levels 1 to n, each over all video processors.
    pub stages: Vec<Stage>,
    /// The numbers of each video processor, row by row of the matrix.
    pub processors: Vec<ProcessorReport>,
    /// The frame's phases, one after another.
    pub phases: Vec<Phase>,
}

/// The numbers of a video processor.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ProcessorReport {
    /// The set-up, and then the levels 1 to n.
    pub units: Vec<UnitReport>,
    /// Pixels that it drew.
    pub fragments: u64,
}

/// The numbers of a level's units, or of the set-up, in a video processor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct UnitReport {
    /// Windows that passed; for the set-up, the polygons' root windows.
    pub windows: u64,
    /// Clocks in which they worked.
    pub busy: u64,
    /// Clocks in which they had a window that was not taken.
    pub stalled: u64,
}

/// A stage of the raster processors, or the set-up before them, in the whole matrix.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stage {
    /// Its level; 0 is the set-up.
    pub level: u32,
    /// Its kind, such as `pipe`.
    pub unit: &'static str,
    /// Units that work in parallel on this level in each video processor; one unit works on all levels of a `stack`.
    pub units: u32,
    /// Coverage tests: four for each window of the level above.
    pub tests: Spread,
    /// Windows that passed.
    pub windows: Spread,
    /// Clocks in which units worked.
    pub busy: Spread,
    /// Clocks in which a unit had a window that was not taken.
    pub stalled: Spread,
    /// The mean share of busy clocks of its units in the clocks of drawing, and the greatest share of a video processor.
    pub load: [f64; 2],
}

/// A number over all video processors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Spread {
    /// The sum.
    pub all: u64,
    /// The least number of a video processor.
    pub least: u64,
    /// The greatest number of a video processor.
    pub most: u64,
}

/// A part of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Phase {
    /// The machine's activity, such as `drawing`.
    pub name: &'static str,
    /// Its clocks.
    pub clocks: u64,
    /// Simulated time.
    pub picoseconds: u64,
}

impl Report {
    /// The name of the phase in which packets are sent and drawn.
    pub const DRAWING: &'static str = "drawing";
    /// The name of the phase in which the banks are swapped and the picture is read.
    pub const READ_OUT: &'static str = "reading out";

    pub(crate) fn new(
        machine: Built,
        form: &Form,
        packets: usize,
        processors: Vec<ProcessorReport>,
        broadcast_stalls: u64,
        phases: Vec<Phase>,
    ) -> Report {
        let mut report = Report {
            machine,
            packets: packets as u64,
            fragments: processors.iter().map(|it| it.fragments).sum(),
            broadcast_stalls,
            stages: Vec::new(),
            processors,
            phases,
        };
        let units = units(form);
        report.stages = (0..).zip(units).map(|(level, (unit, units))| report.stage(level, unit, units)).collect();
        report
    }

    /// Clocks in which packets were sent and drawn.
    pub fn drawing_clocks(&self) -> u64 {
        self.phases.iter().filter(|phase| phase.name == Report::DRAWING).map(|phase| phase.clocks).sum()
    }

    /// Clocks of drawing for each packet.
    pub fn clocks_per_packet(&self) -> f64 {
        self.drawing_clocks() as f64 / self.packets.max(1) as f64
    }

    /// Mean busy clocks of the video processors over those of the busiest one, from 0 to 1.
    pub fn balance(&self) -> f64 {
        let busy = |it: &ProcessorReport| it.units.iter().skip(1).map(|unit| unit.busy).sum::<u64>();
        let most = self.processors.iter().map(busy).max().unwrap_or(0).max(1) * self.processors.len() as u64;
        self.processors.iter().map(busy).sum::<u64>() as f64 / most as f64
    }

    fn stage(&self, level: usize, unit: &'static str, units: u32) -> Stage {
        let spread = |of: &dyn Fn(&[UnitReport]) -> u64| {
            let counts = || self.processors.iter().map(|it| of(&it.units));
            let (least, most) = (counts().min().unwrap_or(0), counts().max().unwrap_or(0));
            Spread { all: counts().sum(), least, most }
        };
        let busy = spread(&|it| it[level].busy);
        let clocks = (self.drawing_clocks().max(1) * u64::from(units)) as f64;
        Stage {
            level: level as u32,
            unit,
            units,
            tests: spread(&|it| level.checked_sub(1).map_or(0, |above| 4 * it[above].windows)),
            windows: spread(&|it| it[level].windows),
            busy,
            stalled: spread(&|it| it[level].stalled),
            load: [busy.all as f64 / (clocks * self.processors.len() as f64), busy.most as f64 / clocks],
        }
    }
}

/// The set-up and each level: its kind, and the number of parallel units.
fn units(form: &Form) -> Vec<(&'static str, u32)> {
    let mut units = vec![("set-up", 1)];
    for part in form.parts() {
        match *part {
            Part::Stack(levels) => units.extend((0..levels).map(|_| ("stack", 1))),
            Part::Pipe(levels) => units.extend((0..levels).map(|_| ("pipe", 1))),
            Part::Tree(levels) => units.extend((0..levels).map(|level| ("tree", 4_u32.pow(level)))),
        }
    }
    units
}

#[cfg(test)]
mod tests;
