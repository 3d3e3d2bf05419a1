//! The command for long campaigns:
//! `cargo run --profile checked -p tilewright-cosim -- --designs 100000 --seed 1 --verilator 600`.

use std::io::IsTerminal;
use std::process::ExitCode;
use std::time::Duration;
use tilewright_cosim::drawn::Kind;
use tilewright_cosim::{Campaign, Summary, fuzz};

const USAGE: &str =
    "usage: tilewright-cosim [--designs N] [--verilator N] [--seed N] [--first N] [--jobs N] [--shrinks N] [--lints 0]
       tilewright-cosim --shaped N [--seed N] [--first N] [--jobs N] [--shrinks N] [--lints 0]
       tilewright-cosim --streams N [--seed N] [--first N] [--jobs N] [--shrinks N] [--lints 0]
       tilewright-cosim --fuzz SECONDS [--seed N] [--first N] [--jobs N]

Runs N random designs through our simulator and Icarus Verilog, and N through Verilator (none by default).
With --shaped, runs N random circuits whose values have shapes instead, which a fifth of the others are, too.
With --streams, runs N random networks of streams, which a tenth of the others are.
With --fuzz, runs random designs and random edits of them on both of our engines for so long instead; --fuzz-designs N
runs so many in this process. With --shaped 1 beside it, all of them are circuits with shapes.
The same seed makes the same designs; --first says the number of the first one. With --shrinks, so many of the designs
that fail are made smaller, 5 by default; with --lints 0, nothing is linted.";

fn main() -> ExitCode {
    let mut campaign = Campaign::icarus(1, 5000);
    let mut verilator = 0;
    let (mut fuzz, mut fuzz_designs) = (None, None);
    let mut arguments = std::env::args().skip(1);
    while let Some(option) = arguments.next() {
        let number = arguments.next().and_then(|number| number.parse::<u64>().ok());
        match (option.as_str(), number) {
            ("--designs", Some(number)) => campaign.designs = number,
            ("--verilator", Some(number)) => verilator = number,
            ("--shaped", Some(0)) => {}
            ("--shaped", Some(number)) => (campaign.designs, campaign.kind) = (number, Kind::Shaped),
            ("--streams", Some(0)) => {}
            ("--streams", Some(number)) => (campaign.designs, campaign.kind) = (number, Kind::Streams),
            ("--fuzz", Some(number)) => fuzz = Some(Duration::from_secs(number)),
            ("--fuzz-designs", Some(number)) => fuzz_designs = Some(number),
            ("--seed", Some(number)) => campaign.seed = number,
            ("--lints", Some(number)) => campaign.lints = number > 0,
            ("--shrinks", Some(number)) => campaign.shrinks = number as usize,
            ("--first", Some(number)) => campaign.first = number,
            ("--jobs", Some(number)) if number > 0 => campaign.jobs = number as usize,
            _ => {
                eprintln!("{USAGE}");
                return ExitCode::from(2);
            }
        }
    }
    let Campaign { kind, seed, first, jobs, .. } = campaign;
    if let Some(designs) = fuzz_designs {
        println!("{}", fuzz::run_here(kind, seed, first, designs));
        return ExitCode::SUCCESS;
    }
    if let Some(time) = fuzz {
        let (tally, failures) = fuzz::run_for(kind, seed, first, time, jobs);
        failures.iter().for_each(|failure| println!("{failure}\n"));
        println!("{tally}, failures: {}", failures.len());
        return ExitCode::from(u8::from(!failures.is_empty()));
    }
    let in_verilator =
        Campaign { first: campaign.first, kind: campaign.kind, ..Campaign::verilator(campaign.seed, verilator) };
    let mut failed = false;
    for campaign in [campaign, in_verilator] {
        if campaign.designs > 0 && campaign.tool.is_here() {
            failed |= !run(&campaign).failures.is_empty();
        }
    }
    ExitCode::from(u8::from(failed))
}

fn run(campaign: &Campaign) -> Summary {
    let designs = campaign.designs;
    let shows_progress = std::io::stderr().is_terminal();
    let summary = campaign.run(|done| {
        if shows_progress {
            eprint!("\r{done} of {designs} designs");
        }
    });
    if shows_progress {
        eprintln!();
    }
    summary.failures.iter().for_each(|failure| println!("{failure}\n"));
    println!("{}: {summary}", campaign.tool.name());
    summary
}
