//! `tilewright completions`: a script that completes commands, options and names in a shell.

use crate::CommandLine;
use crate::names;
use crate::shell::{Exit, Failure, terminal};
use clap::{Args, CommandFactory};
use clap_complete::Shell;

/// Prints the completion script of a shell
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright completions bash > tilewright.bash
  tilewright completions zsh > _tilewright")]
pub struct Completions {
    /// The shell
    #[arg(value_parser = names::of::<Shell>("shell"))]
    shell: Shell,
}

impl Completions {
    /// Prints the script.
    pub fn run(self) -> Result<Exit, Failure> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut CommandLine::command(), "tilewright", &mut script);
        terminal::print(&String::from_utf8_lossy(&script))?;
        Ok(Exit::Done)
    }
}
