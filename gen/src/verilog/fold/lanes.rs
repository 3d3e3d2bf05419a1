//! Lanes: values that need none become plain, values that are the same in every lane are computed once, and a lane of
//! a list becomes an entry.

use super::Fold;
use super::Outcome::{self, Op as Is, Same};
use super::lower::WIDEST_VECTOR;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Affine, NodeId, Op, Reduction, Relation};

/// Longer lists are combined by a generated tree rather than by an expression.
const LONGEST_LIST: usize = 64;

impl Fold {
    pub(super) fn lane_op(&mut self, id: NodeId, op: Op) -> Outcome {
        match op {
            Op::Broadcast { of, axis } => match self.constant(of) {
                Some(value) => Is(Op::Const(value)),
                None => Is(Op::Broadcast { of, axis }),
            },
            Op::Stack { parts, axis } if parts.iter().all(|&part| part == parts[0]) => {
                self.lane_op(id, Op::Broadcast { of: parts[0], axis })
            }
            Op::Map { of, axis, index, edge } => self.map(id, of, axis, index, edge),
            Op::Interleave { parts, .. } if parts.len() == 1 => Same(parts[0]),
            Op::Lane { of, axis, index } => self.lane(of, axis, index),
            Op::Pick { of, axis, index } => self.pick(id, of, axis, index),
            Op::Reduce { by, of, axis } => self.reduce(id, by, of, axis),
            Op::Pack { of, axis } => self.pack(id, of, axis),
            Op::Unpack { of, axis } => self.unpack(id, of, axis),
            other => Is(other),
        }
    }

    fn extent(&self, id: NodeId, axis: u32) -> u32 {
        self.module.shape(id).extent(axis)
    }

    fn map(&mut self, id: NodeId, of: NodeId, axis: u32, index: Affine, edge: Option<NodeId>) -> Outcome {
        let (lanes, extent) = (self.extent(id, axis), self.extent(of, axis));
        let sources: Vec<Option<u32>> = (0..lanes).map(|lane| index.source(lane, extent)).collect();
        if lanes == extent && (0..lanes).zip(&sources).all(|(lane, source)| *source == Some(lane)) {
            return Same(of);
        }
        let beyond = edge.filter(|_| sources.iter().all(Option::is_none));
        if let Some(edge) = beyond {
            return self.lane_op(id, Op::Broadcast { of: edge, axis });
        }
        let from = |lanes: &dyn Fn(u32) -> NodeId| {
            let part = |source: &Option<u32>| source.map_or_else(|| edge.expect("an edge for lanes beyond"), lanes);
            sources.iter().map(part).collect::<Vec<_>>()
        };
        let parts = match &self.module.node(of).op {
            Op::Const(value) if edge.is_none_or(|edge| self.constant(edge).as_ref() == Some(value)) => {
                return Is(Op::Const(value.clone()));
            }
            Op::Broadcast { of: plain, axis: same } if *same == axis => from(&|_| *plain),
            Op::Stack { parts, axis: same } if *same == axis => from(&|lane| parts[lane as usize]),
            _ if self.is_small(lanes, index) => return Is(Op::Map { of, axis, index, edge }),
            // The formula would exceed the 32 bits in which Verilog computes.
            _ => {
                let width = self.width(of);
                let lane = |fold: &mut Self, index: u32| fold.add(id, width, Op::Lane { of, axis, index });
                let edge = || edge.expect("an edge for lanes beyond");
                sources.iter().map(|source| source.map_or_else(edge, |index| lane(self, index))).collect()
            }
        };
        self.lane_op(id, Op::Stack { parts, axis })
    }

    /// Whether every step of the rule fits in 32 bits.
    fn is_small(&self, lanes: u32, index: Affine) -> bool {
        let before = Affine { div: 1, ..index };
        let product = Affine { add: 0, ..before };
        let ends = [before, product].map(|rule| rule.at(lanes - 1));
        ends.into_iter().all(|end| end.unsigned_abs() < 1 << 31) && index.div < 1 << 31
    }

    fn lane(&self, mut of: NodeId, axis: u32, mut index: u32) -> Outcome {
        loop {
            of = match &self.module.node(of).op {
                Op::Broadcast { of: inner, axis: same } if *same == axis => return Same(*inner),
                Op::Stack { parts, axis: same } if *same == axis => return Same(parts[index as usize]),
                Op::Const(value) => return Is(Op::Const(value.clone())),
                Op::Wire(inner) => *inner,
                Op::Map { of: inner, axis: same, index: rule, edge } if *same == axis => {
                    match (rule.source(index, self.extent(*inner, axis)), edge) {
                        (Some(from), _) => index = from,
                        (None, edge) => return Same(edge.expect("an edge for lanes beyond")),
                    }
                    *inner
                }
                _ => return Is(Op::Lane { of, axis, index }),
            }
        }
    }

    fn pick(&self, id: NodeId, of: NodeId, axis: u32, index: NodeId) -> Outcome {
        let Some(value) = self.constant(index) else { return Is(Op::Pick { of, axis, index }) };
        match value.to_u64().and_then(|value| u32::try_from(value).ok()).filter(|lane| *lane < self.extent(of, axis)) {
            Some(lane) => self.lane(of, axis, lane),
            None => Is(Op::Const(Bits::zero(self.width(id)))),
        }
    }

    /// A list of single values is combined by an expression; everything else by a generated tree.
    fn reduce(&mut self, id: NodeId, by: Reduction, of: NodeId, axis: u32) -> Outcome {
        if self.extent(of, axis) == 1 {
            return self.lane(of, axis, 0);
        }
        if let Some(constants) = self.combined_constants(id, by, of, axis) {
            return constants;
        }
        let mut level: Vec<NodeId> = match &self.module.node(of).op {
            Op::Const(value) if !matches!(by, Reduction::Xor | Reduction::Add) => {
                return Is(Op::Const(value.clone()));
            }
            Op::Broadcast { of: inner, axis: same } if *same == axis => vec![*inner; self.extent(of, axis) as usize],
            Op::Stack { parts, axis: same } if *same == axis => parts.clone(),
            _ => Vec::new(),
        };
        if level.is_empty() || level.len() > LONGEST_LIST {
            return self.between_ends(id, by, of, axis).unwrap_or(Is(Op::Reduce { by, of, axis }));
        }
        while level.len() > 1 {
            let pairs: Vec<Vec<NodeId>> = level.chunks(2).map(<[NodeId]>::to_vec).collect();
            level = pairs
                .into_iter()
                .map(|pair| match pair[..] {
                    [a, b] => self.combined(id, by, a, b),
                    _ => pair[0],
                })
                .collect();
        }
        Same(level[0])
    }

    /// Two values combined, at the place of `id`.
    fn combined(&mut self, id: NodeId, by: Reduction, a: NodeId, b: NodeId) -> NodeId {
        let width = self.width(a);
        match by.operator() {
            Some(operator) => self.add(id, width, Op::Binary(operator, a, b)),
            None => {
                let relation = if by == Reduction::Min { Relation::Lt } else { Relation::Gt };
                let first = self.add(id, 1, Op::Compare { relation, signed: false, operands: [a, b] });
                self.add(id, width, Op::Mux { select: first, on_true: a, on_false: b })
            }
        }
    }

    fn pack(&mut self, id: NodeId, of: NodeId, axis: u32) -> Outcome {
        let count = self.extent(of, axis);
        match self.module.node(of).op.clone() {
            _ if count == 1 => self.lane(of, axis, 0),
            Op::Unpack { of: inner, axis: same } if same == axis => Same(inner),
            Op::Const(value) if u64::from(self.width(id)) <= WIDEST_VECTOR => {
                Is(Op::Const(Bits::join(&vec![value; count as usize])))
            }
            Op::Broadcast { of: inner, axis: same } if same == axis => Is(Op::Repeat(inner, count)),
            Op::Stack { parts, axis: same } if same == axis => self.concat(id, parts.into_iter().rev().collect()),
            _ => Is(Op::Pack { of, axis }),
        }
    }

    fn unpack(&mut self, id: NodeId, of: NodeId, axis: u32) -> Outcome {
        let (count, width) = (self.extent(id, axis), self.width(id));
        match &self.module.node(of).op {
            _ if count == 1 => return Is(Op::Broadcast { of, axis }),
            Op::Pack { of: inner, axis: same }
                if *same == axis && self.module.shape(*inner) == self.module.shape(id) =>
            {
                return Same(*inner);
            }
            _ => {}
        }
        let Some(value) = self.constant(of) else { return Is(Op::Unpack { of, axis }) };
        let parts = (0..count)
            .map(|lane| self.add(of, width, Op::Const(value.slice(lane * width..(lane + 1) * width))))
            .collect();
        self.lane_op(id, Op::Stack { parts, axis })
    }
}
