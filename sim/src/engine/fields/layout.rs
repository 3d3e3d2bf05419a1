//! The borders at which words are assembled and taken apart, found by unification.
//!
//! Each wide value has a *node*, and so has each part that is a value somewhere. Values that are the same word (a
//! register and its input, a memory and its ports, both sides of a choice) share a node. So a border in one of them
//! is a border in all.

use rustc_hash::FxHashMap;
use tilewright_circuit::ir::{Binary, Unary};

use super::{Piece, WIDE};
use crate::engine::program::{Axis, Cell, Kind, Program, ValueId};

/// The parts of the words of a program.
pub(super) struct Layout<'a> {
    program: &'a Program,
    nodes: Vec<Node>,
    values: FxHashMap<ValueId, NodeId>,
    memories: Vec<NodeId>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct NodeId(usize);

/// A word, or a part of words.
struct Node {
    width: u32,
    form: Form,
}

/// What is known of the borders in a node.
enum Form {
    /// The borders of another node.
    Same(NodeId),
    /// No borders so far.
    Open,
    /// Parts, the lowest first.
    Parts(Vec<NodeId>),
    /// This number of lanes, side by side.
    Row(u32),
    /// No borders, because an operation uses it as a whole.
    Whole,
}

impl<'a> Layout<'a> {
    /// Finds the parts.
    pub fn of(program: &'a Program) -> Layout<'a> {
        let mut layout = Layout { program, nodes: Vec::new(), values: FxHashMap::default(), memories: Vec::new() };
        for memory in &program.memories {
            let node = layout.node(memory.width, Form::Open);
            layout.memories.push(node);
        }
        program.circuit.cells().for_each(|(id, cell)| layout.whole(id, cell));
        program.circuit.cells().for_each(|(id, cell)| layout.cell(id, cell));
        for register in &program.registers {
            layout.link(register.value, register.next);
        }
        for (memory, &node) in program.memories.iter().zip(&layout.memories.clone()) {
            let data = memory.reads.iter().map(|read| read.value).chain(memory.writes.iter().map(|write| write.data));
            data.for_each(|id| layout.link_to(id, node));
        }
        layout
    }

    /// The parts of a value; a single one if it is not split.
    pub fn value(&self, id: ValueId) -> Vec<Piece> {
        match self.values.get(&id) {
            Some(&node) if self.program.circuit[id].width > WIDE => self.pieces(node),
            _ => vec![Piece::all(self.program.circuit[id].width)],
        }
    }

    /// The parts of a memory's words.
    pub fn memory(&self, index: usize) -> Vec<Piece> {
        match self.program.memories[index].width {
            width if width > WIDE => self.pieces(self.memories[index]),
            width => vec![Piece::all(width)],
        }
    }

    fn pieces(&self, node: NodeId) -> Vec<Piece> {
        let (mut pieces, mut low) = (Vec::new(), 0);
        let mut open = vec![node];
        while let Some(node) = open.pop() {
            let Node { width, form } = &self.nodes[self.root(node).0];
            match form {
                Form::Parts(parts) => {
                    open.extend(parts.iter().rev());
                    continue;
                }
                Form::Row(lanes) => pieces.push(Piece { low, width: *width, lanes: *lanes }),
                _ => pieces.push(Piece { low, width: *width, lanes: 1 }),
            }
            low += width;
        }
        pieces
    }

    /// Records what an operation uses or produces as a whole, as a sum does.
    fn whole(&mut self, id: ValueId, cell: &Cell) {
        let splits = match &cell.kind {
            Kind::Compare(..) | Kind::Shift(..) | Kind::Reduce { .. } => false,
            Kind::Unary(op, _) => *op == Unary::Not,
            Kind::Binary(op, ..) => is_bitwise(*op),
            Kind::Extend(_, signed) => !signed,
            Kind::Pack { axis, .. } | Kind::Unpack { axis, .. } => axis.inner == 1,
            Kind::Case { subject, .. } => return self.mark(*subject),
            Kind::Pick { index, .. } => return self.mark(*index),
            _ => true,
        };
        if !splits {
            self.mark(id);
            cell.kind.for_each_operand(|operand| self.mark(operand));
        }
    }

    fn mark(&mut self, id: ValueId) {
        if self.program.circuit[id].width > WIDE {
            let node = self.of_value(id);
            self.nodes[node.0].form = Form::Whole;
        }
    }

    /// Enters the borders that an operation makes.
    fn cell(&mut self, id: ValueId, cell: &Cell) {
        let is_wide = cell.width > WIDE;
        let width = |id: ValueId| self.program.circuit[id].width;
        match &cell.kind {
            Kind::Pack { of, axis: Axis { count, inner: 1 } } => {
                let inside = match self.program.circuit[*of].kind {
                    Kind::Pack { axis: Axis { count, inner: 1 }, .. } => count,
                    _ => 1,
                };
                self.row(id, count * inside);
            }
            Kind::Unpack { of, axis: Axis { count, inner: 1 } } => {
                self.row(*of, *count);
                if let Kind::Unpack { of, axis: Axis { count: outside, inner: 1 } } = self.program.circuit[*of].kind {
                    self.row(of, outside * count);
                }
            }
            Kind::Slice(of, low) if width(*of) > WIDE => {
                let of = self.of_value(*of);
                if let Some(part) = self.part(of, *low, cell.width) {
                    self.link_to(id, part);
                }
            }
            _ if !is_wide => {}
            Kind::Concat(parts) => self.parts(id, parts.iter().rev().copied()),
            Kind::Repeat(of, times) => self.parts(id, (0..*times).map(|_| *of)),
            Kind::Extend(of, false) => self.parts(id, [*of].into_iter()),
            Kind::Read { memory, .. } => self.link_to(id, self.memories[*memory as usize]),
            Kind::Mux { on_true, on_false, .. } => [*on_true, *on_false].into_iter().for_each(|of| self.link(id, of)),
            Kind::Select { arms, default } => {
                arms.iter().map(|arm| arm.1).chain([*default]).for_each(|of| self.link(id, of));
            }
            Kind::Case { arms, default, .. } => {
                arms.iter().map(|arm| arm.1).chain([*default]).for_each(|of| self.link(id, of));
            }
            Kind::Pick { of, .. } => self.link(id, *of),
            Kind::Binary(op, ..) if !is_bitwise(*op) => {}
            Kind::Alias(_)
            | Kind::Unary(..)
            | Kind::Binary(..)
            | Kind::Broadcast { .. }
            | Kind::Stack { .. }
            | Kind::Map { .. }
            | Kind::Interleave { .. }
            | Kind::Lane { .. } => cell.kind.for_each_operand(|operand| self.link(id, operand)),
            _ => {}
        }
    }

    /// A value begins with these parts, the lowest first.
    fn parts(&mut self, id: ValueId, parts: impl Iterator<Item = ValueId>) {
        let (of, mut low) = (self.of_value(id), 0);
        for part in parts {
            let width = self.program.circuit[part].width;
            if let Some(node) = self.part(of, low, width) {
                self.link_to(part, node);
            }
            low += width;
        }
    }

    /// A value is this number of lanes side by side.
    fn row(&mut self, id: ValueId, lanes: u32) {
        let width = self.program.circuit[id].width;
        if lanes == 1 {
            return;
        }
        if width / lanes <= WIDE {
            let row = self.node(width, Form::Row(lanes));
            self.link_to(id, row);
        } else {
            let of = self.of_value(id);
            (1..lanes).for_each(|lane| {
                self.split(of, lane * (width / lanes));
            });
        }
    }

    /// Two values are the same word.
    fn link(&mut self, id: ValueId, other: ValueId) {
        if self.program.circuit[other].width > WIDE && self.program.circuit.constant(id).is_none() {
            let node = self.of_value(id);
            self.link_to(other, node);
        }
    }

    /// A value is a word, unless it is constant.
    fn link_to(&mut self, id: ValueId, node: NodeId) {
        if self.program.circuit.constant(id).is_none() {
            let of = self.of_value(id);
            self.unify(of, node);
        }
    }

    fn node(&mut self, width: u32, form: Form) -> NodeId {
        self.nodes.push(Node { width, form });
        NodeId(self.nodes.len() - 1)
    }

    fn of_value(&mut self, id: ValueId) -> NodeId {
        match self.values.get(&id) {
            Some(&node) => self.find(node),
            None => {
                let node = self.node(self.program.circuit[id].width, Form::Open);
                self.values.insert(id, node);
                node
            }
        }
    }

    /// The node into which a node has been merged.
    fn root(&self, node: NodeId) -> NodeId {
        let mut node = node;
        while let Form::Same(other) = self.nodes[node.0].form {
            node = other;
        }
        node
    }

    /// Like [`Layout::root`], with path compression.
    fn find(&mut self, node: NodeId) -> NodeId {
        let (root, mut node) = (self.root(node), node);
        while let Form::Same(other) = self.nodes[node.0].form {
            self.nodes[node.0].form = Form::Same(root);
            node = other;
        }
        root
    }

    /// Merges two nodes, and so their parts.
    fn unify(&mut self, a: NodeId, b: NodeId) {
        let mut open = vec![(a, b)];
        while let Some((a, b)) = open.pop() {
            let (a, b) = (self.find(a), self.find(b));
            if a == b {
                continue;
            }
            self.align(a, b);
            self.align(b, a);
            let mut take = |node: NodeId| std::mem::replace(&mut self.nodes[node.0].form, Form::Open);
            let form = match (take(a), take(b)) {
                (Form::Open, form) | (form, Form::Open) => form,
                (Form::Row(n), Form::Row(m)) if n.is_multiple_of(m) || m.is_multiple_of(n) => Form::Row(n.max(m)),
                (Form::Parts(left), Form::Parts(right)) => {
                    open.extend(self.matching(&left, &right));
                    Form::Parts(left)
                }
                // Lanes stay together, and borders within them do not matter.
                (Form::Row(n), Form::Parts(_)) | (Form::Parts(_), Form::Row(n)) => Form::Row(n),
                _ => Form::Whole,
            };
            self.nodes[a.0].form = form;
            self.nodes[b.0].form = Form::Same(a);
        }
    }

    /// Splits a node at the borders of another one, if both have parts.
    fn align(&mut self, node: NodeId, like: NodeId) {
        if let (Form::Parts(_), Form::Parts(parts)) = (&self.nodes[node.0].form, &self.nodes[like.0].form) {
            let mut low = 0;
            for part in parts.clone() {
                low += self.nodes[part.0].width;
                self.split(node, low);
            }
        }
    }

    /// The parts of two nodes that begin and end at the same bits.
    fn matching(&self, left: &[NodeId], right: &[NodeId]) -> Vec<(NodeId, NodeId)> {
        let places = |parts: &[NodeId]| {
            let mut low = 0;
            let place = |&part: &NodeId| {
                let width = self.nodes[part.0].width;
                low += width;
                ((low, width), part)
            };
            parts.iter().map(place).collect::<Vec<_>>()
        };
        let right: FxHashMap<(u32, u32), NodeId> = places(right).into_iter().collect();
        places(left).into_iter().filter_map(|(place, part)| Some((part, *right.get(&place)?))).collect()
    }

    /// Gives a node a border at a bit; returns whether it has one then. Whole nodes and lanes get none, and there is
    /// at most one border in [`SPARSE`] bits.
    fn split(&mut self, node: NodeId, at: u32) -> bool {
        let node = self.find(node);
        let Node { width, form } = &self.nodes[node.0];
        if at == 0 || at == *width {
            return true;
        }
        let parts = match form {
            Form::Parts(parts) => parts,
            Form::Open => {
                let parts = [at, width - at].map(|width| self.node(width, Form::Open));
                self.nodes[node.0].form = Form::Parts(parts.to_vec());
                return true;
            }
            _ => return false,
        };
        let is_full = parts.len() as u32 * SPARSE > *width + WIDE || parts.len() > MOST;
        let (mut low, mut index) = (0, 0);
        while low + self.nodes[parts[index].0].width <= at {
            low += self.nodes[parts[index].0].width;
            index += 1;
        }
        if low == at {
            return true;
        }
        let part = parts[index];
        if is_full || !self.split(part, at - low) {
            return false;
        }
        if let (Form::Parts(parts), Form::Parts(inside)) =
            (&self.nodes[node.0].form, &self.nodes[self.root(part).0].form)
        {
            let mut parts = parts.clone();
            parts.splice(index..=index, inside.iter().copied());
            self.nodes[node.0].form = Form::Parts(parts);
        }
        true
    }

    /// The part from a bit on, if there can be a border on each side.
    fn part(&mut self, of: NodeId, low: u32, width: u32) -> Option<NodeId> {
        let of = self.find(of);
        if self.nodes[of.0].width == width {
            return Some(of);
        }
        if !self.split(of, low) || !self.split(of, low + width) {
            return None;
        }
        let Form::Parts(parts) = &self.nodes[of.0].form else { return None };
        let (mut at, mut inside) = (0, Vec::new());
        for &part in parts {
            if (low..low + width).contains(&at) {
                inside.push(part);
            }
            at += self.nodes[part.0].width;
        }
        match inside[..] {
            [part] => Some(part),
            _ => Some(self.node(width, Form::Parts(inside))),
        }
    }
}

/// The least average distance of borders: more of them would cost more than the words that they split.
const SPARSE: u32 = 8;

/// The most parts of a node, approximately.
const MOST: usize = 512;

/// Whether each bit of the result depends on the same bit of both operands.
pub(super) fn is_bitwise(op: Binary) -> bool {
    matches!(op, Binary::And | Binary::Or | Binary::Xor)
}
