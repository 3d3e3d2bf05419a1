//! Waveform files in the Value Change Dump format of IEEE 1364-2001, section 18.
//!
//! Scopes and names are those of the Verilog: the top module, its instances, and for an array the scopes `u_cell[3]`
//! with the instance `lane` in each. A state machine's register has a `string` twin, `NAME_state`. Times are the
//! clocks' own, in picoseconds; what a testbench sets after an edge shows from that edge on.

use std::collections::VecDeque;
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use vcd::{SimulationCommand, Value, Writer};

use super::vcd_header::{Clock, Header, Variable, VariableKind};
use super::{Observer, View};
use crate::error::Error;

/// How much is collected before it goes to the file, always in whole time steps so that a killed run leaves a file
/// that opens.
const CHUNK: usize = 1 << 16;

/// What a waveform file shows. Attach it with [`Simulation::trace`](crate::Simulation::trace).
#[derive(Debug, Clone)]
pub struct Vcd {
    pub(crate) path: PathBuf,
    pub(crate) patterns: Vec<String>,
    pub(crate) window: Option<Window>,
    pub(crate) last: Option<usize>,
}

/// Which part of a run is written.
#[derive(Debug, Clone)]
pub(crate) enum Window {
    Time(std::ops::Range<u64>),
    Cycles(String, std::ops::Range<u64>),
}

impl Vcd {
    /// Everything, for the whole run, into this file.
    pub fn to(path: impl AsRef<Path>) -> Vcd {
        Vcd { path: path.as_ref().to_path_buf(), patterns: Vec::new(), window: None, last: None }
    }

    /// Only the signals whose hierarchical name matches this pattern, or another one given: `*` stands for anything
    /// but a dot, `**` for anything, as in `u_cell[*].value` or `u_cell[3].**`.
    pub fn only(mut self, pattern: &str) -> Vcd {
        self.patterns.push(pattern.to_string());
        self
    }

    /// Only what happens in these picoseconds.
    pub fn times(mut self, picoseconds: std::ops::Range<u64>) -> Vcd {
        self.window = Some(Window::Time(picoseconds));
        self
    }

    /// Only what happens in these cycles of a clock, the first being 0.
    pub fn cycles(mut self, clock: &str, cycles: std::ops::Range<u64>) -> Vcd {
        self.window = Some(Window::Cycles(clock.to_string(), cycles));
        self
    }

    /// A flight recorder: keeps the last `n` instants in memory, and writes the file only if an assertion fails.
    pub fn last(mut self, n: usize) -> Vcd {
        self.last = Some(n.max(1));
        self
    }
}

/// Writes a waveform file.
pub(crate) struct Dump {
    path: PathBuf,
    header: Header,
    window: std::ops::Range<u64>,
    /// The values of the last step written; none before the first.
    written: Option<Snapshot>,
    /// Up to when the file goes.
    time: u64,
    /// The last time that stands in the file.
    stamped: Option<u64>,
    writer: Writer<Vec<u8>>,
    /// None until something is to be written.
    file: Option<File>,
    /// The flight recorder's length and what it holds.
    last: Option<usize>,
    recent: VecDeque<Snapshot>,
}

/// All traced values between two instants.
#[derive(Debug, Clone)]
struct Snapshot {
    since: u64,
    until: u64,
    limbs: Vec<u64>,
    resets: Vec<bool>,
}

impl Dump {
    /// Creates the file, or for a flight recorder only prepares it.
    pub fn new(vcd: Vcd, header: Header, window: std::ops::Range<u64>) -> Result<Dump, Error> {
        let mut dump = Dump {
            path: vcd.path,
            header,
            window,
            written: None,
            time: 0,
            stamped: None,
            writer: Writer::new(Vec::new()),
            file: None,
            last: vcd.last,
            recent: VecDeque::new(),
        };
        if dump.last.is_none() {
            dump.open()?;
        }
        Ok(dump)
    }

    fn open(&mut self) -> Result<(), Error> {
        let file = File::create(&self.path).map_err(|source| self.error(source))?;
        self.file = Some(file);
        self.writer.writer().extend_from_slice(&self.header.text);
        self.flush()
    }

    fn error(&self, source: io::Error) -> Error {
        Error::Trace { path: self.path.clone(), source }
    }

    /// Hands what is collected, which ends with a whole time step, to the system.
    fn flush(&mut self) -> Result<(), Error> {
        let Some(file) = &mut self.file else { return Ok(()) };
        let result = file.write_all(self.writer.writer());
        self.writer.writer().clear();
        result.map_err(|source| self.error(source))
    }

    fn snapshot(&self, view: &mut View) -> Snapshot {
        let mut limbs = Vec::with_capacity(self.header.limbs);
        for &value in &self.header.values {
            limbs.extend_from_slice(view.engine.read(value));
        }
        Snapshot { since: view.since, until: view.until, limbs, resets: view.resets.to_vec() }
    }

    fn add(&mut self, snapshot: Snapshot) -> Result<(), Error> {
        if snapshot.until <= self.window.start || snapshot.since >= self.window.end {
            return Ok(());
        }
        match self.last {
            Some(n) => {
                if self.recent.len() == n {
                    self.recent.pop_front();
                }
                self.recent.push_back(snapshot);
                Ok(())
            }
            None => self.emit(snapshot),
        }
    }

    /// Writes a time step: what has changed at its begin, and the clocks that fall within it.
    fn emit(&mut self, snapshot: Snapshot) -> Result<(), Error> {
        self.collect(&snapshot).map_err(|source| self.error(source))?;
        self.written = Some(snapshot);
        if self.writer.writer().len() >= CHUNK { self.flush() } else { Ok(()) }
    }

    fn collect(&mut self, new: &Snapshot) -> io::Result<()> {
        let Dump { writer, header, written, time, stamped, .. } = self;
        let clocks = &header.clocks;
        let first = written.is_none();
        let since = new.since.max(*time);
        let mut body = Writer::new(Vec::new());
        for variable in &header.variables {
            let limbs = variable.limbs(&new.limbs);
            if written.as_ref().is_none_or(|old| variable.limbs(&old.limbs) != limbs) {
                change(&mut body, variable, limbs)?;
            }
        }
        for (index, clock) in clocks.iter().enumerate() {
            let level = clock.is_high(new.since);
            if first || (level != clock.is_high(*time) && since == new.since) {
                clock.id.iter().try_for_each(|id| body.change_scalar(*id, level))?;
            }
            let reset = new.resets[index];
            if written.as_ref().is_none_or(|old| old.resets[index] != reset) {
                clock.reset_id.iter().try_for_each(|id| body.change_scalar(*id, reset))?;
            }
        }
        let body = std::mem::take(body.writer());
        if first {
            stamp(writer, stamped, since)?;
            writer.begin(SimulationCommand::Dumpvars)?;
            writer.writer().extend_from_slice(&body);
            writer.end()?;
        } else if !body.is_empty() {
            stamp(writer, stamped, since)?;
            writer.writer().extend_from_slice(&body);
        }
        *time = since;
        for (fall, falling) in Clock::falls(clocks, since, new.until) {
            stamp(writer, stamped, fall)?;
            falling.iter().flat_map(|clock| &clocks[*clock].id).try_for_each(|id| writer.change_scalar(*id, false))?;
            *time = fall;
        }
        Ok(())
    }
}

/// Writes a time unless it stands there already.
fn stamp(writer: &mut Writer<Vec<u8>>, stamped: &mut Option<u64>, time: u64) -> io::Result<()> {
    if stamped.replace(time) == Some(time) { Ok(()) } else { writer.timestamp(time) }
}

/// Writes a variable's new value.
fn change(writer: &mut Writer<Vec<u8>>, variable: &Variable, limbs: &[u64]) -> io::Result<()> {
    match &variable.kind {
        VariableKind::Bits(1) => writer.change_scalar(variable.id, limbs[0] & 1 == 1),
        VariableKind::Bits(width) => {
            let highest = (0..*width).rev().find(|&i| crate::limbs::bit(limbs, i)).unwrap_or(0);
            let bits = (0..=highest).rev().map(|i| Value::from(crate::limbs::bit(limbs, i)));
            writer.change_vector(variable.id, bits)
        }
        VariableKind::State(states) => match states.names.get(limbs[0] as usize) {
            Some(name) => writer.change_string(variable.id, name),
            None => writer.change_string(variable.id, &format!("code_{}", limbs[0])),
        },
    }
}

impl Observer for Dump {
    fn sample(&mut self, view: &mut View) -> Result<(), Error> {
        if view.until <= self.window.start || view.since >= self.window.end {
            return Ok(());
        }
        let snapshot = self.snapshot(view);
        self.add(snapshot)
    }

    fn failed(&mut self) -> Result<(), Error> {
        if self.last.take().is_some() {
            self.open()?;
            for snapshot in std::mem::take(&mut self.recent) {
                self.emit(snapshot)?;
            }
        }
        self.flush()
    }

    fn finish(&mut self, view: &mut View) -> Result<(), Error> {
        self.sample(view)?;
        let end = view.until.min(self.window.end);
        if self.written.is_some() && self.time < end {
            stamp(&mut self.writer, &mut self.stamped, end).map_err(|source| self.error(source))?;
        }
        self.flush()
    }
}

/// A run that ends without [`Simulation::finish`](crate::Simulation::finish), as by a panic, still leaves its waves.
impl Drop for Dump {
    fn drop(&mut self) {
        if let Err(error) = self.flush() {
            eprintln!("{error}");
        }
    }
}
