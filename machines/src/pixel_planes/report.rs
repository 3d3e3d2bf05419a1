//! What a frame took: primitives, regions and clocks, the same on every run.

use serde::Serialize;
use std::fmt;
use tilewright_rtl::pixel_planes::PERIOD;

use super::clocks::{ProgramClocks, Tally};
use super::config::Built;

/// The report of a frame. Everything in it is counted in the simulated machine; nothing depends on the computer that runs it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The machine.
    pub machine: Built,
    /// Primitives of the scene, P.
    pub primitives: u64,
    /// The regions, in the order in which they were drawn: those with most primitives first.
    pub regions: Vec<RegionReport>,
    /// What each renderer did.
    pub renderers: Vec<RendererReport>,
    /// The clocks of the primitives drawn, by the programs that drew any.
    pub programs: Vec<ProgramClocks>,
    /// Clocks until the last primitive was drawn.
    pub drawn: u64,
    /// Clocks until the last region was sent to the frame buffer.
    pub sent: u64,
}

/// What became of a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct RegionReport {
    /// Its number, counted line by line from the upper left.
    pub region: usize,
    /// The renderer that drew it.
    pub renderer: usize,
    /// Primitives in its bin.
    pub primitives: u64,
    /// Those of them that an edge does not keep out of it.
    pub drawn: u64,
    /// The clock in which the renderer got it.
    pub begun: u64,
    /// Clocks until the renderer could be given another one.
    pub clocks: u64,
    /// Those of its primitives.
    #[serde(skip)]
    pub programs: Tally,
}

/// What a renderer did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct RendererReport {
    /// Regions.
    pub regions: u64,
    /// Primitives in their bins.
    pub primitives: u64,
    /// Primitives drawn.
    pub drawn: u64,
    /// Clocks in which it had a region.
    pub busy: u64,
}

impl Report {
    pub(super) fn new(machine: Built, primitives: usize, regions: Vec<RegionReport>, sent: u64) -> Report {
        let mut renderers = vec![RendererReport::default(); machine.renderers as usize];
        let mut programs = Tally::default();
        for it in &regions {
            programs.add(it.programs);
            let renderer = &mut renderers[it.renderer];
            renderer.regions += 1;
            renderer.primitives += it.primitives;
            renderer.drawn += it.drawn;
            renderer.busy += it.clocks;
        }
        let drawn = regions.iter().map(|it| it.begun + it.clocks).max().unwrap_or(0);
        let programs = programs.used().collect();
        Report { machine, primitives: primitives as u64, regions, renderers, programs, drawn, sent }
    }

    /// Simulated picoseconds until the last region was sent.
    pub fn picoseconds(&self) -> u64 {
        self.sent * PERIOD.picoseconds()
    }

    /// Primitives in all bins: each as often as it is in one.
    pub fn binned(&self) -> u64 {
        self.regions.iter().map(|it| it.primitives).sum()
    }

    /// Primitives of the renderer with the most of them, P_w (PP5-UT).
    pub fn worst_load(&self) -> u64 {
        self.renderers.iter().map(|it| it.primitives).max().unwrap_or(0)
    }

    /// Clocks for each primitive drawn, N, with what a region takes by itself in them (PP5-UT).
    pub fn clocks_per_primitive(&self) -> f64 {
        let drawn: u64 = self.renderers.iter().map(|it| it.drawn).sum();
        self.renderers.iter().map(|it| it.busy).sum::<u64>() as f64 / drawn.max(1) as f64
    }

    /// Busy clocks of all renderers in parts of those that they would have if all were as busy as the busiest, from 0 to 1.
    pub fn balance(&self) -> f64 {
        let most = self.renderers.iter().map(|it| it.busy).max().unwrap_or(0).max(1) * self.renderers.len() as u64;
        self.renderers.iter().map(|it| it.busy).sum::<u64>() as f64 / most as f64
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Built { width, height, renderers, side, queue, strict, side_by_side, edges, .. } = self.machine;
        writeln!(f, "pixel-planes-5, {renderers} renderers of {side}x{side} pixels: {width}x{height} pixels,")?;
        let rule = if strict { "strict" } else { "the least word stays" };
        let manner = if side_by_side { "side by side" } else { "one at a time" };
        let edges = match edges {
            "least" => "as least half-planes",
            "own" => "in their own lengths",
            _ => "in one length",
        };
        writeln!(f, "{rule}, edges {edges}, instructions {manner}, queues of {queue} instructions")?;
        let (regions, binned) = (self.regions.len(), self.binned());
        writeln!(f, "{} primitives, {binned} in the bins of {regions} regions\n", self.primitives)?;

        writeln!(
            f,
            "{:9} {:>8} {:>11} {:>8} {:>10} {:>7}",
            "renderer", "regions", "primitives", "drawn", "busy", "load"
        )?;
        for (number, it) in self.renderers.iter().enumerate() {
            let load = 100.0 * it.busy as f64 / self.drawn.max(1) as f64;
            let RendererReport { regions, primitives, drawn, busy } = it;
            writeln!(f, "{number:<9} {regions:>8} {primitives:>11} {drawn:>8} {busy:>10} {load:>5.1} %")?;
        }
        writeln!(f, "The load of the renderers is {:.1} % balanced.\n", 100.0 * self.balance())?;

        writeln!(f, "{:13} {:>8} {:>7} {:>7}", "program", "drawn", "N mean", "N most")?;
        for it in &self.programs {
            let ProgramClocks { program, primitives, most, .. } = it;
            writeln!(f, "{program:<13} {primitives:>8} {:>7.1} {most:>7}", it.mean())?;
        }
        writeln!(f, "N is the clocks from a primitive's first operation to the next one's.\n")?;

        writeln!(
            f,
            "{:9} {:>8} {:>11} {:>8} {:>10} {:>9}",
            "region", "renderer", "primitives", "drawn", "clocks", "begun"
        )?;
        for it in &self.regions {
            let RegionReport { region, renderer, primitives, drawn, begun, clocks, .. } = it;
            writeln!(f, "{region:<9} {renderer:>8} {primitives:>11} {drawn:>8} {clocks:>10} {begun:>9}")?;
        }
        let ms = |clocks: u64| (clocks * PERIOD.picoseconds()) as f64 / 1e9;
        writeln!(
            f,
            "A primitive that is drawn takes {:.1} clocks, with what a region takes by itself.",
            self.clocks_per_primitive()
        )?;
        write!(
            f,
            "All is drawn after {} clocks, {:.3} ms, and sent after {}, {:.3} ms.",
            self.drawn,
            ms(self.drawn),
            self.sent,
            ms(self.sent)
        )
    }
}
