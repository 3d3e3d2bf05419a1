//! The solver: a process that is asked in SMT-LIB.

use crate::answer::bits;
use crate::process::apart;
use crate::{Error, model::Model};
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};
use tilewright_gen::tools::Missing;

/// What to do where Z3 is missing.
const Z3: Missing = Missing { program: "z3", remedy: "install it (Debian: apt-get install z3)" };
/// The time between two looks at the watcher.
const SLICE: Duration = Duration::from_millis(50);

/// When to give up: asked while the solver works.
pub struct Patience<'a> {
    /// Whether to stop, for example because of Ctrl-C.
    pub stop: &'a dyn Fn() -> bool,
    /// The time at which no more is asked.
    pub end: Option<Instant>,
}

/// Why there is no answer.
pub enum Halt {
    /// The time is over.
    Late,
    /// Any other reason.
    Failed(Error),
}

impl From<Error> for Halt {
    fn from(error: Error) -> Halt {
        Halt::Failed(error)
    }
}

/// A solver that knows the formulas of a design.
pub struct Solver<'a> {
    child: Child,
    /// What it is told. It may be slow to read, and the time may be over before it has read all.
    commands: Sender<String>,
    lines: Receiver<String>,
    patience: &'a Patience<'a>,
    model: &'a Model,
}

impl<'a> Solver<'a> {
    /// A solver for this model.
    ///
    /// # Errors
    ///
    /// Z3 is missing, or it fails.
    pub fn new(model: &'a Model, patience: &'a Patience<'a>) -> Result<Solver<'a>, Halt> {
        let mut command = Command::new(Z3.program);
        command.args(["-smt2", "-in"]).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        apart(&mut command);
        let mut child = command.spawn().map_err(|error| match error.kind() {
            std::io::ErrorKind::NotFound => Error::Missing(Z3),
            _ => Error::tool(Z3.program, error.to_string()),
        })?;
        let (mut input, output) = (child.stdin.take().expect("it is piped"), child.stdout.take().expect("it is piped"));
        let (commands, told) = channel::<String>();
        std::thread::spawn(move || told.into_iter().all(|text| input.write_all(text.as_bytes()).is_ok()));
        let (sender, lines) = channel();
        std::thread::spawn(move || {
            let lines = BufReader::new(output).lines().map_while(Result::ok);
            lines.into_iter().all(|line| sender.send(line).is_ok())
        });
        let mut solver = Solver { child, commands, lines, patience, model };
        solver.tell("(set-option :produce-models true)\n(set-logic QF_BV)\n")?;
        solver.tell(&model.formulas.prelude)?;
        Ok(solver)
    }

    /// A function of the state of clock `at`, as an expression.
    pub fn of(&self, function: &str, at: u32) -> String {
        format!("|{}_{function}@{at}|", self.model.top)
    }

    /// Declares the state of clock `at`, which satisfies the assumptions and, if there is one, follows the one before.
    pub fn state(&mut self, at: u32) -> Result<(), Halt> {
        self.tell(&format!("(declare-fun s{at} () |{}_s|)\n", self.model.top))?;
        self.tell(&self.model.formulas.of(at))?;
        for function in ["h", "u"] {
            let holds = self.of(function, at);
            self.assert(&holds)?;
        }
        if at > 0 {
            let step = self.of("t", at);
            self.assert(&step)?;
        }
        Ok(())
    }

    /// States that an expression is true.
    pub fn assert(&mut self, expression: &str) -> Result<(), Halt> {
        self.tell(&format!("(assert {expression})\n"))
    }

    /// Gives commands that have no answer.
    pub fn tell(&mut self, commands: &str) -> Result<(), Halt> {
        self.commands.send(commands.to_owned()).map_err(|_| Error::tool(Z3.program, "it ended").into())
    }

    /// Whether all that is asserted can be true together, under these assumptions.
    pub fn is_possible(&mut self, assumptions: &[&str]) -> Result<bool, Halt> {
        self.tell(&format!("(check-sat-assuming ({}))\n", assumptions.join(" ")))?;
        match self.line()?.as_str() {
            "sat" => Ok(true),
            "unsat" => Ok(false),
            other => Err(Error::tool(Z3.program, other).into()),
        }
    }

    /// The values of expressions in the model that was found, the lowest bit first.
    pub fn values(&mut self, expressions: &[String]) -> Result<Vec<Vec<bool>>, Halt> {
        self.tell(&expressions.iter().map(|it| format!("(eval {it})\n")).collect::<String>())?;
        let value = |line: String| bits(&line).ok_or_else(|| Error::tool(Z3.program, line).into());
        expressions.iter().map(|_| self.line().and_then(value)).collect()
    }

    /// The next line of its output.
    fn line(&mut self) -> Result<String, Halt> {
        loop {
            if (self.patience.stop)() {
                return Err(Error::Interrupted.into());
            }
            if self.patience.end.is_some_and(|end| Instant::now() >= end) {
                return Err(Halt::Late);
            }
            match self.lines.recv_timeout(SLICE) {
                Ok(line) => return Ok(line),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Err(Error::tool(Z3.program, "it ended").into()),
            }
        }
    }
}

impl Drop for Solver<'_> {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
