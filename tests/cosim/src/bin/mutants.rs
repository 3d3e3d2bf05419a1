//! Whether the tests of `rtl` find small edits of its blocks:
//! `cargo run -p tilewright-cosim --bin mutants -- --mutants 1000 --seed 1 --jobs 2`.

use std::io::IsTerminal;
use std::process::ExitCode;
use tilewright_cosim::mutation::{Comparison, Subject, Suite, Verdict, choose, compare, run, subjects};

const USAGE: &str = "usage: mutants [--mutants N] [--seed N] [--jobs N] [--block NAME] [--list]

Makes N mutants of the blocks of `rtl`, of each in turn: one operator, constant, enable or reset is another. Runs the tests of
the block on each, and says which no test finds, and what random inputs show of those. The same seed makes the same mutants.
With --block, only of the block of that name in the catalogue; with --list, only says what they are.";

struct Options {
    mutants: usize,
    seed: u64,
    jobs: usize,
    block: Option<String>,
    lists: bool,
}

fn options() -> Option<Options> {
    let mut options = Options { mutants: 1000, seed: 1, jobs: 1, block: None, lists: false };
    let mut arguments = std::env::args().skip(1);
    while let Some(option) = arguments.next() {
        match option.as_str() {
            "--list" => options.lists = true,
            "--mutants" => options.mutants = arguments.next()?.parse().ok()?,
            "--seed" => options.seed = arguments.next()?.parse().ok()?,
            "--jobs" => options.jobs = arguments.next()?.parse().ok().filter(|jobs| *jobs > 0)?,
            "--block" => options.block = Some(arguments.next()?),
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
    let mut subjects = subjects();
    subjects.retain(|subject| options.block.as_deref().is_none_or(|block| block == subject.name));
    let chosen = choose(&subjects, options.mutants, options.seed);
    if options.lists {
        chosen.iter().for_each(|&(subject, mutant)| println!("{}", subjects[subject].mutants[mutant]));
        return ExitCode::SUCCESS;
    }
    match judge(&subjects, &chosen, &options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("{problem}");
            ExitCode::FAILURE
        }
    }
}

fn judge(subjects: &[Subject], chosen: &[(usize, usize)], options: &Options) -> Result<(), String> {
    let suite = Suite::build(options.seed)?;
    for subject in subjects {
        match suite.run(&subject.tests, None) {
            Verdict::Survives => {}
            verdict => {
                return Err(format!("the tests of `{}` do not pass without a mutant: {verdict:?}", subject.name));
            }
        }
    }
    let shows_progress = std::io::stderr().is_terminal();
    let verdicts = run(&suite, subjects, chosen, options.jobs, |done| {
        if shows_progress {
            eprint!("\r{done} of {} mutants", chosen.len());
        }
    });
    report(subjects, chosen, &verdicts);
    Ok(())
}

/// Prints the mutants that survive, and for each block how many there are and what became of them.
fn report(subjects: &[Subject], chosen: &[(usize, usize)], verdicts: &[Verdict]) {
    let mut rows = vec![];
    for (index, subject) in subjects.iter().enumerate() {
        let of_it = || chosen.iter().zip(verdicts).filter(|((of, _), _)| *of == index);
        let mut row = [of_it().count(), 0, 0, 0];
        for (&(_, mutant), verdict) in of_it() {
            match verdict {
                Verdict::Found(_) => row[1] += 1,
                Verdict::Endless | Verdict::Broken => row[2] += 1,
                Verdict::Survives => {
                    let comparison = survives(subject, mutant);
                    row[3] += usize::from(matches!(comparison, Comparison::Same(_)));
                }
            }
        }
        rows.push((subject.name, row));
    }
    let sum = rows.iter().fold([0; 4], |sum, (_, row)| std::array::from_fn(|i| sum[i] + row[i]));
    println!("| block | mutants | found | endless | survive | of those the same | found of the others |");
    println!("|---|---|---|---|---|---|---|");
    for (name, [all, found, endless, same]) in rows.into_iter().chain([("all", sum)]) {
        let caught = found + endless;
        let percent = 100.0 * caught as f64 / (all - same).max(1) as f64;
        println!("| {name} | {all} | {found} | {endless} | {} | {same} | {percent:.1} % |", all - caught);
    }
}

/// Prints a mutant that no test finds, with its line and what random inputs show.
fn survives(subject: &Subject, mutant: usize) -> Comparison {
    let mutant = &subject.mutants[mutant];
    let edited = subject.with(mutant).expect("it was a design when it was chosen");
    let comparison = compare(&subject.design, &edited);
    println!("{mutant}\n    {comparison}");
    let source = std::fs::read_to_string(mutant.loc.file()).unwrap_or_default();
    if let Some(line) = source.lines().nth(mutant.loc.line() as usize - 1) {
        println!("    {}", line.trim());
    }
    comparison
}
