//! Writing a file whole or not at all.
//!
//! The bytes go to a new file in the same folder, are flushed to the disk, and take the name only then: a full disk or a killed run
//! leaves the old file, or none. A device or a pipe cannot be renamed over and is written directly.

use crate::error::SceneError;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

/// Writes `bytes` to `path`, replacing what was there, or leaves everything as it was.
///
/// # Errors
/// [`SceneError::Write`], naming the file: no such folder, no permission, a full disk.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), SceneError> {
    let failed = |error: io::Error| SceneError::Write {
        path: path.to_owned(),
        reason: reason(&error),
        remedy: remedy(path, &error),
    };
    // /dev/stdout may be a plain file underneath; to rename over that would leave the caller's handle with the old one.
    let device = path.starts_with("/dev") || path.starts_with("/proc");
    match fs::metadata(path) {
        Ok(known) if known.is_dir() => Err(failed(io::ErrorKind::IsADirectory.into())),
        Ok(known) if device || !known.is_file() => write_directly(path, bytes).map_err(failed),
        Ok(known) if known.permissions().readonly() => Err(failed(io::ErrorKind::PermissionDenied.into())),
        // Through a link, the file that it points to is replaced and the link stays.
        Ok(_) => fs::canonicalize(path).and_then(|real| replace(&real, bytes)).map_err(failed),
        Err(_) => replace(path, bytes).map_err(failed),
    }
}

fn write_directly(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = OpenOptions::new().write(true).open(path)?;
    file.write_all(bytes)?;
    file.flush()
}

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let (aside, file) = create_aside(path)?;
    let written = fill(file, path, bytes).and_then(|()| fs::rename(&aside, path));
    if written.is_err() {
        // The error that matters is the first one; a leftover that cannot be removed either is no news.
        let _ = fs::remove_file(&aside);
    }
    written
}

fn fill(mut file: File, path: &Path, bytes: &[u8]) -> io::Result<()> {
    file.write_all(bytes)?;
    if let Ok(old) = fs::metadata(path) {
        file.set_permissions(old.permissions())?;
    }
    file.sync_all()
}

/// A new file beside `path`, hidden, with a name that no other writer uses.
fn create_aside(path: &Path) -> io::Result<(PathBuf, File)> {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let name = path.file_name().ok_or(io::ErrorKind::InvalidInput)?;
    loop {
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let mut hidden = std::ffi::OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{}.{count}.part", std::process::id()));
        let aside = path.with_file_name(hidden);
        match OpenOptions::new().write(true).create_new(true).open(&aside) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            opened => return opened.map(|file| (aside, file)),
        }
    }
}

/// What the system said, in lower case and without its number.
pub(crate) fn reason(error: &io::Error) -> String {
    let text = error.to_string();
    let text = text.split(" (os error").next().unwrap_or_default();
    text.to_lowercase()
}

fn remedy(path: &Path, error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => {
            let folder = path.parent().unwrap_or(Path::new("")).display();
            format!("make the folder `{folder}` first")
        }
        io::ErrorKind::IsADirectory => "name a file in that folder".to_owned(),
        io::ErrorKind::PermissionDenied => "choose a place that you may write to".to_owned(),
        io::ErrorKind::StorageFull => "make room, or choose another disk".to_owned(),
        _ => "choose another place".to_owned(),
    }
}
