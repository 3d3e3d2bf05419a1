//! `tilewright manual`: pages for `man`, one for each command.

use crate::CommandLine;
use crate::shell::output::Folder;
use crate::shell::{Exit, Failure};
use clap::{Args, CommandFactory};
use clap_mangen::Man;
use std::path::PathBuf;

/// Writes the manual, a page for `man` for each command
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright manual -o man/man1

`man -M man tilewright-render` then shows a page. In ~/.local/share/man/man1, or /usr/local/share/man/man1 for all users, `man` finds the pages by itself.
They say what `tilewright help COMMAND` says. A package of this program has its build run this command, and `tilewright completions`.")]
pub struct Manual {
    /// The folder for the pages, which is made if it is not there; all of them are written, or none
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
}

impl Manual {
    /// Writes the pages.
    pub fn run(self) -> Result<Exit, Failure> {
        Folder::check(&self.output)?;
        let pages = pages();
        Folder::make(&self.output)?.fill(pages.iter().map(|(name, text)| (name.as_str(), text.as_slice())))?;
        Ok(Exit::Done)
    }
}

/// The names of the pages' files, and what is in them.
fn pages() -> Vec<(String, Vec<u8>)> {
    let mut whole = CommandLine::command().disable_help_subcommand(true);
    // Subcommands get their full names, and the options of all commands.
    whole.build();
    let commands = std::iter::once(&whole).chain(whole.get_subcommands());
    let page = |command: &clap::Command| {
        let version = whole.get_version().unwrap_or_default();
        let man = Man::new(command.clone()).source(format!("tilewright {version}")).manual("Tilewright");
        let mut text = Vec::new();
        man.render(&mut text).expect("memory takes all that is written");
        (man.get_filename(), text)
    };
    commands.map(page).collect()
}
