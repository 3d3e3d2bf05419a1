//! What holds state in a module, by the names that the printed text has: for testbenches, which set it.

use super::printer::Printer;
use tilewright_hdl::Bits;
use tilewright_hdl::ir::{Contents, InstanceId, Memory, Register};

/// What a testbench knows of a module.
pub struct ModuleState {
    /// What holds state in the module itself, not in its instances.
    pub own: Vec<State>,
    /// For each instance that is an array, what the instance in each lane is called.
    pub lanes: Vec<Option<String>>,
}

/// Something that holds state.
pub enum State {
    /// A register that starts at `start` if nobody says otherwise.
    Register { name: String, start: Bits },
    /// The data of a synchronous read whose word is gated: the word's register and the flag that lets it through.
    GatedRead { name: String, word: String, inside: String, width: u32 },
    /// A memory; one of unknown contents starts with zeros.
    Memory { name: String, depth: u32, width: u32, is_unknown: bool },
}

impl Printer<'_> {
    /// Registers, read data and memories, and where those of the lanes are.
    pub fn state(&self) -> ModuleState {
        let module = self.module;
        let registers = module.registers.iter().map(|register| self.register_state(register));
        let memories = module.memories.iter().enumerate().flat_map(|(index, memory)| self.memory_state(index, memory));
        let instances = (0..module.instances.len() as u32).map(InstanceId);
        let lanes = instances.map(|id| Some(self.arrays.arrays.get(&id)?.instance.clone()));
        ModuleState { own: registers.chain(memories).collect(), lanes: lanes.collect() }
    }

    fn register_state(&self, register: &Register) -> State {
        let width = self.module.width(register.node);
        let start = register.reset.as_ref().map_or_else(|| Bits::zero(width), |reset| reset.lane(0).clone());
        State::Register { name: self.name(register.node).to_string(), start }
    }

    fn memory_state(&self, index: usize, memory: &Memory) -> Vec<State> {
        let width = memory.width;
        let reads = self.reads[index].iter().flatten().map(|names| match names.raw.clone() {
            None => State::Register { name: names.data.clone(), start: Bits::zero(width) },
            Some(raw) => State::GatedRead { name: names.data.clone(), word: raw.word, inside: raw.inside, width },
        });
        let mut all: Vec<State> = reads.collect();
        let is_unknown = memory.contents == Contents::Unknown;
        all.push(State::Memory { name: memory.name.clone(), depth: memory.depth, width, is_unknown });
        all
    }
}
