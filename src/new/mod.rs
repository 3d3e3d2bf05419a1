//! `tilewright new`: a crate with a first block of hardware.

mod name;
mod origin;
mod template;

use crate::shell::output::{Folder, quoted};
use crate::shell::{Exit, Failure, terminal};
use clap::Args;
use origin::Origin;
use std::fs;
use std::path::{Path, PathBuf};

/// Makes a crate with a block of hardware, its test, its wave and its Verilog
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright new my-block --git https://example.org/tilewright.git

The crate is a new folder of that name. It needs the crates tilewright-hdl, -sim and -gen. --path takes them from a folder with Tilewright's sources,
as in `tilewright new my-block --path ../tilewright`, and --git from a repository. In the crate, `cargo test` runs the block clock by clock,
`cargo run --example wave` shows its wave, and `cargo run --example verilog` prints its Verilog.")]
pub struct New {
    /// The crate's name: lower-case letters, digits, `-` and `_`, a letter first
    #[arg(value_name = "NAME")]
    name: String,
    /// A folder with Tilewright's sources
    #[arg(long, value_name = "FOLDER", conflicts_with = "git")]
    path: Option<PathBuf>,
    /// A repository with Tilewright's sources
    #[arg(long, value_name = "URL")]
    git: Option<String>,
}

impl New {
    /// Writes the crate.
    pub fn run(self) -> Result<Exit, Failure> {
        name::check(&self.name)?;
        let origin = Origin::of(self.path, self.git, env!("CARGO_PKG_REPOSITORY"))?;
        let folder = Path::new(&self.name);
        // A link that points nowhere is there too.
        if fs::symlink_metadata(folder).is_ok() {
            let sentence = format!("{}: exists already: choose another name, or remove it", self.name);
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        let files = template::files(&self.name, &origin)?;
        let made = Folder::make_with(folder, &["examples", "src"])?;
        made.fill(files.iter().map(|(name, text)| (*name, text.as_bytes())))?;
        terminal::report(&format!("(cd {} && cargo test)\n", quoted(folder)))?;
        Ok(Exit::Done)
    }
}
