//! The rules of operations that change the shape along an axis.

use super::{Named, Needs, Rules};
use crate::ir::{Affine, Node, NodeId, Op, Shape};

impl Rules<'_> {
    pub(super) fn lane_op(&mut self, node: &Node, owner: Named) {
        let loc = node.loc;
        match &node.op {
            Op::Broadcast { of, axis } => {
                let Some(across) = self.across(node, owner, *axis) else { return };
                self.refers(loc, "the operand", &owner, *of, Needs::of(node.width, across));
            }
            Op::Stack { parts, axis } => {
                let Some(across) = self.across(node, owner, *axis) else { return };
                let (has, needs) = (parts.len(), node.shape.extent(*axis));
                self.rule(has == needs as usize, loc, || format!("{owner} lists {has} signals for {needs} lanes"));
                let part = Needs::of(node.width, across);
                parts.iter().for_each(|id| self.refers(loc, "a lane", &owner, *id, part));
            }
            Op::Map { of, axis, index, edge } => self.map(node, owner, *of, *axis, *index, *edge),
            Op::Interleave { parts, axis } => self.interleave(node, owner, parts, *axis),
            Op::Lane { of, axis, index } => {
                let Some(count) = self.drops(node, owner, *of, *axis) else { return };
                self.same_width(node, owner, *of);
                self.rule(*index < count, loc, || format!("{owner} is lane {index} of {count}"));
            }
            Op::Pick { of, axis, index } => {
                if self.drops(node, owner, *of, *axis).is_some() {
                    self.same_width(node, owner, *of);
                }
                self.refers(loc, "the index", &owner, *index, Needs::shape(node.shape));
            }
            Op::Reduce { of, axis, .. } => {
                if self.drops(node, owner, *of, *axis).is_some() {
                    self.same_width(node, owner, *of);
                }
            }
            Op::Pack { of, axis } => {
                let Some(count) = self.drops(node, owner, *of, *axis) else { return };
                let width = u64::from(self.module.node(*of).width) * u64::from(count);
                self.has_width(node, owner, width, "its lanes side by side have");
            }
            Op::Unpack { of, axis } => {
                let Some(across) = self.across(node, owner, *axis) else { return };
                self.refers(loc, "the operand", &owner, *of, Needs::shape(across));
                let Some(operand) = self.module.nodes.get(of.0 as usize) else { return };
                let (has, count) = (operand.width, node.shape.extent(*axis));
                let needs = u64::from(node.width) * u64::from(count);
                self.rule(u64::from(has) == needs, loc, || {
                    format!("{owner} unpacks {has} bits into {count} lanes of {}, which have {needs}", node.width)
                });
            }
            _ => unreachable!("the other operations are elementwise"),
        }
    }

    fn map(&mut self, node: &Node, owner: Named, of: NodeId, axis: u32, index: Affine, edge: Option<NodeId>) {
        let loc = node.loc;
        let Some(across) = self.across(node, owner, axis) else { return };
        let Some(shape) = self.operand_shape(node, owner, of) else { return };
        let (count, extent) = (node.shape.extent(axis), shape.extent(axis));
        // Only the extent may differ.
        let needs = if axis < shape.axes() { across.with(axis, extent) } else { None };
        self.refers(loc, "the operand", &owner, of, Needs::of(node.width, needs.unwrap_or(node.shape)));
        if index.div == 0 {
            return self.report(loc, format!("{owner} divides lane numbers by 0"));
        }
        let lanes = || format!("{count} lanes from {extent}");
        match edge {
            None => self.rule(index.stays_inside(count, extent), loc, || {
                format!("{owner} takes {}, some from beyond the ends, but has no edge", lanes())
            }),
            Some(edge) => {
                self.rule(!index.stays_inside(count, extent), loc, || {
                    format!("{owner} takes {}, none from beyond the ends, but has an edge", lanes())
                });
                self.refers(loc, "the edge", &owner, edge, Needs::of(node.width, across));
            }
        }
    }

    fn interleave(&mut self, node: &Node, owner: Named, parts: &[NodeId], axis: u32) {
        let Some(across) = self.across(node, owner, axis) else { return };
        let (count, k) = (node.shape.extent(axis), parts.len());
        let fits = k > 0 && (count as usize).is_multiple_of(k);
        self.rule(fits, node.loc, || format!("{owner} has {count} lanes, which {k} parts cannot share evenly"));
        if fits && let Some(part) = across.with(axis, count / k as u32) {
            parts.iter().for_each(|id| self.refers(node.loc, "a part", &owner, *id, Needs::of(node.width, part)));
        }
    }

    /// Checks that the node has that axis; returns its shape without the axis.
    fn across(&mut self, node: &Node, owner: Named, axis: u32) -> Option<Shape> {
        let shape = node.shape;
        let has = axis < shape.axes();
        self.rule(has, node.loc, || format!("{owner} is laid out along axis {axis}, but has {shape}"));
        has.then(|| shape.without(axis))
    }

    /// Checks that the operand has that axis and otherwise the node's shape; returns its number of lanes along the
    /// axis.
    fn drops(&mut self, node: &Node, owner: Named, of: NodeId, axis: u32) -> Option<u32> {
        let shape = self.operand_shape(node, owner, of)?;
        let (has, left) = (axis < shape.axes(), shape.without(axis));
        let text = self.node(of);
        self.rule(has, node.loc, || format!("{owner} goes along axis {axis} of {text}, which has {shape}"));
        if !has {
            return None;
        }
        self.rule(left == node.shape, node.loc, || {
            format!("{owner} has {}, but {text} without axis {axis} has {left}", node.shape)
        });
        Some(shape.extent(axis))
    }

    fn same_width(&mut self, node: &Node, owner: Named, of: NodeId) {
        self.refers(node.loc, "the operand", &owner, of, Needs::of(node.width, self.module.shape(of)));
    }

    /// The shape of the operand, which must exist.
    fn operand_shape(&mut self, node: &Node, owner: Named, of: NodeId) -> Option<Shape> {
        match self.module.nodes.get(of.0 as usize) {
            Some(operand) => Some(operand.shape),
            None => {
                self.refers(node.loc, "the operand", &owner, of, Needs::shape(node.shape));
                None
            }
        }
    }
}
