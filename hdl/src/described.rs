//! Nodes in the words of the description: its operators and methods, as messages show them.

use crate::draft::{Draft, UNDRIVEN};
use tilewright_circuit::Bits;
use tilewright_circuit::ir::*;

impl Draft {
    /// A node in the words of the description: its name, or its expression, shortened.
    pub fn describe(&self, id: NodeId) -> String {
        self.describe_to(id, 3)
    }

    fn describe_to(&self, id: NodeId, depth: u32) -> String {
        let node = self.node(id);
        if let Some(name) = &node.name {
            return name.clone();
        }
        if depth == 0 {
            return "..".to_owned();
        }
        let say = |id: &NodeId| self.describe_to(*id, depth - 1);
        let list = |ids: &[NodeId]| ids.iter().map(say).collect::<Vec<_>>().join(", ");
        let inner = |id: &NodeId| match self.node(*id) {
            Node { name: None, op: Op::Binary(..) | Op::Compare { .. } | Op::Shift(..), .. } => {
                format!("({})", say(id))
            }
            _ => say(id),
        };
        match &node.op {
            Op::Input(index) => self.inputs[*index as usize].name.clone(),
            Op::Const(value) => constant_text(value, node.kind),
            Op::Unary(Unary::Not, a) => format!("!{}", inner(a)),
            Op::Unary(Unary::AllOnes, a) => format!("{}.all_ones()", inner(a)),
            Op::Unary(Unary::AnyOne, a) => format!("{}.any_one()", inner(a)),
            Op::Unary(Unary::Parity, a) => format!("{}.parity()", inner(a)),
            Op::Binary(op, a, b) => format!("{} {} {}", inner(a), op.symbol(), inner(b)),
            Op::Compare { relation, operands: [a, b], .. } => format!("{}.{}({})", inner(a), relation.method(), say(b)),
            Op::Shift(op, a, b) => format!("{} {} {}", inner(a), op.symbol(), inner(b)),
            Op::Mux { select, on_true, on_false } => format!("mux({})", list(&[*select, *on_true, *on_false])),
            Op::Select { .. } => "select(..)".to_owned(),
            Op::Case { subject, .. } => format!("case({}, ..)", say(subject)),
            Op::Slice { of, low } if node.width == 1 => format!("{}.bit({low})", inner(of)),
            Op::Slice { of, low } => format!("{}.slice({low}..{})", inner(of), low + node.width),
            Op::Concat(parts) => format!("cat![{}]", list(parts)),
            Op::Repeat(a, n) => format!("{}.repeat({n})", inner(a)),
            Op::Extend { of, signed: false } => format!("{}.zext({})", inner(of), node.width),
            Op::Extend { of, signed: true } => format!("{}.sext({})", inner(of), node.width),
            Op::Read(memory, _) => format!("{}.read(..)", self.memories[memory.0 as usize].memory.name),
            Op::Output(instance, port) => {
                let index = instance.0 as usize;
                format!("{}.{}", self.instances[index].name, self.instance_outputs[index][*port as usize])
            }
            // Of all wires without a driver, only that of a stream has no name.
            Op::Wire(UNDRIVEN) => "ready".to_owned(),
            Op::QuasiStatic(a, _) | Op::Wire(a) => say(a),
            Op::Broadcast { of, .. } => format!("{}.of(..)", inner(of)),
            Op::Stack { .. } => "stack(..)".to_owned(),
            Op::Map { of, index: Affine { mul: 1, add, div: 1 }, .. } => {
                format!("{}.shifted({}, ..)", inner(of), -i64::from(*add))
            }
            Op::Map { of, .. } => format!("{}.take(..)", inner(of)),
            Op::Interleave { .. } => "interleave(..)".to_owned(),
            Op::Lane { of, index, .. } => format!("{}.lane({index})", inner(of)),
            Op::Pick { of, index, .. } => format!("{}.pick({})", inner(of), say(index)),
            Op::Reduce { by, of, .. } => format!("{}.{}()", inner(of), by.method()),
            Op::Pack { of, .. } => format!("{}.pack()", inner(of)),
            Op::Unpack { of, .. } => format!("{}.unpack()", inner(of)),
            Op::Register(_) => match self.pasts.iter().find(|(_, past)| **past == id) {
                Some(((of, ..), _)) => format!("past({})", say(of)),
                None => "a register".to_owned(),
            },
        }
    }
}

/// A constant as a description writes it: a code by its name, a signed number with its sign.
fn constant_text(value: &Bits, kind: Kind) -> String {
    let code = |names: Names| Some(format!("{}::{}", names.of, names.name(value.to_u64()?)?));
    let text = match kind {
        Kind::Code(names) => code(names),
        Kind::Signed => value.to_i128().map(|number| number.to_string()),
        Kind::Number => None,
    };
    text.or_else(|| value.to_u64().map(|number| number.to_string())).unwrap_or_else(|| value.to_string())
}
