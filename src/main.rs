//! The command line: one file a subcommand, and what they share in `shell`.

mod bench;
mod block;
mod completions;
mod engine;
mod golden;
mod list;
mod machine;
mod player;
mod render;
mod save_file;
mod scene;
mod shell;
mod trace;
mod verdict;
mod verilog;
mod wave;

use clap::{Parser, Subcommand};
use shell::{Exit, Failure, crash, output};
use std::process::ExitCode;

/// Parallel rendering machines of the 1990s, as hardware that runs cycle by cycle
#[derive(Parser)]
#[command(name = "tilewright", version, after_help = AFTER_HELP)]
struct CommandLine {
    #[command(subcommand)]
    command: Command,
}

const AFTER_HELP: &str = "\
Exit codes:
  0    done
  1    a check failed: a frame differs from the golden image, an assertion of the hardware does not hold, or simulators or engines disagree
  2    bad usage or bad input
  3    an output cannot be written
  4    a program that was asked for is not installed, or fails
  70   a mistake in tilewright itself
  130  interrupted; a waveform that was being written opens

Results go to standard output, everything else to standard error.
`tilewright help COMMAND` has the options and examples of a command.";

#[derive(Subcommand)]
enum Command {
    Render(render::Render),
    Golden(golden::Golden),
    Wave(wave::Wave),
    Verilog(verilog::Verilog),
    Bench(bench::Bench),
    List(list::List),
    Completions(completions::Completions),
}

impl Command {
    fn run(self) -> Result<Exit, Failure> {
        match self {
            Command::Render(it) => it.run(),
            Command::Golden(it) => it.run(),
            Command::Wave(it) => it.run(),
            Command::Verilog(it) => it.run(),
            Command::Bench(it) => it.run(),
            Command::List(it) => it.run(),
            Command::Completions(it) => it.run(),
        }
    }
}

fn main() -> ExitCode {
    crash::guard(|| match CommandLine::try_parse() {
        Ok(line) => line.command.run(),
        Err(shown) if shown.use_stderr() => {
            // Nobody is left to tell if standard error is closed.
            let _ = shown.print();
            Ok(Exit::BadInput)
        }
        Err(help) => output::check(help.print()).map(|()| Exit::Done),
    })
    .unwrap_or_else(|failure| {
        output::talk(&format!("error: {}", failure.sentence));
        failure.exit
    })
    .into()
}
