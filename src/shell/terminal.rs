//! Standard output for results, standard error for talk, and files that appear whole or not at all.

use super::{Exit, Failure};
use serde::Serialize;
use std::fs;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use tilewright_scenes::write_whole;

/// Prints a result. A reader that has gone away, as `head` does, is no error.
///
/// # Errors
/// Standard output cannot be written, such as a file on a full disk.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    check(out.write_all(text.as_bytes()).and_then(|()| out.flush()))
}

/// Prints a result as JSON.
///
/// # Errors
/// As [`print()`].
pub fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(value).expect("reports have names for keys and finite numbers");
    print(&(text + "\n"))
}

/// What became of writing to standard output.
///
/// # Errors
/// As [`print()`].
pub fn check(written: io::Result<()>) -> Result<(), Failure> {
    match written {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::unwritable(&"standard output", &error)),
        _ => Ok(()),
    }
}

/// Tells the user something that is no result.
pub fn talk(line: &str) {
    // Nobody is left to tell if standard error is closed.
    let _ = writeln!(io::stderr(), "{line}");
}

/// Writes a file, whole or not at all, and says so.
///
/// # Errors
/// It cannot be written.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_whole(path, bytes)?;
    talk(&format!("wrote {}", path.display()));
    Ok(())
}

/// Makes a folder and those above it, unless they are there.
///
/// # Errors
/// It cannot be made.
pub fn make_folder(path: &Path) -> Result<(), Failure> {
    fs::create_dir_all(path).map_err(|error| Failure::unwritable(&path.display(), &error))
}

/// Whether a file can be written there, as far as that can be told beforehand; a long run should not end in a misspelt folder.
///
/// # Errors
/// It is a folder, or in a folder that is not there.
pub fn check_place(path: &Path) -> Result<(), Failure> {
    let folder = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    let problem = match folder {
        _ if path.is_dir() => "it is a folder: name a file in it".to_owned(),
        Some(folder) if !folder.is_dir() => format!("make the folder `{}` first", folder.display()),
        _ => return Ok(()),
    };
    Err(Failure::new(Exit::NoOutput, format!("{}: cannot be written: {problem}", path.display())))
}

/// The file of that extension beside an output, or `None` if the output is no plain file, such as a pipe: beside that no
/// file belongs.
pub fn beside(path: &Path, extension: &str) -> Option<PathBuf> {
    (!is_device(path) && !path.is_dir()).then(|| path.with_extension(extension))
}

/// Whether what is written there goes elsewhere than to a plain file. /dev/stdout may be one underneath, but not by that name.
fn is_device(path: &Path) -> bool {
    let elsewhere = fs::metadata(path).is_ok_and(|known| !known.is_file() && !known.is_dir());
    elsewhere || path.starts_with("/dev") || path.starts_with("/proc")
}

/// That no output is also another output, or one of the files that are read.
///
/// # Errors
/// Two are the same file, whatever their names.
pub fn check_distinct(outputs: &[&Path], inputs: &[&Path]) -> Result<(), Failure> {
    let outputs: Vec<&Path> = outputs.iter().copied().filter(|path| !is_device(path)).collect();
    for (i, output) in outputs.iter().enumerate() {
        let place = real(output);
        let same = |others: &[&Path]| {
            others.iter().find(|other| real(other) == place).map(|other| other.display().to_string())
        };
        let read = same(inputs).map(|input| format!("{input}, which is read: name another output"));
        let clash =
            read.or_else(|| same(&outputs[..i]).map(|other| format!("{other}, another output: name another file")));
        if let Some(clash) = clash {
            let problem = format!("{}: would be written over {clash}", output.display());
            return Err(Failure::new(Exit::BadInput, problem));
        }
    }
    Ok(())
}

/// The file itself behind links and dots, also if it is not there yet.
fn real(path: &Path) -> PathBuf {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let beside = || Some(fs::canonicalize(folder).ok()?.join(path.file_name()?));
    fs::canonicalize(path).ok().or_else(beside).unwrap_or_else(|| path.to_owned())
}

/// A path as a shell takes it.
pub fn quoted(path: &Path) -> String {
    let text = path.display().to_string();
    let plain = |c: char| c.is_alphanumeric() || "-_./+,:@%=".contains(c);
    if !text.is_empty() && text.chars().all(plain) { text } else { format!("'{}'", text.replace('\'', r"'\''")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shell_reads_back_what_was_quoted() {
        assert_eq!(quoted(Path::new("out/mu.vcd")), "out/mu.vcd");
        assert_eq!(quoted(Path::new("my wave's.vcd")), r"'my wave'\''s.vcd'");
    }
}
