//! Programs that take long, and that somebody may want to stop.

use std::fs::File;
use std::io;
use std::ops::ControlFlow;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// The time between two looks.
const PAUSE: Duration = Duration::from_millis(10);

/// A program, which is ended when dropped.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // One that has ended cannot be killed.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Runs a program without input, with all that it prints in a file. `watch` is asked again and again. Where it breaks,
/// the program is ended.
///
/// ```
/// use std::ops::ControlFlow::{Break, Continue};
/// use std::process::Command;
/// use tilewright_gen::tools::run_watched;
///
/// let printed = tempfile::NamedTempFile::new()?;
/// let ended = run_watched(Command::new("rustc").arg("--version"), printed.reopen()?, || Continue::<()>(()))?;
/// assert!(matches!(ended, Continue(status) if status.success()));
/// assert!(std::fs::read_to_string(printed.path())?.starts_with("rustc "));
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
///
/// The program cannot be run.
pub fn run_watched<B>(
    command: &mut Command,
    printed: File,
    mut watch: impl FnMut() -> ControlFlow<B>,
) -> io::Result<ControlFlow<B, ExitStatus>> {
    let mut child = Running(command.stdin(Stdio::null()).stderr(printed.try_clone()?).stdout(printed).spawn()?);
    loop {
        if let Some(status) = child.0.try_wait()? {
            return Ok(ControlFlow::Continue(status));
        }
        if let ControlFlow::Break(why) = watch() {
            return Ok(ControlFlow::Break(why));
        }
        sleep(PAUSE);
    }
}
