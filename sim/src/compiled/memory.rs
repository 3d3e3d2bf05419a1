//! Words of memories, read and written by code.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{InstBuilder, Value, types};

use super::function::{Emitter, MemoryAt};
use crate::program::ValueId;

impl Emitter<'_, '_, '_> {
    /// Reads the word at an address, given by its clean limbs, of a lane whose words begin at `base`.
    ///
    /// Every address that fits has a word, and those beyond the depth are zero; only an address wider than the
    /// memory's own is looked at.
    pub(super) fn read(&mut self, id: ValueId, memory: u32, address: &[Value], base: Value) {
        let memory = self.memories[memory as usize];
        let at = self.word(memory, address[0], base);
        let element = (memory.words.word as u32 * 8).min(64);
        self.scalars.load(self.builder, id, memory.width, element, at, 0);
    }

    /// The address of a word.
    fn word(&mut self, memory: MemoryAt, address: Value, base: Value) -> Value {
        let size = self.builder.ins().iconst(types::I64, memory.words.word as i64);
        let within = self.builder.ins().imul(address, size);
        self.builder.ins().iadd(base, within)
    }

    /// Writes a word where the port is enabled and the address within the depth.
    pub(super) fn write(&mut self, memory: u32, enable: ValueId, address: ValueId, data: ValueId, base: Value) {
        let memory = self.memories[memory as usize];
        let writing = self.builder.create_block();
        let done = self.builder.create_block();
        let limbs = self.scalars.clean(self.builder, address);
        let enabled = self.scalars.flag(self.builder, enable);
        let depth = self.builder.ins().iconst(types::I64, i64::from(memory.depth));
        let inside = self.builder.ins().icmp(IntCC::UnsignedLessThan, limbs[0], depth);
        let go = self.builder.ins().band(enabled, inside);
        // What is converted in the branch is not there behind it.
        self.scalars.clean(self.builder, data);
        let at = self.word(memory, limbs[0], base);
        self.builder.ins().brif(go, writing, &[], done, &[]);
        self.builder.switch_to_block(writing);
        let element = (memory.words.word as u32 * 8).min(64);
        self.scalars.store(self.builder, data, element, at, 0);
        self.builder.ins().jump(done, &[]);
        self.builder.switch_to_block(done);
    }
}
