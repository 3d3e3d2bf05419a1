//! Prepares a module for printing. Constants are folded, so that no linter meets `a >= 8'd0`; shifts by a constant
//! become slices; nodes that only pass a value on disappear unless they have a name.

mod constants;
mod lanes;
pub mod lower;
mod memories;
mod operators;
mod ranges;
mod shift;

use super::order::{for_each_read, map_operands, operands_first};
use operators::WIDEST_SIGNED_PRODUCT;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Binary, Design, Directive, Kind, Module, Node, NodeId, Op, Shape};

/// A circuit that is ready to be printed.
pub struct Folded {
    /// Simplified; ports have no lanes.
    pub module: Module,
    /// For each register its reset value, if that differs between its lanes.
    pub resets: Vec<Option<NodeId>>,
    /// For each memory and read port whether the address can be beyond the last word.
    pub beyond: Vec<Vec<bool>>,
}

/// The same circuit, simplified. Nodes keep their ids; new ones are appended.
pub fn fold(design: &Design, module: &Module) -> Folded {
    let (module, mut resets) = lower::lower(design, module);
    let has_chains = has_chains(&module, &operands_first(&module));
    let mut fold = Fold { same: (0..module.nodes.len() as u32).map(NodeId).collect(), module };
    // With chains of lanes, a node is visited before its operands, and so again until nothing new is known.
    let (nodes, mut known) = (fold.same.len(), None);
    loop {
        operands_first(&fold.module).into_iter().for_each(|id| fold.visit(id));
        let now = (0..nodes).filter(|&id| fold.is_settled(id)).count();
        if !has_chains || known.replace(now) == Some(now) {
            break;
        }
    }
    fold.rewire();
    fold.settle_memories();
    resets.iter_mut().flatten().for_each(|id| *id = fold.stands_for(*id));
    let beyond = ranges::beyond(&fold.module);
    Folded { module: fold.module, resets, beyond }
}

/// Whether some node comes before one of its operands.
fn has_chains(module: &Module, order: &[NodeId]) -> bool {
    let mut done = vec![false; module.nodes.len()];
    order.iter().any(|&id| {
        let mut is_early = false;
        for_each_read(module, id, |operand| is_early |= !done[operand.0 as usize]);
        done[id.0 as usize] = true;
        is_early
    })
}

struct Fold {
    module: Module,
    /// For each node, the node that replaces it.
    same: Vec<NodeId>,
}

/// The replacement of a node.
enum Outcome {
    /// An operator on other nodes.
    Op(Op),
    /// Another node.
    Same(NodeId),
}

use Outcome::{Op as Is, Same};

impl Fold {
    fn visit(&mut self, id: NodeId) {
        let op = map_operands(&self.module.node(id).op, |operand| self.same[operand.0 as usize]);
        let outcome = self.simplify(id, op);
        let named = self.module.node(id).name.is_some();
        match outcome {
            Is(Op::Wire(to)) | Is(Op::QuasiStatic(to, _)) | Same(to) if !named && self.hands_over_kind(id, to) => {
                self.same[id.0 as usize] = to;
            }
            Same(to) => self.module.nodes[id.0 as usize].op = Op::Wire(to),
            Is(op) => self.module.nodes[id.0 as usize].op = op,
        }
    }

    /// Makes `to`, which is a number, a code if the node that it replaces is one. Returns whether that is possible:
    /// not if it is a code of another enum.
    fn hands_over_kind(&mut self, of: NodeId, to: NodeId) -> bool {
        let (kind, node) = (self.module.node(of).kind, &mut self.module.nodes[to.0 as usize]);
        match (kind, node.kind, &node.op) {
            (Kind::Code(_), Kind::Number, op) if !matches!(op, Op::Const(_)) => node.kind = kind,
            (Kind::Code(own), Kind::Code(other), _) => return own == other,
            _ => {}
        }
        true
    }

    /// Makes registers, memories, instances, outputs and properties refer to the remaining nodes.
    fn rewire(&mut self) {
        let same: Vec<NodeId> = (0..self.same.len() as u32).map(|id| self.stands_for(NodeId(id))).collect();
        let to = |id: &mut NodeId| *id = same[id.0 as usize];
        let module = &mut self.module;
        // With chains of lanes, a node is visited before its operands.
        for node in &mut module.nodes {
            node.op = map_operands(&node.op, |operand| same[operand.0 as usize]);
        }
        // A mask is constant only if all lanes are.
        let constant = |nodes: &[Node], id: NodeId| match &nodes[id.0 as usize].op {
            Op::Const(bits) if bits.not().is_zero() => Some(true),
            Op::Const(bits) if bits.is_zero() => Some(false),
            _ => None,
        };
        for register in &mut module.registers {
            to(&mut register.next);
            register.enable.iter_mut().for_each(to);
            match register.enable.and_then(|enable| constant(&module.nodes, enable)) {
                Some(true) => register.enable = None,
                Some(false) => (register.enable, register.next) = (None, register.node),
                None => {}
            }
        }
        for memory in &mut module.memories {
            for read in &mut memory.reads {
                to(&mut read.address);
                read.enable.iter_mut().for_each(to);
                if read.enable.and_then(|enable| constant(&module.nodes, enable)) == Some(true) {
                    read.enable = None;
                }
            }
            for write in &mut memory.writes {
                [&mut write.enable, &mut write.address, &mut write.data].into_iter().for_each(to);
            }
        }
        module.instances.iter_mut().flat_map(|instance| &mut instance.inputs).for_each(to);
        module.outputs.iter_mut().for_each(|output| to(&mut output.node));
        for property in &mut module.properties {
            to(&mut property.condition);
            property.values.iter_mut().for_each(|shown| to(&mut shown.node));
        }
        // An assertion that is always true is not printed; what always happens is.
        module.properties.retain(|property| {
            let holds = matches!(property.directive, Directive::Assert | Directive::Assume);
            !holds || constant(&module.nodes, property.condition) != Some(true)
        });
    }

    /// Whether a node has become another one, or a constant.
    fn is_settled(&self, id: usize) -> bool {
        self.same[id].0 as usize != id || self.constant(NodeId(id as u32)).is_some()
    }

    /// The node that replaces this one.
    fn stands_for(&self, mut id: NodeId) -> NodeId {
        while self.same[id.0 as usize] != id {
            id = self.same[id.0 as usize];
        }
        id
    }

    /// The value of a node that is constant and the same in every lane, even if it has a name.
    fn constant(&self, mut id: NodeId) -> Option<Bits> {
        loop {
            match &self.module.node(id).op {
                Op::Const(bits) => return Some(bits.clone()),
                Op::Wire(to) | Op::QuasiStatic(to, _) => id = *to,
                _ => return None,
            }
        }
    }

    fn width(&self, id: NodeId) -> u32 {
        self.module.width(id)
    }

    /// A new unnamed node, at the place of `of`.
    fn add(&mut self, of: NodeId, width: u32, op: Op) -> NodeId {
        // An operation that changes the shape determines it.
        let shape = match op {
            Op::Lane { of, axis, .. } => self.module.shape(of).without(axis),
            _ => self.module.shape(of),
        };
        self.add_shaped(of, width, shape, op)
    }

    /// Like [`Fold::add`], with another shape.
    fn add_shaped(&mut self, of: NodeId, width: u32, shape: Shape, op: Op) -> NodeId {
        let id = NodeId(self.module.nodes.len() as u32);
        let loc = self.module.node(of).loc;
        self.module.nodes.push(Node::new(op, width, shape, loc));
        self.same.push(id);
        self.visit(id);
        self.same[id.0 as usize]
    }

    fn simplify(&mut self, id: NodeId, op: Op) -> Outcome {
        let width = self.width(id);
        if let Some(outcome) = self.lane_constant(id, &op) {
            return outcome;
        }
        match op {
            Op::Unary(unary, a) => self.unary(unary, a),
            Op::Binary(Binary::MulSigned, a, b) if width > WIDEST_SIGNED_PRODUCT => self.wide_product(id, a, b),
            Op::Binary(binary, a, b) => self.binary(binary, a, b),
            Op::Compare { relation, signed, operands: [a, b] } => self.compare(relation, signed, a, b),
            Op::Shift(shift, a, amount) => self.shift(id, shift, a, amount),
            Op::Mux { select, on_true, on_false } => self.mux(select, on_true, on_false),
            Op::Select { arms, default } => self.select(id, arms, default),
            Op::Case { subject, arms, default } => match self.constant(subject) {
                Some(value) => Same(arms.iter().find(|(key, _)| *key == value).map_or(default, |&(_, value)| value)),
                None if arms.iter().all(|&(_, value)| value == default) => Same(default),
                None => self.case(id, subject, arms, default),
            },
            Op::Slice { of, low } => self.slice(id, of, low, width),
            Op::Concat(parts) => self.concat(id, parts),
            Op::Repeat(a, 1) => Same(a),
            Op::Repeat(a, times) => match self.constant(a) {
                Some(value) => Is(Op::Const(Bits::join(&vec![value; times as usize]))),
                None => Is(Op::Repeat(a, times)),
            },
            Op::Extend { of, signed } => self.extend(of, signed, width),
            Op::Read(memory, port) => self.word(memory, port),
            other => self.lane_op(id, other),
        }
    }
}
