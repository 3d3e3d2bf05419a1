//! The values that something outside the expressions refers to.

use super::{Program, ValueId};

impl Program {
    /// Calls `visit` with every reference from outside the cells, which it may replace: ports, registers, memories,
    /// asserts and names.
    pub(crate) fn rewrite_roots(&mut self, mut visit: impl FnMut(&mut ValueId)) {
        self.rewrite_sinks(&mut visit);
        self.inputs.iter_mut().for_each(|port| visit(&mut port.value));
        self.registers.iter_mut().for_each(|register| visit(&mut register.value));
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
}
