//! Writes a file completely or not at all.
//!
//! The bytes go to a new file in the same folder and are flushed to the disk. Only then does it take the name. A full
//! disk or a killed run leaves the old file, or none, and nothing beside it: on Linux the new file has no name until
//! then.

use crate::error::SceneError;
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};

/// Writes `bytes` to `path`, replacing what was there, or leaves everything as it was.
///
/// # Errors
/// As [`WholeFile::at`] and [`WholeFile::fill`].
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), SceneError> {
    let mut file = WholeFile::at(path)?;
    file.fill(bytes)?;
    file.commit()
}

/// A file that takes its name when all of it is on the disk.
#[derive(Debug)]
pub struct WholeFile {
    /// The path as the user gave it.
    path: PathBuf,
    sink: Sink,
}

#[derive(Debug)]
enum Sink {
    /// A device or a pipe.
    Stream(File),
    /// The final path.
    Aside(PathBuf, Aside),
}

/// A new file in the same folder.
#[derive(Debug)]
enum Aside {
    /// It vanishes with the process, however that ends.
    Nameless(File),
    /// It is deleted when dropped.
    Named(NamedTempFile),
}

impl WholeFile {
    /// Prepares to write that file, and checks that the system allows it. Nothing is visible to a user yet; only a
    /// device or a pipe is opened.
    ///
    /// # Errors
    /// [`SceneError::Write`], naming the file: it is a folder, it or its folder is not writable, or its folder does not
    /// exist.
    pub fn at(path: &Path) -> Result<WholeFile, SceneError> {
        let sink = match Place::of(path)? {
            Place::Stream => OpenOptions::new().write(true).open(path).map(Sink::Stream),
            Place::File(real) => Aside::new(folder(&real)).map(|aside| Sink::Aside(real, aside)),
        };
        let path = path.to_owned();
        match sink {
            Ok(sink) => Ok(WholeFile { path, sink }),
            Err(error) => Err(SceneError::unwritable(&path, &error)),
        }
    }

    /// Writes the bytes to the disk. The new file takes the permissions of the file that it replaces, and its owner if
    /// the system allows it.
    ///
    /// # Errors
    /// [`SceneError::Write`], naming the file: a full disk.
    pub fn fill(&mut self, bytes: &[u8]) -> Result<(), SceneError> {
        match &mut self.sink {
            Sink::Stream(file) => file.write_all(bytes),
            Sink::Aside(real, aside) => fill(aside.file(), bytes, real),
        }
        .map_err(|error| SceneError::unwritable(&self.path, &error))
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// [`SceneError::Write`], naming the file.
    pub fn commit(self) -> Result<(), SceneError> {
        match self.sink {
            Sink::Stream(_) => Ok(()),
            Sink::Aside(real, aside) => aside.become_file(&real),
        }
        .map_err(|error| SceneError::unwritable(&self.path, &error))
    }
}

impl Aside {
    fn new(folder: &Path) -> io::Result<Aside> {
        // Not all systems and disks have files without a name.
        nameless::create(folder).map(Aside::Nameless).or_else(|_| named().tempfile_in(folder).map(Aside::Named))
    }

    fn file(&mut self) -> &mut File {
        match self {
            Aside::Nameless(file) => file,
            Aside::Named(named) => named.as_file_mut(),
        }
    }

    fn become_file(self, real: &Path) -> io::Result<()> {
        match self {
            Aside::Nameless(file) => {
                let linked = named().make_in(folder(real), |path| nameless::link(&file, path))?;
                Ok(linked.persist(real).map(|_| ())?)
            }
            Aside::Named(named) => Ok(named.persist(real).map(|_| ())?),
        }
    }
}

/// The name of a temporary file: short, because the final name may have the greatest length allowed.
fn named() -> Builder<'static, 'static> {
    let mut builder = Builder::new();
    builder.prefix(".tilewright-").suffix(".part");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder
}

fn fill(file: &mut File, bytes: &[u8], real: &Path) -> io::Result<()> {
    file.write_all(bytes)?;
    if let Ok(old) = fs::metadata(real) {
        keep_owner(file, &old);
        file.set_permissions(old.permissions())?;
    }
    file.sync_all()
}

/// Gives a file the owner and the group of another one; only the superuser may do that for arbitrary owners.
#[cfg(unix)]
fn keep_owner(file: &File, old: &fs::Metadata) {
    use std::os::unix::fs::{MetadataExt, fchown};
    let _ = fchown(file, Some(old.uid()), Some(old.gid()));
}

#[cfg(not(unix))]
fn keep_owner(_: &File, _: &fs::Metadata) {}

/// Files without a name.
#[cfg(target_os = "linux")]
mod nameless {
    use rustix::fs::{AtFlags, CWD, OFlags, linkat};
    use std::fs::{File, OpenOptions};
    use std::io;
    use std::os::fd::AsRawFd;
    use std::os::unix::fs::OpenOptionsExt;
    use std::path::Path;

    /// The links through which an open file can be named.
    const OPEN_FILES: &str = "/proc/self/fd";

    pub fn create(folder: &Path) -> io::Result<File> {
        if !Path::new(OPEN_FILES).exists() {
            return Err(io::ErrorKind::Unsupported.into());
        }
        OpenOptions::new().write(true).custom_flags(OFlags::TMPFILE.bits() as i32).open(folder)
    }

    pub fn link(file: &File, path: &Path) -> io::Result<()> {
        let open = format!("{OPEN_FILES}/{}", file.as_raw_fd());
        Ok(linkat(CWD, open, CWD, path, AtFlags::SYMLINK_FOLLOW)?)
    }
}

#[cfg(not(target_os = "linux"))]
mod nameless {
    use std::fs::File;
    use std::io;
    use std::path::Path;

    pub fn create(_: &Path) -> io::Result<File> {
        Err(io::ErrorKind::Unsupported.into())
    }

    pub fn link(_: &File, _: &Path) -> io::Result<()> {
        Err(io::ErrorKind::Unsupported.into())
    }
}

/// The kind of an output in the file system.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// A device or a pipe, which is written directly.
    Stream,
    /// A plain file, which may not exist yet, with all links resolved. If a link's target is missing, the file is made
    /// there.
    File(PathBuf),
}

impl Place {
    /// The kind of the output with that name.
    ///
    /// # Errors
    /// [`SceneError::Write`], naming the file: it is a folder, it is not writable, or its folder does not exist.
    pub fn of(path: &Path) -> Result<Place, SceneError> {
        Place::look(path).map_err(|error| SceneError::unwritable(path, &error))
    }

    fn look(path: &Path) -> io::Result<Place> {
        match fs::metadata(path) {
            Ok(known) if known.is_dir() => return Err(ErrorKind::IsADirectory.into()),
            Ok(known) if !known.is_file() => return Ok(Place::Stream),
            Ok(known) if known.permissions().readonly() => return Err(ErrorKind::PermissionDenied.into()),
            Ok(_) => drop(OpenOptions::new().write(true).open(path)?),
            Err(_) if !ends_in_a_name(path) => return Err(ErrorKind::IsADirectory.into()),
            Err(_) => {}
        }
        behind_links(path).map(Place::File)
    }
}

/// Whether a path names more than a folder, unlike `a/` and `a/..`.
fn ends_in_a_name(path: &Path) -> bool {
    let end = path.as_os_str().as_encoded_bytes();
    path.file_name().is_some_and(|name| end.ends_with(name.as_encoded_bytes()))
}

/// The file itself with links and dots resolved, even if it does not exist yet.
///
/// # Errors
/// Its folder does not exist, or may not be entered.
pub fn behind_links(path: &Path) -> io::Result<PathBuf> {
    match fs::canonicalize(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => match fs::read_link(path) {
            Ok(target) => behind_links(&folder(path).join(target)),
            Err(_) => Ok(fs::canonicalize(folder(path))?.join(path.file_name().ok_or(error)?)),
        },
        found => found,
    }
}

/// The folder that a file is in.
fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

impl SceneError {
    /// The error for an output that the system does not let us write, with the remedy.
    pub fn unwritable(path: &Path, error: &io::Error) -> SceneError {
        SceneError::Write { path: path.to_owned(), reason: reason(error), remedy: remedy(path, error) }
    }
}

/// The system's message, in lower case and without its number.
pub(crate) fn reason(error: &io::Error) -> String {
    let text = error.to_string();
    let text = text.split(" (os error").next().unwrap_or_default();
    text.to_lowercase()
}

fn remedy(path: &Path, error: &io::Error) -> String {
    match error.kind() {
        ErrorKind::NotFound if !folder(path).exists() => format!("make the folder `{}` first", folder(path).display()),
        ErrorKind::NotADirectory => format!("`{}` is no folder: name a file in one", folder(path).display()),
        ErrorKind::IsADirectory => "name a file in that folder".to_owned(),
        ErrorKind::PermissionDenied => "choose a place that you may write to".to_owned(),
        ErrorKind::StorageFull => "make room, or choose another disk".to_owned(),
        ErrorKind::FileTooLarge => "allow larger files (`ulimit -f`), or choose another disk".to_owned(),
        _ => "choose another place".to_owned(),
    }
}
