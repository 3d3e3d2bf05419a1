//! The file under a waveform. It grows by whole blocks, and its header always says what it has.

use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::PathBuf;
use std::sync::Arc;

use crate::testbench::error::Error;

/// A file of whole blocks. After an error, which it keeps for the report, it takes nothing more.
pub struct BlockFile {
    path: PathBuf,
    /// A file that was open already.
    given: Option<Arc<File>>,
    /// `None` before [`BlockFile::create`], and after an error.
    to: Option<To>,
    /// The error to be reported.
    error: Option<Error>,
}

enum To {
    /// A file from `start` on, to which `length` bytes were written.
    File { file: Arc<File>, start: u64, length: u64, was_empty: bool },
    /// A pipe, in which nothing can be written afterwards: all of it waits here for the end.
    Pipe { file: Arc<File>, blocks: Vec<u8> },
}

impl BlockFile {
    /// A file with this name, which is not created yet unless it is given.
    pub fn new(path: PathBuf, given: Option<Arc<File>>) -> BlockFile {
        BlockFile { path, given, to: None, error: None }
    }

    /// Creates the file, or takes the given one.
    pub fn create(&mut self) {
        let file = self.given.take().map_or_else(|| File::create(&self.path).map(Arc::new), Ok);
        match file.and_then(To::of) {
            Ok(to) => self.to = Some(to),
            Err(source) => self.fail(source),
        }
    }

    /// Appends whole blocks, and replaces the header. If they do not fit, the file keeps the earlier ones, so that it
    /// can still be opened.
    pub fn append(&mut self, blocks: &[u8], header: &[u8]) {
        if let Some(Err(source)) = self.to.as_mut().map(|to| to.append(blocks, header)) {
            self.fail(source);
        }
    }

    /// Writes what has waited for the end.
    pub fn close(&mut self) {
        if let Some(To::Pipe { file, blocks }) = self.to.take()
            && let Err(source) = file.as_ref().write_all(&blocks)
        {
            self.fail(source);
        }
    }

    /// The error that has happened, once.
    pub fn report(&mut self) -> Result<(), Error> {
        self.error.take().map_or(Ok(()), Err)
    }

    fn fail(&mut self, source: io::Error) {
        self.to = None;
        self.error = Some(Error::Trace { path: self.path.clone(), source });
    }
}

impl To {
    fn of(file: Arc<File>) -> io::Result<To> {
        Ok(match file.as_ref().stream_position() {
            Ok(start) => {
                let was_empty = file.metadata()?.len() == 0;
                To::File { file, start, length: 0, was_empty }
            }
            Err(_) => To::Pipe { file, blocks: Vec::new() },
        })
    }

    fn append(&mut self, more: &[u8], header: &[u8]) -> io::Result<()> {
        match self {
            To::Pipe { blocks, .. } => {
                blocks.extend_from_slice(more);
                blocks[..header.len()].copy_from_slice(header);
            }
            To::File { file, start, length, was_empty } => {
                let mut place = file.as_ref();
                let end = *start + *length;
                let written = place.seek(SeekFrom::Start(end)).and_then(|_| place.write_all(more));
                if written.is_err() && *was_empty {
                    // The error to report is the first one.
                    let _ = file.set_len(end);
                }
                written?;
                *length += more.len() as u64;
                place.seek(SeekFrom::Start(*start)).and_then(|_| place.write_all(header))?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(unix)]
    fn a_pipe_has_all_at_the_end() {
        let (mut reader, writer) = io::pipe().unwrap();
        let mut file = BlockFile::new("pipe".into(), Some(Arc::new(std::os::fd::OwnedFd::from(writer).into())));
        file.create();
        file.append(b"head, blocks", b"head");
        file.append(b", more", b"HEAD");
        file.close();
        file.report().unwrap();
        drop(file);
        assert_eq!(io::read_to_string(&mut reader).unwrap(), "HEAD, blocks, more");
    }

    #[test]
    fn a_file_that_cannot_be_made_is_reported() {
        let folder = tempfile::tempdir().unwrap();
        let mut file = BlockFile::new(folder.path().join("missing").join("a.fst"), None);
        file.create();
        file.append(b"block", b"b");
        let error = file.report().unwrap_err().to_string();
        assert!(error.contains("a.fst: "), "{error}");
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn an_error_is_reported_once() {
        let mut file = BlockFile::new("/dev/full".into(), None);
        file.create();
        file.append(b"block", b"b");
        file.append(b"block", b"b");
        file.close();
        let error = file.report().unwrap_err().to_string();
        assert!(error.starts_with("cannot write the trace /dev/full: No space left"), "{error}");
        file.report().unwrap();
    }
}
