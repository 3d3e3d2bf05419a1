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

`man -M man tilewright-render` then shows a page. `man` finds pages by itself in ~/.local/share/man/man1, or in /usr/local/share/man/man1 for all users.
The pages contain the same text as `tilewright help COMMAND`. The build of a package should run this command, and `tilewright completions`.")]
pub struct Manual {
    /// Folder for the pages, created if missing; either all pages are written, or none
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
    // Subcommands get their full names, and the global options.
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
