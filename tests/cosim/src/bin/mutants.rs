//! Whether the tests of blocks find small edits of them:
//! `cargo run -p tilewright-cosim --bin mutants -- --mutants 1000 --seed 1 --jobs 2`.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::process::ExitCode;
use tilewright_cosim::mutation::{Comparison, Subject, Suite, Verdict, choose, compare, run, subjects};
use tilewright_mutants::Mutant;

const USAGE: &str = "usage: mutants [--mutants N] [--seed N] [--jobs N] [--of CRATE] [--block NAME] [--list]

Makes N mutants of the blocks of `rtl`, or of another crate, of each in turn: one operator, constant, enable or reset is another.
Runs the tests of the block on each, and says which no test finds, and what random inputs show of those. The same seed makes the
same mutants. With --block, only of blocks with that in their names; with --list, only says what the mutants are.";

struct Options {
    mutants: usize,
    seed: u64,
    jobs: usize,
    of: String,
    block: String,
    lists: bool,
}

fn options() -> Option<Options> {
    let mut options = Options { mutants: 1000, seed: 1, jobs: 1, of: "rtl".into(), block: String::new(), lists: false };
    let mut arguments = std::env::args().skip(1);
    while let Some(option) = arguments.next() {
        match option.as_str() {
            "--list" => options.lists = true,
            "--mutants" => options.mutants = arguments.next()?.parse().ok()?,
            "--seed" => options.seed = arguments.next()?.parse().ok()?,
            "--jobs" => options.jobs = arguments.next()?.parse().ok().filter(|jobs| *jobs > 0)?,
            "--of" => options.of = arguments.next()?,
            "--block" => options.block = arguments.next()?,
            _ => return None,
        }
    }
    Some(options)
}

fn main() -> ExitCode {
    let Some(options) = options() else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    match judge(&options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("{problem}");
            ExitCode::FAILURE
        }
    }
}

/// Has the tests of each block find its mutants, block by block.
fn judge(options: &Options) -> Result<(), String> {
    let subjects = subjects(|of, name| of.name() == options.of && name.contains(&options.block));
    if subjects.is_empty() {
        let Options { of, block, .. } = options;
        return Err(format!("no block of `{of}` has `{block}` in its name; the crates are `rtl` and `blocks`"));
    }
    let chosen = choose(&subjects, options.mutants, options.seed);
    let (mut suites, mut rows) = (HashMap::new(), Vec::new());
    for (subject, chosen) in subjects.iter().zip(chosen) {
        let mutants: Vec<&Mutant> = chosen.into_iter().map(|index| &subject.mutants[index]).collect();
        if options.lists {
            mutants.iter().for_each(|mutant| println!("{mutant}"));
            continue;
        }
        let suite = match suites.entry(subject.of) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(of) => of.insert(Suite::build(subject.of, options.seed)?),
        };
        match suite.run(&subject.tests, None) {
            Verdict::Survives => {}
            verdict => {
                return Err(format!("the tests of `{}` do not pass without a mutant: {verdict:?}", subject.name));
            }
        }
        let verdicts = run(suite, &subject.tests, &mutants, options.jobs);
        rows.push((subject.name.as_str(), Row::of(subject, &mutants, &verdicts)));
    }
    if !options.lists {
        print(&rows);
    }
    Ok(())
}

/// What became of the mutants of a block.
#[derive(Default)]
struct Row {
    mutants: usize,
    found: usize,
    /// Of those found: the tests do not come to an end, or break.
    endless: usize,
    survive: usize,
    /// Of those that survive: random inputs show no difference.
    same: usize,
}

impl Row {
    /// Counts, and prints what survives.
    fn of(subject: &Subject, mutants: &[&Mutant], verdicts: &[Verdict]) -> Row {
        let mut row = Row { mutants: mutants.len(), ..Row::default() };
        for (mutant, verdict) in mutants.iter().zip(verdicts) {
            row.found += usize::from(*verdict != Verdict::Survives);
            row.endless += usize::from(matches!(verdict, Verdict::Endless | Verdict::Broken));
            if *verdict == Verdict::Survives {
                row.survive += 1;
                row.same += usize::from(matches!(survives(subject, mutant), Comparison::Same(_)));
            }
        }
        row
    }
}

fn print(rows: &[(&str, Row)]) {
    let sum = rows.iter().fold(Row::default(), |sum, (_, row)| Row {
        mutants: sum.mutants + row.mutants,
        found: sum.found + row.found,
        endless: sum.endless + row.endless,
        survive: sum.survive + row.survive,
        same: sum.same + row.same,
    });
    println!("| block | mutants | found | of these, without an end | survive | of these, no difference | found |");
    println!("|---|---|---|---|---|---|---|");
    for (name, row) in rows.iter().map(|(name, row)| (*name, row)).chain([("all", &sum)]) {
        let Row { mutants, found, endless, survive, same } = row;
        let percent = 100.0 * *found as f64 / (*mutants).max(1) as f64;
        println!("| {name} | {mutants} | {found} | {endless} | {survive} | {same} | {percent:.1} % |");
    }
}

/// Prints a mutant that no test finds, with its line and what random inputs show.
fn survives(subject: &Subject, mutant: &Mutant) -> Comparison {
    let edited = subject.with(mutant).expect("it was a design when it was chosen");
    let comparison = compare(&subject.design, &edited);
    println!("{mutant}\n    {comparison}");
    let source = std::fs::read_to_string(mutant.loc.file()).unwrap_or_default();
    if let Some(line) = source.lines().nth(mutant.loc.line() as usize - 1) {
        println!("    {}", line.trim());
    }
    comparison
}
