//! The files beside a waveform, with which a viewer shows its signals at once.

use crate::shell::output::{Output, quoted};
use crate::shell::place::beside;
use crate::shell::{Failure, terminal};
use crate::{command_file, save_file};
use std::fs::File;
use std::io::Read;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A viewer of waveforms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Viewer {
    GtkWave,
    Surfer,
}

/// The viewers, each with the end of the name of its file, and the file's first line.
const VIEWERS: [(Viewer, &str, &str); 2] =
    [(Viewer::GtkWave, "gtkw", save_file::FIRST_LINE), (Viewer::Surfer, "sucl", command_file::FIRST_LINE)];

/// The files beside a waveform; none if it is a pipe or a device.
pub fn files(waveform: &Path) -> Vec<(Viewer, PathBuf)> {
    VIEWERS.iter().filter_map(|(viewer, end, _)| Some((*viewer, beside(waveform, end)?))).collect()
}

/// The name of a waveform, which must not be that of a file beside it.
pub fn waveform(path: PathBuf) -> Result<PathBuf, &'static str> {
    if VIEWERS.iter().any(|(_, end, _)| path.extension().is_some_and(|it| it == *end)) {
        Err("a viewer's file is written beside the waveform: name the waveform itself, such as wave.vcd")
    } else {
        Ok(path)
    }
}

impl Viewer {
    /// Prepares its file, which an earlier run may have written. If somebody else has, it is kept, with a warning.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn prepare(self, path: &Path) -> Result<Option<Output>, Failure> {
        is_ours_or_warn(path, self.first_line()).then(|| Output::at(path)).transpose()
    }

    /// Its file for a waveform with that header, of these picoseconds. It shows the top module, or with `all` every signal.
    pub fn text(self, waveform: &Path, header: &[u8], times: Range<u64>, all: bool) -> String {
        match self {
            Viewer::GtkWave => save_file::of(waveform, header, times, all),
            Viewer::Surfer => command_file::of(header, all),
        }
    }

    /// The command that opens a waveform with its file.
    pub fn command(self, waveform: &Path, file: &Path) -> String {
        let (waveform, file) = (quoted(waveform), quoted(file));
        match self {
            Viewer::GtkWave => format!("gtkwave {waveform} {file}"),
            Viewer::Surfer => format!("surfer -c {file} {waveform}"),
        }
    }

    fn first_line(self) -> &'static str {
        VIEWERS.iter().find(|(viewer, ..)| *viewer == self).map_or("", |(.., line)| line)
    }
}

/// Whether a file is missing, or begins with that line. If somebody else has written it, there is a warning that it is kept.
pub fn is_ours_or_warn(path: &Path, first_line: &str) -> bool {
    let is_ours = is_ours(path, first_line);
    if !is_ours {
        let path = path.display();
        terminal::warn(&format!("{path} was not written by tilewright and is kept: remove it to have it written"));
    }
    is_ours
}

/// Whether a file is missing, or begins with that line.
fn is_ours(path: &Path, first_line: &str) -> bool {
    let mut begin = String::new();
    let read = |file: File| file.take(first_line.len() as u64).read_to_string(&mut begin);
    let is_read = path.is_file() && File::open(path).and_then(read).is_ok();
    !path.exists() || is_read && begin == first_line
}
