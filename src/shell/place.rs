//! Which file a path leads to. One file can have many names, so the file system is asked.

use super::terminal::STANDARD_OUTPUT;
use super::{Exit, Failure};
use std::fs::{self, File, Metadata};
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};
use tilewright_scenes::behind_links;

/// The identity of a file.
#[derive(Debug, PartialEq)]
enum Identity {
    /// Its device, and its number there.
    Number(u64, u64),
    /// Its path, if it does not exist yet or files have no numbers.
    Path(PathBuf),
}

/// Whether a path means standard output: it is `-`, or leads to the same file or pipe, as `/dev/stdout` does.
pub fn is_standard_output(path: &Path) -> bool {
    is_dash(path)
        || fs::metadata(path).is_ok_and(|there| {
            let standard = standard_output().and_then(|file| file.metadata());
            let same = standard.is_ok_and(|standard| number(&standard).is_some_and(|it| number(&there) == Some(it)));
            same && (!is_device(&there) || io::stdout().is_terminal())
        })
}

fn is_dash(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// An output's name for the user.
pub fn shown(path: &Path) -> String {
    if is_dash(path) { STANDARD_OUTPUT.to_owned() } else { path.display().to_string() }
}

/// The file of that extension beside an output, or `None` if the output is not a plain file, such as a pipe.
pub fn beside(path: &Path, extension: &str) -> Option<PathBuf> {
    let is_plain = !is_standard_output(path) && fs::metadata(path).map_or(true, |there| there.is_file());
    is_plain.then(|| path.with_extension(extension))
}

/// Checks that no output is another output, standard error, or a file that is read.
///
/// # Errors
/// Two are the same file, whatever their names.
pub fn check_distinct(outputs: &[&Path], inputs: &[&Path]) -> Result<(), Failure> {
    let takes_anything = |path: &Path| !is_dash(path) && fs::metadata(path).is_ok_and(|there| is_device(&there));
    let outputs: Vec<&Path> = outputs.iter().copied().filter(|path| !takes_anything(path)).collect();
    let errors = standard_error().and_then(|file| file.metadata()).ok().filter(|there| !is_device(there));
    let errors = errors.and_then(|there| number(&there));
    for (i, output) in outputs.iter().enumerate() {
        let identity = identity(output);
        let same = |others: &[&Path]| others.iter().find(|other| self::identity(other) == identity).copied().map(shown);
        let clash = if let Some(input) = same(inputs) {
            format!("written over {input}, which is read: name another output")
        } else if let Some(other) = same(&outputs[..i]) {
            format!("written over {other}, another output: name another file")
        } else if errors.as_ref() == Some(&identity) {
            "mixed with the errors on standard error: name another file".to_owned()
        } else {
            continue;
        };
        return Err(Failure::new(Exit::BadInput, format!("{}: would be {clash}", shown(output))));
    }
    Ok(())
}

fn identity(path: &Path) -> Identity {
    let there = if is_dash(path) { standard_output().and_then(|file| file.metadata()) } else { fs::metadata(path) };
    let found = there.ok().and_then(|there| number(&there));
    found.unwrap_or_else(|| Identity::Path(behind_links(path).unwrap_or_else(|_| path.to_owned())))
}

#[cfg(unix)]
fn number(there: &Metadata) -> Option<Identity> {
    use std::os::unix::fs::MetadataExt;
    Some(Identity::Number(there.dev(), there.ino()))
}

#[cfg(not(unix))]
fn number(_: &Metadata) -> Option<Identity> {
    None
}

/// Whether it is a device such as a terminal or `/dev/null`, which several can write to.
#[cfg(unix)]
fn is_device(there: &Metadata) -> bool {
    std::os::unix::fs::FileTypeExt::is_char_device(&there.file_type())
}

#[cfg(not(unix))]
fn is_device(there: &Metadata) -> bool {
    !there.is_file() && !there.is_dir()
}

/// Standard output without a buffer, from where it stands.
#[cfg(unix)]
pub fn standard_output() -> io::Result<File> {
    Ok(std::os::fd::AsFd::as_fd(&io::stdout()).try_clone_to_owned()?.into())
}

#[cfg(windows)]
pub fn standard_output() -> io::Result<File> {
    Ok(std::os::windows::io::AsHandle::as_handle(&io::stdout()).try_clone_to_owned()?.into())
}

#[cfg(unix)]
fn standard_error() -> io::Result<File> {
    Ok(std::os::fd::AsFd::as_fd(&io::stderr()).try_clone_to_owned()?.into())
}

#[cfg(windows)]
fn standard_error() -> io::Result<File> {
    Ok(std::os::windows::io::AsHandle::as_handle(&io::stderr()).try_clone_to_owned()?.into())
}
