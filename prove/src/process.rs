//! Runs a program that can be interrupted.

use crate::Error;
use crate::model::unwritable;
use crate::solver::{Halt, Patience};
use std::fs::{self, File};
use std::ops::ControlFlow::{Break, Continue};
use std::path::Path;
use std::process::Command;
use std::time::Instant;
use tempfile::TempDir;
use tilewright_gen::tools::{is_installed, run_watched};

/// The file with all that a program prints.
const PRINTED: &str = "output";

/// A folder that is deleted when dropped.
///
/// # Errors
///
/// It cannot be made.
pub fn temporary() -> Result<TempDir, Error> {
    TempDir::with_prefix("tilewright-").map_err(unwritable)
}

/// Runs a program in a folder; returns whether it succeeded, and its output. `None` if there is no such program.
///
/// # Errors
///
/// It cannot be run, or the watcher asks to stop.
pub fn run(
    program: &'static str,
    arguments: &[&str],
    folder: &Path,
    patience: &Patience,
) -> Result<Option<(bool, String)>, Halt> {
    if !is_installed(program) {
        return Ok(None);
    }
    let path = folder.join(PRINTED);
    let printed = File::create(&path).map_err(unwritable)?;
    let mut command = Command::new(program);
    apart(command.args(arguments).current_dir(folder));
    let ended = run_watched(&mut command, printed, || {
        if (patience.stop)() {
            Break(Halt::from(Error::Interrupted))
        } else if patience.end.is_some_and(|end| Instant::now() >= end) {
            Break(Halt::Late)
        } else {
            Continue(())
        }
    });
    match ended.map_err(|error| Error::tool(program, error.to_string()))? {
        Break(halt) => Err(halt),
        Continue(status) => {
            let text = fs::read(path).map_err(unwritable)?;
            Ok(Some((status.success(), String::from_utf8_lossy(&text).trim().to_owned())))
        }
    }
}

/// What a program printed in this folder that was ended before its end.
pub fn printed(folder: &Path) -> String {
    fs::read(folder.join(PRINTED)).map(|text| String::from_utf8_lossy(&text).into_owned()).unwrap_or_default()
}

/// Keeps Ctrl-C from a program: it is for this one alone, which then ends the other.
pub fn apart(command: &mut Command) {
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(command, 0);
    #[cfg(not(unix))]
    let _ = command;
}
