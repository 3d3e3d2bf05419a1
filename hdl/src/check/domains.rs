//! Paths from one clock domain to another that bypass every declared crossing.

use crate::draft::Draft;
use crate::names::port_name;
use crate::summary::{self, Summary, View};
use std::collections::BTreeSet;
use tilewright_circuit::graph::Sets;
use tilewright_circuit::ir::{ClockId, Module, NodeId};
use tilewright_circuit::{Mistake, Problem};

/// Returns the outputs that mix clocks.
pub(crate) fn check(
    draft: &Draft,
    done: &[Module],
    summaries: &[Summary],
    outputs: &[(String, NodeId)],
    problems: &mut Vec<Problem>,
) -> Vec<usize> {
    if draft.clocks.len() < 2 {
        return Vec::new();
    }
    let timed = summary::timed(draft, summaries);
    let sets = summary::clock_sets(draft, summaries, View::Inside, &timed);
    let inputs = summary::input_sets(draft, &timed);
    let mut checker = Checker { draft, summaries, sets, inputs, without_clock: BTreeSet::new(), problems };
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
    for part in draft.parts.iter().filter(|part| part.reaches) {
        checker.sampled(part.enable, part.clock, "an `enabled`", part.enable);
    }
    for property in draft.properties.iter().map(|draft| &draft.property) {
        for node in property.nodes() {
            checker.sampled(node, property.clock, property.directive.noun(), node);
        }
    }
    let mixed = outputs.iter().enumerate().filter(|(_, (path, node))| checker.mixes(path, *node));
    mixed.map(|(output, _)| output).collect()
}

struct Checker<'a> {
    draft: &'a Draft,
    summaries: &'a [Summary],
    sets: Sets,
    /// The inputs whose clocks are visible in each node.
    inputs: Sets,
    /// Sampled inputs without a known clock that have been reported.
    without_clock: BTreeSet<usize>,
    problems: &'a mut Vec<Problem>,
}

impl Checker<'_> {
    /// Records that `what` samples `node` at edges of `clock`.
    fn sampled(&mut self, node: NodeId, clock: ClockId, what: &str, place: NodeId) {
        let inputs: Vec<_> = self.inputs.members(node.0).collect();
        inputs.into_iter().for_each(|input| self.needs_clock(input, clock, what, place));
        let foreign: Vec<_> = self.sets.members(node.0).filter(|&from| from != clock.0 as usize).collect();
        for from in foreign {
            let source = self.source(node, from);
            let (text, to) = (self.draft.describe(source), self.draft.clock_name(clock));
            let from = self.draft.clock_name(ClockId(from as u32));
            let message =
                format!("`{text}` is on clock `{from}` but reaches {what} on clock `{to}` without a crossing");
            let problem = Problem::new(Mistake::Crossing, self.draft.node(place).loc, message)
                .note(format!("`{text}` is declared"), self.draft.node(source).loc)
                .help("cross with `m.synchronize`, a memory with a port on each clock, or `.quasi_static(reason)`; an input of another clock is declared `bits(n).on(clock)`");
            if !self.problems.contains(&problem) {
                self.problems.push(problem);
            }
        }
    }

    /// Records that `what` samples input `input` at edges of `clock`: the input's own clock must be known.
    fn needs_clock(&mut self, input: usize, clock: ClockId, what: &str, place: NodeId) {
        let port = &self.draft.inputs[input];
        if port.clock.is_some() || !self.without_clock.insert(input) {
            return;
        }
        let used = (0..self.draft.clocks.len()).filter(|clock| self.draft.clock_used[*clock]);
        let clocks: Vec<_> = used.map(|clock| format!("`{}`", self.draft.clock_name(ClockId(clock as u32)))).collect();
        let (name, block) = (&port.name, self.draft.block);
        let message = format!("input `{name}` of `{block}` does not say on which clock it is: {}", clocks.join(" or "));
        let sampled = format!("{what} on clock `{}` takes it", self.draft.clock_name(clock));
        let problem = Problem::new(Mistake::UnknownClock, self.draft.node(port.node).loc, message)
            .note(sampled, self.draft.node(place).loc)
            .help("declare it as `bits(n).on(clock)`; only a block with a clock of its own may leave that out");
        self.problems.push(problem);
    }

    /// Whether an output depends on several clocks, which is a problem.
    fn mixes(&mut self, path: &str, node: NodeId) -> bool {
        let clocks: Vec<_> = self.sets.members(node.0).collect();
        let [first, second, ..] = clocks[..] else { return false };
        let name = |clock: usize| self.draft.clock_name(ClockId(clock as u32));
        let (output, block) = (port_name("", path), self.draft.block);
        let message = format!("output `{output}` of `{block}` mixes clocks `{}` and `{}`", name(first), name(second));
        let mut problem = Problem::new(Mistake::MixedClocks, self.draft.node(node).loc, message);
        for clock in [first, second] {
            let source = self.source(node, clock);
            let text = format!("`{}`, on clock `{}`, is declared", self.draft.describe(source), name(clock));
            problem = problem.note(text, self.draft.node(source).loc);
        }
        self.problems.push(problem.help(
            "give each clock an output of its own, or cross with `m.synchronize` or `.quasi_static(reason)` before",
        ));
        true
    }

    /// The nearest node behind `node` at which clock `from` enters.
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
