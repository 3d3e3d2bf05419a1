//! A circuit in lines.

use std::fmt::Write;

use rustc_hash::FxHashMap;
use tilewright_circuit::ir::Init;

use super::operation::{constant, operation};
use crate::engine::program::{Circuit, Kind, Program, ValueId};

/// The names of values and memories.
#[derive(Clone)]
pub(in crate::engine) struct Names {
    values: FxHashMap<ValueId, String>,
    memories: Vec<String>,
}

impl Names {
    /// The names of a program's values and memories: the path of the scope and the name, without lanes.
    pub fn of(program: &Program) -> Names {
        let hierarchy = &program.hierarchy;
        let mut values = FxHashMap::default();
        let mut memories = vec![String::new(); program.memories.len()];
        let mut paths: Vec<String> = Vec::new();
        for scope in &hierarchy.scopes {
            let path =
                scope.parent.map_or(String::new(), |parent| format!("{}{}.", paths[parent.0 as usize], scope.name));
            for signal in &scope.signals {
                values.entry(signal.value).or_insert_with(|| format!("{path}{}", signal.name));
            }
            scope.memories.iter().for_each(|(name, index, _)| memories[*index as usize] = format!("{path}{name}"));
            paths.push(path);
        }
        Names { values, memories }
    }

    /// The same for a circuit in which values have been replaced.
    pub fn renamed(&self, became: &FxHashMap<ValueId, ValueId>) -> Names {
        let mut named: Vec<_> =
            self.values.iter().filter_map(|(id, name)| Some((*became.get(id)?, *id, name))).collect();
        named.sort();
        let mut values = FxHashMap::default();
        for (id, _, name) in named {
            values.entry(id).or_insert_with(|| name.clone());
        }
        Names { values, memories: self.memories.clone() }
    }
}

/// Writes a circuit.
pub(in crate::engine) struct Text<'a> {
    program: &'a Program,
    circuit: &'a Circuit,
    pub names: Names,
    /// The numbers of unnamed values, in the sequence of appearance.
    numbers: FxHashMap<ValueId, usize>,
}

impl<'a> Text<'a> {
    /// For the circuit of a program.
    pub fn of(program: &'a Program) -> Text<'a> {
        Text::with(program, &program.circuit, Names::of(program))
    }

    /// For another circuit, made of a program's.
    pub fn with(program: &'a Program, circuit: &'a Circuit, names: Names) -> Text<'a> {
        Text { program, circuit, names, numbers: FxHashMap::default() }
    }

    /// All of a program: its values, then the changes of its clocks, its assertions, and its outputs.
    pub fn program(&mut self) -> String {
        let mut text = self.values(self.program.circuit.ids());
        let program = self.program;
        for (clock, declared) in program.clocks.iter().enumerate() {
            let mut changes = String::new();
            for register in program.registers.iter().filter(|it| it.clock as usize == clock) {
                let line = self.change(&self.name(register.value), &self.name(register.next), register.enable);
                let reset = match &register.reset {
                    None => String::new(),
                    Some(Init::Same(value)) => format!(", {} after a reset", constant(value)),
                    Some(Init::Each(values)) => {
                        format!(", {} after a reset", values.iter().map(constant).collect::<Vec<_>>().join(" "))
                    }
                };
                let _ = writeln!(changes, "{}{reset}", line.trim_end());
            }
            for (index, memory) in (0..).zip(&program.memories) {
                for read in memory.reads.iter().filter(|it| it.clock as usize == clock) {
                    let word = format!("{}[{}]", self.memory(index), self.name(read.address));
                    changes.push_str(&self.change(&self.name(read.value), &word, read.enable));
                }
                for write in memory.writes.iter().filter(|it| it.clock as usize == clock) {
                    let word = format!("{}[{}]", self.memory(index), self.name(write.address));
                    changes.push_str(&self.change(&word, &self.name(write.data), Some(write.enable)));
                }
            }
            for assert in program.asserts.iter().filter(|it| it.clock as usize == clock) {
                let _ = writeln!(changes, "  assert {}: {}", self.name(assert.condition), assert.message);
            }
            if !changes.is_empty() {
                let _ = write!(text, "at {}:\n{changes}", declared.name);
            }
        }
        for port in &program.outputs {
            let _ = writeln!(text, "output {} = {}", port.name, self.name(port.value));
        }
        text
    }

    /// Lines for values except constants, which are written where they are used.
    pub fn values(&mut self, ids: impl Iterator<Item = ValueId>) -> String {
        let ids: Vec<ValueId> = ids.filter(|id| self.circuit.constant(*id).is_none()).collect();
        for id in &ids {
            let next = self.numbers.len();
            if !self.names.values.contains_key(id) {
                self.numbers.entry(*id).or_insert(next);
            }
        }
        let lines: Vec<[String; 4]> = ids.iter().map(|id| self.line(*id)).collect();
        let wide = |column: usize| lines.iter().map(|line| line[column].len()).max().unwrap_or(0).min(48);
        let [first, second, third] = [0, 1, 2].map(wide);
        let mut text = String::new();
        for [name, shape, operation, place] in lines {
            let line = format!("{name:first$} : {shape:second$} = {operation:third$}   {place}");
            let _ = writeln!(text, "{}", line.trim_end());
        }
        text
    }

    /// Name, shape, operation and place of a value.
    fn line(&self, id: ValueId) -> [String; 4] {
        let cell = &self.circuit[id];
        let shape = match cell.lanes {
            1 => cell.width.to_string(),
            lanes => format!("{lanes} x {}", cell.width),
        };
        let operation = match cell.kind {
            Kind::State => self.state(id).to_owned(),
            _ => operation(&cell.kind, cell.width, &|id| self.name(id), &|memory| self.memory(memory)),
        };
        let place = self.circuit.loc(id).map(|loc| format!("{}:{}", loc.file(), loc.line()));
        [self.name(id), shape, operation, place.unwrap_or_default()]
    }

    /// The external source of a value.
    fn state(&self, id: ValueId) -> &'static str {
        match () {
            () if self.program.inputs.iter().any(|port| port.value == id) => "input",
            () if self.program.registers.iter().any(|register| register.value == id) => "register",
            () if self.program.memories.iter().flat_map(|memory| &memory.reads).any(|read| read.value == id) => {
                "word read"
            }
            () => "given",
        }
    }

    /// The name of a value, or its number; a constant itself.
    pub fn name(&self, id: ValueId) -> String {
        match (self.circuit.constant(id), self.names.values.get(&id), self.numbers.get(&id)) {
            (Some(bits), ..) => constant(bits),
            (None, Some(name), _) => name.clone(),
            (None, None, Some(number)) => format!("%{number}"),
            (None, None, None) => format!("%v{}", id.0),
        }
    }

    /// The name of a memory.
    pub fn memory(&self, index: u32) -> String {
        self.names.memories[index as usize].clone()
    }

    /// An assignment at an edge, with its condition.
    pub fn change(&self, what: &str, next: &str, enable: Option<ValueId>) -> String {
        let when = enable.map(|enable| format!(" if {}", self.name(enable))).unwrap_or_default();
        format!("  {what} <- {next}{when}\n")
    }
}
