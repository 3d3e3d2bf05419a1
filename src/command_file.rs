//! Surfer's command file: the signals that it shows when it opens a waveform.
//!
//! Its format is that of Surfer's page of commands: a command a line, and `#` before a comment.

use crate::save_file::shown;
use std::fmt::Write;
use vcd::Parser;

/// The first line of every file that Tilewright writes.
pub const FIRST_LINE: &str = "# Tilewright\n";

/// The command file for a waveform with that header. It shows the whole time, and the signals of the top module, or with `all` every
/// signal.
///
/// # Panics
/// The header is not one that the simulation writes.
pub fn of(header: &[u8], all: bool) -> String {
    let header = Parser::new(header).parse_header().expect("the simulation writes sound headers");
    let mut text = FIRST_LINE.to_owned();
    for (path, variable) in shown(&header, all) {
        // Surfer's reader takes lanes and words for the elements of an array, which is a scope: `words[3]` is `[3]` in `words`.
        let _ = writeln!(text, "variable_add {path}.{}", variable.reference.replace('[', ".["));
    }
    text + "zoom_fit\n"
}
