//! Lanes: what is picked or combined of them becomes plain, unless it is an output of an array.

use super::Fold;
use super::Outcome::{self, Op as Is, Same};
use tilewright_hdl::ir::{NodeId, Op, Reduction};

impl Fold {
    pub(super) fn lane(&self, of: NodeId, lane: u32) -> Outcome {
        match self.module.node(of).op.clone() {
            Op::Broadcast { of: plain, .. } => Same(plain),
            Op::Stack { parts, .. } => Same(parts[lane as usize]),
            Op::Wire(inner) => self.lane(inner, lane),
            Op::Map { of: inner, index, edge: Some(edge), .. } => {
                let by = -index.add;
                let lanes = self.module.node(of).shape.lanes();
                match source_lane(lane, by, lanes) {
                    Some(from) => self.lane(inner, from),
                    None => Same(edge),
                }
            }
            _ => Is(Op::Lane { of, axis: 0, index: lane }),
        }
    }

    /// A lane of a shifted value whose lanes are plain nodes.
    pub(super) fn shifted_lane(&self, of: NodeId, lane: u32, by: i32, edge: NodeId, lanes: u32) -> NodeId {
        match source_lane(lane, by, lanes).map(|from| self.lane(of, from)) {
            Some(Same(plain)) => plain,
            _ => edge,
        }
    }

    /// Only outputs of arrays are reduced by the array's own tree; anything else is written out lane by lane.
    pub(super) fn reduce(&mut self, id: NodeId, reduction: Reduction, of: NodeId) -> Outcome {
        let node = self.module.node(of);
        let lanes = node.shape.lanes();
        if lanes > 1 && matches!(node.op, Op::Output(..)) {
            return Is(Op::Reduce { by: reduction, of, axis: 0 });
        }
        let (width, binary) = (node.width, reduction.operator().expect("the language makes no other yet"));
        let mut level: Vec<NodeId> =
            (0..lanes).map(|lane| self.add(id, width, Op::Lane { of, axis: 0, index: lane })).collect();
        while level.len() > 1 {
            let pairs: Vec<Vec<NodeId>> = level.chunks(2).map(<[NodeId]>::to_vec).collect();
            level = pairs
                .into_iter()
                .map(|pair| match pair[..] {
                    [a, b] => self.add(id, width, Op::Binary(binary, a, b)),
                    _ => pair[0],
                })
                .collect();
        }
        Same(level[0])
    }
}

/// The lane that reaches `lane` when all move by `by`.
fn source_lane(lane: u32, by: i32, lanes: u32) -> Option<u32> {
    u32::try_from(i64::from(lane) - i64::from(by)).ok().filter(|&from| from < lanes)
}
