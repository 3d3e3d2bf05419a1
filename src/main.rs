//! The command line: one file for each subcommand, and what they share in `shell`.

mod against;
mod bench;
mod bitstream;
mod block;
mod command_file;
mod compare;
mod completions;
mod constraints;
mod debug;
mod diagram;
mod engine;
mod equal;
mod explain;
mod first_difference;
mod formats;
mod golden;
mod list;
mod machine;
mod manual;
mod moment;
mod names;
mod new;
mod number;
mod pictures;
mod player;
mod prove;
mod render;
mod reproduce;
mod save_file;
mod scene;
mod shell;
mod synth;
mod trace;
mod verdict;
mod verilog;
mod view;
mod viewer;
mod watch;
mod wave;
mod wcp;
mod why;

use clap::{Parser, Subcommand};
use shell::{Exit, Failure, crash, interrupt, progress, terminal};
use std::process::ExitCode;

/// Parallel rendering machines of the 1990s, as hardware that runs cycle by cycle
#[derive(Parser)]
#[command(name = "tilewright", version, after_help = AFTER_HELP)]
struct CommandLine {
    #[command(subcommand)]
    command: Command,
    /// Print no progress, no `wrote FILE` and no report in words; print warnings and errors
    #[arg(short, long, global = true)]
    quiet: bool,
}

const AFTER_HELP: &str = "\
Exit codes:
  0    done
  1    a check failed: a frame, or the pixel that is asked about, differs from the golden image, an assertion of the hardware fails, a cover of a block is never reached, a module differs from the block that it is compared with, a block does not fit its device or is too slow there, two waveforms differ, or simulators or engines disagree
  2    bad usage or bad input
  3    an output cannot be written
  4    an external program is not installed, or fails
  5    a statement is neither proved nor refuted
  70   a mistake in tilewright itself
  71   out of memory
  129  as 130, because the terminal closed (SIGHUP)
  130  interrupted; a waveform that was being written can be opened
  143  as 130, by a request of another program (SIGTERM)

Results go to standard output, everything else to standard error. With `-o -` or `--vcd -` the picture or the waveform goes to standard output,
and all text to standard error. `--quiet` leaves out progress, `wrote FILE` and reports. It keeps the tables of list and bench, waves in text,
--json, warnings and errors.
A file is written whole or not at all. It keeps its permissions and, where the system allows it, its owner. A link is followed to its target.
Only a waveform grows in place.
`tilewright help COMMAND` shows the options and examples of a command.";

#[derive(Subcommand)]
enum Command {
    Render(Box<render::Render>),
    Compare(compare::Compare),
    Golden(golden::Golden),
    Wave(wave::Wave),
    Why(Box<why::Why>),
    Debug(debug::Debug),
    View(view::View),
    Verilog(verilog::Verilog),
    Prove(prove::Prove),
    Diagram(diagram::Diagram),
    Synth(synth::Synth),
    Bitstream(bitstream::Bitstream),
    Reproduce(reproduce::Reproduce),
    Bench(bench::Bench),
    Explain(explain::Explain),
    List(list::List),
    New(new::New),
    Completions(completions::Completions),
    Manual(manual::Manual),
}

impl Command {
    fn run(self) -> Result<Exit, Failure> {
        match self {
            Command::Render(it) => it.run(),
            Command::Compare(it) => it.run(),
            Command::Golden(it) => it.run(),
            Command::Wave(it) => it.run(),
            Command::Why(it) => it.run(),
            Command::Debug(it) => it.run(),
            Command::View(it) => it.run(),
            Command::Verilog(it) => it.run(),
            Command::Prove(it) => it.run(),
            Command::Diagram(it) => it.run(),
            Command::Synth(it) => it.run(),
            Command::Bitstream(it) => it.run(),
            Command::Reproduce(it) => it.run(),
            Command::Bench(it) => it.run(),
            Command::Explain(it) => it.run(),
            Command::List(it) => it.run(),
            Command::New(it) => it.run(),
            Command::Completions(it) => it.run(),
            Command::Manual(it) => it.run(),
        }
    }
}

fn main() -> ExitCode {
    interrupt::tame();
    crash::guard(|| match CommandLine::try_parse() {
        Ok(line) => {
            if line.quiet {
                terminal::be_quiet();
            }
            progress::begin();
            line.command.run()
        }
        Err(shown) if shown.use_stderr() => {
            terminal::scold(&shown.to_string());
            Ok(Exit::BadInput)
        }
        Err(help) => terminal::check(help.print()).map(|()| Exit::Done),
    })
    .inspect(|_| progress::end())
    .unwrap_or_else(|failure| {
        progress::end();
        terminal::complain(&failure);
        failure.exit
    })
    .into()
}
