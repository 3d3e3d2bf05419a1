//! The report of a frame: primitives, regions and clocks, the same in every run.

use serde::Serialize;
use std::fmt;
use tilewright_rtl::pixel_planes::PERIOD;

use super::bin::Work;
use super::clocks::{ProgramClocks, Tally};
use super::config::Built;
use super::geometry::GeometryReport;
use super::model::{RegionTiming, RendererTiming, RingTiming, Starved, Timing};

/// The report of a frame. All numbers are counted in the simulated machine, and none depends on the computer that runs it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The machine.
    pub machine: Built,
    /// Primitives of the scene, P.
    pub primitives: u64,
    /// The clocks of the geometry processors.
    pub geometry: GeometryReport,
    /// The regions in the sequence in which they were drawn: those with most primitives come first.
    pub regions: Vec<RegionReport>,
    /// The numbers of each renderer.
    pub renderers: Vec<RendererReport>,
    /// The clocks of the drawn primitives, by program.
    pub programs: Vec<ProgramClocks>,
    /// The traffic on the ring.
    pub ring: RingReport,
    /// The first wait of a renderer for an instruction, if there was one.
    pub first_starved: Option<StarvedReport>,
    /// Clocks until the last primitive was drawn.
    pub drawn: u64,
    /// Clocks until the last region was sent to the frame buffer.
    pub sent: u64,
}

/// The numbers of a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct RegionReport {
    /// Its number, counted line by line from the upper left.
    pub region: usize,
    /// The renderer that drew it.
    pub renderer: usize,
    /// Primitives in its bin.
    pub primitives: u64,
    /// Those of them that no edge, and no outline of a sphere, excludes from it.
    pub drawn: u64,
    /// The clock in which the renderer got it.
    pub begun: u64,
    /// Clocks until the renderer could get another region.
    pub clocks: u64,
    /// Clocks of them in which it could have begun its next instruction, which had not arrived.
    pub starved: u64,
    /// Clocks in which it could not save the region, because the one before was not sent yet.
    pub waited_for_store: u64,
}

/// The numbers of a renderer.
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
    /// Clocks of them in which it could have begun its next instruction, which had not arrived.
    pub starved: u64,
    /// Clocks in which it could not save its region, because the one before was not sent yet.
    pub waited_for_store: u64,
}

impl RendererReport {
    /// Clocks in which it had a region and did not wait.
    pub fn working(&self) -> u64 {
        self.busy - self.starved - self.waited_for_store
    }
}

/// The traffic on the ring.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RingReport {
    /// Instructions to renderers.
    pub instructions: u64,
    /// Planes to the frame buffer, each a bit of all pixels of a line.
    pub planes: u64,
    /// The bits of both.
    pub bits: u64,
    /// Clocks of these bits, one after another.
    pub clocks: u64,
    /// The bits over what the ring's rate brings until the last one. It is slightly above 1 if the initial credit pays for some.
    pub load: f64,
}

/// A kind of unit that works on a frame while others work on it or on the next one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// The geometry processors.
    Geometry,
    /// The renderers.
    Renderers,
    /// The ring.
    Ring,
    /// The frame buffer, which takes a plane in a clock.
    FrameBuffer,
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Unit::Geometry => "geometry",
            Unit::Renderers => "renderers",
            Unit::Ring => "ring",
            Unit::FrameBuffer => "frame buffer",
        })
    }
}

/// The working time of a kind of unit for a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Busy {
    /// The kind.
    pub unit: Unit,
    /// Clocks of the unit that works longest, without waiting.
    pub clocks: u64,
}

/// A renderer's wait for an instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct StarvedReport {
    /// The renderer.
    pub renderer: usize,
    /// The clock.
    pub clock: u64,
}

impl Report {
    pub(super) fn new(
        machine: Built,
        primitives: usize,
        geometry: GeometryReport,
        works: &[Work],
        timing: &Timing,
    ) -> Report {
        let region = |(work, timing): (&Work, &RegionTiming)| {
            let [primitives, drawn] = work.primitives;
            let &RegionTiming { renderer, given, free, starved, waited_for_store } = timing;
            RegionReport {
                region: work.region,
                renderer,
                primitives,
                drawn,
                begun: given,
                clocks: free - given,
                starved,
                waited_for_store,
            }
        };
        let renderer = |it: &RendererTiming| {
            let sum = |which: usize| it.regions.iter().map(|&region| works[region].primitives[which]).sum();
            let &RendererTiming { busy, starved, waited_for_store, .. } = it;
            let regions = it.regions.len() as u64;
            RendererReport { regions, primitives: sum(0), drawn: sum(1), busy, starved, waited_for_store }
        };
        let mut programs = Tally::default();
        works.iter().for_each(|work| programs.add(work.programs));
        let RingTiming { instructions, planes, bits, rate, .. } = timing.ring;
        let clocks = bits.div_ceil(rate);
        Report {
            machine,
            primitives: primitives as u64,
            geometry,
            regions: works.iter().zip(&timing.regions).map(region).collect(),
            renderers: timing.renderers.iter().map(renderer).collect(),
            programs: programs.used().collect(),
            ring: RingReport { instructions, planes, bits, clocks, load: timing.ring.load() },
            first_starved: timing.first_starved.map(|Starved { renderer, clock }| StarvedReport { renderer, clock }),
            drawn: timing.drawn,
            sent: timing.sent,
        }
    }

    /// Simulated picoseconds until the last region was sent.
    pub fn picoseconds(&self) -> u64 {
        self.sent * PERIOD.picoseconds()
    }

    /// The working time of each kind of unit for the frame.
    pub fn busy(&self) -> [Busy; 4] {
        let renderers = self.renderers.iter().map(RendererReport::working).max().unwrap_or(0);
        [
            (Unit::Geometry, self.geometry.clocks),
            (Unit::Renderers, renderers),
            (Unit::Ring, self.ring.clocks),
            (Unit::FrameBuffer, self.ring.planes),
        ]
        .map(|(unit, clocks)| Busy { unit, clocks })
    }

    /// The kind of unit that limits the rate of frames: the one that works longest.
    pub fn limit(&self) -> Busy {
        self.busy().into_iter().max_by_key(|it| it.clocks).expect("there are four kinds")
    }

    /// Clocks from a frame to the next one. The geometry of a frame overlaps with drawing and sending the one before.
    pub fn interval(&self) -> u64 {
        self.geometry.clocks.max(self.sent)
    }

    /// Clocks from the beginning of a frame's geometry until it is sent.
    pub fn latency(&self) -> u64 {
        self.geometry.clocks + self.sent
    }

    /// Pixels that processors tested: the whole region for each drawn primitive, because all processors execute the same instruction.
    pub fn tested(&self) -> u64 {
        let drawn: u64 = self.regions.iter().map(|it| it.drawn).sum();
        drawn * u64::from(self.machine.side).pow(2)
    }

    /// Primitives in all bins; a primitive counts once for each of its bins.
    pub fn binned(&self) -> u64 {
        self.regions.iter().map(|it| it.primitives).sum()
    }

    /// Primitives of the busiest renderer, P_w (PP5-UT).
    pub fn worst_load(&self) -> u64 {
        self.renderers.iter().map(|it| it.primitives).max().unwrap_or(0)
    }

    /// N, the clocks for each drawn primitive. They include the clocks of regions without primitives, and exclude waiting (PP5-UT).
    pub fn clocks_per_primitive(&self) -> f64 {
        let drawn: u64 = self.renderers.iter().map(|it| it.drawn).sum();
        self.renderers.iter().map(RendererReport::working).sum::<u64>() as f64 / drawn.max(1) as f64
    }

    /// Mean working clocks of the renderers over those of the busiest one, from 0 to 1.
    pub fn balance(&self) -> f64 {
        let working = || self.renderers.iter().map(RendererReport::working);
        let most = working().max().unwrap_or(0).max(1) * self.renderers.len() as u64;
        working().sum::<u64>() as f64 / most as f64
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Built {
            width, height, renderers, side, queue, ring, strict, side_by_side, edges, quadratic, geometry, ..
        } = self.machine;
        let tree = if quadratic { " with quadratic trees" } else { "" };
        writeln!(f, "pixel-planes-5, {renderers} renderers of {side}x{side} pixels{tree}: {width}x{height} pixels,")?;
        let rule = if strict { "strict" } else { "the least word stays" };
        let manner = if side_by_side { "side by side" } else { "one at a time" };
        let edges = match edges {
            "least" => "as least half-planes",
            "own" => "in their own lengths",
            _ => "in one length",
        };
        writeln!(f, "{rule}, edges {edges}, instructions {manner},")?;
        writeln!(f, "queues of {queue} instructions, a ring of {ring} Mbit/s, {geometry} geometry processors")?;
        let (regions, binned) = (self.regions.len(), self.binned());
        writeln!(f, "{} primitives, {binned} in the bins of {regions} regions\n", self.primitives)?;

        writeln!(
            f,
            "{:9} {:>8} {:>11} {:>8} {:>10} {:>7} {:>8} {:>8}",
            "renderer", "regions", "primitives", "drawn", "busy", "load", "starved", "sending"
        )?;
        for (number, it) in self.renderers.iter().enumerate() {
            let load = 100.0 * it.working() as f64 / self.drawn.max(1) as f64;
            let RendererReport { regions, primitives, drawn, busy, starved, waited_for_store } = it;
            writeln!(
                f,
                "{number:<9} {regions:>8} {primitives:>11} {drawn:>8} {busy:>10} {load:>5.1} % {starved:>8} {waited_for_store:>8}"
            )?;
        }
        writeln!(f, "Starved: waiting for instructions; sending: waiting until the region before is sent.")?;
        writeln!(f, "The load of the renderers is {:.1} % balanced.\n", 100.0 * self.balance())?;

        writeln!(f, "{:13} {:>8} {:>7} {:>7}", "program", "drawn", "N mean", "N most")?;
        for it in &self.programs {
            let ProgramClocks { program, primitives, most, .. } = it;
            writeln!(f, "{program:<13} {primitives:>8} {:>7.1} {most:>7}", it.mean())?;
        }
        writeln!(f, "N is the clocks from a primitive's first operation to the next one's.\n")?;

        writeln!(
            f,
            "{:9} {:>8} {:>11} {:>8} {:>10} {:>9} {:>8} {:>8}",
            "region", "renderer", "primitives", "drawn", "clocks", "begun", "starved", "sending"
        )?;
        for it in &self.regions {
            let RegionReport { region, renderer, primitives, drawn, begun, clocks, starved, waited_for_store } = it;
            writeln!(
                f,
                "{region:<9} {renderer:>8} {primitives:>11} {drawn:>8} {clocks:>10} {begun:>9} {starved:>8} {waited_for_store:>8}"
            )?;
        }
        self.write_ring(f)?;
        writeln!(
            f,
            "A drawn primitive takes {:.1} clocks, including those of regions without primitives.",
            self.clocks_per_primitive()
        )?;
        writeln!(
            f,
            "All is drawn after {} clocks, {:.3} ms, and sent after {}, {:.3} ms.",
            self.drawn,
            ms(self.drawn),
            self.sent,
            ms(self.sent)
        )?;
        self.write_geometry(f)
    }
}

/// The milliseconds of a number of clocks.
fn ms(clocks: u64) -> f64 {
    (clocks * PERIOD.picoseconds()) as f64 / 1e9
}

impl Report {
    /// The time of geometry, and the limit of the rate of frames.
    fn write_geometry(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let (processors, GeometryReport { transform, set_up, binning, clocks }) =
            (self.machine.geometry, self.geometry);
        let share = |of: u64| 100.0 * of as f64 / self.geometry.total().max(1) as f64;
        writeln!(
            f,
            "Geometry takes {clocks} clocks, {:.3} ms, of the busiest of {processors} processors:",
            ms(clocks)
        )?;
        writeln!(
            f,
            "{:.1} % transformation, {:.1} % set-up, {:.1} % binning. That of the next frame runs while this one is drawn.",
            share(transform),
            share(set_up),
            share(binning)
        )?;
        let (interval, latency) = (ms(self.interval()), ms(self.latency()));
        writeln!(f, "So a frame is sent every {interval:.3} ms, {latency:.3} ms after its geometry began.")?;
        let busy = self.busy().map(|Busy { unit, clocks }| format!("{unit} {clocks}"));
        write!(f, "The {} limits the rate of frames: busy clocks are {}.", self.limit().unit, busy.join(", "))
    }

    /// The traffic on the ring, and whether a renderer had to wait for it.
    fn write_ring(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let RingReport { instructions, planes, load, .. } = self.ring;
        let load = 100.0 * load;
        writeln!(f, "The ring brought {instructions} instructions and {planes} planes: it was loaded to {load:.1} %.")?;
        match self.first_starved {
            None => writeln!(f, "No renderer had to wait for an instruction."),
            Some(StarvedReport { renderer, clock }) => {
                writeln!(f, "Renderer {renderer} was the first to wait for an instruction, in clock {clock}.")
            }
        }
    }
}
