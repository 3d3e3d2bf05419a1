//! The state of a module, by the names in the printed text: for testbenches, which set it.

use super::printer::Printer;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Contents, Init, InstanceId, Memory, Module, Shape};

/// A testbench's view of a module.
pub struct ModuleState {
    /// The state in the module itself, not in its instances or lanes.
    pub own: Vec<State>,
    /// The state in lanes.
    pub scopes: Vec<ScopeState>,
}

/// The state in the scopes of a `generate for`.
pub struct ScopeState {
    pub shape: Shape,
    /// The label of the loop; for a grid, of the outer loop.
    label: String,
    /// The label of a grid's inner loop.
    column: String,
    /// The state in a lane itself.
    pub own: Vec<State>,
    /// The instances in a lane, and their names there.
    pub instances: Vec<(InstanceId, String)>,
}

impl ScopeState {
    /// The scope of a lane, with each index given as text.
    pub fn path(&self, lane: &[&str]) -> String {
        match lane {
            [row, column] => format!("{}[{row}].{}[{column}]", self.label, self.column),
            _ => format!("{}[{}]", self.label, lane.join("][")),
        }
    }
}

/// An element of state.
pub enum State {
    /// A register that starts at this value by default; with different lanes, at these values, in row-major order. A
    /// lane has a name of its own where the module has a port of the description's.
    Register { name: String, described: String, start: Vec<Bits> },
    /// The data of a synchronous read whose word is gated: the word's register and the gating flag.
    GatedRead { name: String, word: String, inside: String, width: u32 },
    /// A memory; one with unknown contents starts with zeros.
    Memory { name: String, depth: u32, width: u32, is_unknown: bool },
}

impl State {
    /// Whether the description calls it so.
    pub fn is(&self, wanted: &str) -> bool {
        match self {
            State::Register { described: name, .. } | State::GatedRead { name, .. } | State::Memory { name, .. } => {
                name == wanted
            }
        }
    }
}

impl Printer<'_> {
    /// Registers, read data and memories of a module that is `described` so, including those of the lanes.
    pub fn state(&self, described: &Module) -> ModuleState {
        let module = self.module;
        let is_plain = |register: &usize| module.shape(module.registers[*register].node).is_plain();
        let registers = (0..module.registers.len()).filter(is_plain);
        let registers = registers.map(|register| self.register_state(register, described));
        let memories = module.memories.iter().enumerate().filter(|(_, memory)| memory.shape.is_plain());
        let memories = memories.flat_map(|(index, memory)| self.memory_state(index, memory));
        let scopes = (0..self.groups.groups.len()).flat_map(|group| self.scope_states(group, described));
        ModuleState { own: registers.chain(memories).collect(), scopes: scopes.collect() }
    }

    /// The scopes of a group, and those of the values read before it.
    fn scope_states(&self, group: usize, described: &Module) -> Vec<ScopeState> {
        let (module, own, names) = (self.module, &self.groups.groups[group], &self.lanes.groups[group]);
        let (ahead, later): (Vec<usize>, Vec<usize>) =
            own.registers.iter().partition(|&&index| own.ahead.contains(&module.registers[index].node));
        let states =
            |registers: Vec<usize>| registers.into_iter().map(|register| self.register_state(register, described));
        let scope = |label: &String, own: Vec<State>| ScopeState {
            shape: self.groups.groups[group].shape,
            label: label.clone(),
            column: self.lanes.column.clone(),
            own,
            instances: Vec::new(),
        };
        let memories = own.memories.iter().flat_map(|&index| self.memory_state(index, &module.memories[index]));
        let mut body = scope(&names.label, states(later).chain(memories).collect());
        body.instances = names.instances.iter().map(|(&id, name)| (InstanceId(id as u32), name.clone())).collect();
        let ahead = names.ahead.as_ref().map(|label| scope(label, states(ahead).collect()));
        ahead.into_iter().chain([body]).collect()
    }

    fn register_state(&self, index: usize, described: &Module) -> State {
        let register = &self.module.registers[index];
        let described = described.register_name(&described.registers[index]).to_string();
        let width = self.module.width(register.node);
        let start = match (&register.initial, &register.reset) {
            (Some(value), _) | (None, Some(Init::Same(value))) => vec![value.clone()],
            (None, Some(Init::Each(values))) => values.clone(),
            (None, None) => vec![Bits::zero(width)],
        };
        State::Register { name: self.name(register.node).to_string(), described, start }
    }

    fn memory_state(&self, index: usize, memory: &Memory) -> Vec<State> {
        let width = memory.width;
        let reads = self.reads[index].iter().flatten().map(|names| match names.raw.clone() {
            None => State::Register {
                name: names.data.clone(),
                described: names.data.clone(),
                start: vec![Bits::zero(width)],
            },
            Some(raw) => State::GatedRead { name: names.data.clone(), word: raw.word, inside: raw.inside, width },
        });
        let mut all: Vec<State> = reads.collect();
        let is_unknown = memory.contents == Contents::Unknown;
        all.push(State::Memory { name: memory.name.clone(), depth: memory.depth, width, is_unknown });
        all
    }
}
