//! The file below a waveform, which grows by whole time steps and ends with one whatever happens.

use std::fs::File;
use std::io::{self, Write};
use std::path::PathBuf;

use crate::error::Error;

/// A file that takes whole time steps; after an error it takes nothing more.
pub(super) struct StepFile {
    path: PathBuf,
    /// None before [`StepFile::create`], and after an error.
    file: Option<File>,
    /// How many bytes were written.
    length: u64,
}

impl StepFile {
    /// A file of that name, which is not created yet.
    pub fn new(path: PathBuf) -> StepFile {
        StepFile { path, file: None, length: 0 }
    }

    /// Creates the file.
    pub fn create(&mut self) -> Result<(), Error> {
        self.file = Some(File::create(&self.path).map_err(|source| self.error(source))?);
        Ok(())
    }

    /// Adds whole time steps. If they do not fit, the file keeps those from before, so that it still opens.
    pub fn append(&mut self, steps: &[u8]) -> Result<(), Error> {
        let Some(file) = &mut self.file else { return Ok(()) };
        if let Err(source) = file.write_all(steps) {
            // What is no regular file, such as a pipe, keeps what it has got; the error is the one to report.
            let _ = file.set_len(self.length);
            self.file = None;
            return Err(self.error(source));
        }
        self.length += steps.len() as u64;
        Ok(())
    }

    fn error(&self, source: io::Error) -> Error {
        Error::Trace { path: self.path.clone(), source }
    }
}
