//! Runs a program that can be interrupted.

use crate::Error;
use crate::model::unwritable;
use crate::solver::{Halt, Patience};
use std::fs::File;
use std::io::{Read, Seek};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// The time between two looks at the watcher.
const SLICE: Duration = Duration::from_millis(10);

/// A program, which is ended when dropped.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
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
    let mut output = File::options().read(true).write(true).create(true).truncate(true).open(folder.join("output"));
    let output = output.as_mut().map_err(|error| unwritable(std::io::Error::from(error.kind())))?;
    let [stdout, stderr] = [output.try_clone(), output.try_clone()];
    let mut command = Command::new(program);
    command.args(arguments).current_dir(folder).stdin(Stdio::null());
    command.stdout(stdout.map_err(unwritable)?).stderr(stderr.map_err(unwritable)?);
    apart(&mut command);
    let failed = |error: std::io::Error| Error::tool(program, error.to_string());
    let mut child = match command.spawn() {
        Ok(child) => Running(child),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(failed(error).into()),
    };
    let status = loop {
        match child.0.try_wait().map_err(failed)? {
            Some(status) => break status,
            None if (patience.stop)() => return Err(Error::Interrupted.into()),
            None if patience.end.is_some_and(|end| Instant::now() >= end) => return Err(Halt::Late),
            None => std::thread::sleep(SLICE),
        }
    };
    let mut text = Vec::new();
    output.rewind().and_then(|()| output.read_to_end(&mut text)).map_err(failed)?;
    Ok(Some((status.success(), String::from_utf8_lossy(&text).trim().to_owned())))
}

/// Keeps Ctrl-C from a program: it is for this one alone, which then ends the other.
pub fn apart(command: &mut Command) {
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(command, 0);
    #[cfg(not(unix))]
    let _ = command;
}
