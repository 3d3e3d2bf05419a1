//! The rules of what holds state, and of assertions.

use super::{Needs, Rules};
use crate::ir::{Contents, Memory, MemoryId, NodeId, Op, RegisterId};
use crate::limits::WIDEST;
use crate::loc::Loc;
use crate::names::is_legal;
use crate::signal::bits_text;
use crate::width::index_width;
use std::fmt;

impl Rules<'_> {
    /// `owner` is node `id`, whose operator is to be `op`; the node's width and place.
    pub(super) fn is_node(&mut self, loc: Loc, owner: &dyn fmt::Display, id: NodeId, op: &Op) -> Option<(u32, Loc)> {
        match self.module.nodes.get(id.0 as usize) {
            Some(node) if node.op == *op => return Some((node.width, node.loc)),
            Some(_) => self.report(loc, format!("{owner} has node {}, which is something else", id.0)),
            None => self.report(loc, format!("{owner} has node {} of {}", id.0, self.module.nodes.len())),
        }
        None
    }

    pub(super) fn registers(&mut self) {
        for (index, register) in (0..).zip(&self.module.registers) {
            let owner = self.of(&format!("register {index}"));
            let op = Op::Register(RegisterId(index));
            let Some((width, loc)) = self.is_node(self.module.loc, &owner, register.node, &op) else { continue };
            let owner = self.node(register.node);
            let has_name = self.module.node(register.node).name.is_some();
            self.rule(has_name, loc, || format!("{owner} is a register without a name"));
            self.clock(loc, &owner, register.clock);
            self.refers(loc, "the next value", &owner, register.next, Needs::plain(width));
            if let Some(enable) = register.enable {
                self.refers(loc, "the enable", &owner, enable, Needs::plain(1));
            }
            if let Some(reset) = &register.reset {
                self.rule(reset.width() == width, loc, || {
                    format!("the reset value of {owner} has {}, not {width}", bits_text(reset.width()))
                });
                let clock = self.module.clocks.get(register.clock.0 as usize);
                self.rule(clock.is_none_or(|clock| clock.reset.is_some()), loc, || {
                    format!("{owner} has a reset value, but its clock has no reset port")
                });
            }
            if let Some(states) = &register.states {
                let fits = !states.names.is_empty() && index_width(states.names.len() as u64) <= width;
                let count = states.names.len();
                self.rule(fits, loc, || format!("{owner} has {count} states, which do not fit into {width} bits"));
                let illegal = states.names.iter().chain([&states.name]).find(|name| !is_legal(name));
                self.rule(illegal.is_none(), loc, || format!("{owner} has a state whose name is not legal"));
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
            let address = Needs::plain(index_width(memory.depth.into()));
            for (port, read) in (0..).zip(&memory.reads) {
                let owner = format!("read port {port} of {owner}");
                let node = self.is_node(loc, &owner, read.node, &Op::Read(index, port));
                self.rule(node.is_none_or(|(width, _)| width == memory.width), loc, || {
                    format!("the data of {owner} is not as wide as a word, which has {}", bits_text(memory.width))
                });
                self.refers(loc, "the address", &owner, read.address, address);
                read.clock.into_iter().for_each(|clock| self.clock(loc, &owner, clock));
                if let Some(enable) = read.enable {
                    self.refers(loc, "the enable", &owner, enable, Needs::plain(1));
                    self.rule(read.clock.is_some(), loc, || format!("{owner} is asynchronous but has an enable"));
                }
            }
            for (port, write) in memory.writes.iter().enumerate() {
                let owner = format!("write port {port} of {owner}");
                self.clock(loc, &owner, write.clock);
                self.refers(loc, "the enable", &owner, write.enable, Needs::plain(1));
                self.refers(loc, "the address", &owner, write.address, address);
                self.refers(loc, "the data", &owner, write.data, Needs::plain(memory.width));
            }
        }
    }

    fn contents(&mut self, memory: &Memory, owner: &str) {
        let words = match &memory.contents {
            Contents::Unknown => &[],
            Contents::Fill(word) => std::slice::from_ref(word),
            Contents::Words(words) => words.as_slice(),
        };
        let (loc, count) = (memory.loc, words.len());
        self.rule(count <= memory.depth as usize, loc, || {
            format!("memory {owner} has {} words, but contents of {count}", memory.depth)
        });
        let wrong = words.iter().find(|word| word.width() != memory.width);
        self.rule(wrong.is_none(), loc, || {
            format!("the contents of memory {owner} are not as wide as a word, which has {}", bits_text(memory.width))
        });
    }

    pub(super) fn asserts(&mut self) {
        for assert in &self.module.asserts {
            let owner = format!("an assertion in `{}`", self.module.name);
            self.clock(assert.loc, &owner, assert.clock);
            self.refers(assert.loc, "the condition", &owner, assert.condition, Needs::plain(1));
        }
    }
}
