//! Puts the enables of a module's parts before all that is clocked in them.

use super::PartId;
use crate::draft::Draft;
use crate::past::only_where;
use std::collections::HashMap;
use tilewright_circuit::ir::{Binary, ClockId, Module, NodeId, Op, Shape};
use tilewright_circuit::{Bits, Loc, Mistake, Problem};

/// Enables registers, memory ports, instances and properties of a finished description by the parts that they are in.
pub(crate) fn apply(
    draft: &mut Draft,
    done: &[Module],
    enables: &[Vec<Option<&'static str>>],
    problems: &mut Vec<Problem>,
) {
    if draft.parts.is_empty() && draft.enables.is_empty() {
        return;
    }
    let mut gates = Gates { draft, problems, known: HashMap::new(), spread: HashMap::new() };
    gates.registers();
    gates.memories();
    gates.properties();
    gates.instances(done, enables);
}

struct Gates<'a> {
    draft: &'a mut Draft,
    problems: &'a mut Vec<Problem>,
    /// The enable of a clock in a part, if there is one.
    known: HashMap<(Option<PartId>, ClockId), Option<NodeId>>,
    /// Enables that are repeated in the lanes of a shape.
    spread: HashMap<(NodeId, Shape), NodeId>,
}

impl Gates<'_> {
    fn registers(&mut self) {
        for index in 0..self.draft.registers.len() {
            let register = &self.draft.registers[index];
            let (node, enable) = (register.node, register.enable);
            let Some(gate) = self.gate(register.part, register.clock) else { continue };
            let Some(gate) = self.fit(gate, node, |draft| format!("register `{}`", draft.describe(node))) else {
                continue;
            };
            let (gate, loc) = (self.and(enable.map(|(own, _)| own), gate), self.draft.node(gate).loc);
            self.draft.registers[index].enable = Some((gate, loc));
        }
    }

    fn memories(&mut self) {
        for index in 0..self.draft.memories.len() {
            for port in 0..self.draft.memories[index].read_parts.len() {
                let memory = &self.draft.memories[index];
                let (read, part) = (&memory.memory.reads[port], memory.read_parts[port]);
                let (Some(clock), own) = (read.clock, read.enable) else { continue };
                if let Some(gate) = self.gate(part, clock).and_then(|gate| self.of_memory(gate, index)) {
                    self.draft.memories[index].memory.reads[port].enable = Some(self.and(own, gate));
                }
            }
            for port in 0..self.draft.memories[index].write_parts.len() {
                let memory = &self.draft.memories[index];
                let (write, part) = (&memory.memory.writes[port], memory.write_parts[port]);
                let own = write.enable;
                if let Some(gate) = self.gate(part, write.clock).and_then(|gate| self.of_memory(gate, index)) {
                    self.draft.memories[index].memory.writes[port].enable = self.and(Some(own), gate);
                }
            }
        }
    }

    /// The enable of a memory's port, plain or of the memory's shape; otherwise that is a problem.
    fn of_memory(&mut self, gate: NodeId, index: usize) -> Option<NodeId> {
        let memory = &self.draft.memories[index].memory;
        let (shape, loc) = (memory.shape, memory.loc);
        if self.draft.node(gate).shape.is_plain() || self.draft.node(gate).shape == shape {
            return Some(gate);
        }
        let what = format!("memory `{}`", memory.name);
        self.report(gate, &what, shape, loc);
        None
    }

    fn properties(&mut self) {
        for index in 0..self.draft.properties.len() {
            let draft = &self.draft.properties[index];
            let (condition, directive, loc) = (draft.property.condition, draft.property.directive, draft.property.loc);
            let Some(gate) = self.gate(draft.part, draft.property.clock) else { continue };
            let Some(gate) = self.fit(gate, condition, |_| directive.noun().to_owned()) else { continue };
            self.draft.properties[index].property.condition = only_where(self.draft, directive, (condition, gate), loc);
        }
    }

    fn instances(&mut self, done: &[Module], enables: &[Vec<Option<&'static str>>]) {
        for index in 0..self.draft.instances.len() {
            let (part, instance) = (self.draft.instance_parts[index], &self.draft.instances[index]);
            let (shape, loc) = (instance.shape, instance.loc);
            let (module, clocks) = (instance.module.0 as usize, instance.clocks.clone());
            for name in &enables[module] {
                let at = done[module].clocks.iter().position(|clock| clock.name == *name);
                let clock = clocks[at.expect("a module has the clocks that it is enabled on")];
                let gate = self.gate(part, clock).and_then(|gate| self.of_instance(gate, index));
                let gate = gate.unwrap_or_else(|| {
                    let high = self.draft.add(Op::Const(Bits::new(1, 1)), 1, Shape::Plain, loc);
                    self.draft.spread(high, shape, loc)
                });
                self.draft.instances[index].inputs.push(gate);
            }
        }
    }

    fn of_instance(&mut self, gate: NodeId, index: usize) -> Option<NodeId> {
        let instance = &self.draft.instances[index];
        let (shape, loc, what) = (instance.shape, instance.loc, format!("instance `{}`", instance.name));
        self.laid_out(gate, shape, loc, |_| what)
    }

    /// The enable of what runs on `clock` in `part`.
    fn gate(&mut self, part: Option<PartId>, clock: ClockId) -> Option<NodeId> {
        if let Some(known) = self.known.get(&(part, clock)) {
            return *known;
        }
        let gate = match part {
            None => self.draft.enables.iter().find(|(of, _)| *of == clock).map(|(_, input)| *input),
            Some(PartId(index)) => {
                let part = &self.draft.parts[index as usize];
                let own = (part.clock == clock).then_some((part.enable, part.loc));
                let outer = self.gate(part.outer, clock);
                own.map_or(outer, |(own, loc)| self.nested(outer, own, loc))
            }
        };
        self.known.insert((part, clock), gate);
        gate
    }

    /// The enable of a part within another one.
    fn nested(&mut self, outer: Option<NodeId>, own: NodeId, loc: Loc) -> Option<NodeId> {
        let Some(outer) = outer else { return Some(own) };
        let [of_outer, of_own] = [outer, own].map(|node| self.draft.node(node).shape);
        if of_own.is_plain() && !of_outer.is_plain() {
            return Some(self.and(Some(own), outer));
        }
        let outer = self.laid_out(outer, of_own, loc, |draft| format!("the enable `{}`", draft.describe(own)));
        Some(outer.map_or(own, |outer| self.and(Some(outer), own)))
    }

    /// The enable with the lanes of an object; otherwise that is a problem.
    fn fit(&mut self, gate: NodeId, of: NodeId, what: impl FnOnce(&Draft) -> String) -> Option<NodeId> {
        let (shape, loc) = (self.draft.node(of).shape, self.draft.node(of).loc);
        self.laid_out(gate, shape, loc, what)
    }

    fn laid_out(
        &mut self,
        gate: NodeId,
        shape: Shape,
        loc: Loc,
        what: impl FnOnce(&Draft) -> String,
    ) -> Option<NodeId> {
        let own = self.draft.node(gate).shape;
        if own == shape || own.is_plain() {
            return Some(self.spread(gate, shape));
        }
        let what = what(self.draft);
        self.report(gate, &what, shape, loc);
        None
    }

    /// An enable in the lanes of a shape.
    fn spread(&mut self, node: NodeId, shape: Shape) -> NodeId {
        if self.draft.node(node).shape == shape {
            return node;
        }
        if let Some(known) = self.spread.get(&(node, shape)) {
            return *known;
        }
        let loc = self.draft.node(node).loc;
        let spread = self.draft.spread(node, shape, loc);
        self.spread.insert((node, shape), spread);
        spread
    }

    /// Both enables; a plain one is the same in all lanes of the other.
    fn and(&mut self, own: Option<NodeId>, gate: NodeId) -> NodeId {
        let Some(own) = own else { return gate };
        let (shape, loc) = (self.draft.shape_of_both([own, gate]), self.draft.node(gate).loc);
        let [own, gate] = [own, gate].map(|node| self.spread(node, shape));
        self.draft.add(Op::Binary(Binary::And, gate, own), 1, shape, loc)
    }

    fn report(&mut self, gate: NodeId, what: &str, shape: Shape, loc: Loc) {
        let draft = &self.draft;
        if draft.follows_a_problem(&[gate]) {
            return;
        }
        let (text, lanes) = (draft.describe(gate), draft.node(gate).shape);
        let message = format!("{what} has {shape}, but is enabled by `{text}`, which has {lanes}");
        let problem = Problem::new(Mistake::OtherLayout, loc, message)
            .note(format!("`{text}` is made"), draft.node(gate).loc)
            .help("an enable is plain, one for all lanes, or has the lanes of everything that is described within");
        self.problems.push(problem);
    }
}
