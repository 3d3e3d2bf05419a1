//! The order of a program: the values that are kept, their sequence in storage and in evaluation, and their segments.
//!
//! An operation on which another one depends has no more triggers and no fewer readers. Segments are the sets of
//! operations with equal triggers and readers. Therefore they do not depend on each other cyclically, and sorting by
//! those two gives an order of evaluation.

use std::cmp::Reverse;

use tilewright_circuit::limbs_for;

use super::{Cell, Circuit, Kind, Memory, Program, Readers, Schedule, Segment, Triggers, ValueId};

/// Orders the values of a program for storage and evaluation, each after its operands; unreferenced values are
/// removed.
pub(super) fn schedule(program: &mut Program) {
    assign_to_clocks(program);
    let triggers = triggers(program);
    let readers = readers(program);
    watch(program, &triggers);
    let kept = kept(program);
    let place = |id: ValueId| match program.circuit[id].kind {
        Kind::State => (0, 0, Reverse(0), Triggers::NONE, Readers::NONE),
        Kind::Const(_) => (1, 0, Reverse(0), Triggers::NONE, Readers::NONE),
        _ => {
            let (triggers, readers) = (triggers[id.index()], readers[id.index()]);
            (2, triggers.count(), Reverse(readers.count()), triggers, readers)
        }
    };
    let mut sorted: Vec<ValueId> = program.circuit.ids().filter(|id| kept[id.index()]).collect();
    sorted.sort_by_cached_key(|&id| place(id));
    let mut number = vec![ValueId(u32::MAX); program.circuit.len()];
    sorted.iter().enumerate().for_each(|(new, old)| number[old.index()] = ValueId(new as u32));
    let mut circuit = Circuit::default();
    let mut schedule = Schedule::default();
    for old in sorted {
        let mut cell = program.circuit[old].clone();
        cell.kind.rewrite(|operand| *operand = number[operand.index()]);
        schedule.add(&cell, circuit.len() as u32, (triggers[old.index()], readers[old.index()]));
        circuit.push(cell, program.circuit.loc(old));
    }
    program.rewrite_roots(|value| *value = number[value.index()]);
    program.circuit = circuit;
    program.schedule = schedule;
}

/// Enters into each clock everything that happens at its edges.
pub(crate) fn assign_to_clocks(program: &mut Program) {
    let clocks = &mut program.clocks;
    for clock in clocks.iter_mut() {
        clock.registers.clear();
        clock.asserts.clear();
        clock.reads.clear();
        clock.writes.clear();
    }
    for (index, register) in program.registers.iter().enumerate() {
        clocks[register.clock as usize].registers.push(index as u32);
    }
    for (index, assert) in program.asserts.iter().enumerate() {
        clocks[assert.clock as usize].asserts.push(index as u32);
    }
    for (index, memory) in program.memories.iter().enumerate() {
        for (port, read) in memory.reads.iter().enumerate() {
            clocks[read.clock as usize].reads.push((index as u32, port as u32));
        }
        for (port, write) in memory.writes.iter().enumerate() {
            clocks[write.clock as usize].writes.push((index as u32, port as u32));
        }
    }
}

/// The triggers that can change each cell.
fn triggers(program: &Program) -> Vec<Triggers> {
    let mut all = vec![Triggers::NONE; program.circuit.len()];
    program.inputs.iter().for_each(|port| all[port.value.index()] = port.triggers);
    for register in &program.registers {
        all[register.value.index()] = Triggers::state(register.clock as usize);
    }
    for read in program.memories.iter().flat_map(|memory| &memory.reads) {
        all[read.value.index()] = Triggers::state(read.clock as usize);
    }
    for id in program.circuit.ids() {
        let kind = &program.circuit[id].kind;
        let mut mine = all[id.index()];
        kind.for_each_operand(|operand| mine = mine.with(all[operand.index()]));
        if let Kind::Read { memory, .. } = kind {
            mine = mine.with(written(program, *memory));
        }
        all[id.index()] = mine;
    }
    all
}

/// The triggers of a memory's words.
fn written(program: &Program, memory: u32) -> Triggers {
    let writes = &program.memories[memory as usize].writes;
    writes.iter().fold(Triggers::NONE, |all, write| all.with(Triggers::state(write.clock as usize)))
}

/// The direct and indirect readers of each cell.
fn readers(program: &Program) -> Vec<Readers> {
    let mut all = vec![Readers::NONE; program.circuit.len()];
    let mut add = |id: ValueId, readers| all[id.index()] = all[id.index()].with(readers);
    program.outputs.iter().for_each(|port| add(port.value, Readers::OUTPUT));
    for clock in 0..program.clocks.len() {
        program.sampled(clock, true).into_iter().for_each(|value| add(value, Readers::edge(clock)));
    }
    for id in program.circuit.ids().rev() {
        let mine = all[id.index()];
        program.circuit[id].kind.for_each_operand(|operand| all[operand.index()] = all[operand.index()].with(mine));
    }
    all
}

/// Enters into each clock the triggers that can make its edge have another effect.
fn watch(program: &mut Program, triggers: &[Triggers]) {
    for clock in 0..program.clocks.len() {
        let values = program.sampled(clock, true);
        let seen = values.iter().fold(Triggers::state(clock), |all, value| all.with(triggers[value.index()]));
        program.clocks[clock].triggers = program.clocks[clock].triggers.with(seen);
    }
    for memory in 0..program.memories.len() {
        let written = written(program, memory as u32);
        // A port that repeats the same write must write again after another port has written.
        let Memory { reads, writes, .. } = &program.memories[memory];
        for clock in reads.iter().map(|read| read.clock).chain(writes.iter().map(|write| write.clock)) {
            let clock = &mut program.clocks[clock as usize];
            clock.triggers = clock.triggers.with(written);
        }
    }
}

/// The cells that objects outside the expressions refer to, directly or not.
fn kept(program: &mut Program) -> Vec<bool> {
    let mut kept = vec![false; program.circuit.len()];
    program.rewrite_roots(|value| kept[value.index()] = true);
    for id in program.circuit.ids().rev() {
        if kept[id.index()] {
            program.circuit[id].kind.for_each_operand(|operand| kept[operand.index()] = true);
        }
    }
    kept
}

impl Schedule {
    /// Places the next value.
    fn add(&mut self, cell: &Cell, id: u32, needs: (Triggers, Readers)) {
        let segment = match cell.kind {
            Kind::State | Kind::Const(_) => None,
            _ => Some(self.segment(id, needs)),
        };
        self.slots.push((self.storage, segment));
        self.storage += cell.lanes as usize * limbs_for(cell.width);
        if cell.kind == Kind::State {
            self.state_end = self.storage;
        }
    }

    /// The segment of the value to be added.
    fn segment(&mut self, id: u32, (triggers, readers): (Triggers, Readers)) -> u32 {
        match self.segments.last_mut() {
            Some(last) if (last.triggers, last.readers) == (triggers, readers) => last.values.end = id + 1,
            _ => {
                let needed = |(_, before): &(usize, &Segment)| {
                    before.triggers.within(triggers) && readers.with(before.readers) == before.readers
                };
                let needs = self.segments.iter().enumerate().filter(needed).map(|(i, _)| i as u32).collect();
                self.segments.push(Segment { values: id..id + 1, triggers, readers, needs });
            }
        }
        self.segments.len() as u32 - 1
    }
}
