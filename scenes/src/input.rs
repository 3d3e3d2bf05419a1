//! Reading a user's file, with an error that names it.

use crate::SceneError;
use crate::output::reason;
use std::io;
use std::path::Path;

/// The bytes of a file; `remedy` says what to do if it cannot be read.
pub(crate) fn read_bytes(path: &Path, remedy: &str) -> Result<Vec<u8>, SceneError> {
    let failed = |error: io::Error| SceneError::Read {
        path: path.to_owned(),
        reason: reason(&error),
        remedy: remedy.to_owned(),
    };
    // Opening a directory for reading succeeds on some systems.
    if path.is_dir() {
        return Err(failed(io::ErrorKind::IsADirectory.into()));
    }
    std::fs::read(path).map_err(failed)
}
