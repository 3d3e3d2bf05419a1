//! The report as tables.

use std::fmt;

use super::{Report, Stage};
use crate::quadtree::config::Built;

impl Report {
    fn write_machine(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Built { width, height, p, q, ref form, test, edges, aperture, strict, .. } = self.machine;
        let Built { broadcast_queue, packet_queue, window_queue, .. } = self.machine;
        writeln!(f, "quadtree generator, {p}x{q} video processors of {form}: {width}x{height} pixels,")?;
        write!(f, "{test} tests of up to {edges} edges, ")?;
        if aperture > 0 {
            write!(f, "an aperture of {aperture}, ")?;
        }
        if strict {
            write!(f, "strict, ")?;
        }
        writeln!(f, "queues of {broadcast_queue} and {packet_queue} packets and {window_queue} windows")?;
        writeln!(f, "{} packets, {} fragments", self.packets, self.fragments)
    }

    fn write_phases(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:14} {:>11} {:>10}", "phase", "clocks", "ms")?;
        for phase in &self.phases {
            writeln!(f, "{:14} {:>11} {:>10.3}", phase.name, phase.clocks, phase.picoseconds as f64 / 1e9)?;
        }
        writeln!(
            f,
            "A packet takes {:.2} clocks of drawing; the broadcast waited for {} clocks.",
            self.clocks_per_packet(),
            self.broadcast_stalls
        )
    }

    fn write_windows(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:12} {:>10} {:>10} {:>8} {:>8}", "stage", "tests", "windows", "least", "most")?;
        for stage in &self.stages {
            let Stage { tests, windows, .. } = stage;
            let name = stage.name();
            writeln!(f, "{name:12} {:>10} {:>10} {:>8} {:>8}", tests.all, windows.all, windows.least, windows.most)?;
        }
        writeln!(f, "Least and most are the windows of one video processor; each has four tests on the next level.")
    }

    fn write_clocks(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:12} {:>10} {:>8} {:>8} {:>10} {:>8} {:>7} {:>7}",
            "stage", "busy", "least", "most", "stalled", "most", "load", "most"
        )?;
        for stage in &self.stages {
            let Stage { busy, stalled, load, .. } = stage;
            let name = stage.name();
            let [load, most] = load.map(|load| 100.0 * load);
            writeln!(
                f,
                "{name:12} {:>10} {:>8} {:>8} {:>10} {:>8} {load:>5.1} % {most:>5.1} %",
                busy.all, busy.least, busy.most, stalled.all, stalled.most
            )?;
        }
        write!(f, "The load of the video processors is {:.1} % balanced.", 100.0 * self.balance())
    }
}

impl Stage {
    /// How a report calls it.
    pub(in crate::quadtree) fn name(&self) -> String {
        match self.level {
            0 => self.unit.to_owned(),
            level if self.units == 1 => format!("{level} {}", self.unit),
            level => format!("{level} {} x {}", self.unit, self.units),
        }
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write_machine(f)?;
        writeln!(f)?;
        self.write_phases(f)?;
        writeln!(f)?;
        self.write_windows(f)?;
        writeln!(f)?;
        self.write_clocks(f)
    }
}
