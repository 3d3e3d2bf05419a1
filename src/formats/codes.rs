//! Surfer's mapping files: the names of codes, by which it shows numbers of a waveform, also of one of another program.
//!
//! Surfer looks for them in `.surfer/mappings` of the folder in which it starts, and offers each as a format. A file has the
//! format's name, the number of bits, and a line for each number: that of Surfer's page on mapping translators.

use crate::command_file::FIRST_LINE;
use crate::shell::Failure;
use crate::shell::output::Folder;
use crate::viewer::is_ours_or_warn;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use tilewright_hdl::ir::Names;
use tilewright_sim::Simulation;

/// Where Surfer looks for them.
const FOLDER: &str = ".surfer/mappings";

/// Writes the mapping files of a block's codes beside a waveform. What somebody else wrote is kept, with a warning.
///
/// # Errors
/// One cannot be written.
pub fn write(waveform: &Path, sim: &Simulation) -> Result<Vec<PathBuf>, Failure> {
    let folder = waveform.parent().unwrap_or(Path::new("")).join(FOLDER);
    let files: Vec<(String, String)> =
        of(sim).into_iter().filter(|(name, _)| is_ours_or_warn(&folder.join(name), FIRST_LINE)).collect();
    if files.is_empty() {
        return Ok(Vec::new());
    }
    Folder::make(&folder)?.fill(files.iter().map(|(name, text)| (name.as_str(), text.as_bytes())))?;
    Ok(files.iter().map(|(name, _)| folder.join(name)).collect())
}

/// The file of each kind of code, by name.
fn of(sim: &Simulation) -> Vec<(String, String)> {
    let signals = sim.program().hierarchy.scopes.iter().flat_map(|scope| &scope.signals);
    let mut kinds: Vec<(Names, u32)> = Vec::new();
    for kind in signals.filter_map(|signal| Some((signal.kind.names()?, signal.width))) {
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    let alike = |at: usize| kinds[..at].iter().filter(|(names, _)| names.of == kinds[at].0.of).count();
    let file = |(at, (names, width)): (usize, &(Names, u32))| {
        let name = if alike(at) == 0 { names.of.to_owned() } else { format!("{}_{}", names.of, alike(at) + 1) };
        let text = text(&name, *names, *width);
        (name, text)
    };
    kinds.iter().enumerate().map(file).collect()
}

fn text(name: &str, names: Names, width: u32) -> String {
    let mut text = format!("{FIRST_LINE}Name = {name}\nBits = {width}\n");
    for (code, value) in names.codes.iter().zip(names.values) {
        let _ = writeln!(text, "{value} {code}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_hdl::{Codes, codes};

    codes! { enum Phase { Idle = 0, Run = 2, Finished = 5 } }

    #[test]
    fn a_file_has_a_name_a_width_and_a_line_for_each_code() {
        let expected = "# Tilewright\nName = Phase\nBits = 3\n0 Idle\n2 Run\n5 Finished\n";
        assert_eq!(text("Phase", Phase::NAMES, 3), expected);
    }
}
