//! Waveform files of any tool, as a list of changes.

use crate::shell::crash;
use crate::shell::place::shown;
use crate::shell::text::one_line;
use crate::shell::{Exit, Failure};
use fst_reader::{FstFilter, FstHierarchyEntry, FstReader, FstSignalValue, FstVarType};
use std::collections::HashMap;
use std::fmt::Display;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;
use vcd::{Command, IdCode, Parser, ReferenceIndex, ScopeItem, TimescaleUnit, Var, VarType};

/// The size of a value that is a text: a string, or a number with a point.
pub const TEXT: u32 = 0;

/// A waveform file.
pub struct Waves {
    /// The file's name.
    pub name: String,
    pub signals: Vec<Signal>,
    /// The number of variables, of which one may be several signals.
    pub variables: usize,
    /// In the sequence of time, which is counted in 10^`exponent` seconds.
    pub changes: Vec<Change>,
    pub exponent: i32,
    /// The last time in the file.
    pub end: u64,
    values: Vec<u8>,
}

/// A name of a variable.
pub struct Signal {
    /// The scopes, and the name without its range of bits.
    pub path: Vec<String>,
    /// The number of bits, or [`TEXT`].
    pub width: u32,
    pub variable: u32,
}

/// A new value of a variable.
pub struct Change {
    pub time: u64,
    pub variable: u32,
    start: usize,
    length: u32,
}

impl Waves {
    /// Reads a VCD or an FST file.
    ///
    /// # Errors
    /// It cannot be read, or is no waveform.
    pub fn read(path: &Path) -> Result<Waves, Failure> {
        let unreadable = |error: std::io::Error| {
            let why = one_line(&error.to_string());
            let sentence = format!("{}: it cannot be read ({why}): name a VCD or an FST file", shown(path));
            Failure::new(Exit::BadInput, sentence)
        };
        let mut input = BufReader::with_capacity(1 << 20, File::open(path).map_err(unreadable)?);
        let first = input.fill_buf().map_err(unreadable)?.first().copied();
        let mut reading = Reading {
            waves: Waves {
                name: shown(path),
                signals: Vec::new(),
                variables: 0,
                changes: Vec::new(),
                exponent: 0,
                end: 0,
                values: Vec::new(),
            },
            path: Vec::new(),
            widths: Vec::new(),
        };
        // The first block of an FST file is the header, or one that has the others packed.
        match first {
            Some(0 | 254) => match crash::quietly(|| reading.fst(input)) {
                Some(read) => read?,
                None => return Err(reading.unsound("a block of it is malformed")),
            },
            _ => reading.vcd(input)?,
        }
        reading.waves.variables = reading.widths.len();
        Ok(reading.waves)
    }

    /// The same under another name.
    pub fn named(self, name: &str) -> Waves {
        Waves { name: name.to_owned(), ..self }
    }

    /// The value of a change: a character for each bit, the highest first, or a text.
    pub fn value(&self, change: &Change) -> &[u8] {
        &self.values[change.start..change.start + change.length as usize]
    }
}

/// A file that is being read.
struct Reading {
    waves: Waves,
    /// The scopes that are open.
    path: Vec<String>,
    /// The width of each variable.
    widths: Vec<u32>,
}

impl Reading {
    fn vcd(&mut self, input: impl BufRead) -> Result<(), Failure> {
        let mut parser = Parser::new(input);
        let header = parser.parse_header().map_err(|error| self.unsound(error))?;
        let Some((number, unit)) = header.timescale else { return Err(self.unsound("it has no time scale")) };
        let unit = match unit {
            TimescaleUnit::S => 0,
            TimescaleUnit::MS => -3,
            TimescaleUnit::US => -6,
            TimescaleUnit::NS => -9,
            TimescaleUnit::PS => -12,
            TimescaleUnit::FS => -15,
        };
        self.waves.exponent = unit + number.max(1).ilog10() as i32;
        let mut variables = HashMap::new();
        header.items.iter().for_each(|item| self.item(item, &mut variables));
        let mut time = 0;
        for command in parser {
            let command = command.map_err(|error| self.unsound(error))?;
            let (code, value) = match command {
                Command::Timestamp(next) if next < time => {
                    return Err(self.unsound(format!("time goes back to {next}")));
                }
                Command::Timestamp(next) => {
                    time = next;
                    self.waves.end = time;
                    continue;
                }
                Command::ChangeScalar(code, value) => (code, value.to_string()),
                Command::ChangeVector(code, digits) => (code, digits.to_string()),
                Command::ChangeReal(code, number) => (code, number.to_string()),
                Command::ChangeString(code, text) => (code, text),
                _ => continue,
            };
            match variables.get(&code) {
                Some(&variable) => self.change(time, variable, value.as_bytes()),
                None => return Err(self.unsound(format!("`{code}` changes and is not declared"))),
            }
        }
        Ok(())
    }

    fn item(&mut self, item: &ScopeItem, variables: &mut HashMap<IdCode, u32>) {
        match item {
            ScopeItem::Scope(scope) => {
                self.path.push(scope.identifier.clone());
                scope.items.iter().for_each(|item| self.item(item, variables));
                self.path.pop();
            }
            ScopeItem::Var(Var { var_type, size, code, reference, index, .. }) => {
                let is_text = matches!(var_type, VarType::String | VarType::Real);
                let width = if is_text { TEXT } else { *size };
                let next = variables.len() as u32;
                let variable = *variables.entry(*code).or_insert(next);
                let name = match index {
                    Some(ReferenceIndex::BitSelect(bit)) => format!("{reference}[{bit}]"),
                    _ => reference.clone(),
                };
                self.signal(name, width, variable);
            }
            _ => {}
        }
    }

    fn fst(&mut self, input: BufReader<File>) -> Result<(), Failure> {
        let mut reader = FstReader::open(input).map_err(|error| self.unsound(error))?;
        let header = reader.get_header();
        (self.waves.exponent, self.waves.end) = (header.timescale_exponent.into(), header.end_time);
        let mut entries = Vec::new();
        reader.read_hierarchy(|entry| entries.push(entry)).map_err(|error| self.unsound(error))?;
        for entry in entries {
            match entry {
                FstHierarchyEntry::Scope { name, .. } => self.path.push(name),
                FstHierarchyEntry::UpScope => drop(self.path.pop()),
                FstHierarchyEntry::Var { tpe, name, length, handle, .. } => {
                    use FstVarType::*;
                    let is_text = matches!(tpe, GenericString | Real | RealParameter | RealTime | ShortReal);
                    let width = if is_text { TEXT } else { length };
                    self.signal(without_range(&name), width, handle.get_index() as u32);
                }
                _ => {}
            }
        }
        let take = |time, handle: fst_reader::FstSignalHandle, value: FstSignalValue| {
            let variable = handle.get_index() as u32;
            match value {
                FstSignalValue::String(value) => self.change(time, variable, value),
                FstSignalValue::Real(number) => self.change(time, variable, number.to_string().as_bytes()),
            }
            Ok::<(), std::convert::Infallible>(())
        };
        let all = FstFilter { start: 0, end: None, include: None };
        reader.read_signals(&all, take).map_err(|error| self.unsound(format!("{error:?}")))
    }

    fn signal(&mut self, name: String, width: u32, variable: u32) {
        // Icarus escapes the brackets of a word of a memory.
        let name = name.strip_prefix('\\').map_or(name.clone(), str::to_owned);
        let path = self.path.iter().cloned().chain([name]).collect();
        self.waves.signals.push(Signal { path, width, variable });
        if self.widths.len() <= variable as usize {
            self.widths.resize(variable as usize + 1, TEXT);
        }
        self.widths[variable as usize] = width;
    }

    /// A new value; one of bits gets the leading ones that a VCD file leaves out.
    fn change(&mut self, time: u64, variable: u32, value: &[u8]) {
        let values = &mut self.waves.values;
        let start = values.len();
        let width = self.widths.get(variable as usize).map_or(TEXT, |width| *width) as usize;
        if let (Some(first), true) = (value.first(), width > value.len()) {
            let leading = if matches!(first, b'0' | b'1') { b'0' } else { first.to_ascii_lowercase() };
            values.resize(start + width - value.len(), leading);
        }
        match width {
            0 => values.extend_from_slice(value),
            _ => values.extend(value.iter().map(u8::to_ascii_lowercase)),
        }
        let length = (values.len() - start) as u32;
        self.waves.changes.push(Change { time, variable, start, length });
    }

    fn unsound(&self, why: impl Display) -> Failure {
        let why = one_line(&why.to_string());
        let sentence = format!("{}: it is no sound waveform ({why}): name a VCD or an FST file", self.waves.name);
        Failure::new(Exit::BadInput, sentence)
    }
}

/// A name without the range of bits, such as `[7:0]`, at its end.
fn without_range(name: &str) -> String {
    let base = name.rfind('[').filter(|_| name.ends_with(']')).filter(|start| name[*start..].contains(':'));
    name[..base.unwrap_or(name.len())].replace(' ', "")
}
