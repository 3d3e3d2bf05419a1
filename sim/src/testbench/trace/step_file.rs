//! The file under a waveform. It grows by whole time steps and always ends with a whole one.

use std::fs::File;
use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, channel, sync_channel};
use std::thread::{self, JoinHandle};

use crate::testbench::error::Error;

/// A file of whole time steps. After an error, which it keeps for the report, it takes nothing more.
pub(super) struct StepFile {
    path: PathBuf,
    /// A file that was open already.
    given: Option<Arc<File>>,
    /// `None` before [`StepFile::create`], and after an error.
    file: Option<Grown>,
    /// Whether a separate thread writes it, as there are several processors. The query takes long, so its result is
    /// kept.
    is_apart: Option<bool>,
    /// The thread that writes it.
    writer: Option<Writer>,
    /// The error to be reported.
    error: Option<Error>,
}

/// A file and its length.
#[derive(Clone)]
struct Grown {
    file: Arc<File>,
    /// Whether it was empty before.
    was_empty: bool,
    /// The number of bytes written.
    length: u64,
}

/// A thread that writes: the system takes about as long to write a step as it takes to make its text.
struct Writer {
    /// The text to be written, and its length.
    full: SyncSender<(Vec<u8>, usize)>,
    /// The buffers of written texts.
    written: Receiver<Vec<u8>>,
    thread: JoinHandle<io::Result<Grown>>,
}

/// The number of texts that may wait to be written before the sender blocks: the system may be slow to start the
/// thread.
const WAITING: usize = 2;

impl StepFile {
    /// A file with this name, which is not created yet unless it is given.
    pub fn new(path: PathBuf, given: Option<Arc<File>>) -> StepFile {
        StepFile { path, given, file: None, is_apart: None, writer: None, error: None }
    }

    /// Creates the file, or takes the given one.
    pub fn create(&mut self) {
        let file = self.given.take().map_or_else(|| File::create(&self.path).map(Arc::new), Ok);
        match file.and_then(|file| Ok(Grown { was_empty: file.metadata()?.len() == 0, file, length: 0 })) {
            Ok(file) => self.file = Some(file),
            Err(source) => self.fail(source),
        }
    }

    /// Appends whole time steps after everything handed over. If they do not fit, the file keeps those that do, so
    /// that it can still be opened.
    pub fn append(&mut self, steps: &[u8]) {
        self.settle();
        if let Some(Err(source)) = self.file.as_mut().map(|file| file.append(steps)) {
            self.fail(source);
        }
    }

    /// Appends whole time steps like [`StepFile::append`], perhaps later, and returns a buffer for the next ones.
    /// Errors are reported later too. The steps are the first `length` bytes.
    pub fn hand_over(&mut self, steps: Vec<u8>, length: usize) -> Vec<u8> {
        let Some(file) = &self.file else { return steps };
        let several = || thread::available_parallelism().is_ok_and(|processors| processors.get() > 1);
        if self.writer.is_none() && *self.is_apart.get_or_insert_with(several) {
            self.writer = Writer::start(file.clone());
        }
        let Some(writer) = &self.writer else {
            self.append(&steps[..length]);
            return steps;
        };
        let room = steps.len();
        if writer.full.send((steps, length)).is_err() {
            self.settle();
            return Vec::new();
        }
        // Zeros from the system take no time before they are written.
        writer.written.try_recv().unwrap_or_else(|_| vec![0; room])
    }

    /// Waits until everything handed over is written.
    fn settle(&mut self) {
        let Some(Writer { full, thread, .. }) = self.writer.take() else { return };
        drop(full);
        match thread.join().unwrap_or_else(|_| Err(io::Error::other("the thread that writes it has ended"))) {
            Ok(file) => self.file = Some(file),
            Err(source) => self.fail(source),
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

impl Grown {
    fn append(&mut self, steps: &[u8]) -> io::Result<()> {
        let mut written = 0;
        while written < steps.len() {
            match self.file.as_ref().write(&steps[written..]) {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Ok(more) if more > 0 => written += more,
                refused => {
                    // A file that is not regular, such as a pipe, keeps what it has received; the error to report is
                    // the first one.
                    if self.was_empty {
                        let _ = self.file.set_len(self.length + whole_steps(&steps[..written]) as u64);
                    }
                    return refused.and(Err(io::ErrorKind::WriteZero.into()));
                }
            }
        }
        self.length += written as u64;
        Ok(())
    }
}

/// The end of the last whole step in a text; each step begins with a line of its time.
fn whole_steps(text: &[u8]) -> usize {
    text.windows(2).rposition(|pair| pair == b"\n#").map_or(0, |end| end + 1)
}

impl Writer {
    /// `None` if no thread is available.
    fn start(mut file: Grown) -> Option<Writer> {
        let (full, filled) = sync_channel::<(Vec<u8>, usize)>(WAITING);
        let (empty, written) = channel();
        let write = move || {
            for (steps, length) in filled {
                file.append(&steps[..length])?;
                // At the end, nobody receives it.
                let _ = empty.send(steps);
            }
            Ok(file)
        };
        let thread = thread::Builder::new().name("waveform".to_owned()).spawn(write).ok()?;
        Some(Writer { full, written, thread })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_handed_over_comes_before_what_is_appended() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("steps");
        let mut file = StepFile::new(path.clone(), None);
        file.create();
        let mut expected = Vec::new();
        let mut room = Vec::new();
        for step in 0..300_u32 {
            let text = format!("step {step}\n").repeat(step as usize);
            room.resize(text.len().max(room.len()), 0);
            room[..text.len()].copy_from_slice(text.as_bytes());
            expected.extend_from_slice(text.as_bytes());
            if step % 50 == 0 {
                file.append(text.as_bytes());
            } else {
                room = file.hand_over(room, text.len());
            }
        }
        file.append(b"end\n");
        expected.extend_from_slice(b"end\n");
        file.report().unwrap();
        assert!(std::fs::read(path).unwrap() == expected);
    }

    #[test]
    fn whole_steps_end_where_the_last_one_begins() {
        for (text, whole) in [("", 0), ("#1", 0), ("#1\n0#\n", 0), ("#1\n0#\n#", 6), ("#1\n0!\n#2\nb1 #\n#3\n0", 14)] {
            assert_eq!(whole_steps(text.as_bytes()), whole, "{text}");
        }
    }

    #[test]
    fn an_error_of_what_was_handed_over_is_reported_once() {
        for is_apart in [false, true] {
            let mut file = StepFile::new("/dev/full".into(), None);
            file.is_apart = Some(is_apart);
            file.create();
            file.hand_over(b"step".to_vec(), 4);
            // It takes nothing more.
            file.append(b"step");
            let error = file.report().unwrap_err().to_string();
            assert!(error.starts_with("cannot write the trace /dev/full: No space left"), "{error}");
            file.hand_over(b"step".to_vec(), 4);
            file.append(b"step");
            file.report().unwrap();
        }
    }
}
