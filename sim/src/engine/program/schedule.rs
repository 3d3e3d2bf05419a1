//! From a netlist to a program: which values are kept, in what order they are stored and computed, and in which
//! segments.
//!
//! An operation that another one depends on has no more triggers and no fewer readers. Therefore segments, which are
//! the sets of operations of equal triggers and readers, do not depend on each other in a circle, and sorting by
//! those two gives an order of evaluation.

use std::cmp::Reverse;

use tilewright_hdl::limbs_for;

use super::netlist::Netlist;
use super::order::order;
use super::{Kind, Memory, Operation, Program, Readers, Segment, Triggers, Value, ValueId};
use crate::engine::Passes;

/// Schedules a netlist without cycles.
pub(super) fn schedule(mut netlist: Netlist, passes: &Passes) -> Program {
    let order = order(&netlist).expect("cycles were found before");
    assign_to_clocks(&mut netlist);
    let triggers = triggers(&netlist, &order);
    let readers = readers(&netlist, &order);
    watch(&mut netlist, &triggers);
    let kept = kept(&mut netlist, &order);
    let place = |id: ValueId| match netlist.cell(id).kind {
        Kind::State => (0, 0, Reverse(0), Triggers::NONE, Readers::NONE),
        Kind::Const(_) => (1, 0, Reverse(0), Triggers::NONE, Readers::NONE),
        _ => {
            let (triggers, readers) = (triggers[id.index()], readers[id.index()]);
            (2, triggers.count(), Reverse(readers.count()), triggers, readers)
        }
    };
    let mut sorted: Vec<ValueId> = order.into_iter().filter(|id| kept[id.index()]).collect();
    sorted.sort_by_key(|&id| place(id));
    let mut number = vec![ValueId(u32::MAX); netlist.cells.len()];
    sorted.iter().enumerate().for_each(|(new, old)| number[old.index()] = ValueId(new as u32));
    let shape = |id: &ValueId| (triggers[id.index()], readers[id.index()]);
    let mut layout = Layout::default();
    for old in &sorted {
        layout.add(&mut netlist, *old, shape(old), &number);
    }
    netlist.rewrite_roots(|value| *value = number[value.index()]);
    layout.finish(netlist, passes)
}

/// Enters into each clock what happens at its edges.
fn assign_to_clocks(netlist: &mut Netlist) {
    let clocks = &mut netlist.clocks;
    for (index, register) in netlist.registers.iter().enumerate() {
        clocks[register.clock as usize].registers.push(index as u32);
    }
    for (index, assert) in netlist.asserts.iter().enumerate() {
        clocks[assert.clock as usize].asserts.push(index as u32);
    }
    for (index, memory) in netlist.memories.iter().enumerate() {
        for (port, read) in memory.reads.iter().enumerate() {
            clocks[read.clock as usize].reads.push((index as u32, port as u32));
        }
        for (port, write) in memory.writes.iter().enumerate() {
            clocks[write.clock as usize].writes.push((index as u32, port as u32));
        }
    }
}

/// What can change each cell.
fn triggers(netlist: &Netlist, order: &[ValueId]) -> Vec<Triggers> {
    let mut all = vec![Triggers::NONE; netlist.cells.len()];
    netlist.inputs.iter().for_each(|port| all[port.value.index()] = port.triggers);
    for register in &netlist.registers {
        all[register.value.index()] = Triggers::state(register.clock as usize);
    }
    for read in netlist.memories.iter().flat_map(|memory| &memory.reads) {
        all[read.value.index()] = Triggers::state(read.clock as usize);
    }
    for &id in order {
        let kind = &netlist.cell(id).kind;
        let mut mine = all[id.index()];
        kind.for_each_operand(|operand| mine = mine.with(all[operand.index()]));
        if let Kind::Read { memory, .. } = kind {
            mine = mine.with(written(netlist, *memory));
        }
        all[id.index()] = mine;
    }
    all
}

/// The triggers of a memory's words.
fn written(netlist: &Netlist, memory: u32) -> Triggers {
    let writes = &netlist.memories[memory as usize].writes;
    writes.iter().fold(Triggers::NONE, |all, write| all.with(Triggers::state(write.clock as usize)))
}

/// Who needs each cell, directly or not.
fn readers(netlist: &Netlist, order: &[ValueId]) -> Vec<Readers> {
    let mut all = vec![Readers::NONE; netlist.cells.len()];
    let mut add = |id: ValueId, readers| all[id.index()] = all[id.index()].with(readers);
    netlist.outputs.iter().for_each(|port| add(port.value, Readers::OUTPUT));
    for (clock, values) in sampled(netlist) {
        values.into_iter().for_each(|value| add(value, Readers::edge(clock)));
    }
    for &id in order.iter().rev() {
        let mine = all[id.index()];
        netlist.cell(id).kind.for_each_operand(|operand| all[operand.index()] = all[operand.index()].with(mine));
    }
    all
}

/// What the edges of each clock sample: registers, read ports, write ports, asserts.
fn sampled(netlist: &Netlist) -> Vec<(usize, Vec<ValueId>)> {
    let registers = netlist.registers.iter().map(|register| {
        (register.clock as usize, [Some(register.next), register.enable].into_iter().flatten().collect())
    });
    let reads = netlist
        .memories
        .iter()
        .flat_map(|memory| &memory.reads)
        .map(|read| (read.clock as usize, [Some(read.address), read.enable].into_iter().flatten().collect()));
    let writes = netlist
        .memories
        .iter()
        .flat_map(|memory| &memory.writes)
        .map(|write| (write.clock as usize, vec![write.enable, write.address, write.data]));
    let asserts = netlist.asserts.iter().map(|assert| (assert.clock as usize, vec![assert.condition]));
    registers.chain(reads).chain(writes).chain(asserts).collect()
}

/// Enters into each clock what can make its edge do something else.
fn watch(netlist: &mut Netlist, triggers: &[Triggers]) {
    for (clock, values) in sampled(netlist) {
        let seen = values.iter().fold(Triggers::state(clock), |all, value| all.with(triggers[value.index()]));
        netlist.clocks[clock].triggers = netlist.clocks[clock].triggers.with(seen);
    }
    for memory in 0..netlist.memories.len() {
        let written = written(netlist, memory as u32);
        // Who writes the same again and again has to do so after somebody else has.
        let Memory { reads, writes, .. } = &netlist.memories[memory];
        for clock in reads.iter().map(|read| read.clock).chain(writes.iter().map(|write| write.clock)) {
            let clock = &mut netlist.clocks[clock as usize];
            clock.triggers = clock.triggers.with(written);
        }
    }
}

/// The cells that something outside the expressions refers to, directly or not.
fn kept(netlist: &mut Netlist, order: &[ValueId]) -> Vec<bool> {
    let mut kept = vec![false; netlist.cells.len()];
    netlist.rewrite_roots(|value| kept[value.index()] = true);
    for &id in order.iter().rev() {
        if kept[id.index()] {
            netlist.cell(id).kind.for_each_operand(|operand| kept[operand.index()] = true);
        }
    }
    kept
}

/// The values and operations of the program as they are laid out.
#[derive(Default)]
struct Layout {
    values: Vec<Value>,
    storage: usize,
    state_end: usize,
    constants: Vec<(ValueId, tilewright_hdl::Bits)>,
    operations: Vec<Operation>,
    segments: Vec<Segment>,
}

impl Layout {
    fn add(&mut self, netlist: &mut Netlist, old: ValueId, shape: (Triggers, Readers), number: &[ValueId]) {
        let result = ValueId(self.values.len() as u32);
        let cell = &mut netlist.cells[old.index()];
        let mut kind = std::mem::replace(&mut cell.kind, Kind::State);
        let (lanes, width) = (cell.lanes, cell.width);
        let segment = match kind {
            Kind::State => None,
            Kind::Const(bits) => {
                self.constants.push((result, bits));
                None
            }
            _ => {
                kind.rewrite(|operand| *operand = number[operand.index()]);
                self.operations.push(Operation { result, kind });
                Some(self.segment(shape))
            }
        };
        self.values.push(Value { lanes, width, offset: self.storage, segment });
        self.storage += lanes as usize * limbs_for(width);
        if self.constants.is_empty() && self.operations.is_empty() {
            self.state_end = self.storage;
        }
    }

    /// The segment of the operation just added.
    fn segment(&mut self, (triggers, readers): (Triggers, Readers)) -> u32 {
        let end = self.operations.len();
        match self.segments.last_mut() {
            Some(last) if (last.triggers, last.readers) == (triggers, readers) => last.operations.end = end,
            _ => {
                let needed = |(_, before): &(usize, &Segment)| {
                    before.triggers.within(triggers) && readers.with(before.readers) == before.readers
                };
                let needs = self.segments.iter().enumerate().filter(needed).map(|(i, _)| i as u32).collect();
                self.segments.push(Segment { operations: end - 1..end, triggers, readers, needs });
            }
        }
        self.segments.len() as u32 - 1
    }

    fn finish(self, netlist: Netlist, passes: &Passes) -> Program {
        Program {
            values: self.values,
            storage: self.storage,
            state_end: self.state_end,
            constants: self.constants,
            operations: self.operations,
            segments: self.segments,
            clocks: netlist.clocks,
            inputs: netlist.inputs,
            outputs: netlist.outputs,
            registers: netlist.registers,
            memories: netlist.memories,
            asserts: netlist.asserts,
            hierarchy: netlist.hierarchy,
            passes: passes.clone(),
        }
    }
}
