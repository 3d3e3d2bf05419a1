//! What was measured, as a table and for programs.

use serde::Serialize;
use std::fmt;

/// A number for each time that the form of a report changes.
pub const FORMAT: u32 = 1;

/// All that was measured.
#[derive(Debug, Clone, Serialize)]
pub struct Report {
    /// [`FORMAT`].
    pub format: u32,
    /// The versions of Verilator and clang, if they took part.
    pub verilator: Option<Versions>,
    /// Runs of each simulator; times are medians over them.
    pub rounds: u32,
    /// By design.
    pub designs: Vec<Measurement>,
}

/// What the models were made with.
#[derive(Debug, Clone, Serialize)]
pub struct Versions {
    /// Such as `5.048`.
    pub verilator: String,
    /// Such as `19.1.7`.
    pub clang: String,
}

/// A design in all simulators.
#[derive(Debug, Clone, Serialize)]
pub struct Measurement {
    /// The name of a [`Subject`](crate::Subject).
    pub design: String,
    /// The cycles of each run.
    pub cycles: u64,
    /// How many of them a frame takes, in a design that draws frames.
    pub frame_cycles: Option<u64>,
    /// What all runs ended with, 8 hexadecimal digits.
    pub checksum: String,
    /// By simulator, ours first.
    pub simulators: Vec<Figures>,
}

/// A design in a simulator.
#[derive(Debug, Clone, Serialize)]
pub struct Figures {
    /// Its name, and what it runs.
    pub simulator: String,
    /// The median; of several stimuli at once, for a cycle of one of them.
    pub ns_per_cycle: f64,
    /// Of the fastest run.
    pub least_ns_per_cycle: f64,
    /// Of the slowest run.
    pub most_ns_per_cycle: f64,
    /// What it took to make a program of the design, if it was.
    pub build_seconds: Option<f64>,
    /// From a description or Verilog to the end of the first cycle, building included.
    pub first_cycle_seconds: f64,
    /// How many times as long as in the first simulator a cycle takes.
    pub ratio: f64,
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let names = self.designs.iter().flat_map(|design| &design.simulators).map(|it| it.simulator.len());
        let wide = names.max().unwrap_or_default();
        let first = self.designs.iter().map(|it| it.design.len()).chain(["design".len()]).max().unwrap_or_default();
        writeln!(f, "{:first$}  {:wide$}  ns a cycle   spread  first cycle    ratio", "design", "simulator")?;
        for design in &self.designs {
            for (number, figures) in design.simulators.iter().enumerate() {
                let name = if number == 0 { design.design.as_str() } else { "" };
                let Figures { simulator, ns_per_cycle, least_ns_per_cycle, most_ns_per_cycle, .. } = figures;
                let spread = (most_ns_per_cycle - least_ns_per_cycle) / ns_per_cycle * 100.0;
                let (ready, ratio) = (Seconds(figures.first_cycle_seconds).to_string(), figures.ratio);
                let digits = if ratio < 10.0 { 3 } else { 1 };
                writeln!(
                    f,
                    "{name:first$}  {simulator:wide$}  {ns_per_cycle:10.1}  {spread:5.0} %  {ready:>11}  {ratio:7.digits$}"
                )?;
            }
        }
        writeln!(f, "\nMedians of {} alternating runs; the ratio is to the first simulator of a design.", self.rounds)?;
        if self.designs.iter().any(|it| it.design.contains('*')) {
            writeln!(f, "Of several stimuli at once, the time is for a cycle of one of them.")?;
        }
        for Measurement { design, cycles, frame_cycles, checksum, simulators } in &self.designs {
            write!(f, "{design}: {cycles} cycles, checksum {checksum}")?;
            if let (Some(frame), [first, ..]) = (frame_cycles, simulators.as_slice()) {
                let time = Seconds(*frame as f64 * first.ns_per_cycle / 1e9);
                write!(f, "; a frame takes {frame} cycles, which is {time} in the first simulator")?;
            }
            writeln!(f)?;
        }
        if let Some(Versions { verilator, clang }) = &self.verilator {
            writeln!(f, "Verilator {verilator}, clang {clang}")?;
        }
        Ok(())
    }
}

/// A time for people.
struct Seconds(f64);

impl fmt::Display for Seconds {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.0 {
            seconds if seconds >= 1.0 => write!(f, "{seconds:.1} s"),
            seconds => write!(f, "{:.2} ms", seconds * 1e3),
        }
    }
}
