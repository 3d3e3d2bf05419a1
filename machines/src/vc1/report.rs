//! The report of frames: counts, clocks and times, the same in every run.

use std::fmt;

use serde::Serialize;
use tilewright_rtl::clocks::PE;
use tilewright_scenes::Frame;

use super::clocks::Clocks;
use super::config::Built;
use super::job::View;
use super::processor::Tally;
use super::words::POLYGON_WORDS;

/// The report of a run. All numbers are counted in the simulated machine, and none depends on the computer that runs it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The machine.
    pub machine: Built,
    /// Polygons of the scene.
    pub polygons: u32,
    /// Words to load the scene before the first frame: 6 a vertex, 3 a triangle. They are computed, not simulated.
    pub load_words: u64,
    /// T_m in clocks of the merger (VC1-TM).
    pub merge_clocks: u64,
    /// Refreshes of the display that were compared with the frame buffer.
    pub judged: u64,
    /// Events, times and counts that were compared with the [model](super::model) of the machine.
    pub compared: u64,
    /// The frames in their sequence.
    pub frames: Vec<FrameReport>,
}

/// The report of a frame.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct FrameReport {
    /// Triangle packets, after clipping.
    pub packets: u64,
    /// Words on the bus: its command, its scene if that is sent, and polygons for all.
    pub words: u64,
    /// The times of the frame.
    pub times: Times,
    /// Refreshes of the display from the frame before, or from the beginning, until this one is shown.
    pub refreshes: u64,
    /// The numbers of each processing element, from its swap of the frame before to that of this one.
    pub processors: Vec<ProcessorReport>,
}

/// The times of a frame in simulated picoseconds, observed at edges of the processing elements' clock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Times {
    /// The host began to send the command.
    pub command: u64,
    /// All had drawn it: the sync line was high.
    pub drawn: Option<u64>,
    /// The last local frame buffer had swapped.
    pub swapped: Option<u64>,
    /// The global frame buffer had stored it.
    pub merged: Option<u64>,
    /// The global frame buffer had swapped.
    pub shown: Option<u64>,
    /// A refresh of the average began, for the last pass of a picture.
    pub averaged: Option<u64>,
}

/// The numbers of a processing element in a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct ProcessorReport {
    /// Polygons assigned to it.
    pub polygons: u32,
    /// Their clocks expected by the assignment.
    pub expected: u64,
    /// Pixels that it drew.
    pub pixels: u64,
    /// Pages of image memory that the pixels took, since the last overflow if there was one.
    pub pages: u32,
    /// Swaps of its local frame buffer because all pages were taken.
    pub overflows: u64,
    /// Polygons that it sent to all (VC1-APR).
    pub broadcast: u64,
    /// Its clocks.
    pub clocks: Clocks,
}

/// A frame that has been shown for a refresh.
#[derive(Clone, Debug)]
pub struct Shown {
    /// Counted from 0.
    pub number: u32,
    /// The colours that the display got, which are those of the global frame buffer, and its depths.
    pub frame: Frame,
    /// For the last pass of a picture, the displayed average of its passes' colours, with the depths of this pass.
    pub average: Option<Frame>,
    /// Its report.
    pub report: FrameReport,
}

impl Times {
    /// The time at which it was displayed: the frame, or the average of the picture that it ends.
    fn seen(&self) -> Option<u64> {
        self.averaged.or(self.shown)
    }
}

impl ProcessorReport {
    /// The numbers for a view, from the counts of the processing element of that number.
    pub(crate) fn of(view: &View, number: u32, tally: &Tally, pages: u32) -> ProcessorReport {
        ProcessorReport {
            polygons: view.polygons(number).len() as u32,
            expected: view.assignment.loads[number as usize],
            pixels: tally.pixels,
            pages,
            overflows: tally.overflows,
            broadcast: tally.broadcast,
            clocks: tally.clocks,
        }
    }
}

impl FrameReport {
    /// The report for a view and a number of the host's words; those of polygons for all are added.
    pub(crate) fn of(
        view: &View,
        words: u64,
        times: Times,
        refreshes: u64,
        processors: Vec<ProcessorReport>,
    ) -> FrameReport {
        let packets = view.projection.triangles.len() as u64;
        let mut report = FrameReport { packets, words, times, refreshes, processors };
        report.words += report.broadcast() * POLYGON_WORDS as u64;
        report
    }

    /// Simulated picoseconds from the command until the frame is shown, or the average of the picture that it ends.
    pub fn picoseconds(&self) -> u64 {
        self.times.seen().map_or(0, |seen| seen - self.times.command)
    }

    /// Drawn pixels; a pixel counts each time.
    pub fn pixels(&self) -> u64 {
        self.processors.iter().map(|it| it.pixels).sum()
    }

    /// Swaps because all pages were taken.
    pub fn overflows(&self) -> u64 {
        self.processors.iter().map(|it| it.overflows).sum()
    }

    /// Polygons sent to all.
    pub fn broadcast(&self) -> u64 {
        self.processors.iter().map(|it| it.broadcast).sum()
    }

    /// The balance of the work: the mean of the processing elements' busy clocks over the greatest, from 0 to 1.
    pub fn balance(&self) -> f64 {
        let busy = || self.processors.iter().map(|it| it.clocks.busy());
        let most = busy().max().unwrap_or(0).max(1) * self.processors.len() as u64;
        busy().sum::<u64>() as f64 / most as f64
    }

    /// Clocks in which a pixel waited at the port of a local frame buffer, per drawn pixel.
    pub fn stalls_per_pixel(&self) -> f64 {
        let stalls: u64 = self.processors.iter().map(|it| it.clocks.stalled).sum();
        stalls as f64 / self.pixels().max(1) as f64
    }

    fn write_row(&self, number: usize, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Times { command, drawn, swapped, merged, shown, .. } = self.times;
        write!(f, "{number:>5} {:>8} {:>8}", self.packets, self.pixels())?;
        for time in [Some(command), drawn, swapped, merged, shown] {
            write!(f, " {:>9.3}", milliseconds(time.unwrap_or_default()))?;
        }
        writeln!(f, " {:>9} {:>9} {:>9} {:>8}", self.refreshes, self.overflows(), self.broadcast(), self.words)
    }
}

fn milliseconds(picoseconds: u64) -> f64 {
    picoseconds as f64 / 1e9
}

impl Report {
    /// Simulated picoseconds from the beginning until the last frame is shown, or the last average.
    pub fn picoseconds(&self) -> u64 {
        self.frames.last().and_then(|frame| frame.times.seen()).unwrap_or_default()
    }

    /// The clocks of each processing element in all frames.
    fn clocks(&self) -> Vec<Clocks> {
        let mut sums = vec![Clocks::default(); self.machine.processors as usize];
        for frame in &self.frames {
            sums.iter_mut().zip(&frame.processors).for_each(|(sum, it)| *sum += it.clocks);
        }
        sums
    }

    fn write_frames(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:>5} {:>8} {:>8}", "frame", "packets", "pixels")?;
        for time in ["command", "drawn", "swapped", "merged", "shown ms"] {
            write!(f, " {time:>9}")?;
        }
        writeln!(f, " {:>9} {:>9} {:>9} {:>8}", "refreshes", "overflows", "broadcast", "words")?;
        (1..).zip(&self.frames).try_for_each(|(number, frame)| frame.write_row(number, f))
    }

    /// The times at which averages of several frames were shown.
    fn write_pictures(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let passes = self.machine.passes as usize;
        for (number, averaged) in (1..).zip(&self.frames).filter_map(|(at, it)| Some((at, it.times.averaged?))) {
            let (first, time) = (number + 1 - passes, milliseconds(averaged));
            writeln!(f, "The average of frames {first} to {number} is on display from {time:.3} ms on.")?;
        }
        Ok(())
    }

    fn write_processors(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:>3}", "PE")?;
        Clocks::NAMES.iter().try_for_each(|name| write!(f, " {name:>9}"))?;
        writeln!(f)?;
        for (number, clocks) in self.clocks().iter().enumerate() {
            write!(f, "{number:>3}")?;
            clocks.all().iter().try_for_each(|clocks| write!(f, " {clocks:>9}"))?;
            writeln!(f)?;
        }
        let mean = |of: &dyn Fn(&FrameReport) -> f64| {
            self.frames.iter().map(of).sum::<f64>() / self.frames.len().max(1) as f64
        };
        write!(f, "The load is {:.1} % balanced; a pixel stalls for ", 100.0 * mean(&FrameReport::balance))?;
        write!(f, "{:.3} clocks on average.", mean(&FrameReport::stalls_per_pixel))
    }

    /// Nothing, if there was no circuit.
    fn write_compared(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.compared {
            0 => Ok(()),
            events => write!(f, "\nThe model has the same {events} events, times and counts."),
        }
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Built { width, height, processors, patch, patches, pages, cluster, word_clocks, apr, .. } = self.machine;
        writeln!(f, "VC-1, n = {processors}: {width}x{height} pixels, {patches} patches of {patch}x{patch},")?;
        write!(f, "{pages} pages in each local frame buffer, clusters of {cluster} polygons")?;
        match apr {
            Some(threshold) => writeln!(f, ", those above {threshold} pixels drawn by all")?,
            None => writeln!(f)?,
        }
        let load = milliseconds(self.load_words * u64::from(word_clocks) * PE.period.picoseconds());
        let loaded = if self.machine.immediate { "sent anew for each frame" } else { "loaded" };
        writeln!(
            f,
            "{} polygons, {loaded} in {load:.1} ms; T_m is {} merge clocks\n",
            self.polygons, self.merge_clocks
        )?;
        self.write_frames(f)?;
        self.write_pictures(f)?;
        writeln!(f, "\nclocks of each processing element")?;
        self.write_processors(f)?;
        self.write_compared(f)
    }
}

#[cfg(test)]
mod tests;
