//! Memories that some tool would break into registers or complain about.

use super::Fold;
use super::Outcome::{self, Op as Is};
use crate::verilog::reads::constant_address;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Contents, MemoryId, Node, NodeId, Op};

impl Fold {
    /// The bit that all lanes of a mask have, if they have one; otherwise the mask.
    fn one_for_all(&mut self, mask: NodeId) -> NodeId {
        let node = self.module.node(mask);
        match &node.op {
            Op::Repeat(bit, _) if self.module.width(*bit) == 1 => *bit,
            Op::Const(value) if value.not().is_zero() && value.width() > 1 => {
                let bit = Node { op: Op::Const(Bits::ones(1)), width: 1, ..node.clone() };
                self.module.nodes.push(bit);
                NodeId(self.module.nodes.len() as u32 - 1)
            }
            _ => mask,
        }
    }

    /// A word that is always beyond the last one is zero.
    pub(super) fn word(&self, id: MemoryId, port: u32) -> Outcome {
        let memory = &self.module.memories[id.0 as usize];
        let read = &memory.reads[port as usize];
        let address = constant_address(&self.module, self.stands_for(read.address));
        match address {
            Some(address) if read.clock.is_none() && address >= memory.depth.into() => {
                Is(Op::Const(Bits::zero(memory.width)))
            }
            _ => Is(Op::Read(id, port)),
        }
    }

    /// Removes writes that never happen. A memory that is never written is zero, not undriven. A constant write
    /// address gets a net, because Yosys makes registers of a memory with a literal one.
    pub(super) fn settle_memories(&mut self) {
        for index in 0..self.module.memories.len() {
            let mut memory = self.module.memories[index].clone();
            let depth = u64::from(memory.depth);
            memory.writes.retain(|write| {
                let address = self.constant(write.address);
                let never = self.constant(write.enable).is_some_and(|enable| enable.is_zero());
                !never && address.is_none_or(|address| address.to_u64().is_some_and(|address| address < depth))
            });
            // A mask with the same bit in every lane is not a mask.
            memory.reads.iter_mut().for_each(|read| read.enable = read.enable.map(|id| self.one_for_all(id)));
            memory.writes.iter_mut().for_each(|write| write.enable = self.one_for_all(write.enable));
            for write in &mut memory.writes {
                let address = self.module.node(write.address);
                if matches!(address.op, Op::Const(_)) && address.name.is_none() {
                    let node = Node { op: Op::Wire(write.address), ..address.clone() };
                    write.address = NodeId(self.module.nodes.len() as u32);
                    self.module.nodes.push(node);
                }
            }
            if memory.writes.is_empty() && memory.contents == Contents::Unknown {
                memory.contents = Contents::Fill(Bits::zero(memory.width));
            }
            self.module.memories[index] = memory;
        }
    }
}
