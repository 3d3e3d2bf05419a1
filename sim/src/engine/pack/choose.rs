//! Selects the lanes that are packed, and their number in a word.
//!
//! Values connected by logic are packed together or not at all. It is worth it if few lanes are packed or unpacked at
//! the borders, because that is done lane by lane.

use rustc_hash::FxHashMap;
use tilewright_circuit::graph::Union;
use tilewright_circuit::ir::ReadUnderWrite;

use super::making::{Making, Shifted, making, repeated, shifted};
use crate::engine::program::{Axis, Cell, Circuit, Kind, Memory, Program, ValueId};

/// The possible numbers of lanes in a word, the largest first.
const WORDS: [u32; 4] = [64, 32, 16, 8];
/// Lanes that are computed at once without being packed.
const AT_ONCE: u32 = 16;
/// The cost of packing or unpacking a lane, in lanes computed one by one.
const LANE_BY_LANE: i64 = 2;
/// The cost of gathering a lane from one of two values.
const GATHERED: i64 = 4;
/// The gain if words with this number of lanes are impossible.
const NEVER: i64 = i64::MIN >> 32;

/// The packed values, with the lanes in a word.
#[derive(Debug, Default)]
pub(super) struct Choice {
    pub values: FxHashMap<ValueId, u32>,
    pub memories: FxHashMap<u32, u32>,
}

/// Chooses what is packed.
pub(super) fn choose(program: &Program) -> Choice {
    let mut groups = Groups::of(program);
    let mut choice = Choice::default();
    let packable = (0..groups.is_packable.len()).filter(|&node| groups.is_packable[node]);
    let mut members = groups.union.sets(packable);
    // Unchanged values must be packed for their users, which may cost the users too much.
    loop {
        let (packed, apart): (Vec<_>, Vec<_>) = members.into_iter().partition(|nodes| groups.best(nodes).is_some());
        apart.iter().flatten().for_each(|&node| groups.is_packable[node] = false);
        members = packed;
        if apart.is_empty() {
            break;
        }
    }
    for nodes in members {
        let best = groups.best(&nodes).expect("it is worth it");
        for node in nodes {
            match node.checked_sub(program.circuit.len()) {
                None => choice.values.insert(ValueId(node as u32), best),
                Some(memory) => choice.memories.insert(memory as u32, best),
            };
        }
    }
    choice
}

/// Values, and after them memories, in groups.
struct Groups<'a> {
    program: &'a Program,
    /// For each value and memory: it can be packed.
    is_packable: Vec<bool>,
    /// The values and memories of each group.
    union: Union,
    /// For each value: an edge needs it.
    is_needed: Vec<bool>,
    /// For each value that can be packed: the needed values that use it; itself, if the user is not a value.
    takers: Vec<Vec<ValueId>>,
}

impl<'a> Groups<'a> {
    fn of(program: &'a Program) -> Groups<'a> {
        let count = program.circuit.len();
        let mut groups = Groups {
            program,
            is_packable: packable(program),
            union: Union::new(count + program.memories.len()),
            is_needed: vec![false; count],
            takers: vec![Vec::new(); count],
        };
        groups.link();
        groups.look();
        groups
    }

    fn is_packable(&self, id: ValueId) -> bool {
        self.is_packable[id.index()]
    }

    /// The index of a memory among values and memories.
    fn node(&self, memory: u32) -> usize {
        self.program.circuit.len() + memory as usize
    }

    /// Merges the groups of two values or memories, if both can be packed.
    fn join(&mut self, a: usize, b: usize) {
        if self.is_packable[a] && self.is_packable[b] {
            self.union.join(a, b);
        }
    }

    /// Makes the groups.
    fn link(&mut self) {
        let Program { circuit, registers, memories, .. } = self.program;
        for (id, cell) in circuit.cells() {
            match cell.kind {
                Kind::Read { memory, .. } => self.join(id.index(), self.node(memory)),
                _ if cell.kind.is_elementwise() || matches!(cell.kind, Kind::Alias(_)) => {
                    cell.kind.for_each_operand(|operand| self.join(id.index(), operand.index()));
                }
                _ => {}
            }
        }
        for register in registers {
            let value = register.value.index();
            [Some(register.next), register.enable].iter().flatten().for_each(|id| self.join(value, id.index()));
        }
        for (index, memory) in (0..).zip(memories) {
            let read = memory.reads.iter().map(|read| read.value);
            let written = memory.writes.iter().flat_map(|write| [write.data, write.enable]);
            read.chain(written).for_each(|id| self.join(self.node(index), id.index()));
        }
    }

    /// Finds the users of what can be packed.
    fn look(&mut self) {
        let program = self.program;
        let roots: Vec<ValueId> = (0..program.clocks.len()).flat_map(|clock| program.sampled(clock, true)).collect();
        for id in program.circuit.needed(roots) {
            self.is_needed[id.index()] = true;
            program.circuit[id].kind.for_each_operand(|operand| {
                if self.is_packable[operand.index()] {
                    self.takers[operand.index()].push(id);
                }
            });
        }
        let conditions = program.asserts.iter().map(|assert| assert.condition);
        let memories = (0..).zip(&program.memories).filter(|(index, _)| !self.is_packable[self.node(*index)]);
        let ports = memories.flat_map(|(_, memory)| {
            let writes = memory.writes.iter().flat_map(|write| [write.enable, write.address, write.data]);
            writes.chain(memory.reads.iter().flat_map(|read| [Some(read.address), read.enable].into_iter().flatten()))
        });
        let registers = program.registers.iter().filter(|register| !self.is_packable(register.value));
        let registers = registers.flat_map(|register| [Some(register.next), register.enable].into_iter().flatten());
        let takes: Vec<ValueId> = conditions.chain(ports).chain(registers).filter(|id| self.is_packable(*id)).collect();
        takes.into_iter().for_each(|id| self.takers[id.index()].push(id));
    }

    /// The lanes of a word with which packing a group gains the most; `None` if there is no gain.
    fn best(&self, nodes: &[usize]) -> Option<u32> {
        let Program { circuit, memories, .. } = self.program;
        let lanes = match nodes[0].checked_sub(circuit.len()) {
            None => circuit[ValueId(nodes[0] as u32)].lanes,
            Some(memory) => memories[memory].lanes,
        };
        let words = WORDS.into_iter().chain([lanes]).filter(|&word| word <= lanes.min(WORDS[0]));
        let (gain, best) = words.map(|lanes| (self.gain(nodes, lanes), lanes)).max()?;
        (gain > 0).then_some(best)
    }

    /// The gain of packing a group, in lanes that are not computed.
    fn gain(&self, nodes: &[usize], lanes: u32) -> i64 {
        nodes.iter().map(|&node| self.gain_of(node, lanes)).sum()
    }

    fn gain_of(&self, node: usize, lanes: u32) -> i64 {
        let circuit = &self.program.circuit;
        if let Some(memory) = node.checked_sub(circuit.len()) {
            let memory = &self.program.memories[memory];
            let mut ports =
                memory.writes.iter().map(|write| write.address).chain(
                    memory.reads.iter().flat_map(|read| [Some(read.address), read.enable].into_iter().flatten()),
                );
            let is_same = |id: ValueId| repeated(circuit, id, lanes).is_some() || circuit.constant(id).is_some();
            let fits = memory.lanes.is_multiple_of(lanes) && ports.all(is_same);
            return if fits { i64::from(memory.lanes.div_ceil(AT_ONCE)) } else { NEVER };
        }
        let id = ValueId(node as u32);
        let all = i64::from(circuit[id].lanes);
        let made = match making(circuit, id, lanes) {
            // A value that is only observed is packed if that costs nothing.
            Some(_) if !self.is_needed[node] => i64::from(self.packed_operands(id, lanes) == 0),
            None if matches!(circuit[id].kind, Kind::Read { .. }) => NEVER,
            None if !self.is_needed[node] => 0,
            // They would be gathered by a table.
            Some(Making::Alternating) => GATHERED * all - self.packed_operands(id, lanes),
            Some(_) => i64::from(circuit[id].lanes.div_ceil(AT_ONCE)) - self.packed_operands(id, lanes),
            None if all % i64::from(lanes) == 0 => -LANE_BY_LANE * all,
            None => NEVER,
        };
        let is_unpacked = self.takers[node].iter().any(|&by| !self.takes_words(by, id, lanes));
        // All lanes read the one word of a row at once.
        let unpacking = if all == i64::from(lanes) { all } else { LANE_BY_LANE * all };
        made - if is_unpacked { unpacking } else { 0 }
    }

    /// The cost of packing the operands of an operation that belong to no group.
    fn packed_operands(&self, id: ValueId, lanes: u32) -> i64 {
        let (circuit, mut cost) = (&self.program.circuit, 0);
        circuit[id].kind.for_each_operand(|operand| {
            let cell = &circuit[operand];
            let is_word = cell.width > 1
                || is_taken_apart(&circuit[id].kind, operand)
                || cell.lanes == 1
                || matches!(
                    making(circuit, operand, lanes),
                    Some(Making::Constant | Making::Known | Making::Repeated { .. })
                );
            if !self.is_packable(operand) && !is_word {
                cost += LANE_BY_LANE * i64::from(cell.lanes);
            }
        });
        cost
    }

    /// Whether the user of a value can use its words.
    fn takes_words(&self, by: ValueId, of: ValueId, lanes: u32) -> bool {
        let circuit = &self.program.circuit;
        match circuit[by].kind {
            _ if by == of => false,
            ref kind if is_taken_apart(kind, of) => false,
            Kind::Pack { axis: Axis { count, inner: 1 }, .. } | Kind::Reduce { axis: Axis { count, inner: 1 }, .. } => {
                count.is_multiple_of(lanes)
            }
            // Few of many lanes remain.
            Kind::Lane { .. } => true,
            _ => self.is_packable(by) && making(circuit, by, lanes).is_some(),
        }
    }
}

/// Whether an operation that moves lanes uses a single lane of an operand for each word: the value at the edge.
fn is_taken_apart(kind: &Kind, operand: ValueId) -> bool {
    matches!(shifted(kind), Some(Shifted { edge, .. }) if edge == operand)
}

/// For each value, and then for each memory: whether its lanes, one bit each, can be packed.
fn packable(program: &Program) -> Vec<bool> {
    let Program { circuit, passes, .. } = program;
    let are_enough = |lanes: u32| lanes >= passes.pack_from.max(2);
    let is_packable = |memory: &Memory| are_enough(memory.lanes) && is_packable_memory(circuit, memory);
    let memories: Vec<bool> = program.memories.iter().map(is_packable).collect();
    let read = program.memories.iter().zip(&memories).filter(|(_, is_packable)| **is_packable);
    let mut is_state = vec![false; circuit.len()];
    read.flat_map(|(memory, _)| &memory.reads).for_each(|read| is_state[read.value.index()] = true);
    program.registers.iter().for_each(|register| is_state[register.value.index()] = true);
    let is_packable = |(id, cell): (ValueId, &Cell)| {
        cell.width == 1
            && are_enough(cell.lanes)
            && match cell.kind {
                Kind::State => is_state[id.index()],
                Kind::Read { memory, .. } => memories[memory as usize],
                // Its users repeat it in each word.
                Kind::Const(_) | Kind::Broadcast { axis: Axis { inner: 1, .. }, .. } => false,
                _ => true,
            }
    };
    circuit.cells().map(is_packable).chain(memories.iter().copied()).collect()
}

/// Whether a memory has one bit a lane, the same address for all of them, and at most one write. If a read during a
/// write is undefined, only written lanes may show it.
fn is_packable_memory(circuit: &Circuit, memory: &Memory) -> bool {
    let is_same = |id: ValueId| repeated(circuit, id, 1).is_some() || circuit.constant(id).is_some();
    let is_written_alike = memory.writes.iter().all(|write| is_same(write.enable));
    memory.width == 1
        && memory.writes.len() <= 1
        && memory.writes.iter().all(|write| is_same(write.address))
        && memory.reads.iter().all(|read| is_same(read.address) && read.enable.is_none_or(is_same))
        && (is_written_alike || memory.reads.is_empty() || memory.policy == ReadUnderWrite::Old)
}
