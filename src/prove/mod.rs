//! `tilewright prove`: what a block states is proved, or a run shows that it does not hold.

mod parts;

use crate::block::{BlockArguments, ports};
use crate::number::number;
use crate::shell::output::Waveform;
use crate::shell::{Exit, Failure, terminal};
use clap::Args;
use parts::{Part, statements};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Duration;
use tilewright_hdl::catalog::{Entry, Values};
use tilewright_hdl::ir::Directive;
use tilewright_hdl::{Design, Period};
use tilewright_prove::{Outcome, Run, Stage, Statement};
use tilewright_sim::Simulation;

/// Proves a block's assertions, and searches runs that reach its covers
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright prove fifo
  tilewright prove fifo --set depth=5 --depth 30
  tilewright prove lifo --json
  tilewright prove merging-unit
  tilewright prove round-robin-arbiter --show 2 --ascii -o run.vcd

Yosys makes formulas of the block's Verilog, and Z3 decides them. An assertion is proved by induction over k clocks, fails in a clock, or holds for as
many clocks as were searched. Clock 0 is the first one. Where induction does not suffice, ABC, which comes with Yosys, searches an invariant. A cover is reached in a clock, or never.

Where a block has several clocks, a statement is first proved for edges in any sequence, and so for all periods. If that is impossible, it is proved
or searched with edges at the times of the periods, as in the simulator. All resets come together. A clock is here an instant with an edge.

Inputs and the reset have any value that the block's assumptions allow. So has what starts without a value: registers without a reset, and memories
of unknown contents. A larger --depth searches longer runs, and may prove more.

A harness around a block claims more, such as that a queue keeps the sequence of its words. It has a size of its own, and is proved, too, unless a
parameter is set. --harness proves harnesses alone.

--ascii and -o show a run: of the statement that --show names by its number, or else of the first assertion that fails. The simulator has replayed it.

Exit code 1 means that an assertion fails, or that a cover of the block is never reached; 5 that a statement is not settled. Covers of the blocks inside
are shown, and do not count: the block need not use all that they can do. To prove them, prove those blocks.")]
pub struct Prove {
    #[command(flatten)]
    block: BlockArguments,
    /// The number of clocks to search, and to prove over; a harness has a number of its own
    #[arg(long, value_name = "CLOCKS", default_value_t = 20, value_parser = number(1_u32..=10_000))]
    depth: u32,
    /// Prove only what harnesses around the block claim, not what stands in it
    #[arg(long, conflicts_with = "settings")]
    harness: bool,
    /// End the proof after this number of seconds, with what is known then [default: no limit]
    #[arg(long, value_name = "SECONDS", value_parser = number(1_u64..=1_000_000))]
    seconds: Option<u64>,
    /// Show the run of the statement with this number [default: the first assertion that fails]
    #[arg(long, value_name = "NUMBER")]
    show: Option<usize>,
    /// Print the waves of the ports in the shown run as text
    #[arg(long, conflicts_with = "json")]
    ascii: bool,
    /// Write the waveform of the shown run, a VCD file, or an FST file if the name ends in .fst; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Print the results as JSON
    #[arg(long)]
    json: bool,
}

impl Prove {
    /// Proves, prints what was found, and shows a run.
    pub fn run(self) -> Result<Exit, Failure> {
        let (entry, values) = self.block.find()?;
        let waveform = self.output.as_deref().map(Waveform::at).transpose()?;
        let parts = self.parts(entry, &values)?;
        let shown = self.shown(&parts)?;
        if self.json {
            terminal::print_json(&report(entry, &values, &parts))?;
        } else {
            terminal::print(&parts::text(&parts))?;
        }
        match shown {
            Some((design, run)) => self.show_run(design, run, waveform)?,
            None if self.ascii || waveform.is_some() => {
                terminal::warn("no assertion fails, so there is no run to show: name a statement with --show NUMBER");
            }
            None => {}
        }
        Ok(exit(statements(&parts).map(|(part, it)| (part.design.top().name.as_str(), it))))
    }

    /// The run to show, and the design that it is of.
    fn shown<'a>(&self, parts: &'a [Part]) -> Result<Option<(&'a Design, &'a Run)>, Failure> {
        let run = |(part, statement): (&'a Part, &'a Statement)| match &statement.outcome {
            Outcome::Fails(run) => Some((&part.design, run)),
            _ => None,
        };
        let Some(number) = self.show else {
            return Ok(statements(parts).filter(|(_, it)| it.directive == Directive::Assert).find_map(run));
        };
        let bad = |sentence: String| Err(Failure::new(Exit::BadInput, sentence));
        let count = statements(parts).count();
        match number.checked_sub(1).and_then(|index| statements(parts).nth(index)) {
            None => bad(format!("there is no statement {number}: --show takes a number from 1 to {count}")),
            Some(statement) => match run(statement) {
                None => bad(format!("statement {number} has no run: choose one that fails or is reached")),
                run => Ok(run),
            },
        }
    }

    /// Replays a run and shows its waves.
    fn show_run(&self, design: &Design, run: &Run, waveform: Option<Waveform>) -> Result<(), Failure> {
        if !self.ascii && waveform.is_none() {
            return Ok(());
        }
        let sim = Simulation::from_design(design)?.starting_as(&run.recording);
        let mut sim = sim.map_err(tilewright_sim::Error::from)?;
        let text = self.ascii.then(|| sim.record(ports(&sim)));
        if let Some(waveform) = &waveform {
            let trace = waveform.trace()?;
            waveform.clear()?;
            sim.trace(trace)?;
        }
        // It ends where the assertion fails.
        match sim.replay(&run.recording) {
            Ok(()) | Err(tilewright_sim::Error::Violated(_)) => sim.finish()?,
            Err(error) => return Err(error.into()),
        }
        if let Some(waveform) = waveform {
            waveform.tell_written();
        }
        text.map_or(Ok(()), |text| terminal::print(&format!("\n{text}")))
    }
}

/// The exit code: a statement that fails counts more than one that is not settled. A cover of an inner block does not
/// count.
fn exit<'a>(statements: impl Iterator<Item = (&'a str, &'a Statement)>) -> Exit {
    let counting: Vec<&Statement> = statements.filter(|(top, it)| !is_inner_cover(it, top)).map(|(_, it)| it).collect();
    let mut all = counting.into_iter();
    match all.clone().any(Statement::fails) {
        true => Exit::CheckFailed,
        false if all.any(|it| !it.outcome.is_settled()) => Exit::Undecided,
        false => Exit::Done,
    }
}

/// Whether it is a cover of a block inside: the block around it need not use all of that.
fn is_inner_cover(statement: &Statement, top: &str) -> bool {
    statement.directive == Directive::Cover && statement.module != top
}

/// A line for each statement, with its number from `first` on, and what was not searched.
fn table(Part { harness, design, proof }: &Part, first: usize) -> String {
    let (clocks, top) = (design.top().clocks.len(), &design.top().name);
    let rows: Vec<[String; 5]> = (first..).zip(&proof.statements).map(|(number, it)| row(number, it, clocks)).collect();
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let [number, kind, result, message] = [0, 1, 2, 3].map(width);
    let mut text = String::new();
    for [a, b, c, d, place] in &rows {
        text += &format!("{a:>number$}  {b:kind$}  {c:result$}  {d:message$}  {place}\n");
    }
    if let Some(most) = proof.ends_after {
        let unit = if clocks > 1 { "edges" } else { "clocks" };
        text += &format!("the assumptions allow no run of more than {most} {unit}: nothing later is searched\n");
    }
    if let Some(stage) = proof.late {
        text += &format!("{}\n", late(stage, harness.is_some()));
    }
    let is_unreached = |it: &Statement| is_inner_cover(it, top) && !matches!(it.outcome, Outcome::Fails(_));
    if proof.statements.iter().any(is_unreached) {
        text += &format!(
            "a cover inside that is not reached is no failure: `{top}` may not use all of a block that it contains\n"
        );
    }
    text
}

/// What the time was too short for, and what to do. The size of a harness is its own.
fn late(stage: Stage, is_harness: bool) -> String {
    let (work, remedy) = match stage {
        Stage::Conversion => ("Yosys made formulas of the block", "--set smaller parameters"),
        Stage::Search => ("Z3 searched", "--set smaller parameters"),
        Stage::Invariant => ("ABC searched an invariant", "a larger --depth"),
    };
    let or = if is_harness { String::new() } else { format!(", or {remedy}") };
    format!("the time was over while {work}: give more --seconds{or}")
}

fn row(number: usize, statement: &Statement, clocks: usize) -> [String; 5] {
    let Statement { directive, message, loc, .. } = statement;
    let kind = if *directive == Directive::Cover { "cover" } else { "assert" };
    let place = format!("{}:{}", loc.file(), loc.line());
    [number.to_string(), kind.to_owned(), result(statement, clocks), message.replace('\n', " "), place]
}

/// The result of a statement in words.
fn result(statement: &Statement, clocks: usize) -> String {
    let is_cover = statement.directive == Directive::Cover;
    match &statement.outcome {
        Outcome::Proved { .. } if is_cover => "never reached".to_owned(),
        Outcome::Proved { depth, needs_periods } => {
            let by = depth.map_or_else(|| "invariant".to_owned(), |depth| format!("k = {depth}"));
            format!("proved, {by}{}", if *needs_periods { ", these periods" } else { "" })
        }
        Outcome::Fails(run) => format!("{} {}", if is_cover { "reached" } else { "fails" }, when(run, clocks)),
        Outcome::Holds { clocks: 0 } => "not searched".to_owned(),
        Outcome::Holds { clocks: searched } => {
            let unit = if clocks > 1 { "edge" } else { "clock" };
            let plural = if *searched == 1 { "" } else { "s" };
            format!("{} {searched} {unit}{plural}", if is_cover { "not reached in" } else { "holds for" })
        }
    }
}

/// When a run ends: in a clock, or at a time if there are several.
fn when(run: &Run, clocks: usize) -> String {
    match run.recording.steps.last().filter(|_| clocks > 1) {
        Some(step) => format!("at {}", Period::ps(step.time_ps)),
        None => format!("in clock {}", run.clock),
    }
}

#[derive(Serialize)]
struct Report<'a> {
    format: u32,
    block: &'a str,
    parameters: BTreeMap<&'a str, u64>,
    /// After so many clocks the assumptions allow no further one.
    ends_after: Option<u32>,
    /// What the time was too short for: `conversion`, `search` or `invariant`.
    late: Option<&'static str>,
    statements: Vec<Row<'a>>,
}

#[derive(Serialize)]
struct Row<'a> {
    /// The block and the size that a harness is around; none of a statement that stands in the block.
    harness: Option<&'a str>,
    statement: &'static str,
    message: &'a str,
    module: &'a str,
    place: String,
    /// `proved`, `never`, `fails`, `reached` or `open`.
    result: &'static str,
    /// The clocks of the induction, or those that were searched; none where an invariant was found.
    depth: Option<u32>,
    /// Whether it is proved for edges at the times of the clocks' periods alone.
    needs_periods: bool,
    /// The seconds until this was found.
    seconds: f64,
    run: Option<RunReport<'a>>,
}

/// The run at whose end an assertion fails, or a cover is reached.
#[derive(Serialize)]
struct RunReport<'a> {
    /// The clock, from 0; where there are several, the instant at which one or more of them have an edge.
    clock: u32,
    /// Its time in picoseconds.
    time_ps: u64,
    instance: &'a str,
    /// What starts with a value of its own: the words of each, in hexadecimal.
    initial: BTreeMap<&'a str, Vec<String>>,
    /// In each clock, whether the reset is active.
    reset: Vec<bool>,
    /// In each clock, the value in hexadecimal, by port.
    inputs: BTreeMap<&'a str, Vec<String>>,
}

fn report<'a>(entry: &'a Entry, values: &Values, parts: &'a [Part]) -> Report<'a> {
    Report {
        format: 1,
        block: entry.name,
        parameters: values.iter().collect(),
        ends_after: parts.iter().find_map(|part| part.proof.ends_after),
        late: parts.iter().find_map(|part| part.proof.late).map(|stage| match stage {
            Stage::Conversion => "conversion",
            Stage::Search => "search",
            Stage::Invariant => "invariant",
        }),
        statements: statements(parts).map(|(part, it)| row_report(part, it)).collect(),
    }
}

fn row_report<'a>(part: &'a Part, it: &'a Statement) -> Row<'a> {
    let is_cover = it.directive == Directive::Cover;
    let (result, depth, run) = match &it.outcome {
        Outcome::Proved { depth, .. } => (if is_cover { "never" } else { "proved" }, *depth, None),
        Outcome::Fails(run) => (if is_cover { "reached" } else { "fails" }, None, Some(run_report(&part.design, run))),
        Outcome::Holds { clocks } => ("open", Some(*clocks), None),
    };
    Row {
        harness: part.harness,
        statement: if is_cover { "cover" } else { "assert" },
        message: &it.message,
        module: &it.module,
        place: format!("{}:{}", it.loc.file(), it.loc.line()),
        result,
        depth,
        needs_periods: matches!(it.outcome, Outcome::Proved { needs_periods: true, .. }),
        seconds: seconds(it.time),
        run,
    }
}

fn run_report<'a>(design: &'a Design, run: &'a Run) -> RunReport<'a> {
    let steps = &run.recording.steps;
    let input = |(index, port): (usize, &'a tilewright_hdl::ir::Input)| {
        (port.name.as_str(), steps.iter().map(|step| format!("{:x}", step.inputs[index])).collect())
    };
    let words = |words: &[tilewright_hdl::Bits]| words.iter().map(|word| format!("{word:x}")).collect();
    RunReport {
        clock: run.clock,
        time_ps: steps.last().map_or(0, |step| step.time_ps),
        instance: &run.instance,
        initial: run.recording.initial.iter().map(|it| (it.path.as_str(), words(&it.words))).collect(),
        reset: steps.iter().map(|step| !step.resets.is_empty()).collect(),
        inputs: design.top().inputs.iter().enumerate().map(input).collect(),
    }
}

/// Seconds with three decimals.
fn seconds(time: Duration) -> f64 {
    (time.as_secs_f64() * 1000.0).round() / 1000.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_hdl::Loc;
    use tilewright_prove::Proof;

    fn cover(module: &str, outcome: Outcome) -> Proof {
        let (message, module) = ("it happens".to_owned(), module.to_owned());
        let loc = Loc::caller();
        let statement = Statement { directive: Directive::Cover, message, module, loc, outcome, time: Duration::ZERO };
        Proof { statements: vec![statement], ends_after: None, late: None }
    }

    #[test]
    fn a_cover_of_an_inner_block_does_not_count() {
        let never = Outcome::Proved { depth: Some(1), needs_periods: false };
        let open = Outcome::Holds { clocks: 20 };
        let exit = |proof: &Proof| exit(proof.statements.iter().map(|it| ("top", it)));
        assert_eq!(exit(&cover("top", never.clone())), Exit::CheckFailed);
        assert_eq!(exit(&cover("top", open.clone())), Exit::Undecided);
        assert_eq!([never, open].map(|outcome| exit(&cover("inner", outcome))), [Exit::Done; 2]);
    }
}
