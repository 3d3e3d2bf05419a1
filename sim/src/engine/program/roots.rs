//! The values that objects outside the expressions refer to.

use super::{Clock, Program, Register, ValueId};

impl Program {
    /// Calls `visit` with every reference from outside the cells, which it may replace: ports, registers, memories,
    /// properties and names.
    pub(crate) fn rewrite_roots(&mut self, mut visit: impl FnMut(&mut ValueId)) {
        self.rewrite_sinks(&mut visit);
        self.inputs.iter_mut().for_each(|port| visit(&mut port.value));
        self.registers.iter_mut().for_each(|register| visit(&mut register.value));
        self.covers.iter_mut().for_each(|cover| visit(&mut cover.counter));
        for display in &mut self.displays {
            visit(&mut display.condition);
            display.values.iter_mut().for_each(|(value, _)| visit(value));
        }
        self.memories.iter_mut().flat_map(|memory| &mut memory.reads).for_each(|read| visit(&mut read.value));
        for scope in &mut self.hierarchy.scopes {
            scope.signals.iter_mut().for_each(|signal| visit(&mut signal.value));
        }
    }

    /// Calls `visit` with every value that an edge samples or an output port shows.
    fn rewrite_sinks(&mut self, mut visit: impl FnMut(&mut ValueId)) {
        self.outputs.iter_mut().for_each(|port| visit(&mut port.value));
        for register in &mut self.registers {
            visit(&mut register.next);
            register.enable.iter_mut().for_each(&mut visit);
        }
        for memory in &mut self.memories {
            for read in &mut memory.reads {
                visit(&mut read.address);
                read.enable.iter_mut().for_each(&mut visit);
            }
            for write in &mut memory.writes {
                [&mut write.enable, &mut write.address, &mut write.data].into_iter().for_each(&mut visit);
            }
        }
        self.asserts.iter_mut().for_each(|assert| visit(&mut assert.condition));
    }

    /// The values that an edge of a clock samples: for registers, read ports and write ports, and for assertions if
    /// requested.
    pub(crate) fn sampled(&self, clock: usize, with_asserts: bool) -> Vec<ValueId> {
        self.sampled_but_by(clock, with_asserts, |_| false)
    }

    /// The same, without values that only these registers sample.
    pub(crate) fn sampled_but_by(
        &self,
        clock: usize,
        with_asserts: bool,
        is_left_out: impl Fn(&Register) -> bool,
    ) -> Vec<ValueId> {
        let Clock { registers, reads, writes, asserts, .. } = &self.clocks[clock];
        let mut all = Vec::new();
        let registers = registers.iter().map(|&index| &self.registers[index as usize]);
        for register in registers.filter(|register| !is_left_out(register)) {
            all.extend([Some(register.next), register.enable].into_iter().flatten());
        }
        for read in reads.iter().map(|&(memory, port)| &self.memories[memory as usize].reads[port as usize]) {
            all.extend([Some(read.address), read.enable].into_iter().flatten());
        }
        for write in writes.iter().map(|&(memory, port)| &self.memories[memory as usize].writes[port as usize]) {
            all.extend([write.enable, write.address, write.data]);
        }
        if with_asserts {
            all.extend(asserts.iter().map(|&index| self.asserts[index as usize].condition));
        }
        all
    }
}
