//! Constants that differ from lane to lane: what is computed of them is constant, too.

use super::Fold;
use super::Outcome::{self, Op as Is};
use crate::verilog::constant;
use crate::verilog::lane_values::values;
use tilewright_hdl::Bits;
use tilewright_hdl::ir::{NodeId, Op, Relation, Shape};

/// More lanes than this are not computed one by one.
const MOST_LANES: u32 = 4096;

impl Fold {
    /// The value of an operator whose operands are constants of the lanes, and a comparison with one that linters take.
    pub(super) fn lane_constant(&mut self, id: NodeId, op: &Op) -> Option<Outcome> {
        let (shape, width) = (self.module.shape(id), self.width(id));
        if shape.is_plain() || shape.lanes() > MOST_LANES {
            return None;
        }
        if let &Op::Compare { relation, signed, operands } = op
            && let Some(compare) = self.widened(id, relation, signed, operands)
        {
            return Some(compare);
        }
        let operands = match op {
            Op::Unary(_, a) | Op::Slice { of: a, .. } | Op::Extend { of: a, .. } => vec![*a],
            Op::Binary(_, a, b) | Op::Compare { operands: [a, b], .. } => vec![*a, *b],
            _ => return None,
        };
        let operands: Vec<Vec<Bits>> =
            operands.iter().map(|operand| values(&self.module, *operand)).collect::<Option<_>>()?;
        let lane = |lane: usize| match op {
            Op::Unary(unary, _) => Some(constant::unary(*unary, &operands[0][lane])),
            Op::Binary(binary, ..) => constant::binary(*binary, &operands[0][lane], &operands[1][lane]),
            Op::Compare { relation, signed, .. } => {
                Some(Bits::from(constant::compare(*relation, *signed, &operands[0][lane], &operands[1][lane])))
            }
            Op::Slice { low, .. } => Some(operands[0][lane].slice(*low..low + width)),
            Op::Extend { signed: true, .. } => Some(operands[0][lane].sext(width)),
            _ => Some(operands[0][lane].resize(width)),
        };
        let values = (0..shape.lanes() as usize).map(lane).collect::<Option<Vec<Bits>>>()?;
        Some(self.list(id, &values))
    }

    /// These constants in the lanes of `id`.
    fn list(&mut self, id: NodeId, values: &[Bits]) -> Outcome {
        let (shape, width) = (self.module.shape(id), self.width(id));
        let constant =
            |fold: &mut Self, value: &Bits| fold.add_shaped(id, width, Shape::Plain, Op::Const(value.clone()));
        let row = |fold: &mut Self, values: &[Bits]| {
            let parts = values.iter().map(|value| constant(fold, value)).collect();
            Op::Stack { parts, axis: 0 }
        };
        let op = match shape {
            Shape::Grid(_, columns) => {
                let mut parts = Vec::new();
                for values in values.chunks(columns as usize) {
                    let op = row(self, values);
                    parts.push(self.add_shaped(id, width, Shape::Row(columns), op));
                }
                Op::Stack { parts, axis: 0 }
            }
            _ => row(self, values),
        };
        Is(op)
    }

    /// A comparison that is decided in some lanes, as `x >= 0` is, is one of more bits: a linter complains of a lane where
    /// it is constant.
    fn widened(&mut self, id: NodeId, relation: Relation, signed: bool, operands: [NodeId; 2]) -> Option<Outcome> {
        if matches!(relation, Relation::Eq | Relation::Ne) {
            return None;
        }
        let width = self.width(operands[0]);
        let (lowest, highest) = constant::range(width, signed);
        let constants = operands.map(|operand| values(&self.module, operand));
        let decides = |values: &Vec<Bits>| values.iter().any(|value| *value == lowest || *value == highest);
        if !matches!(&constants, [Some(values), None] | [None, Some(values)] if decides(values)) {
            return None;
        }
        let operands = operands.map(|of| self.add(id, width + 2, Op::Extend { of, signed }));
        Some(Is(Op::Compare { relation, signed: true, operands }))
    }
}
