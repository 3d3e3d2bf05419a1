//! Paths from one clock domain into another that do not go through a declared crossing.

use crate::draft::Draft;
use crate::graph::Sets;
use crate::ir::{ClockId, Module, NodeId};
use crate::problem::Problem;
use crate::summary::{self, Summary, View};

pub(crate) fn check(draft: &Draft, done: &[Module], summaries: &[Summary], problems: &mut Vec<Problem>) {
    if draft.clocks.len() < 2 {
        return;
    }
    let sets = summary::clock_sets(draft, summaries, View::Inside);
    let mut checker = Checker { draft, summaries, sets, problems };
    for register in &draft.registers {
        let name = draft.describe(register.node);
        for (node, _) in register.next.iter().chain(&register.enable) {
            checker.sampled(*node, register.clock, &format!("register `{name}`"), register.node);
        }
    }
    for memory in draft.memories.iter().map(|draft| &draft.memory) {
        let what = format!("memory `{}`", memory.name);
        for read in &memory.reads {
            for node in read.enable.into_iter().chain([read.address]) {
                read.clock.into_iter().for_each(|clock| checker.sampled(node, clock, &what, read.node));
            }
        }
        for write in &memory.writes {
            for node in [write.enable, write.address, write.data] {
                checker.sampled(node, write.clock, &what, node);
            }
        }
    }
    for instance in &draft.instances {
        let child = &done[instance.module.0 as usize];
        for (input, driver) in child.inputs.iter().zip(&instance.inputs) {
            let Some(clock) = input.clock else { continue };
            let what = format!("input `{}` of `{}`", input.name, instance.name);
            checker.sampled(*driver, instance.clocks[clock.0 as usize], &what, *driver);
        }
    }
    for assert in &draft.asserts {
        checker.sampled(assert.condition, assert.clock, "an assertion", assert.condition);
    }
}

struct Checker<'a> {
    draft: &'a Draft,
    summaries: &'a [Summary],
    sets: Sets,
    problems: &'a mut Vec<Problem>,
}

impl Checker<'_> {
    /// `node` is sampled by `what` at edges of `clock`.
    fn sampled(&mut self, node: NodeId, clock: ClockId, what: &str, place: NodeId) {
        let foreign: Vec<_> = self.sets.members(node.0).filter(|&from| from != clock.0 as usize).collect();
        for from in foreign {
            let source = self.source(node, from);
            let (text, to) = (self.draft.describe(source), self.draft.clock_name(clock));
            let from = self.draft.clock_name(ClockId(from as u32));
            let message =
                format!("`{text}` is on clock `{from}` but reaches {what} on clock `{to}` without a crossing");
            let problem = Problem::new(self.draft.node(place).loc, message)
                .note(format!("`{text}` is declared"), self.draft.node(source).loc)
                .help("cross with `m.synchronize`, a memory with a port on each clock, or `.quasi_static(reason)`; an input of another clock is declared `bits(n).on(clock)`");
            if !self.problems.contains(&problem) {
                self.problems.push(problem);
            }
        }
    }

    /// The nearest node behind `node` where clock `from` comes in.
    fn source(&self, node: NodeId, from: usize) -> NodeId {
        let mut at = node;
        let mut seen = std::collections::BTreeSet::new();
        while seen.insert(at) {
            let mut behind = None;
            summary::operands(self.draft, self.summaries, at, &mut |operand| {
                if behind.is_none()
                    && !seen.contains(&operand)
                    && self.sets.members(operand.0).any(|clock| clock == from)
                {
                    behind = Some(operand);
                }
            });
            at = behind.unwrap_or(at);
        }
        at
    }
}
