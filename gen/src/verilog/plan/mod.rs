//! Decides how each node of a module appears in the text: inline where it is used, as a net of its own, as branches
//! of an always block, or not at all.

mod needs;

use super::fold::Folded;
use super::lane_values::lane_constants;
use super::order::{for_each_read, operands_first};
pub use needs::is_place;
use needs::{lane_operands, lists};
use tilewright_circuit::ir::{Binary, Module, Node, NodeId, Op, Property, Shift, Unary};

/// Longer expressions, in columns, are split.
const LONGEST: usize = 84;
/// The assumed length of a generated name, in columns, before names are given.
const NAME: usize = 16;
/// The deepest nesting of branches of an always block.
const DEEPEST: u32 = 4;

/// A net with a choice of more conditions is split: Yosys takes time quadratic in those of one `always @*`. A
/// register is never split.
pub const MOST_ARMS: usize = 64;

/// If more parts are taken from vectors, a block is used instead of an assignment: Icarus takes time quadratic in the
/// parts that assignments take from one vector.
const MOST_SLICES: usize = 128;

/// The most keys of a `case`: Verilator takes time quadratic in their number.
pub const MOST_KEYS: usize = 256;

/// How a node appears.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// Not at all.
    Dead,
    /// By a name that is declared otherwise than as a net: a port, a register, an instance's output.
    Declared,
    /// As its expression, wherever it is used.
    Inline,
    /// As branches in the always block of its register or net.
    Branches,
    /// As a net with a continuous assignment.
    Net,
    /// As a net that an `always @*` block computes.
    Block,
    /// As constants of the lanes: a formula or a table, read in the lane.
    Constants,
}

/// The decision for each node, by id.
pub struct Plan(Vec<Form>);

impl Plan {
    /// Decides for a folded module with its reset values.
    pub fn new(folded: &Folded) -> Plan {
        let Folded { module, resets, beyond } = folded;
        let order = operands_first(module);
        let mut planner =
            Planner { module, form: vec![Form::Dead; module.nodes.len()], uses: vec![0; module.nodes.len()] };
        planner.find_live(&order, resets, beyond);
        planner.find_nets(&order);
        planner.find_branches(&order);
        planner.split_long(&order);
        Plan(planner.form)
    }

    /// How a node appears.
    pub fn form(&self, id: NodeId) -> Form {
        self.0[id.0 as usize]
    }

    /// Whether a node is a net with a declaration among the nets.
    pub fn is_net(&self, id: NodeId) -> bool {
        matches!(self.form(id), Form::Net | Form::Block)
    }
}

/// Calls `visit` with every node from which a register, memory, instance, port or property takes its value, as often
/// as the text names it.
pub fn for_each_root(module: &Module, beyond: &[Vec<bool>], mut visit: impl FnMut(NodeId)) {
    for register in &module.registers {
        register.enable.iter().for_each(|&id| visit(id));
        visit(register.next);
    }
    for (memory, beyond) in module.memories.iter().zip(beyond) {
        for (read, beyond) in memory.reads.iter().zip(beyond) {
            read.enable.iter().for_each(|&id| visit(id));
            visit(read.address);
            if *beyond {
                visit(read.address);
            }
        }
        for write in &memory.writes {
            [write.enable, write.address, write.data].into_iter().for_each(&mut visit);
        }
    }
    module.instances.iter().flat_map(|instance| &instance.inputs).for_each(|&id| visit(id));
    module.outputs.iter().for_each(|output| visit(output.node));
    module.properties.iter().flat_map(Property::nodes).for_each(visit);
}

struct Planner<'a> {
    module: &'a Module,
    form: Vec<Form>,
    uses: Vec<u32>,
}

impl Planner<'_> {
    fn form(&self, id: NodeId) -> Form {
        self.form[id.0 as usize]
    }

    fn set(&mut self, id: NodeId, form: Form) {
        self.form[id.0 as usize] = form;
    }

    /// Counts uses from printed objects; every named node is printed.
    fn find_live(&mut self, order: &[NodeId], resets: &[Option<NodeId>], beyond: &[Vec<bool>]) {
        let module = self.module;
        for_each_root(module, beyond, |id| self.uses[id.0 as usize] += 1);
        resets.iter().flatten().for_each(|id| self.uses[id.0 as usize] += 1);
        let mut live: Vec<NodeId> = order.iter().copied().rev().filter(|&id| self.is_root(id)).collect();
        live.reverse();
        // With chains of lanes, a user of a node may come before it in any sequence.
        while let Some(id) = live.pop() {
            if self.form(id) != Form::Dead {
                continue;
            }
            self.set(id, self.first_form(id));
            // A formula or a table does not name its operands.
            let is_list = matches!(module.node(id).op, Op::Stack { .. } | Op::Broadcast { .. });
            if is_list && lane_constants(module, id).is_some() {
                continue;
            }
            module.node(id).op.for_each_operand(|operand| {
                self.uses[operand.0 as usize] += 1;
                live.push(operand);
            });
        }
    }

    fn is_root(&self, id: NodeId) -> bool {
        self.uses[id.0 as usize] > 0 || self.module.node(id).name.is_some()
    }

    fn first_form(&self, id: NodeId) -> Form {
        let node = self.module.node(id);
        match &node.op {
            Op::Input(_) | Op::Register(_) | Op::Output(..) => Form::Declared,
            Op::Read(memory, port) => {
                let read = &self.module.memories[memory.0 as usize].reads[*port as usize];
                if read.clock.is_none() { Form::Net } else { Form::Declared }
            }
            Op::Reduce { .. } | Op::Pick { .. } | Op::Pack { .. } | Op::Wire(_) => Form::Net,
            Op::Interleave { .. } | Op::Map { edge: Some(_), .. } => Form::Net,
            Op::Stack { .. } | Op::Broadcast { .. }
                if node.name.is_none() && lane_constants(self.module, id).is_some() =>
            {
                Form::Constants
            }
            Op::Stack { .. } => Form::Net,
            _ if node.name.is_some() => Form::Net,
            Op::Binary(Binary::MulSigned, ..) | Op::Shift(Shift::RightSigned, ..) => Form::Net,
            _ => Form::Inline,
        }
    }

    /// An inline node becomes a net if Verilog needs a name, or if it is used twice and worth one.
    fn find_nets(&mut self, order: &[NodeId]) {
        for &id in order {
            if self.form(id) == Form::Inline && self.uses[id.0 as usize] > 1 && !self.is_trivial(id) {
                self.set(id, Form::Net);
            }
            if self.form(id) == Form::Dead {
                continue;
            }
            if let Some(of) = self.must_be_net(id) {
                self.set(of, Form::Net);
            }
            for of in lane_operands(&self.module.node(id).op) {
                self.name_lane_operand(id, of);
            }
            // Linters complain about a lane that is shifted by its width or more.
            if let Op::Shift(_, _, amount) = self.module.node(id).op {
                self.keep_constants(vec![amount]);
            }
            for of in lists(&self.module.node(id).op) {
                self.name_constants(of);
            }
            self.join_packs(id);
        }
        self.find_address_nets();
        self.find_mask_nets();
    }

    /// Whether a node's expression is as readable as a name for it.
    fn is_trivial(&self, id: NodeId) -> bool {
        let declared = |id: NodeId| matches!(self.form(id), Form::Declared | Form::Net | Form::Block);
        match &self.module.node(id).op {
            Op::Slice { .. } => true,
            op if is_place(op) => true,
            Op::Unary(Unary::Not, a) | Op::Extend { of: a, signed: false } => declared(*a),
            _ => false,
        }
    }

    /// Selects become branches: of their register, or else of an `always @*` block.
    fn find_branches(&mut self, order: &[NodeId]) {
        let module = self.module;
        for register in &module.registers {
            self.branch(register.next, DEEPEST, usize::MAX);
        }
        for &id in order.iter().rev() {
            let wants_block = match (self.form(id), &module.node(id).op) {
                (Form::Inline | Form::Net, Op::Select { .. } | Op::Case { .. }) => true,
                (Form::Net, Op::Mux { .. }) => self.is_chain(id),
                (Form::Inline | Form::Net, Op::Concat(parts)) => self.is_of_many_bits(parts),
                _ => false,
            };
            if wants_block {
                self.set(id, Form::Block);
                self.branch_operands(id, DEEPEST, MOST_ARMS);
                // A block that reads only constants never runs; a net has a first value.
                let mut reads = Vec::new();
                for_each_read(self.module, id, |read| reads.push(read));
                self.keep_constants(reads);
            }
        }
    }

    /// Whether enough parts are taken from vectors that a block must do it.
    fn is_of_many_bits(&self, parts: &[NodeId]) -> bool {
        let is_slice = |id: &&NodeId| matches!(self.module.node(**id).op, Op::Slice { .. });
        parts.iter().filter(is_slice).count() >= MOST_SLICES
    }

    /// Whether at least three multiplexers are nested in each other's `else`.
    fn is_chain(&self, mut id: NodeId) -> bool {
        for _ in 0..2 {
            match self.module.node(id).op {
                Op::Mux { on_false, .. } if self.form(on_false) == Form::Inline => id = on_false,
                _ => return false,
            }
        }
        matches!(self.module.node(id).op, Op::Mux { .. })
    }

    fn branch(&mut self, id: NodeId, depth: u32, most: usize) {
        let choice = matches!(self.module.node(id).op, Op::Mux { .. } | Op::Select { .. } | Op::Case { .. });
        if choice && self.form(id) == Form::Inline && depth > 0 {
            self.set(id, Form::Branches);
            self.branch_operands(id, depth, most);
        }
    }

    /// The last `else` may continue as `else if` without nesting deeper, up to `most` of them.
    fn branch_operands(&mut self, mut id: NodeId, depth: u32, most: usize) {
        let module = self.module;
        let mut count = 0;
        loop {
            // A value that is never chosen would have no driver.
            match &module.node(id).op {
                Op::Mux { select, .. } => self.keep_constants(vec![*select]),
                Op::Case { subject, .. } => {
                    self.keep_constants(vec![*subject]);
                    self.name_subject(*subject);
                }
                Op::Select { arms, .. } => arms.iter().for_each(|(condition, _)| self.keep_constants(vec![*condition])),
                _ => {}
            }
            id = match &module.node(id).op {
                Op::Mux { on_true, on_false, .. } => {
                    self.branch(*on_true, depth - 1, most);
                    count += 1;
                    *on_false
                }
                Op::Select { arms, default } => {
                    arms.iter().for_each(|&(_, value)| self.branch(value, depth - 1, most));
                    count += arms.len();
                    *default
                }
                Op::Case { arms, default, .. } => {
                    arms.iter().for_each(|&(_, value)| self.branch(value, depth - 1, most));
                    return match module.node(*default).op {
                        Op::Case { .. } if arms.len() >= MOST_KEYS && self.form(*default) == Form::Inline => {
                            self.set(*default, Form::Net);
                        }
                        _ => self.branch(*default, depth - 1, most),
                    };
                }
                _ => return,
            };
            if self.form(id) != Form::Inline {
                return;
            }
            match module.node(id).op {
                Op::Mux { .. } | Op::Select { .. } if count >= most => return self.set(id, Form::Net),
                Op::Mux { .. } | Op::Select { .. } => self.set(id, Form::Branches),
                _ => return self.branch(id, depth - 1, most),
            }
        }
    }

    /// Makes nets of the longest operands of an over-long expression.
    fn split_long(&mut self, order: &[NodeId]) {
        let module = self.module;
        let name = |node: &Node| node.name.as_ref().map_or(NAME, String::len);
        let mut columns: Vec<usize> = module.nodes.iter().map(name).collect();
        for &id in order {
            let node = module.node(id);
            let printed = matches!(self.form(id), Form::Inline | Form::Net);
            if !printed {
                continue;
            }
            let mut operands = Vec::new();
            node.op.for_each_operand(|operand| operands.push(operand));
            let total = loop {
                let length = |id: NodeId| columns[id.0 as usize];
                let total = overhead(&node.op) + operands.iter().map(|&operand| length(operand) + 3).sum::<usize>();
                let longest = operands.iter().copied().max_by_key(|&operand| length(operand));
                match longest.filter(|&longest| total > LONGEST && length(longest) > NAME + 4) {
                    Some(longest) if self.form(longest) == Form::Inline && self.can_split(longest) => {
                        self.set(longest, Form::Net);
                        columns[longest.0 as usize] = NAME;
                    }
                    _ => break total,
                }
            };
            columns[id.0 as usize] = match (self.form(id), &node.op) {
                (Form::Inline, Op::Const(value)) => 5 + value.width() as usize / 4,
                (Form::Inline, _) => total,
                _ => name(node),
            };
        }
    }

    fn can_split(&self, id: NodeId) -> bool {
        let op = &self.module.node(id).op;
        !is_place(op) && !matches!(op, Op::Slice { .. })
    }
}

/// The columns of an operator without its operands.
fn overhead(op: &Op) -> usize {
    match op {
        Op::Slice { .. } => 4,
        Op::Extend { .. } => 8,
        Op::Compare { signed: true, .. } => 18,
        Op::Binary(Binary::Mul, ..) => 16,
        _ => 2,
    }
}
