//! The file below a waveform, which grows by whole time steps and ends with one whatever happens.

use std::fs::File;
use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::Arc;

use crate::testbench::error::Error;

/// A file that takes whole time steps; after an error, which it keeps to be reported, it takes nothing more.
pub(super) struct StepFile {
    path: PathBuf,
    /// One that was open already.
    given: Option<Arc<File>>,
    /// None before [`StepFile::create`], and after an error.
    file: Option<Arc<File>>,
    /// Whether nothing was in it before.
    was_empty: bool,
    /// How many bytes were written.
    length: u64,
    /// What is still to be reported.
    error: Option<Error>,
}

impl StepFile {
    /// A file of that name, which is not created yet unless it is given.
    pub fn new(path: PathBuf, given: Option<Arc<File>>) -> StepFile {
        StepFile { path, given, file: None, was_empty: false, length: 0, error: None }
    }

    /// Creates the file, or takes the one that was given.
    pub fn create(&mut self) {
        let file = self.given.take().map_or_else(|| File::create(&self.path).map(Arc::new), Ok);
        match file.and_then(|file| Ok((file.metadata()?.len() == 0, file))) {
            Ok((was_empty, file)) => (self.was_empty, self.file) = (was_empty, Some(file)),
            Err(source) => self.fail(source),
        }
    }

    /// Adds whole time steps. If they do not fit, the file keeps those from before, so that it still opens.
    pub fn append(&mut self, steps: &[u8]) {
        let Some(file) = &mut self.file else { return };
        match file.write_all(steps) {
            Ok(()) => self.length += steps.len() as u64,
            Err(source) => {
                // What is no regular file, such as a pipe, keeps what it has got; the error is the one to report.
                if self.was_empty {
                    let _ = file.set_len(self.length);
                }
                self.fail(source);
            }
        }
    }

    /// The error that has happened, once.
    pub fn report(&mut self) -> Result<(), Error> {
        self.error.take().map_or(Ok(()), Err)
    }

    fn fail(&mut self, source: io::Error) {
        self.file = None;
        self.error = Some(Error::Trace { path: self.path.clone(), source });
    }
}
