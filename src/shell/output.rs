//! Where a command writes: a file, a device, a pipe or standard output.
//!
//! Outputs are opened when the inputs have been read and before the work begins. So no long run ends at a place that cannot be written.

use super::place::{is_standard_output, shown, standard_output};
use super::terminal::{self, STANDARD_OUTPUT, take_standard_output, talk};
use super::{Exit, Failure};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tilewright_scenes::{Place, SceneError, WholeFile};
use tilewright_sim::{Fst, Trace, Vcd};

/// An output that is written in one step: a file is written whole or not at all.
pub struct Output {
    name: String,
    to: To,
}

enum To {
    Standard(File),
    File(WholeFile),
}

impl Output {
    /// Prepares an output of that name; `-` is standard output.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn at(path: &Path) -> Result<Output, Failure> {
        let to = match is_standard_output(path) {
            true => To::Standard(taken()?),
            false => To::File(WholeFile::at(path)?),
        };
        Ok(Output { name: shown(path), to })
    }

    /// Writes it, and says so.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write(self, bytes: &[u8]) -> Result<(), Failure> {
        write_all([(self, bytes)])
    }
}

/// Writes several outputs, and says so: if one does not fit, none of the files changes.
///
/// # Errors
/// One cannot be written.
pub fn write_all(outputs: impl IntoIterator<Item = (Output, impl AsRef<[u8]>)>) -> Result<(), Failure> {
    let mut filled = Vec::new();
    for (Output { name, to }, bytes) in outputs {
        match to {
            To::Standard(mut file) => terminal::check(file.write_all(bytes.as_ref()))?,
            To::File(mut file) => {
                file.fill(bytes.as_ref())?;
                filled.push((name, file));
            }
        }
    }
    for (name, file) in filled {
        file.commit()?;
        talk(&format!("wrote {name}"));
    }
    Ok(())
}

/// The file of a waveform, which grows while a simulation runs. An interrupted run leaves what it has written.
pub struct Waveform {
    name: String,
    file: File,
    /// Whether it is an FST file, as its name says, and not a VCD file.
    is_fst: bool,
    /// Whether its old content is removed.
    is_plain: bool,
    /// The path, if the file was created for this run.
    made: Option<PathBuf>,
    /// Whether the user is told that it was written.
    is_told: bool,
}

impl Waveform {
    /// Opens or creates a file of that name, without changing its content; `-` is standard output.
    ///
    /// # Errors
    /// It cannot be written, or another run writes it.
    pub fn at(path: &Path) -> Result<Waveform, Failure> {
        let name = shown(path);
        if is_standard_output(path) {
            let name = STANDARD_OUTPUT.to_owned();
            return Ok(Waveform { name, file: taken()?, is_fst: false, is_plain: false, made: None, is_told: false });
        }
        let place = Place::of(path)?;
        let (real, is_plain) = match &place {
            Place::Stream => (path, false),
            Place::File(real) => (real.as_path(), true),
        };
        let is_new = is_plain && !real.exists();
        let opened = OpenOptions::new().write(true).create(is_plain).truncate(false).open(real);
        let file = opened.map_err(|error| SceneError::unwritable(path, &error))?;
        // Not every file system has locks. Only plain files need one.
        if is_plain && matches!(file.try_lock(), Err(TryLockError::WouldBlock)) {
            let sentence = format!("{name}: another run is writing it: wait until it ends, or name another file");
            return Err(Failure::new(Exit::NoOutput, sentence));
        }
        let made = is_new.then(|| real.to_owned());
        let is_fst = path.extension().is_some_and(|it| it.eq_ignore_ascii_case("fst"));
        Ok(Waveform { name, file, is_fst, is_plain, made, is_told: true })
    }

    /// A file without a name, which is not told of.
    pub fn temporary(file: File) -> Waveform {
        let name = "a temporary file".to_owned();
        Waveform { name, file, is_fst: false, is_plain: false, made: None, is_told: false }
    }

    /// The waveform that a simulation writes to this file.
    ///
    /// # Errors
    /// The system has no room for another open file.
    pub fn trace(&self) -> Result<Trace, Failure> {
        let file = self.file.try_clone().map_err(|error| self.unwritable(&error))?;
        Ok(if self.is_fst { Fst::into(&self.name, file) } else { Vcd::into(&self.name, file) })
    }

    /// Removes the old content of the file.
    ///
    /// # Errors
    /// The system refuses it.
    pub fn clear(&self) -> Result<(), Failure> {
        if self.is_plain {
            self.file.set_len(0).map_err(|error| self.unwritable(&error))?;
        }
        Ok(())
    }

    /// Says that it was written.
    pub fn tell_written(&self) {
        if self.is_told {
            talk(&format!("wrote {}", self.name));
        }
    }

    fn unwritable(&self, error: &io::Error) -> Failure {
        SceneError::unwritable(Path::new(&self.name), error).into()
    }
}

/// A command that fails before it writes leaves no empty file.
impl Drop for Waveform {
    fn drop(&mut self) {
        if let Some(path) = self.made.take().filter(|_| self.file.metadata().is_ok_and(|it| it.len() == 0)) {
            let _ = fs::remove_file(path);
        }
    }
}

/// Standard output, for data that is not text.
fn taken() -> Result<File, Failure> {
    take_standard_output();
    standard_output().map_err(|error| SceneError::unwritable(Path::new(STANDARD_OUTPUT), &error).into())
}

/// A folder for outputs. It is created with its parents, and what was created is removed again unless it is kept.
pub struct Folder {
    path: PathBuf,
    made: Vec<PathBuf>,
}

impl Folder {
    /// Refuses standard output for several files.
    ///
    /// # Errors
    /// It is standard output.
    pub fn check(path: &Path) -> Result<(), Failure> {
        match is_standard_output(path) {
            true => {
                let sentence = "-o -: standard output takes one file, and this writes several: name a folder";
                Err(Failure::new(Exit::BadInput, sentence))
            }
            false => Ok(()),
        }
    }

    /// Creates a folder and its parents where they are missing.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn make(path: &Path) -> Result<Folder, Failure> {
        Folder::make_with(path, &[])
    }

    /// The same, with subfolders of those names.
    ///
    /// # Errors
    /// One cannot be made.
    pub fn make_with(path: &Path, inner: &[&str]) -> Result<Folder, Failure> {
        let paths: Vec<PathBuf> = inner.iter().map(|name| path.join(name)).collect();
        let missing = path.ancestors().take_while(|folder| !folder.as_os_str().is_empty() && !folder.exists());
        // Inner folders are removed before outer ones.
        let made = paths.iter().map(PathBuf::as_path).filter(|folder| !folder.exists()).chain(missing);
        let folder = Folder { path: path.to_owned(), made: made.map(Path::to_owned).collect() };
        for path in std::iter::once(path).chain(paths.iter().map(PathBuf::as_path)) {
            fs::create_dir_all(path).map_err(|error| SceneError::unwritable(path, &error))?;
        }
        Ok(folder)
    }

    /// Writes files into the folder, all or none, and keeps the folder. Returns their paths.
    ///
    /// # Errors
    /// One cannot be written.
    pub fn fill<'a>(
        mut self,
        files: impl IntoIterator<Item = (&'a str, &'a [u8])> + Clone,
    ) -> Result<Vec<String>, Failure> {
        let paths: Vec<PathBuf> = files.clone().into_iter().map(|(name, _)| self.path.join(name)).collect();
        let outputs: Result<Vec<Output>, _> = paths.iter().map(|path| Output::at(path)).collect();
        write_all(outputs?.into_iter().zip(files.into_iter().map(|(_, bytes)| bytes)))?;
        self.made.clear();
        Ok(paths.iter().map(|path| shown(path)).collect())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder that is not empty has other files by now.
        self.made.iter().for_each(|folder| drop(fs::remove_dir(folder)));
    }
}

/// A path quoted for a shell.
pub fn quoted(path: &Path) -> String {
    let text = path.to_string_lossy();
    let plain = |c: char| c.is_alphanumeric() || "-_./+,:@%=".contains(c);
    if path.to_str().is_none() || text.chars().any(char::is_control) {
        let byte = |byte: &u8| match byte {
            b'\'' | b'\\' => format!("\\{}", *byte as char),
            b' '..=b'~' => (*byte as char).to_string(),
            _ => format!("\\{byte:03o}"),
        };
        return format!("$'{}'", path.as_os_str().as_encoded_bytes().iter().map(byte).collect::<String>());
    }
    if !text.is_empty() && text.chars().all(plain) {
        text.into_owned()
    } else {
        format!("'{}'", text.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shell_reads_back_what_was_quoted() {
        assert_eq!(quoted(Path::new("out/mu.vcd")), "out/mu.vcd");
        assert_eq!(quoted(Path::new("my wave's.vcd")), r"'my wave'\''s.vcd'");
        assert_eq!(quoted(Path::new("a\u{1b}'.vcd")), r"$'a\033\'.vcd'");
    }

    #[test]
    #[cfg(unix)]
    fn a_name_that_is_no_text_is_quoted_byte_by_byte() {
        let name = std::os::unix::ffi::OsStrExt::from_bytes(b"a \xff.vcd");
        assert_eq!(quoted(Path::new::<std::ffi::OsStr>(name)), r"$'a \377.vcd'");
    }
}
