//! Where Verilog needs a name: bits can only be taken of names, another lane is read by its net's name, and a
//! constant in a condition would be optimised away.

use super::{Form, Planner};
use crate::verilog::order::for_each_read;
use tilewright_circuit::ir::{Node, NodeId, Op};

impl Planner<'_> {
    /// A value that is read in another lane, or more than once, gets a name; but a plain expression may be printed in
    /// the one lane to which it is broadcast.
    pub(super) fn name_lane_operand(&mut self, id: NodeId, of: NodeId) {
        let end = self.end_of_places(of);
        let is_broadcast = matches!(self.module.node(id).op, Op::Broadcast { .. });
        let may_stand = is_broadcast && self.module.shape(end).is_plain() && self.uses[id.0 as usize] <= 1;
        if self.form(end) == Form::Constants && !is_broadcast {
            self.set(end, Form::Net);
        }
        if self.form(end) == Form::Inline && !is_place(&self.module.node(end).op) && !may_stand {
            self.set(end, Form::Net);
        }
    }

    /// Makes nets of the constants that an expression reads: it is in a scope of another shape, from which no tool
    /// finds their parameter.
    pub(super) fn name_constants(&mut self, of: NodeId) {
        let mut stack = vec![of];
        while let Some(read) = stack.pop() {
            match self.form(read) {
                Form::Constants => self.set(read, Form::Net),
                Form::Inline => for_each_read(self.module, read, |read| stack.push(read)),
                _ => {}
            }
        }
    }

    /// The operand behind all operators that only name a place.
    fn end_of_places(&self, of: NodeId) -> NodeId {
        let mut end = of;
        while let Op::Broadcast { of: inner, .. }
        | Op::Lane { of: inner, .. }
        | Op::Unpack { of: inner, .. }
        | Op::Map { of: inner, edge: None, .. } = self.module.node(end).op
            && self.form(end) == Form::Inline
        {
            end = inner;
        }
        end
    }

    /// Rows side by side of columns side by side need no name for the columns.
    pub(super) fn join_packs(&mut self, id: NodeId) {
        if let Op::Pack { of, .. } = self.module.node(id).op
            && let Node { op: Op::Pack { .. }, name: None, .. } = self.module.node(of)
            && self.uses[of.0 as usize] == 1
        {
            self.set(of, Form::Inline);
        }
    }

    /// The lanes of wide words are written one by one, so mask and data have names.
    pub(super) fn find_mask_nets(&mut self) {
        let module = self.module;
        for memory in &module.memories {
            let masked = |enable: NodeId| module.width(enable) > 1;
            let is_masked = memory.writes.iter().any(|write| masked(write.enable));
            let writes = memory.writes.iter().filter(|_| is_masked);
            let writes = writes.flat_map(|write| [Some(write.data), Some(write.enable).filter(|&id| masked(id))]);
            let reads = memory.reads.iter().map(|read| read.enable.filter(|&id| masked(id)));
            for id in writes.chain(reads).flatten() {
                if self.form(id) == Form::Inline {
                    self.set(id, Form::Net);
                }
            }
        }
    }

    /// A computed address becomes a net: Icarus does not truncate an expression in an index to its width.
    pub(super) fn find_address_nets(&mut self) {
        for memory in &self.module.memories {
            let reads = memory.reads.iter().map(|read| read.address);
            for mut address in reads.chain(memory.writes.iter().map(|write| write.address)) {
                // Of lanes that share an address, each has the expression.
                while let (Op::Broadcast { of, .. }, Form::Inline) = (&self.module.node(address).op, self.form(address))
                {
                    address = *of;
                }
                let op = &self.module.node(address).op;
                let plain = is_place(op) || matches!(op, Op::Slice { .. } | Op::Concat(_));
                // Yosys makes registers of a memory with a constant address.
                if self.form(address) == Form::Inline && !plain || self.form(address) == Form::Constants {
                    self.set(address, Form::Net);
                }
            }
        }
        // A port that is never enabled would have no driver if that were a constant.
        let module = self.module;
        let enables = module.registers.iter().filter_map(|register| register.enable);
        let reads = module.memories.iter().flat_map(|memory| memory.reads.iter().filter_map(|read| read.enable));
        let writes = module.memories.iter().flat_map(|memory| memory.writes.iter().map(|write| write.enable));
        enables.chain(reads).chain(writes).for_each(|enable| self.keep_constants(vec![enable]));
    }

    /// If expressions read only constants of the lanes, makes nets of those: no tool optimises them away.
    pub(super) fn keep_constants(&mut self, mut stack: Vec<NodeId>) {
        let mut constants = Vec::new();
        while let Some(read) = stack.pop() {
            match self.form(read) {
                Form::Constants => constants.push(read),
                Form::Inline | Form::Branches => for_each_read(self.module, read, |read| stack.push(read)),
                _ => return,
            }
        }
        constants.into_iter().for_each(|id| self.set(id, Form::Net));
    }

    /// Makes a net of the subject of a `case` that reads other lanes: Yosys needs its width before it has made the
    /// lanes after this one.
    pub(super) fn name_subject(&mut self, subject: NodeId) {
        let mut stack = vec![subject];
        while let Some(read) = stack.pop() {
            if self.form(read) != Form::Inline {
                continue;
            }
            if matches!(self.module.node(read).op, Op::Map { .. }) {
                return self.set(subject, Form::Net);
            }
            for_each_read(self.module, read, |read| stack.push(read));
        }
    }

    /// The operand that a node needs a name for: Verilog takes bits of names only.
    pub(super) fn must_be_net(&self, id: NodeId) -> Option<NodeId> {
        let module = self.module;
        let op = |of: NodeId| &module.node(of).op;
        let of = match *op(id) {
            Op::Slice { of, .. } | Op::Wire(of) | Op::QuasiStatic(of, _) => Some(of),
            Op::Extend { of, signed: true } if module.width(of) > 1 => {
                Some(of).filter(|&of| !matches!(op(of), Op::Slice { .. }))
            }
            _ => None,
        };
        let of = of.map(|of| self.end_of_places(of));
        let of = of.filter(|&of| !is_place(op(of)) || self.form(of) == Form::Constants);
        of.filter(|&of| matches!(self.form(of), Form::Inline | Form::Constants))
    }
}

/// Whether an operator without a name only names a lane of its operand: it costs nothing wherever it is used.
pub fn is_place(op: &Op) -> bool {
    matches!(op, Op::Const(_) | Op::Broadcast { .. } | Op::Lane { .. } | Op::Unpack { .. } | Op::Map { edge: None, .. })
}

/// The operands that are printed in scopes of another shape, unchanged.
pub(super) fn lists(op: &Op) -> Vec<NodeId> {
    match op {
        Op::Stack { parts, .. } => parts.clone(),
        Op::Map { edge, .. } => edge.iter().copied().collect(),
        _ => Vec::new(),
    }
}

/// The operands that a lane operation reads in another lane than its own, or more than once.
pub(super) fn lane_operands(op: &Op) -> Vec<NodeId> {
    match op {
        Op::Broadcast { of, .. } | Op::Lane { of, .. } | Op::Unpack { of, .. } => vec![*of],
        Op::Map { of, .. } | Op::Reduce { of, .. } | Op::Pack { of, .. } => vec![*of],
        Op::Pick { of, index, .. } => vec![*of, *index],
        Op::Interleave { parts, .. } => parts.clone(),
        _ => Vec::new(),
    }
}
