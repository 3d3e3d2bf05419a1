//! Random designs, and random edits of them, on both engines, with the memory of generated code between pages that
//! nobody may touch: an edit is refused with a sentence, or what it makes runs alike on both.
//!
//! Designs run in processes of their own, some at a time, so that one that breaks its process is known and the others
//! go on.

use crate::Campaign;
use crate::batch::{execute, limited};
use crate::drawn::{Drawn, Kind};
use crate::edit::edit;
use crate::spec::Stimulus;
use crate::stimulus::{Numbers, one_or_two, passes, record};
use crate::tally::tally;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};
use tempfile::TempDir;
use tilewright_hdl::ir::Design;
use tilewright_sim::{EngineKind, Passes, Simulation, Target};

/// How many designs run in one process, and its seconds of processor time at most.
const TOGETHER: u64 = 50;
const PATIENCE: u64 = 300;

/// How often a design is edited, and in how many places at most.
const EDITED: u64 = 12;
const PLACES: u64 = 3;

tally! {
    /// What has run.
    pub struct Tally {
        /// Designs, as they were drawn.
        designs: "designs",
        /// Edited designs that keep all rules.
        edited: "edited and run",
        /// Edited designs that were refused.
        refused: "edited and refused",
        /// Instants, on both engines.
        instants: "instants",
    }
}

/// Runs a design on both engines, and what code is made of beside the reference engine; gives how many instants.
///
/// # Panics
///
/// The engines differ, or the simulator does not take the design.
fn run(design: &Design, stimulus: &Stimulus) -> u64 {
    let usual = Passes { held_after: 3, looks_after: 2, versions_after: 2, versions_from: 0, ..Passes::default() };
    let passes = if stimulus.seed.is_multiple_of(2) { usual } else { passes(stimulus.seed / 2) };
    // Of half of the designs, the instances of each array run one by one.
    let passes = match stimulus.seed / 4 % 2 {
        0 => Passes { apart_from: 1, apart_single: 0, ..passes },
        _ => passes,
    };
    let passes = Passes { guarded: true, idle_from: 0, ..passes };
    let steps = |passes: &Passes| {
        let sim = Simulation::with_passes(design, passes).unwrap_or_else(|error| panic!("{error}"));
        let instants = |sim| {
            let run = record(design, stimulus, sim).unwrap_or_else(|error| panic!("{error}"));
            run.recording.steps.len() as u64
        };
        let runs: Vec<u64> = one_or_two(sim.on(EngineKind::Both), stimulus).into_iter().map(instants).collect();
        assert!(runs.iter().all(|instants| *instants == runs[0]), "two simulations of a circuit differ: {runs:?}");
        runs[0]
    };
    // What code is made of is right, and so is the code.
    let instants = steps(&passes);
    for target in [Target::Functions, Target::Strips { vector: 64 << (stimulus.seed % 3) }] {
        let evaluated = steps(&Passes { target, ..passes.clone() });
        assert_eq!(evaluated, instants, "an assertion fails at another edge with {target:?}");
    }
    instants
}

/// Runs a random design, and what random edits make of it.
///
/// # Panics
///
/// The engines differ, or something panics.
fn run_with_edits(spec: &Drawn, number: u64) -> Tally {
    let design = spec.design(number).unwrap_or_else(|problems| panic!("{problems}"));
    let stimulus = spec.stimulus();
    let mut tally = Tally { designs: 1, instants: run(&design, stimulus), ..Tally::default() };
    let mut numbers = Numbers(stimulus.seed ^ number);
    for _ in 0..EDITED {
        let mut modules = design.modules().to_vec();
        (0..=numbers.draw() % PLACES).for_each(|_| edit(&mut modules, &mut numbers));
        match Design::new(modules) {
            Ok(edited) => {
                tally.instants += run(&edited, stimulus);
                tally.edited += 1;
            }
            Err(problems) => {
                assert!(problems.0.iter().all(|problem| !problem.message.is_empty()), "a problem without a sentence");
                tally.refused += 1;
            }
        }
    }
    tally
}

/// Runs so many designs of a seed, from a number on, in this process; prints each number before its design.
///
/// # Panics
///
/// The engines differ, or something panics.
pub fn run_here(kind: Kind, seed: u64, first: u64, designs: u64) -> Tally {
    let campaign = Campaign { kind, ..Campaign::icarus(seed, designs) };
    let mut tally = Tally::default();
    for number in first..first + designs {
        println!("design {number}");
        tally += run_with_edits(&campaign.design(number), number);
    }
    tally
}

/// Runs designs of a seed, from a number on, for so long, so many processes at a time; gives what went wrong.
pub fn run_for(kind: Kind, seed: u64, first: u64, time: Duration, jobs: usize) -> (Tally, Vec<String>) {
    let (start, next) = (Instant::now(), AtomicU64::new(first));
    let all: Mutex<(Tally, Vec<String>)> = Mutex::default();
    let work = || {
        while start.elapsed() < time {
            let result = in_a_process(kind, seed, next.fetch_add(TOGETHER, Ordering::Relaxed));
            let mut all = all.lock().expect("no panic while collecting");
            match result {
                Ok(tally) => all.0 += tally,
                Err(what) => all.1.push(what),
            }
        }
    };
    std::thread::scope(|scope| (0..jobs).for_each(|_| drop(scope.spawn(work))));
    all.into_inner().expect("no panic while collecting")
}

/// Runs some designs in a process of their own.
fn in_a_process(kind: Kind, seed: u64, first: u64) -> Result<Tally, String> {
    let folder = TempDir::with_prefix("tilewright-fuzz-").expect("a temporary folder can be made");
    let program = std::env::current_exe().expect("this program has a path");
    let shaped = u64::from(kind == Kind::Shaped);
    let arguments = [("--shaped", shaped), ("--fuzz-designs", TOGETHER), ("--seed", seed), ("--first", first)];
    let arguments = arguments.map(|(name, number)| [name.to_owned(), number.to_string()]);
    let (succeeded, printed) = execute(&folder, limited(program, PATIENCE).args(arguments.as_flattened()));
    if let Some(tally) = succeeded.then(|| Tally::read(&printed)).flatten() {
        return Ok(tally);
    }
    let number = printed.lines().filter_map(|line| line.strip_prefix("design ")).next_back().unwrap_or("none");
    let rest = printed.split_once(&format!("design {number}\n")).map_or("", |(_, rest)| rest.trim_end());
    Err(format!(
        "design {number} of seed {seed} fails, breaks its process, or takes minutes:\n{rest}\n\
        again: cargo run --profile checked -p tilewright-cosim -- --shaped {shaped} --fuzz-designs 1 --seed {seed} --first {number}"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tally_is_read_as_it_is_printed() {
        let tally = Tally { designs: 50, edited: 7, refused: 593, instants: 12_345 };
        assert_eq!(Tally::read(&format!("design 3\n{tally}\n")), Some(tally));
        assert_eq!(Tally::read("design 3\n"), None);
    }

    #[test]
    fn edited_designs_run_alike_or_are_refused() {
        let tally = run_here(Kind::Mixed, 3, 0, 12);
        assert_eq!((tally.designs, tally.edited + tally.refused), (12, 12 * EDITED));
        assert!(tally.edited > EDITED && tally.refused > EDITED, "{tally}");
        assert!(tally.instants > 4 * (tally.designs + tally.edited), "{tally}");
    }
}
