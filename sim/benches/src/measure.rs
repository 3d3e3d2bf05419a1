//! The measurement: contenders run alternately, round by round, and their checksums must agree.

use crate::contender::{Contender, Run};
use crate::engine::{AtOnce, OnEngine, alone, engines};
use crate::error::Error;
use crate::report::{Figures, Measurement};
use crate::subject::Subject;
use crate::verilated::models;
use std::ops::ControlFlow;
use std::time::Duration;
use tilewright_gen::tools::Compiler;

/// The effort of a measurement.
#[derive(Debug, Clone, Copy)]
pub struct Effort {
    /// Runs of each contender, at least 1.
    pub rounds: u32,
    /// The approximate run time of the slowest contender.
    pub time: Duration,
}

/// The models with which a subject is compared; [`Rivals::default`] has none.
#[derive(Debug, Clone, Copy, Default)]
pub struct Rivals<'a> {
    /// The compilers that make them.
    pub compilers: &'a [Compiler],
    /// Their Verilog, by the names of [`Subject::verilog`]; all of those if none is given.
    pub verilog: &'a [String],
}

/// Called with the present activity and its progress, from 0 to 1; returns whether to continue.
pub type Watch<'a> = &'a mut dyn FnMut(&'static str, f64) -> ControlFlow<()>;

/// Measures a subject on all engines, or with rivals on the fastest one and in their Verilators.
///
/// # Errors
///
/// A contender fails, the checksums differ, or `watch` asks to stop.
pub fn measure(subject: Subject, rivals: Rivals, effort: Effort, watch: Watch) -> Result<Measurement, Error> {
    let mut show = |what, done| match watch(what, done) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Error::Interrupted { design: subject.to_string() }),
    };
    let mut contenders: Vec<Box<dyn Contender>> = Vec::new();
    // The interpreter would make the runs of the others too short.
    let engines = engines().take(if rivals.compilers.is_empty() { usize::MAX } else { 1 });
    if subject.stimuli() > 1 {
        contenders.push(Box::new(AtOnce::new(subject)));
    }
    contenders.extend(engines.map(|engine| Box::new(OnEngine { engine, subject }) as _));
    for compiler in rivals.compilers {
        show("building", 0.0)?;
        contenders.extend(models(compiler, subject, rivals.verilog)?.into_iter().map(|model| Box::new(model) as _));
    }
    show("measuring", 0.0)?;
    let cycles = sufficient_cycles(&contenders, effort.time, &mut || show("measuring", 0.0))?;

    let mut runs: Vec<Vec<Run>> = vec![Vec::new(); contenders.len()];
    for round in 0..effort.rounds {
        for (contender, runs) in contenders.iter().zip(&mut runs) {
            show("measuring", f64::from(round) / f64::from(effort.rounds))?;
            runs.push(contender.run(cycles)?);
        }
    }
    let checksum = agreed(subject, cycles, &contenders, &runs)?;

    let ours = median(&runs[0], |run| run.others) / contenders[0].stimuli();
    let figures = contenders.iter().zip(&runs).map(|(contender, runs)| {
        let stimuli = contender.stimuli();
        let per_cycle = |time: Duration| time.as_secs_f64() * 1e9 / (cycles - 1) as f64 / f64::from(stimuli);
        let others = || runs.iter().map(|run| run.others);
        let build = contender.build_time();
        let theirs = median(runs, |run| run.others);
        Figures {
            simulator: contender.name().to_owned(),
            made: contender.made().cloned(),
            ns_per_cycle: per_cycle(theirs),
            least_ns_per_cycle: per_cycle(others().min().unwrap_or_default()),
            most_ns_per_cycle: per_cycle(others().max().unwrap_or_default()),
            build_seconds: build.map(|time| time.as_secs_f64()),
            first_cycle_seconds: (build.unwrap_or_default() + median(runs, |run| run.first_cycle)).as_secs_f64(),
            ratio: (theirs / stimuli).as_secs_f64() / ours.as_secs_f64(),
        }
    });
    let simulators = figures.collect();
    let frame_cycles = subject.frame_cycles();
    Ok(Measurement {
        design: subject.to_string(),
        cycles,
        frame_cycles,
        checksum: format!("{checksum:08x}"),
        simulators,
    })
}

/// The first of 100, 200, 500, 1000 and so on that takes the slowest contender nearly that long; `go_on` may stop the
/// search.
fn sufficient_cycles(
    contenders: &[Box<dyn Contender>],
    time: Duration,
    go_on: &mut dyn FnMut() -> Result<(), Error>,
) -> Result<u64, Error> {
    let numbers = (2..12).flat_map(|power| [1, 2, 5].map(|digit| digit * 10_u64.pow(power)));
    for cycles in numbers {
        let mut slowest = Duration::ZERO;
        for contender in contenders {
            go_on()?;
            slowest = slowest.max(contender.run(cycles)?.others);
        }
        // The next number could take more than twice the time.
        if slowest >= time.mul_f64(0.4) {
            return Ok(cycles);
        }
    }
    Ok(10_u64.pow(12))
}

/// The common checksum of all runs, which must be the known one if there is one.
fn agreed(subject: Subject, cycles: u64, contenders: &[Box<dyn Contender>], runs: &[Vec<Run>]) -> Result<u32, Error> {
    let known = subject.known().find(|(known, _)| *known == cycles);
    let first = (contenders[0].name(), runs[0][0].checksums[0]);
    let (other, expected) = known.map_or(first, |(_, checksum)| ("what is known", checksum));
    let differs = |name: String, found, other: &str, expected| {
        let (design, other) = (subject.to_string(), other.to_owned());
        Err(Error::Differs { design, cycles, name, found, other, expected })
    };
    for (contender, runs) in contenders.iter().zip(runs) {
        if let Some(run) = runs.iter().find(|run| run.checksums[0] != expected) {
            return differs(contender.name().to_owned(), run.checksums[0], other, expected);
        }
    }
    if subject.stimuli() > 1 {
        let alone = alone(subject, cycles)?;
        for run in &runs[0] {
            let found = run.checksums.iter().zip(&alone).enumerate().find(|(_, (found, alone))| found != alone);
            if let Some((stimulus, (found, alone))) = found {
                let name = format!("{}, stimulus {stimulus}", contenders[0].name());
                return differs(name, *found, "the stimulus alone", *alone);
            }
        }
    }
    Ok(expected)
}

/// The median of the times; for an even number, the lower of the two.
fn median(runs: &[Run], of: impl Fn(&Run) -> Duration) -> Duration {
    let mut times: Vec<Duration> = runs.iter().map(of).collect();
    times.sort();
    times.get((times.len().max(1) - 1) / 2).copied().unwrap_or_default()
}
