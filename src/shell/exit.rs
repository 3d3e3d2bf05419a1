//! Exit codes, and the errors that lead to them.

use super::interrupt;
use super::text::one_line;
use std::process::ExitCode;
use tilewright_hdl::catalog::CatalogError;
use tilewright_scenes::SceneError;

/// How a command ended; `tilewright --help` documents the numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// Done.
    Done = 0,
    /// A frame, or a pixel that is asked about, differs from the golden image, an assertion of the hardware fails, two waveforms differ, or simulators or engines disagree.
    CheckFailed = 1,
    /// Bad usage or bad input.
    BadInput = 2,
    /// An output cannot be written.
    NoOutput = 3,
    /// Another program is not installed, or fails.
    NoTool = 4,
    /// A statement is neither proved nor refuted.
    Undecided = 5,
    /// A mistake in this program.
    Crash = 70,
    /// The system has no more memory, or the stack is full.
    NoMemory = 71,
    /// The terminal went away.
    HungUp = 129,
    /// Ctrl-C.
    Interrupted = 130,
    /// Asked to end by another program.
    Terminated = 143,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> ExitCode {
        ExitCode::from(exit as u8)
    }
}

/// Why a command failed.
#[derive(Debug)]
pub struct Failure {
    /// The exit code.
    pub exit: Exit,
    /// The sentence for the user: what is wrong, where, and what to do.
    pub sentence: String,
    /// The next failure, if there was one.
    next: Option<Box<Failure>>,
}

impl Failure {
    /// A failure of that kind.
    pub fn new(exit: Exit, sentence: impl Into<String>) -> Failure {
        Failure { exit, sentence: sentence.into(), next: None }
    }

    /// The same failure on one of several machines; its sentence then begins with the machine's name.
    pub fn of(self, machine: &str) -> Failure {
        Failure { sentence: format!("{machine}: {}", self.sentence), ..self }
    }

    /// The same failure with that exit code.
    pub fn with(self, exit: Exit) -> Failure {
        Failure { exit, ..self }
    }

    /// The result of two actions that were both tried. The first failure decides the exit code, and all are printed.
    pub fn both<T>(first: Result<T, Failure>, second: Result<(), Failure>) -> Result<T, Failure> {
        match (first, second) {
            (Ok(done), Ok(())) => Ok(done),
            (Ok(_), Err(failure)) | (Err(failure), Ok(())) => Err(failure),
            (Err(first), Err(second)) => Err(first.then(second)),
        }
    }

    /// Several failures, of which the first decides the exit code.
    pub fn all(failures: impl DoubleEndedIterator<Item = Failure>) -> Option<Failure> {
        failures.rev().reduce(|next, first| first.then(next))
    }

    fn then(self, next: Failure) -> Failure {
        Failure { next: Some(Box::new(next)), ..self }
    }

    /// Its sentence and those of the failures after it.
    pub fn sentences(&self) -> impl Iterator<Item = &str> {
        self.chain().map(|failure| failure.sentence.as_str())
    }

    /// All of them in one line.
    pub fn line(&self) -> String {
        self.sentences().collect::<Vec<_>>().join("; ")
    }

    /// There is no room for temporary files.
    pub fn no_temporary(error: &std::io::Error) -> Failure {
        let folder = std::env::temp_dir();
        let sentence = format!("{}: cannot be written ({error}): set TMPDIR to another folder", folder.display());
        Failure::new(Exit::NoOutput, sentence)
    }

    /// Whether the waveform of a run with that result is complete: it is not if an output failed.
    pub fn leaves_a_waveform<T>(ended: &Result<T, Failure>) -> bool {
        ended.as_ref().err().is_none_or(|failure| failure.chain().all(|it| it.exit != Exit::NoOutput))
    }

    fn chain(&self) -> impl Iterator<Item = &Failure> {
        std::iter::successors(Some(self), |failure| failure.next.as_deref())
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Failure {
        let exit = if let SceneError::Write { .. } = error { Exit::NoOutput } else { Exit::BadInput };
        Failure::new(exit, one_line(&error.to_string()))
    }
}

impl From<CatalogError> for Failure {
    fn from(error: CatalogError) -> Failure {
        Failure::new(Exit::BadInput, error.to_string())
    }
}

impl From<tilewright_sim::Error> for Failure {
    fn from(error: tilewright_sim::Error) -> Failure {
        match error {
            tilewright_sim::Error::Trace { path, source } => SceneError::unwritable(&path, &source).into(),
            tilewright_sim::Error::Violated(_) | tilewright_sim::Error::Differs(_) => {
                Failure::new(Exit::CheckFailed, error.to_string())
            }
            _ => Failure::new(Exit::BadInput, error.to_string()),
        }
    }
}

impl From<tilewright_machines::Error> for Failure {
    fn from(error: tilewright_machines::Error) -> Failure {
        match error {
            tilewright_machines::Error::Simulation(error) => error.into(),
            tilewright_machines::Error::Untraced { run, trace } => Failure::from(*run).then(trace.into()),
            tilewright_machines::Error::Displayed { .. } => Failure::new(Exit::CheckFailed, error.to_string()),
            tilewright_machines::Error::Cancelled { .. } => Failure::new(interrupt::exit(), error.to_string()),
            _ => Failure::new(Exit::BadInput, error.to_string()),
        }
    }
}

impl From<tilewright_benches::Error> for Failure {
    fn from(error: tilewright_benches::Error) -> Failure {
        use tilewright_benches::Error::*;
        let exit = match error {
            Simulation(error) => return error.into(),
            Missing(_) | Tool(_) | Unreadable { .. } => Exit::NoTool,
            Differs { .. } => Exit::CheckFailed,
            Interrupted { .. } => interrupt::exit(),
        };
        Failure::new(exit, error.to_string())
    }
}

impl From<tilewright_prove::Error> for Failure {
    fn from(error: tilewright_prove::Error) -> Failure {
        use tilewright_prove::Error::*;
        let exit = match error {
            Missing(_) | Tool { .. } => Exit::NoTool,
            Nothing(_) | Refused(_) => Exit::BadInput,
            Interrupted => interrupt::exit(),
            Unshown(_) => Exit::CheckFailed,
        };
        Failure::new(exit, error.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io;
    use tilewright_hdl::Bits;
    use tilewright_machines::Error;
    use tilewright_sim::Difference;
    use tilewright_sim::Error::{Differs, Late, Trace, Violated};

    /// Engines that differ in a signal.
    fn difference() -> Box<Difference> {
        let [reference, other] = [5, 6].map(|value| Bits::new(8, value));
        Box::new(Difference {
            signal: "u_gfb.row".to_owned(),
            instant: 3,
            clocks: vec!["`pe`".to_owned()],
            reference,
            other,
        })
    }

    #[test]
    fn engines_that_differ_end_in_one_sentence_with_signal_and_clock() {
        let sentence = "the engines differ in `u_gfb.row` after instant 3, an edge of `pe`: the reference engine has 8'h05, \
                        the other one 8'h06: this is a mistake in tilewright, please report the design";
        assert_eq!(Failure::from(Differs(difference())).sentence, sentence);
    }

    #[test]
    fn what_went_wrong_decides_the_exit_code() {
        let full = || Trace { path: "run.vcd".into(), source: io::ErrorKind::StorageFull.into() };
        let cases = [
            (Error::Simulation(Violated(Vec::new())), Exit::CheckFailed),
            (Error::Simulation(Differs(difference())), Exit::CheckFailed),
            (Error::Simulation(full()), Exit::NoOutput),
            (Error::Simulation(Late), Exit::BadInput),
            (Error::Cancelled { phase: "drawing", time: 5 }, Exit::Interrupted),
        ];
        for (error, exit) in cases {
            assert_eq!(Failure::from(error).exit, exit);
        }
        let untraced = Error::Untraced { run: Box::new(Error::Cancelled { phase: "drawing", time: 5 }), trace: full() };
        let both = Failure::from(untraced);
        assert_eq!((both.exit, both.sentences().count()), (Exit::Interrupted, 2));
        assert!(!Failure::leaves_a_waveform::<()>(&Err(both)));
        assert_eq!(
            Failure::from(full()).sentence,
            "run.vcd: cannot be written (no storage space): make room, or choose another disk"
        );
    }
}
