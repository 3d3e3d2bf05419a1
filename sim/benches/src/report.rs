//! The results, as a table and for programs.

use serde::Serialize;
use std::fmt;

/// The version of the report's format.
pub const FORMAT: u32 = 2;

/// All results.
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

/// The tools that made the models.
#[derive(Debug, Clone, Serialize)]
pub struct Versions {
    /// Such as `5.048`, the newest first.
    pub verilators: Vec<String>,
    /// Such as `19.1.7`.
    pub clang: String,
}

/// A model made by Verilator.
#[derive(Debug, Clone, Serialize)]
pub struct Made {
    /// The version of Verilator.
    pub verilator: String,
    /// Its Verilog: `our Verilog`, or the name of a hand-written file.
    pub verilog: String,
}

/// A design in all simulators.
#[derive(Debug, Clone, Serialize)]
pub struct Measurement {
    /// The name of a [`Subject`](crate::Subject).
    pub design: String,
    /// The cycles of each run.
    pub cycles: u64,
    /// The number of cycles of a frame, in a design that draws frames.
    pub frame_cycles: Option<u64>,
    /// The common result of all runs, 8 hexadecimal digits.
    pub checksum: String,
    /// By simulator, ours first.
    pub simulators: Vec<Figures>,
}

/// A design in a simulator.
#[derive(Debug, Clone, Serialize)]
pub struct Figures {
    /// Its name, and what it runs.
    pub simulator: String,
    /// What made it, if it is a model made by Verilator.
    pub made: Option<Made>,
    /// The median; with several stimuli at once, for a cycle of one of them.
    pub ns_per_cycle: f64,
    /// Of the fastest run.
    pub least_ns_per_cycle: f64,
    /// Of the slowest run.
    pub most_ns_per_cycle: f64,
    /// The time to build a program of the design, if one is built.
    pub build_seconds: Option<f64>,
    /// From a description or Verilog to the end of the first cycle, building included.
    pub first_cycle_seconds: f64,
    /// The time of a cycle, relative to the first simulator.
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
            for (Made { verilator, verilog }, ratio) in faster(simulators) {
                writeln!(f, "  {verilog} is fastest in Verilator {verilator}: {ratio:.2} times")?;
            }
        }
        if let Some(Versions { verilators, clang }) = &self.verilator {
            writeln!(f, "Verilator {}, clang {clang}", verilators.join(" and "))?;
        }
        Ok(())
    }
}

/// For each Verilog of which several Verilators have made models, the fastest one and its ratio.
fn faster(simulators: &[Figures]) -> Vec<(&Made, f64)> {
    let models: Vec<(&Made, f64)> = simulators.iter().filter_map(|it| Some((it.made.as_ref()?, it.ratio))).collect();
    let is_fastest = |(made, ratio): &&(&Made, f64)| {
        let mut same = models.iter().filter(|(other, _)| other.verilog == made.verilog);
        same.clone().count() > 1 && same.all(|(_, other)| ratio <= other)
    };
    models.iter().filter(is_fastest).copied().collect()
}

/// A time for readers.
struct Seconds(f64);

impl fmt::Display for Seconds {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.0 {
            seconds if seconds >= 1.0 => write!(f, "{seconds:.1} s"),
            seconds => write!(f, "{:.2} ms", seconds * 1e3),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figures(verilator: &str, verilog: &str, ratio: f64) -> Figures {
        let made = Made { verilator: verilator.to_owned(), verilog: verilog.to_owned() };
        Figures {
            simulator: format!("Verilator {verilator}, {verilog}"),
            made: Some(made),
            ns_per_cycle: 10.0 * ratio,
            least_ns_per_cycle: 10.0 * ratio,
            most_ns_per_cycle: 10.0 * ratio,
            build_seconds: Some(1.0),
            first_cycle_seconds: 1.0,
            ratio,
        }
    }

    #[test]
    fn the_faster_verilator_is_named_for_each_verilog() {
        let both = |version, ours, by_hand| [figures(version, "our Verilog", ours), figures(version, "pim.v", by_hand)];
        let mut simulators = vec![Figures { made: None, simulator: "ours".to_owned(), ..figures("", "", 1.0) }];
        simulators.extend(both("5.048", 2.0, 0.5));
        let design = Measurement {
            design: "pim16".to_owned(),
            cycles: 100,
            frame_cycles: None,
            checksum: "00000001".to_owned(),
            simulators,
        };
        let mut report = Report { format: FORMAT, verilator: None, rounds: 1, designs: vec![design] };
        assert!(!report.to_string().contains("fastest"), "there is nothing to choose from:\n{report}");
        report.designs[0].simulators.extend(both("5.006", 1.25, 0.75));
        let text = report.to_string();
        let expected = "checksum 00000001
  pim.v is fastest in Verilator 5.048: 0.50 times
  our Verilog is fastest in Verilator 5.006: 1.25 times
";
        assert!(text.ends_with(expected), "{text}");
    }
}
