//! What the user reads: results on standard output, everything else on standard error.

use super::text::{legible, legible_json, one_line};
use super::{Failure, progress};
use serde::Serialize;
use std::io::{self, ErrorKind, Write};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use tilewright_scenes::SceneError;

static QUIET: AtomicBool = AtomicBool::new(false);
static TAKEN: AtomicBool = AtomicBool::new(false);

/// From now on only results, warnings and errors are printed.
pub fn be_quiet() {
    QUIET.store(true, Relaxed);
}

/// Whether only results, warnings and errors are printed.
pub fn is_quiet() -> bool {
    QUIET.load(Relaxed)
}

/// From now on all text goes to standard error, because standard output takes a picture or a waveform.
pub fn take_standard_output() {
    TAKEN.store(true, Relaxed);
}

/// The name of standard output in errors.
pub const STANDARD_OUTPUT: &str = "standard output";

/// Prints a result. It is no error if the reader has closed the pipe, as `head` does.
///
/// # Errors
/// Standard output cannot be written, such as a file on a full disk.
pub fn print(text: &str) -> Result<(), Failure> {
    if TAKEN.load(Relaxed) {
        tell(text.trim_end_matches('\n'));
        return Ok(());
    }
    progress::end();
    let mut out = io::stdout().lock();
    check(out.write_all(text.as_bytes()).and_then(|()| out.flush()))
}

/// Prints a command's report, unless it is to be quiet.
///
/// # Errors
/// As [`print()`].
pub fn report(text: &str) -> Result<(), Failure> {
    if is_quiet() { Ok(()) } else { print(&legible(text)) }
}

/// Prints a result as JSON.
///
/// # Errors
/// As [`print()`].
pub fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(value).expect("reports have names for keys and finite numbers");
    print(&(legible_json(&text) + "\n"))
}

/// The result of writing to standard output.
///
/// # Errors
/// As [`print()`].
pub fn check(written: io::Result<()>) -> Result<(), Failure> {
    match written {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(SceneError::unwritable(Path::new(STANDARD_OUTPUT), &error).into())
        }
        _ => Ok(()),
    }
}

/// Tells the user something other than a result, unless it is to be quiet.
pub fn talk(line: &str) {
    if !is_quiet() {
        tell(&one_line(line));
    }
}

/// Warns the user of something odd but harmless.
pub fn warn(line: &str) {
    tell(&one_line(&format!("warning: {line}")));
}

/// Tells the user why a command failed.
pub fn complain(failure: &Failure) {
    for sentence in failure.sentences() {
        tell(&legible(&format!("error: {sentence}")));
    }
}

/// Tells the user what is wrong with the command line.
pub fn scold(text: &str) {
    tell(&legible(text.trim_end()));
}

/// Writes lines to standard error.
pub fn tell(lines: &str) {
    // Nobody is left to tell if standard error is closed.
    progress::aside(|| drop(writeln!(io::stderr(), "{lines}")));
}
