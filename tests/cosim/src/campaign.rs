//! A campaign: many random designs through our simulator and another one and the linters, and what is left of one that
//! differs.

use crate::batch::{self, Printed, Refused, Tool};
use crate::board::on_a_board;
use crate::drawn::{Drawn, Kind};
use crate::stimulus::Run;
use crate::{many, reduce, stimulus};
use std::collections::BTreeMap;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use tilewright_gen::{VerilogFile, testbench, tools, verilog};
use tilewright_hdl::{Design, Recording};

/// A campaign to run.
#[derive(Debug, Clone)]
pub struct Campaign {
    /// What all designs and their stimuli follow from.
    pub seed: u64,
    /// How many designs.
    pub designs: u64,
    /// The number of the first.
    pub first: u64,
    /// Which designs.
    pub kind: Kind,
    /// The other simulator.
    pub tool: Tool,
    /// How many designs go into one run of it.
    pub batch: u64,
    /// How many runs of it go on at once.
    pub jobs: usize,
    /// Whether Yosys and slang look at every design, and all linters at those of each eighth batch.
    pub lints: bool,
    /// How many of the designs that fail, by number, are shrunk: each takes up to 400 runs.
    pub shrinks: usize,
    /// What prints the Verilog; another than [`verilog`] serves to see the campaign fail.
    pub printer: fn(&Design) -> Vec<VerilogFile>,
}

/// What a campaign did.
#[derive(Debug, Clone, Default)]
pub struct Summary {
    /// Designs simulated.
    pub designs: u64,
    /// Instants at which their outputs were compared.
    pub cycles: u64,
    /// Values compared.
    pub outputs: u64,
    /// Designs that the other simulator broke on by a fault of its own ([`Refused::Itself`]).
    pub unusable: u64,
    /// The designs that differ, by number, the first of them shrunk.
    pub failures: Vec<Failure>,
}

/// A design on which the simulators differ, or which one of the tools refuses.
#[derive(Debug, Clone)]
pub struct Failure {
    /// The campaign's seed.
    pub seed: u64,
    /// The design's number in the campaign.
    pub number: u64,
    /// What it fails in.
    pub against: Against,
    /// What happened to the smallest design that was found to fail.
    pub what: String,
    /// That design.
    pub spec: Drawn,
    /// A smaller circuit that fails alike, with what happens to it, as text; empty for what is described in the language.
    pub circuit: String,
    /// Where its Verilog and testbench were written.
    pub folder: PathBuf,
}

/// What a design fails in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Against {
    /// Our simulator breaks on it, or differs from the other one.
    Simulator,
    /// A linter does not find it clean.
    Linters,
}

/// A run of a design in our simulator.
struct Simulated {
    recording: Recording,
    /// What other tools get, if they are asked.
    printed: Option<Printed>,
    /// What they get of a design with pads, without models of them.
    on_a_board: Option<Printed>,
}

/// What became of one design.
enum Verdict {
    Agrees,
    Differs(String),
    Unusable,
}

/// Seconds of processor time that so many random designs may take: a hundred take about a second. Chains of lanes whose values pass
/// each other may make Icarus compute for ever: it has them anew for each change on the way.
fn patience(designs: usize) -> u64 {
    5 + designs as u64 / 4
}

/// What Verilator says of itself, and not of the Verilog: 5.006 breaks on some memories in nested loops, and it takes no signed
/// product of more than 512 bits.
const LIMITS_OF_VERILATOR: [&str; 2] = ["%Error: Internal Error: ", "exceeds hardcoded limit VL_MULS_MAX_WORDS"];

impl Campaign {
    /// So many designs against Icarus, with sizes and jobs that suit two processors.
    pub fn icarus(seed: u64, designs: u64) -> Campaign {
        Campaign {
            seed,
            designs,
            first: 0,
            kind: Kind::Mixed,
            tool: Tool::Icarus,
            batch: 125,
            jobs: 2,
            lints: true,
            shrinks: 5,
            printer: verilog,
        }
    }

    /// So many designs against Verilator, which are not linted: the first designs against Icarus are the same.
    pub fn verilator(seed: u64, designs: u64) -> Campaign {
        Campaign { tool: Tool::Verilator, batch: 100, jobs: 1, lints: false, ..Campaign::icarus(seed, designs) }
    }

    /// Runs it; `progress` hears how many designs are done. The summary depends on the seed and the number of designs
    /// alone.
    pub fn run(&self, progress: impl Fn(u64) + Sync) -> Summary {
        let (next, done) = (AtomicU64::new(0), AtomicU64::new(0));
        let summaries = Mutex::new(Vec::new());
        let work = || {
            loop {
                let start = next.fetch_add(self.batch, Ordering::Relaxed);
                if start >= self.designs {
                    return;
                }
                let count = self.batch.min(self.designs - start);
                let summary = self.batch(self.first + start, count);
                summaries.lock().expect("no panic while collecting").push((start, summary));
                progress(done.fetch_add(count, Ordering::Relaxed) + count);
            }
        };
        std::thread::scope(|scope| (0..self.jobs).for_each(|_| drop(scope.spawn(work))));
        let mut summaries = summaries.into_inner().expect("no panic while collecting");
        summaries.sort_by_key(|(start, _)| *start);
        let mut summary = summaries.into_iter().fold(Summary::default(), |sum, (_, one)| sum.and(one));
        summary.failures.iter_mut().take(self.shrinks).for_each(|failure| self.shrink(failure));
        summary.failures.iter_mut().for_each(|failure| failure.folder = self.keep(&failure.spec, failure.number));
        summary
    }

    /// The random design of that number.
    pub fn design(&self, number: u64) -> Drawn {
        self.kind.draw(self.seed, number).current()
    }

    fn batch(&self, first: u64, count: u64) -> Summary {
        let mut summary = Summary::default();
        let (mut numbers, mut printed, mut boards) = (Vec::new(), Vec::new(), Vec::new());
        for number in first..first + count {
            summary.designs += 1;
            match self.simulate(&self.design(number), number) {
                Ok(run) => {
                    let steps = &run.recording.steps;
                    summary.cycles += steps.len() as u64;
                    summary.outputs += steps.iter().map(|step| step.outputs.len() as u64).sum::<u64>();
                    numbers.extend(run.printed.as_ref().map(|_| number));
                    printed.extend(run.printed);
                    boards.extend(run.on_a_board.map(|board| (number, board)));
                }
                Err(what) => summary.failures.push(self.fails(number, what, Against::Simulator)),
            }
        }
        // Verilator takes its time: it looks at each eighth batch.
        let complaints = self.lint(&printed, (first / self.batch).is_multiple_of(8));
        for (place, (number, verdict)) in numbers.iter().zip(self.compare(&printed)).enumerate() {
            match (complaints.get(&place), verdict) {
                (Some(what), _) => summary.failures.push(self.fails(*number, what.clone(), Against::Linters)),
                (None, Verdict::Agrees) => {}
                (None, Verdict::Differs(what)) => summary.failures.push(self.fails(*number, what, Against::Simulator)),
                (None, Verdict::Unusable) => summary.unusable += 1,
            }
        }
        self.compare_boards(boards, &mut summary);
        summary.failures.sort_by_key(|failure| failure.number);
        summary
    }

    /// Compares designs with pads without models of these. Verilator knows no strengths.
    fn compare_boards(&self, mut boards: Vec<(u64, Printed)>, summary: &mut Summary) {
        boards.retain(|(number, _)| summary.failures.iter().all(|failure| failure.number != *number));
        if boards.is_empty() || self.tool != Tool::Icarus {
            return;
        }
        let (numbers, printed): (Vec<u64>, Vec<Printed>) = boards.into_iter().unzip();
        for (number, verdict) in numbers.into_iter().zip(self.compare(&printed)) {
            if let Verdict::Differs(what) = verdict {
                summary.failures.push(self.fails(number, format!("on a board: {what}"), Against::Simulator));
            }
        }
    }

    /// What became of each design; a batch that the tool refuses is halved until the culprit is alone.
    fn compare(&self, printed: &[Printed]) -> Vec<Verdict> {
        match batch::run(self.tool, printed, patience(printed.len())) {
            Ok(verdicts) => {
                let verdict = |differs: Option<String>| differs.map_or(Verdict::Agrees, Verdict::Differs);
                verdicts.into_iter().map(verdict).collect()
            }
            Err(_) if printed.len() > 1 => {
                let (left, right) = printed.split_at(printed.len() / 2);
                [self.compare(left), self.compare(right)].into_iter().flatten().collect()
            }
            Err(Refused::Verilog(output)) => {
                vec![Verdict::Differs(format!("{} refuses it:\n{output}", self.tool.name()))]
            }
            Err(Refused::Itself(_)) => vec![Verdict::Unusable],
        }
    }

    /// What the linters say of the designs that are not clean, by their places.
    fn lint(&self, printed: &[Printed], in_all: bool) -> BTreeMap<usize, String> {
        if !self.lints || printed.is_empty() {
            return BTreeMap::new();
        }
        let files: Vec<&[VerilogFile]> = printed.iter().map(|design| design.files.as_slice()).collect();
        let linted = if in_all { tools::lint_all(&files) } else { tools::lint_quickly(&files) };
        let wrong = linted.err().unwrap_or_default();
        let texts = wrong.into_iter().map(|(place, problems)| (place, problems.to_string()));
        texts.filter(|(_, text)| !LIMITS_OF_VERILATOR.iter().any(|limit| text.contains(limit))).collect()
    }

    /// Makes, runs and prints a design; what goes wrong on the way is a failure as well.
    fn simulate(&self, spec: &Drawn, number: u64) -> Result<Simulated, String> {
        let make = || spec.design(number).map_err(|problems| problems.to_string());
        let design = quietly(make)?;
        quietly(|| self.simulate_design(&design, spec, number))
    }

    fn simulate_design(&self, design: &Design, spec: &Drawn, number: u64) -> Result<Simulated, String> {
        let Run { recording, fails, covers, shown } =
            stimulus::run(design, spec.stimulus()).map_err(|error| error.to_string())?;
        many::check(design, spec.stimulus(), number)?;
        let hit = covers.iter().filter(|cover| cover.count > 0);
        let hit = hit.map(|cover| cover.path.rsplit('.').next().unwrap_or_default().to_owned()).collect();
        let print = || Printed {
            files: (self.printer)(design),
            bench: testbench(design, &recording),
            fails,
            covered: Some(hit),
            shown: Some(shown),
        };
        let printed = spec.is_printed().then(print);
        let on_a_board = printed.as_ref().and_then(|printed| on_a_board(design, printed));
        Ok(Simulated { recording, printed, on_a_board })
    }

    /// What is wrong with one design, if anything.
    fn failure(&self, spec: &Drawn, number: u64, against: Against) -> Option<String> {
        self.verdict(self.simulate(spec, number), against)
    }

    fn verdict(&self, simulated: Result<Simulated, String>, against: Against) -> Option<String> {
        match (simulated, against) {
            (Err(what), _) => Some(what),
            (Ok(Simulated { printed: None, .. }), _) => None,
            (Ok(Simulated { printed: Some(printed), .. }), Against::Linters) => self.lint(&[printed], true).remove(&0),
            (Ok(Simulated { printed, on_a_board, .. }), Against::Simulator) => {
                let on_a_board = on_a_board.filter(|_| self.tool == Tool::Icarus);
                let differs = |printed: Printed| match self.compare(&[printed]).remove(0) {
                    Verdict::Differs(what) => Some(what),
                    Verdict::Agrees | Verdict::Unusable => None,
                };
                printed.into_iter().chain(on_a_board).find_map(differs)
            }
        }
    }

    fn fails(&self, number: u64, what: String, against: Against) -> Failure {
        Failure {
            seed: self.seed,
            number,
            against,
            what,
            spec: self.design(number),
            circuit: String::new(),
            folder: PathBuf::new(),
        }
    }

    /// Makes the design smaller, and of a circuit with shapes what it is made of.
    fn shrink(&self, failure: &mut Failure) {
        self.shrink_spec(failure);
        let is_shaped = matches!(failure.spec, Drawn::Shaped(_));
        // Linters take seconds a run.
        if !is_shaped || failure.against == Against::Linters {
            return;
        }
        let (spec, number, against) = (failure.spec.clone(), failure.number, failure.against);
        let Ok(design) = spec.design(number) else { return };
        let fails = |design: &Design| self.verdict(quietly(|| self.simulate_design(design, &spec, number)), against);
        let (modules, what) = reduce::reduce(design.into_modules(), failure.what.clone(), fails);
        failure.circuit = format!("{what}\n{}", reduce::text(&modules));
    }

    /// Makes the design smaller for as long as it fails, by proptest's steps.
    fn shrink_spec(&self, failure: &mut Failure) {
        // A single run takes 20 ms in Icarus, and some seconds in Verilator and in all linters.
        let is_quick = self.tool == Tool::Icarus && failure.against == Against::Simulator;
        let most_runs = if is_quick { 400 } else { 20 };
        let mut tree = self.kind.draw(self.seed, failure.number);
        let mut runs = 0;
        while runs < most_runs && tree.simplify() {
            loop {
                runs += 1;
                let spec = tree.current();
                if let Some(what) = self.failure(&spec, failure.number, failure.against) {
                    (failure.spec, failure.what) = (spec, what);
                    break;
                }
                if runs >= most_runs || !tree.complicate() {
                    return;
                }
            }
        }
    }

    /// Writes the files of a failing design.
    fn keep(&self, spec: &Drawn, number: u64) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("tilewright-cosim-seed{}-design{number}", self.seed));
        std::fs::create_dir_all(&folder).expect("a temporary folder can be made");
        // Without a testbench where our simulator itself fails.
        let files = match self.simulate(spec, number) {
            Ok(Simulated { printed: Some(Printed { files, bench, .. }), .. }) => {
                files.into_iter().chain([bench]).collect()
            }
            Err(_) if spec.is_printed() => {
                let print = |design: Design| quietly(|| Ok(verilog(&design))).unwrap_or_default();
                spec.design(number).map_or(Vec::new(), print)
            }
            _ => Vec::new(),
        };
        for file in files {
            std::fs::write(folder.join(&file.name), &file.text).expect("a temporary file can be written");
        }
        folder
    }
}

/// What it gives; a panic is a mistake with a message.
fn quietly<T>(work: impl FnOnce() -> Result<T, String>) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        let text = text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no message");
        Err(format!("a panic: {text}"))
    })
}

impl Summary {
    /// Both together.
    #[must_use]
    pub fn and(mut self, other: Summary) -> Summary {
        self.designs += other.designs;
        self.cycles += other.cycles;
        self.outputs += other.outputs;
        self.unusable += other.unusable;
        self.failures.extend(other.failures);
        self
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Summary { designs, cycles, outputs, unusable, failures } = self;
        write!(f, "designs: {designs}, cycles: {cycles}, outputs compared: {outputs}, mismatches: {}", failures.len())?;
        if *unusable > 0 {
            write!(f, " ({unusable} designs not compared: the other simulator broke on them, or did not end)")?;
        }
        Ok(())
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Failure { seed, number, what, spec, circuit, folder, .. } = self;
        writeln!(f, "design {number} of seed {seed} fails:\n{}\n{spec:#?}", what.trim_end())?;
        if !circuit.is_empty() {
            writeln!(f, "so does this: {circuit}")?;
        }
        writeln!(f, "its Verilog is in {}", folder.display())?;
        write!(
            f,
            "again: cargo run --profile checked -p tilewright-cosim -- --seed {seed} --first {number} --designs 1"
        )
    }
}
