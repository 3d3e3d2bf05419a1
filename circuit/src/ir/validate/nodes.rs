//! The rules of elementwise operations: the requirements on their operands, lane by lane.

use super::{Named, Needs, Rules};
use crate::ir::{Binary, InstanceId, Kind, Names, Node, NodeId, Op, RegisterId, Unary};
use crate::limits::WIDEST;
use crate::loc::Loc;
use crate::names::bits_text;
use crate::names::is_legal;
use std::collections::HashSet;
use std::fmt;

impl Rules<'_> {
    pub(super) fn nodes(&mut self) {
        for (id, node) in (0..).map(NodeId).zip(&self.module.nodes) {
            let owner = self.node(id);
            self.rule((1..=WIDEST).contains(&node.width), node.loc, || {
                format!("{owner} has {}, not 1 to {WIDEST}", bits_text(node.width))
            });
            self.rule(node.shape.lanes() > 0, node.loc, || format!("{owner} needs at least 1 lane"));
            if let Kind::Code(names) = node.kind {
                self.codes(node.loc, node.width, names);
            }
            self.op(id, node, owner);
        }
    }

    /// Checks that the codes of an enum fit in the width, differ and have legal names.
    pub(super) fn codes(&mut self, loc: Loc, width: u32, names: Names) {
        let (count, numbers) = (names.codes.len(), names.values.len());
        self.rule(count > 0 && count == numbers, loc, || {
            format!("`{}` has {count} codes with {numbers} numbers, not one for each", names.of)
        });
        self.rule(names.width() <= width, loc, || {
            format!("`{}` has codes of {}, which do not fit into {width}", names.of, bits_text(names.width()))
        });
        let twice = names.values.iter().enumerate().find(|(place, value)| names.place(**value) != Some(*place));
        self.rule(twice.is_none(), loc, || {
            format!("`{}` has two codes whose number is {}", names.of, twice.map_or(0, |(_, value)| *value))
        });
        let illegal = names.codes.iter().chain([&names.of]).find(|name| !is_legal(name));
        self.rule(illegal.is_none(), loc, || {
            format!("`{}` has a code whose name is not legal: `{}`", names.of, illegal.copied().unwrap_or_default())
        });
    }

    fn op(&mut self, id: NodeId, node: &Node, owner: Named) {
        let (width, loc, module) = (node.width, node.loc, self.module);
        let width_of = |id: NodeId| module.nodes.get(id.0 as usize).map_or(0, |node| u64::from(node.width));
        let (same, alike, bit) = (Needs::of(width, node.shape), Needs::shape(node.shape), Needs::of(1, node.shape));
        match &node.op {
            Op::Input(port) => {
                let there = module.inputs.get(*port as usize).map(|input| input.node);
                self.linked(id, node, there, &format_args!("input {port}"));
            }
            Op::Register(RegisterId(register)) => {
                let there = module.registers.get(*register as usize).map(|register| register.node);
                self.linked(id, node, there, &format_args!("register {register}"));
            }
            Op::Read(memory, port) => {
                let memory_there = module.memories.get(memory.0 as usize);
                let there = memory_there.and_then(|memory| memory.reads.get(*port as usize)).map(|read| read.node);
                self.linked(id, node, there, &format_args!("read port {port} of memory {}", memory.0));
            }
            Op::Output(InstanceId(instance), port) => {
                let instance_there = module.instances.get(*instance as usize);
                let there = instance_there.and_then(|instance| instance.outputs.get(*port as usize)).copied();
                self.linked(id, node, there, &format_args!("output {port} of instance {instance}"));
            }
            Op::Const(bits) => self.has_width(node, owner, bits.width().into(), "its constant has"),
            Op::Unary(Unary::Not, a) => self.refers(loc, "the operand", &owner, *a, same),
            Op::Unary(_, a) => {
                self.has_width(node, owner, 1, "its operator gives");
                self.refers(loc, "the operand", &owner, *a, alike);
            }
            Op::Binary(Binary::Mul | Binary::MulSigned, a, b) => {
                [a, b].into_iter().for_each(|id| self.refers(loc, "an operand", &owner, *id, alike));
                self.has_width(node, owner, width_of(*a) + width_of(*b), "its product has");
            }
            Op::Binary(_, a, b) => [a, b].into_iter().for_each(|id| self.refers(loc, "an operand", &owner, *id, same)),
            Op::Compare { operands: [a, b], .. } => {
                self.has_width(node, owner, 1, "its comparison gives");
                self.refers(loc, "the left operand", &owner, *a, alike);
                self.refers(loc, "the right operand", &owner, *b, Needs::of(width_of(*a) as u32, node.shape));
            }
            Op::Shift(_, a, amount) => {
                self.refers(loc, "the operand", &owner, *a, same);
                self.refers(loc, "the amount", &owner, *amount, alike);
            }
            Op::Mux { select, on_true, on_false } => {
                self.refers(loc, "the select", &owner, *select, bit);
                [on_true, on_false].into_iter().for_each(|id| self.refers(loc, "a value", &owner, *id, same));
            }
            Op::Select { arms, default } => {
                for (condition, value) in arms {
                    self.refers(loc, "a condition", &owner, *condition, bit);
                    self.refers(loc, "a value", &owner, *value, same);
                }
                self.refers(loc, "the default", &owner, *default, same);
            }
            Op::Case { subject, arms, default } => {
                self.refers(loc, "the subject", &owner, *subject, alike);
                let mut keys = HashSet::with_capacity(arms.len());
                for (key, value) in arms {
                    let needed = width_of(*subject);
                    self.rule(u64::from(key.width()) == needed, loc, || {
                        format!("the key {key} of {owner} is not as wide as its subject, which has {needed} bits")
                    });
                    self.rule(keys.insert(key), loc, || format!("the key {key} of {owner} occurs twice"));
                    self.refers(loc, "a value", &owner, *value, same);
                }
                self.refers(loc, "the default", &owner, *default, same);
            }
            Op::Slice { of, low } => {
                self.refers(loc, "the operand", &owner, *of, alike);
                let (high, has) = (u64::from(*low) + u64::from(width), width_of(*of));
                self.rule(high <= has, loc, || format!("{owner} is the slice {low}..{high} of {has} bits"));
            }
            Op::Concat(parts) => {
                parts.iter().for_each(|id| self.refers(loc, "a part", &owner, *id, alike));
                self.has_width(node, owner, parts.iter().map(|id| width_of(*id)).sum(), "its parts have");
            }
            Op::Repeat(of, times) => {
                self.refers(loc, "the operand", &owner, *of, alike);
                self.has_width(node, owner, width_of(*of) * u64::from(*times), "its repetition has");
            }
            Op::Extend { of, .. } => {
                self.refers(loc, "the operand", &owner, *of, alike);
                let has = width_of(*of);
                self.rule(has < width.into(), loc, || format!("{owner} extends {has} bits to {width}"));
            }
            Op::Wire(of) | Op::QuasiStatic(of, _) => self.refers(loc, "the driver", &owner, *of, same),
            _ => self.lane_op(node, owner),
        }
    }

    /// Checks that the node has the width of its result.
    pub(super) fn has_width(&mut self, node: &Node, owner: Named, width: u64, what: &str) {
        self.rule(width == node.width.into(), node.loc, || {
            format!("{owner} has {}, but {what} {width}", bits_text(node.width))
        });
    }

    /// Checks that the object that a node refers to refers back to the node.
    fn linked(&mut self, id: NodeId, node: &Node, there: Option<NodeId>, what: &dyn fmt::Display) {
        let owner = self.node(id);
        match there {
            None => self.report(node.loc, format!("{owner} is {what}, which does not exist")),
            Some(other) if other != id => {
                self.report(node.loc, format!("{owner} is {what}, whose node is node {}", other.0));
            }
            Some(_) => {}
        }
    }
}
