//! What a frame took: counts and clocks, the same on every run.

use std::fmt;

use serde::Serialize;

use tilewright_rtl::clocks::PE;

use super::config::Built;
use super::program::Work;

/// The report of a frame. Everything in it is counted in the simulated machine; nothing depends on the computer that runs it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Report {
    /// The machine.
    pub machine: Built,
    /// Polygons of the scene.
    pub polygons: u32,
    /// Triangle packets, after clipping.
    pub packets: u64,
    /// Pixels drawn, each as often as it was drawn.
    pub pixels: u64,
    /// What each processing element did.
    pub processors: Vec<ProcessorReport>,
    /// The frame's phases, one after another.
    pub phases: Vec<Phase>,
    /// T_m in clocks of the merger (VC1-TM).
    pub merge_clocks: u64,
}

/// What a processing element did.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct ProcessorReport {
    /// Polygons assigned to it.
    pub polygons: u32,
    /// Clocks that the assignment expected them to take.
    pub expected: u64,
    /// Pixels that it drew.
    pub pixels: u64,
    /// Pages of image memory that they took, since the last overflow if there was one.
    pub pages: u32,
    /// Clocks of its program.
    pub work: Work,
    /// Clocks for which it waited for its local frame buffer.
    pub stalls: u64,
    /// Swaps of its local frame buffer because all pages were taken.
    pub overflows: u64,
    /// Clocks for which it waited for these swaps.
    pub overflow_waits: u64,
    /// Clocks for which it waited for the others.
    pub waiting: u64,
}

/// A part of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Phase {
    /// What the machine did, such as `drawing`.
    pub name: &'static str,
    /// Clocks of the processing elements.
    pub pe_clocks: u64,
    /// Clocks of the merger.
    pub merge_clocks: u64,
    /// Simulated time.
    pub picoseconds: u64,
}

impl Phase {
    /// Simulated milliseconds.
    pub fn milliseconds(&self) -> f64 {
        self.picoseconds as f64 / 1e9
    }
}

impl Report {
    /// The name of the phase in which the host reads the picture; it is not part of the frame's time.
    pub const READ_OUT: &'static str = "reading out";

    /// Simulated picoseconds from the command to draw until the picture can be displayed.
    pub fn frame_picoseconds(&self) -> u64 {
        self.phases.iter().filter(|phase| phase.name != Report::READ_OUT).map(|phase| phase.picoseconds).sum()
    }

    /// Clock edges that were simulated, of both clocks.
    pub fn clocks(&self) -> u64 {
        self.phases.iter().map(|phase| phase.pe_clocks + phase.merge_clocks).sum()
    }

    /// How evenly the work was shared: the mean of the processing elements' busy clocks over the greatest, from 0 to 1.
    pub fn balance(&self) -> f64 {
        let busy = || self.processors.iter().map(|processor| processor.work.total() + processor.stalls);
        let most = busy().max().unwrap_or(0).max(1) * self.processors.len() as u64;
        busy().sum::<u64>() as f64 / most as f64
    }

    /// Clocks for which a pixel waited at the port of a local frame buffer, per pixel drawn.
    pub fn stalls_per_pixel(&self) -> f64 {
        let stalls: u64 = self.processors.iter().map(|processor| processor.stalls).sum();
        stalls as f64 / self.pixels.max(1) as f64
    }

    fn write_phases(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:14} {:>11} {:>13} {:>10}", "phase", "PE clocks", "merge clocks", "ms")?;
        for phase in &self.phases {
            let Phase { name, pe_clocks, merge_clocks, .. } = phase;
            writeln!(f, "{name:14} {pe_clocks:>11} {merge_clocks:>13} {:>10.3}", phase.milliseconds())?;
        }
        let frame = self.frame_picoseconds() as f64 / 1e9;
        writeln!(f, "The frame takes {frame:.3} ms before it is read out; T_m is {} merge clocks.", self.merge_clocks)
    }

    fn write_processors(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:>2} {:>9} {:>9} {:>6} {:>10} {:>10} {:>8} {:>10}",
            "PE", "polygons", "pixels", "pages", "geometry", "raster", "stalls", "waiting"
        )?;
        for (number, it) in self.processors.iter().enumerate() {
            let ProcessorReport { polygons, pixels, pages, stalls, waiting, .. } = it;
            let Work { geometry, rasterization, .. } = it.work;
            writeln!(
                f,
                "{number:>2} {polygons:>9} {pixels:>9} {pages:>6} {geometry:>10} {rasterization:>10} {stalls:>8} {waiting:>10}"
            )?;
        }
        let overflows: u64 = self.processors.iter().map(|it| it.overflows).sum();
        if overflows > 0 {
            let waits: u64 = self.processors.iter().map(|it| it.overflow_waits).sum();
            let milliseconds = waits as f64 * PE.period.picoseconds() as f64 / 1e9;
            writeln!(
                f,
                "All pages were taken {overflows} times; the processing elements waited for {milliseconds:.3} ms in all."
            )?;
        }
        write!(f, "The load is {:.1} % balanced; a pixel stalls for ", 100.0 * self.balance())?;
        write!(f, "{:.3} clocks on average.", self.stalls_per_pixel())
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Built { width, height, processors, patch, patches, pages, cluster, .. } = self.machine;
        writeln!(f, "VC-1, n = {processors}: {width}x{height} pixels, {patches} patches of {patch}x{patch},")?;
        writeln!(f, "{pages} pages in each local frame buffer, clusters of {cluster} polygons")?;
        writeln!(f, "{} polygons, {} packets, {} pixels drawn\n", self.polygons, self.packets, self.pixels)?;
        self.write_phases(f)?;
        writeln!(f)?;
        self.write_processors(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vc1::config::Config;
    use tilewright_scenes::Size;

    /// Two processing elements: one works for 100 clocks and stalls for 20, the other works for 60.
    fn report() -> Report {
        let config = Config { processors: 2, ..Config::new(Size::VGA) };
        let busy = ProcessorReport {
            polygons: 4,
            expected: 90,
            pixels: 30,
            pages: 2,
            work: Work { clear: 10, geometry: 40, rasterization: 50 },
            stalls: 20,
            overflows: 0,
            overflow_waits: 0,
            waiting: 0,
        };
        let idle = ProcessorReport {
            polygons: 3,
            expected: 60,
            pixels: 10,
            pages: 1,
            work: Work { clear: 10, geometry: 20, rasterization: 30 },
            stalls: 0,
            overflows: 0,
            overflow_waits: 0,
            waiting: 60,
        };
        let phase = |name, pe_clocks, merge_clocks, picoseconds| Phase { name, pe_clocks, merge_clocks, picoseconds };
        Report {
            machine: config.built().expect("can be built"),
            polygons: 7,
            packets: 8,
            pixels: 40,
            processors: vec![busy, idle],
            phases: vec![
                phase("drawing", 120, 37, 3_000_000_000),
                phase("merging", 200, 64, 5_500_000_000),
                phase(Report::READ_OUT, 9, 3, 700_000_000),
            ],
            merge_clocks: 64,
        }
    }

    #[test]
    fn a_frame_ends_before_it_is_read_out() {
        let report = report();
        assert_eq!(report.frame_picoseconds(), 8_500_000_000);
        assert_eq!(report.phases[1].milliseconds(), 5.5);
        assert_eq!(report.clocks(), 120 + 37 + 200 + 64 + 9 + 3);
    }

    #[test]
    fn the_load_is_balanced_by_the_busiest() {
        let mut report = report();
        assert_eq!(report.balance(), (120.0 + 60.0) / (2.0 * 120.0));
        assert_eq!(report.stalls_per_pixel(), 0.5);
        report.pixels = 0;
        assert_eq!(report.stalls_per_pixel(), 20.0, "without pixels, all stalls");
        report.processors.iter_mut().for_each(|it| (it.work, it.stalls) = (Work::default(), 0));
        assert_eq!(report.balance(), 0.0, "nothing to share");
    }

    #[test]
    fn it_reads_as_tables() {
        assert_eq!(
            report().to_string(),
            "VC-1, n = 2: 640x480 pixels, 19200 patches of 4x4,\n\
             4096 pages in each local frame buffer, clusters of 32 polygons\n\
             7 polygons, 8 packets, 40 pixels drawn\n\
             \n\
             phase            PE clocks  merge clocks         ms\n\
             drawing                120            37      3.000\n\
             merging                200            64      5.500\n\
             reading out              9             3      0.700\n\
             The frame takes 8.500 ms before it is read out; T_m is 64 merge clocks.\n\
             \n\
             PE  polygons    pixels  pages   geometry     raster   stalls    waiting\n \
              0         4        30      2         40         50       20          0\n \
              1         3        10      1         20         30        0         60\n\
             The load is 75.0 % balanced; a pixel stalls for 0.500 clocks on average."
        );
    }
}
