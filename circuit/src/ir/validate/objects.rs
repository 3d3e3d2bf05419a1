//! The rules of registers, memories and properties.

use super::{Needs, Rules};
use crate::bits::Bits;
use crate::bits::index_width;
use crate::ir::{
    Attribute, Contents, Directive, Init, Kind, Memory, MemoryId, Node, NodeId, Op, Piece, ReadUnderWrite, RegisterId,
    Shape,
};
use crate::limits::WIDEST;
use crate::loc::Loc;
use crate::names::bits_text;
use crate::names::{is_legal, is_reserved};
use crate::reset::Reset;
use std::fmt;

impl<'a> Rules<'a> {
    /// Checks that `owner` is node `id` with the operator `op`; returns the node.
    pub(super) fn is_node(&mut self, loc: Loc, owner: &dyn fmt::Display, id: NodeId, op: &Op) -> Option<&'a Node> {
        match self.module.nodes.get(id.0 as usize) {
            Some(node) if node.op == *op => return Some(node),
            Some(_) => self.report(loc, format!("{owner} has node {}, which is something else", id.0)),
            None => self.report(loc, format!("{owner} has node {} of {}", id.0, self.module.nodes.len())),
        }
        None
    }

    pub(super) fn registers(&mut self) {
        for (index, register) in (0..).zip(&self.module.registers) {
            let name = format_args!("register {index}");
            let owner = self.of(name);
            let op = Op::Register(RegisterId(index));
            let Some(node) = self.is_node(self.module.loc, &owner, register.node, &op) else { continue };
            let &Node { width, shape, loc, .. } = node;
            let owner = self.node(register.node);
            let has_name = self.module.node(register.node).name.is_some();
            self.rule(has_name, loc, || format!("{owner} is a register without a name"));
            self.clock(loc, &owner, register.clock);
            self.refers(loc, "the next value", &owner, register.next, Needs::of(width, shape));
            if let Some(enable) = register.enable {
                self.refers(loc, "the enable", &owner, enable, Needs::of(1, shape));
            }
            if let Some(initial) = &register.initial {
                let has = bits_text(initial.width());
                self.rule(initial.width() == width, loc, || {
                    format!("the initial value of {owner} has {has}, not {width}")
                });
            }
            self.attributes(&register.attributes, loc, &owner);
            if let Some(reset) = &register.reset {
                self.init(reset, node, &owner);
                let clock = self.module.clocks.get(register.clock.0 as usize);
                self.rule(clock.is_none_or(|clock| clock.reset.is_some() || clock.kind == Reset::PowerOn), loc, || {
                    format!("{owner} has a reset value, but its clock has no reset port")
                });
            }
        }
    }

    pub(super) fn memories(&mut self) {
        for (index, memory) in (0..).map(MemoryId).zip(&self.module.memories) {
            let (owner, loc) = (self.of(&memory.name), memory.loc);
            self.rule(memory.depth > 0, loc, || format!("memory {owner} has no words"));
            self.rule((1..=WIDEST).contains(&memory.width), loc, || {
                format!("memory {owner} has words of {}, not 1 to {WIDEST}", bits_text(memory.width))
            });
            self.contents(memory, &owner);
            self.attributes(&memory.attributes, loc, &format_args!("memory {owner}"));
            self.rule(memory.shape.lanes() > 0, loc, || format!("memory {owner} needs at least 1 lane"));
            let address = Needs::of(index_width(memory.depth.into()), memory.shape);
            let (bit, word) = (Needs::of(1, memory.shape), Needs::of(memory.width, memory.shape));
            for (port, read) in (0..).zip(&memory.reads) {
                let owner = format_args!("read port {port} of {owner}");
                if self.is_node(loc, &owner, read.node, &Op::Read(index, port)).is_some() {
                    self.refers(loc, "the data", &owner, read.node, word);
                }
                self.refers_or_plain(loc, "the address", &owner, read.address, address);
                read.clock.into_iter().for_each(|clock| self.clock(loc, &owner, clock));
                self.rule(read.clock.is_none() || memory.policy != ReadUnderWrite::New, loc, || {
                    format!("{owner} is synchronous, but gives the word that is written: that is a register beside it")
                });
                if let Some(enable) = read.enable {
                    self.refers_or_plain(loc, "the enable", &owner, enable, bit);
                    self.rule(read.clock.is_some(), loc, || format!("{owner} is asynchronous but has an enable"));
                }
            }
            for (port, write) in memory.writes.iter().enumerate() {
                let owner = format_args!("write port {port} of {owner}");
                self.clock(loc, &owner, write.clock);
                self.refers_or_plain(loc, "the enable", &owner, write.enable, bit);
                self.refers_or_plain(loc, "the address", &owner, write.address, address);
                self.refers(loc, "the data", &owner, write.data, word);
            }
        }
    }

    /// Checks the reset values of a register.
    fn init(&mut self, reset: &Init, node: &Node, owner: &dyn fmt::Display) {
        let values = match reset {
            Init::Same(value) => std::slice::from_ref(value),
            Init::Each(values) => values.as_slice(),
        };
        if let Some(wrong) = values.iter().find(|value| value.width() != node.width) {
            let has = bits_text(wrong.width());
            self.report(node.loc, format!("the reset value of {owner} has {has}, not {}", node.width));
        }
        if let Init::Each(values) = reset {
            let fits = !node.shape.is_plain() && values.len() == node.shape.lanes() as usize;
            let count = values.len();
            self.rule(fits, node.loc, || format!("{owner} has {}, but {count} reset values", node.shape));
        }
    }

    fn contents(&mut self, memory: &Memory, owner: &dyn fmt::Display) {
        let loc = memory.loc;
        let lanes: Vec<&[Bits]> = match &memory.contents {
            Contents::Unknown => Vec::new(),
            Contents::Fill(word) => vec![std::slice::from_ref(word)],
            Contents::Words(words) => vec![words],
            Contents::Each(lanes) => {
                let fits = !memory.shape.is_plain() && lanes.len() == memory.shape.lanes() as usize;
                let count = lanes.len();
                self.rule(fits, loc, || format!("memory {owner} has {}, but contents of {count}", memory.shape));
                lanes.iter().map(Vec::as_slice).collect()
            }
        };
        let count = lanes.iter().map(|words| words.len()).max().unwrap_or(0);
        self.rule(count <= memory.depth as usize, loc, || {
            format!("memory {owner} has {} words, but contents of {count}", memory.depth)
        });
        let wrong = lanes.into_iter().flatten().find(|word| word.width() != memory.width);
        self.rule(wrong.is_none(), loc, || {
            format!("the contents of memory {owner} are not as wide as a word, which has {}", bits_text(memory.width))
        });
    }

    pub(super) fn properties(&mut self) {
        for property in &self.module.properties {
            let owner = format_args!("a property of `{}`", self.module.name);
            self.clock(property.loc, &owner, property.clock);
            let shape = self.module.nodes.get(property.condition.0 as usize).map_or(Shape::Plain, |node| node.shape);
            self.refers(property.loc, "the condition", &owner, property.condition, Needs::of(1, shape));
            for shown in &property.values {
                self.refers(property.loc, "a value", &owner, shown.node, Needs::shape(shape));
                if let (Kind::Code(names), Some(node)) = (shown.kind, self.module.nodes.get(shown.node.0 as usize)) {
                    self.codes(property.loc, node.width, names);
                }
            }
            let places =
                Piece::of(&property.message).map(|it| it.iter().filter(|it| matches!(it, Piece::Value(_))).count());
            let is_sound = match property.directive {
                Directive::Display => places == Ok(property.values.len()),
                _ => property.values.is_empty(),
            };
            self.rule(is_sound, property.loc, || format!("the text of {owner} does not show its values"));
        }
    }

    /// Checks that attribute names are legal in Verilog.
    fn attributes(&mut self, attributes: &[Attribute], loc: Loc, owner: &dyn fmt::Display) {
        for attribute in attributes {
            let message = || format!("{owner} has the attribute `{}`, which is not a plain name", attribute.name);
            self.rule(is_legal(&attribute.name) && !is_reserved(&attribute.name), loc, message);
        }
    }
}
