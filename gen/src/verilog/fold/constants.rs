//! Constants that differ from lane to lane: results computed from them are constants too.

use super::Fold;
use super::Outcome::{self, Op as Is};
use crate::verilog::constant;
use crate::verilog::lane_values::{known, values};
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{NodeId, Op, Reduction, Relation, Shape};

/// More lanes than this are not computed one by one.
const MOST_LANES: u32 = 4096;

impl Fold {
    /// The value of an operator whose operands are constants of the lanes, or a comparison with one in a form that
    /// linters accept.
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
        let operands = constant::operands(op)?;
        let operands: Vec<Vec<Bits>> =
            operands.iter().map(|operand| values(&self.module, *operand)).collect::<Option<_>>()?;
        let lane = |lane: usize| {
            let operands: Vec<&Bits> = operands.iter().map(|values| &values[lane]).collect();
            constant::of(op, width, &operands)
        };
        let values = (0..shape.lanes() as usize).map(lane).collect::<Option<Vec<Bits>>>()?;
        Some(self.list(id, &values))
    }

    /// Lanes along an axis combined, if all lanes are constants.
    pub(super) fn combined_constants(&mut self, id: NodeId, by: Reduction, of: NodeId, axis: u32) -> Option<Outcome> {
        let (from, shape) = (self.module.shape(of), self.module.shape(id));
        if from.lanes() > MOST_LANES {
            return None;
        }
        let values = values(&self.module, of)?;
        let lane = |across: u32| {
            let mut lanes = (0..from.extent(axis)).map(|along| &values[from.lane(axis, along, across) as usize]);
            let first = lanes.next()?.clone();
            lanes.try_fold(first, |all, value| constant::combined(by, &all, value))
        };
        let values = (0..shape.lanes()).map(lane).collect::<Option<Vec<Bits>>>()?;
        Some(if shape.is_plain() { Is(Op::Const(values[0].clone())) } else { self.list(id, &values) })
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

    /// A comparison that is constant in some lanes, as `x >= 0` is, gets more bits: a linter complains about a lane
    /// in which it is constant.
    fn widened(&mut self, id: NodeId, relation: Relation, signed: bool, operands: [NodeId; 2]) -> Option<Outcome> {
        if matches!(relation, Relation::Eq | Relation::Ne) {
            return None;
        }
        let width = self.width(operands[0]);
        let all_known = operands.iter().all(|&operand| values(&self.module, operand).is_some());
        if all_known || !operands.iter().any(|&operand| self.has_end(operand, signed)) {
            return None;
        }
        let operands = operands.map(|of| self.add(id, width + 2, Op::Extend { of, signed }));
        Some(Is(Op::Compare { relation, signed: true, operands }))
    }

    /// The maximum or minimum of lanes, some of which are known to be an end of the range. Additional bits make none
    /// of them one.
    pub(super) fn between_ends(&mut self, id: NodeId, by: Reduction, of: NodeId, axis: u32) -> Option<Outcome> {
        if !matches!(by, Reduction::Min | Reduction::Max) || !self.has_end(of, false) {
            return None;
        }
        let width = self.width(of) + 2;
        let [above, below] = [Bits::zero(1), Bits::ones(1)].map(|bit| self.add(of, 1, Op::Const(bit)));
        let of = self.add(of, width, Op::Concat(vec![above, of, below]));
        let of = self.add(id, width, Op::Reduce { by, of, axis });
        Some(Is(Op::Slice { of, low: 1 }))
    }

    /// Whether a lane is known to be the lowest or the highest value of the width.
    fn has_end(&self, id: NodeId, signed: bool) -> bool {
        let (lowest, highest) = constant::range(self.width(id), signed);
        let is_end = |value: Bits| value == lowest || value == highest;
        let lanes = self.module.shape(id).lanes();
        lanes <= MOST_LANES && (0..lanes).any(|lane| known(&self.module, id, lane).is_some_and(is_end))
    }
}
