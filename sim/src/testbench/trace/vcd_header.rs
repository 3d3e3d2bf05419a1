//! The header of a waveform file: its scopes and variables, and what these show.

use std::collections::{BTreeSet, HashMap};
use std::io;
use std::ops::Range;

use tilewright_circuit::Reset;
use tilewright_circuit::ir::Names;
use vcd::{ReferenceIndex, ScopeType, TimescaleUnit, VarType, Writer};

use super::changes::Id;
use super::glob;
use super::waveform::Trace;
use super::words::MOST_WORDS;
use crate::engine::Word;
use crate::engine::program::hierarchy::{Place, Replication, Role, Signal};
use crate::engine::program::{Program, ValueId, hierarchy};
use crate::testbench::error::{Error, UnknownName};

/// The header, and the data that the changes after it need.
pub(crate) struct Header {
    /// From `$version` to `$enddefinitions`.
    pub text: Vec<u8>,
    pub variables: Vec<Variable>,
    pub words: Vec<WordVariable>,
    pub clocks: Vec<Clock>,
}

/// A variable: the value that it shows, and its format.
pub(crate) struct Variable {
    pub id: Id,
    pub kind: VariableKind,
    pub value: ValueId,
    pub lane: u32,
}

/// A variable that shows a word of a memory.
pub(crate) struct WordVariable {
    pub id: Id,
    pub kind: VariableKind,
    pub word: Word,
}

pub(crate) enum VariableKind {
    /// One bit.
    Bit,
    /// A number of several bits.
    Bits,
    /// The name of a code.
    Code(Names),
}

/// A clock and its reset; without ids if nothing shows them.
pub(crate) struct Clock {
    period: u64,
    pub id: Option<Id>,
    pub reset_id: Option<Id>,
    kind: Reset,
    falls: bool,
}

impl Clock {
    /// Whether its last change up to this time was an edge at which registers act.
    pub fn is_past_edge(&self, time: u64) -> bool {
        time >= self.period && time % self.period < self.period / 2
    }

    /// The level of its port after an edge at which registers act, or else after the other one.
    pub fn level(&self, is_past_edge: bool) -> bool {
        is_past_edge != self.falls
    }

    /// The level of its reset port.
    pub fn reset_level(&self, is_active: bool) -> bool {
        is_active != self.kind.is_active_low()
    }

    /// Whether the end of its reset, released after the instant at this time, is shown when the clock returns. If an
    /// asynchronous reset ended just at an edge, a reader could not tell whether it still resets there.
    pub fn releases_later(&self, time: u64) -> bool {
        self.kind.is_asynchronous() && time > 0 && time.is_multiple_of(self.period)
    }

    /// The time at which it returns to its first level, if it has not at this time.
    pub fn back(&self, time: u64) -> Option<u64> {
        let since = time % self.period;
        (time >= self.period && since < self.period / 2).then(|| time - since + self.period / 2)
    }
}

/// The header for the signals of a run that match one of the trace's patterns, or for all if there are none, and for the
/// words of memories that it asks for.
pub(crate) fn header(program: &Program, run: u32, trace: &Trace) -> Result<Header, Error> {
    let top = &program.hierarchy.scopes[0].name;
    let mut build = Build {
        program,
        run,
        patterns: trace.patterns.iter().map(|pattern| readings(pattern, top)).collect(),
        used: vec![false; trace.patterns.len()],
        memories: trace.words.iter().map(|(pattern, addresses)| (readings(pattern, top), addresses.clone())).collect(),
        used_memories: vec![false; trace.words.len()],
        words: 0,
        writer: Writer::new(Vec::new()),
        ids: HashMap::new(),
        strings: HashMap::new(),
        count: 0,
        header: Header { text: Vec::new(), variables: Vec::new(), words: Vec::new(), clocks: Vec::new() },
    };
    let clock = |clock: &crate::engine::program::Clock| Clock {
        period: clock.period,
        id: None,
        reset_id: None,
        kind: clock.kind,
        falls: clock.falls,
    };
    build.header.clocks = program.clocks.iter().map(clock).collect();
    build.write().expect("writing to memory does not fail");
    if let Some(unused) = build.used.iter().position(|used| !used) {
        return Err(unmatched(program, &trace.patterns[unused]).into());
    }
    if let Some(unused) = build.used_memories.iter().position(|used| !used) {
        return Err(unmatched_memory(program, &trace.words[unused].0).into());
    }
    if build.words > MOST_WORDS {
        return Err(Error::Words { words: build.words, most: MOST_WORDS });
    }
    build.header.text = std::mem::take(build.writer.writer());
    Ok(build.header)
}

/// A pattern as given, and in the form that matches a path of the file or of the Verilog, below this top. Such paths
/// begin with the top's name, have a scope `lane` in each element of an array, and may end in a range of bits.
fn readings(pattern: &str, top: &str) -> [String; 2] {
    let below = pattern.strip_prefix(top).and_then(|rest| rest.strip_prefix('.')).unwrap_or(pattern);
    let is_range = |bits: &str| bits.contains(':') && bits.chars().all(|c| c.is_ascii_digit() || c == ':');
    let range = below.strip_suffix(']').and_then(|rest| rest.rsplit_once('['));
    let name = range.filter(|(_, bits)| is_range(bits)).map_or(below, |(name, _)| name);
    let instances: Vec<&str> = name.split('.').filter(|part| *part != "lane").collect();
    [pattern.to_string(), instances.join(".")]
}

/// The error for a pattern that matches nothing, with the nearest one that does: a name, or all names below an
/// instance. If none is near, it lists the instances, with those of an array as one.
fn unmatched(program: &Program, pattern: &str) -> UnknownName {
    let hierarchy = &program.hierarchy;
    let (mut names, mut instances) = (Vec::new(), Vec::new());
    for place in hierarchy.places(0) {
        let scope = hierarchy.scope(place.scope);
        let signals = scope.signals.iter().map(|signal| &signal.name);
        let clocks = scope.clocks.iter().flat_map(|ports| [Some(&ports.port), ports.reset.as_ref()]).flatten();
        let names_here = signals.chain(clocks).map(String::as_str).chain(["**"]);
        names.extend(names_here.map(|name| hierarchy.path_in(place, name)));
        instances.push(every_element(&hierarchy.path_in(place, "**")));
    }
    instances.sort();
    instances.dedup();
    UnknownName::among("signal that matches", pattern, &names, &instances)
}

/// The error for a pattern that matches no memory.
fn unmatched_memory(program: &Program, pattern: &str) -> UnknownName {
    let hierarchy = &program.hierarchy;
    let of_place = |place: Place| {
        let memories = hierarchy.scope(place.scope).memories.iter();
        memories.map(move |(name, _, _)| hierarchy.path_in(place, name)).collect::<Vec<_>>()
    };
    let names: Vec<String> = hierarchy.places(0).into_iter().flat_map(of_place).collect();
    let mut choose: Vec<String> = names.iter().map(|name| every_element(name)).collect();
    choose.sort();
    choose.dedup();
    UnknownName::among("memory that matches", pattern, &names, &choose)
}

/// A path with a star for the index of each array.
fn every_element(path: &str) -> String {
    let after = |part: &str| part.find(']').map_or_else(|| part.to_string(), |end| format!("*{}", &part[end..]));
    path.split_inclusive('[').map(after).collect()
}

struct Build<'a> {
    program: &'a Program,
    run: u32,
    /// Each in all its forms.
    patterns: Vec<[String; 2]>,
    /// The patterns that have matched something.
    used: Vec<bool>,
    /// The patterns of memories, each with addresses, and those that have matched something.
    memories: Vec<([String; 2], Range<u32>)>,
    used_memories: Vec<bool>,
    /// The number of words that are asked for.
    words: u64,
    writer: Writer<Vec<u8>>,
    /// One id for each lane of a value, whatever its names.
    ids: HashMap<(ValueId, u32), Id>,
    strings: HashMap<(ValueId, u32), Id>,
    /// The number of variables.
    count: u32,
    header: Header,
}

impl Build<'_> {
    fn write(&mut self) -> io::Result<()> {
        self.writer.version(concat!("Tilewright ", env!("CARGO_PKG_VERSION")))?;
        self.writer.timescale(1, TimescaleUnit::PS)?;
        let top = self.program.hierarchy.top(self.run);
        self.writer.scope_def(ScopeType::Module, &self.program.hierarchy.scope(top.scope).name)?;
        self.scope(top, "")?;
        self.writer.upscope()?;
        self.writer.enddefinitions()
    }

    /// The contents of an instance: clocks, signals, instances.
    fn scope(&mut self, place: Place, path: &str) -> io::Result<()> {
        let program = self.program;
        let scope = program.hierarchy.scope(place.scope);
        for ports in &scope.clocks {
            let clock = ports.clock as usize;
            if self.shows(path, &ports.port) {
                let id = self.header.clocks[clock].id;
                self.header.clocks[clock].id = Some(self.wire(id, &ports.port)?);
            }
            if let Some(reset) = ports.reset.as_ref().filter(|reset| self.shows(path, reset)) {
                let id = self.header.clocks[clock].reset_id;
                self.header.clocks[clock].reset_id = Some(self.wire(id, reset)?);
            }
        }
        for signal in &scope.signals {
            let lanes = signal.shape.lanes();
            for lane in if self.shows(path, &signal.name) { 0..lanes } else { 0..0 } {
                self.signal(signal, lane, place.lane * lanes + lane)?;
            }
        }
        for (name, memory, shape) in &scope.memories {
            for lane in 0..shape.lanes() {
                let name = format!("{name}{}", hierarchy::index(*shape, lane));
                let first = Word { memory: *memory, lane: place.lane * shape.lanes() + lane, address: 0 };
                self.memory(path, &name, first)?;
            }
        }
        for (name, child) in program.hierarchy.children(place) {
            self.child(&name, child, path)?;
        }
        Ok(())
    }

    /// The words of a memory that are asked for.
    fn memory(&mut self, path: &str, name: &str, first: Word) -> io::Result<()> {
        let (full, plain) = (joined(path, name), joined(path, name.split('[').next().unwrap_or(name)));
        let memory = &self.program.memories[first.memory as usize];
        let mut addresses = BTreeSet::new();
        for ((pattern, range), used) in self.memories.iter().zip(&mut self.used_memories) {
            if pattern.iter().any(|reading| glob::matches(reading, &full) || glob::matches(reading, &plain)) {
                *used = true;
                let range = range.start..range.end.min(memory.depth);
                // What is too much is counted alone.
                self.words += u64::from(range.end.saturating_sub(range.start));
                if self.words <= MOST_WORDS {
                    addresses.extend(range);
                }
            }
        }
        for address in addresses {
            let id = fresh(&mut self.count);
            let index = (memory.width > 1).then(|| ReferenceIndex::Range(memory.width as i32 - 1, 0));
            self.writer.var_def(VarType::Reg, memory.width, id.code, &format!("{name}[{address}]"), index)?;
            let kind = if memory.width == 1 { VariableKind::Bit } else { VariableKind::Bits };
            self.header.words.push(WordVariable { id, kind, word: Word { address, ..first } });
        }
        Ok(())
    }

    /// An instance, unless nothing in it is shown.
    fn child(&mut self, name: &str, place: Place, path: &str) -> io::Result<()> {
        let path = joined(path, name);
        let start = self.writer.writer().len();
        let in_array = self.program.hierarchy.scope(place.scope).replication != Replication::Single;
        if in_array {
            self.writer.scope_def(ScopeType::Begin, name)?;
        }
        self.writer.scope_def(ScopeType::Module, if in_array { "lane" } else { name })?;
        let inside = self.writer.writer().len();
        self.scope(place, &path)?;
        let is_empty = self.writer.writer().len() == inside;
        self.writer.upscope()?;
        if in_array {
            self.writer.upscope()?;
        }
        if is_empty {
            self.writer.writer().truncate(start);
        }
        Ok(())
    }

    /// Whether a pattern asks for this name; a clock of the top is always shown.
    fn shows(&mut self, path: &str, name: &str) -> bool {
        let full = joined(path, name);
        let mut shown = self.patterns.is_empty();
        for (pattern, used) in self.patterns.iter().zip(&mut self.used) {
            if pattern.iter().any(|reading| glob::matches(reading, &full)) {
                (*used, shown) = (true, true);
            }
        }
        let is_top_clock = path.is_empty() && self.program.clocks.iter().any(|clock| clock.port == name);
        shown || is_top_clock
    }

    fn wire(&mut self, id: Option<Id>, name: &str) -> io::Result<Id> {
        let id = id.unwrap_or_else(|| fresh(&mut self.count));
        self.writer.var_def(VarType::Wire, 1, id.code, name, None)?;
        Ok(id)
    }

    /// A lane of a signal; `lane` is its index in the value.
    fn signal(&mut self, signal: &Signal, own: u32, lane: u32) -> io::Result<()> {
        let name = format!("{}{}", signal.name, hierarchy::index(signal.shape, own));
        let known = self.ids.get(&(signal.value, lane)).copied();
        let id = known.unwrap_or_else(|| fresh(&mut self.count));
        let kind = match signal.role {
            Role::Register | Role::ReadData => VarType::Reg,
            Role::Input | Role::Output | Role::Net => VarType::Wire,
        };
        let index = (signal.width > 1).then(|| ReferenceIndex::Range(signal.width as i32 - 1, 0));
        self.writer.var_def(kind, signal.width, id.code, &name, index)?;
        if known.is_none() {
            self.ids.insert((signal.value, lane), id);
            let kind = if signal.width == 1 { VariableKind::Bit } else { VariableKind::Bits };
            self.variable(id, kind, signal.value, lane);
        }
        let Some(names) = signal.kind.names() else { return Ok(()) };
        let known = self.strings.get(&(signal.value, lane)).copied();
        let id = known.unwrap_or_else(|| fresh(&mut self.count));
        self.writer.var_def(VarType::String, 1, id.code, &format!("{name}_state"), None)?;
        if known.is_none() {
            self.strings.insert((signal.value, lane), id);
            self.variable(id, VariableKind::Code(names), signal.value, lane);
        }
        Ok(())
    }

    fn variable(&mut self, id: Id, kind: VariableKind, value: ValueId, lane: u32) {
        self.header.variables.push(Variable { id, kind, value, lane });
    }
}

/// The path of a name in an instance.
fn joined(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_string() } else { format!("{path}.{name}") }
}

/// The next variable.
fn fresh(count: &mut u32) -> Id {
    *count += 1;
    Id::new(*count - 1)
}
