//! Surfer's formats for a block's values: the names of codes, and the fields of words that are records.
//!
//! Surfer looks for them in `.surfer` of the folder in which it starts, and offers each in its menu of formats to every
//! variable of that width, also in a waveform of another program.

mod codes;
mod records;

use crate::command_file::FIRST_LINE;
use crate::shell::Failure;
use crate::shell::output::Folder;
use crate::viewer::is_ours_or_warn;
use std::path::{Path, PathBuf};
use tilewright_hdl::ir::Design;
use tilewright_sim::Simulation;

/// Where Surfer looks for them.
const FOLDER: &str = ".surfer";

/// Writes the formats of a block beside a waveform. What somebody else wrote is kept, with a warning.
///
/// # Errors
/// One cannot be written.
pub fn write(waveform: &Path, design: &Design, sim: &Simulation) -> Result<Vec<PathBuf>, Failure> {
    let within = waveform.parent().unwrap_or(Path::new("")).join(FOLDER);
    let codes = codes::files(sim).into_iter().map(|(name, text)| (format!("mappings/{name}"), text));
    let records = records::files(design).into_iter().map(|(name, text)| (format!("decoders/{name}/fields.toml"), text));
    let is_ours = |(path, _): &(String, String)| is_ours_or_warn(&within.join(path), FIRST_LINE);
    let files: Vec<(String, String)> = codes.chain(records).filter(is_ours).collect();
    if files.is_empty() {
        return Ok(Vec::new());
    }
    let folders: Vec<&str> = files.iter().filter_map(|(path, _)| Some(path.rsplit_once('/')?.0)).collect();
    let texts = files.iter().map(|(path, text)| (path.as_str(), text.as_bytes()));
    Folder::make_with(&within, &folders)?.fill(texts)?;
    Ok(files.iter().map(|(path, _)| within.join(path)).collect())
}

/// These formats, each with its name: that of the thing, with a number if an earlier one is called alike.
fn named<T>(formats: Vec<(&str, T)>, text: impl Fn(&str, &T) -> String) -> Vec<(String, String)> {
    let name = |at: usize| match formats[..at].iter().filter(|(other, _)| *other == formats[at].0).count() {
        0 => formats[at].0.to_owned(),
        alike => format!("{}_{}", formats[at].0, alike + 1),
    };
    let file = |(at, (_, format)): (usize, &(&str, T))| (name(at), text(&name(at), format));
    formats.iter().enumerate().map(file).collect()
}
