//! Registers: an always block for those that share clock, reset and enable, in the form that power and lint tools
//! expect.

use super::branches::Target;
use super::expression::number;
use super::literal::Style;
use super::plan::Form;
use super::printer::Printer;
use super::statement::{Statement, lines, merged};
use tilewright_circuit::ir::{ClockId, NodeId, Op, Register};
use tilewright_circuit::{Bits, Edge, Reset};

/// The common properties of the registers of one always block.
#[derive(Clone, Copy)]
struct Group {
    clock: ClockId,
    has_reset: bool,
    enable: Option<NodeId>,
}

/// A first condition, and otherwise what follows; a single choice becomes a chain with it as the first arm.
fn after(first: (String, Vec<Statement>), mut body: Vec<Statement>) -> Statement {
    match body.pop() {
        Some(Statement::If(mut arms, last)) if body.is_empty() => {
            arms.insert(0, first);
            Statement::If(arms, last)
        }
        last => {
            body.extend(last);
            Statement::If(vec![first], body)
        }
    }
}

impl Printer<'_> {
    /// The always blocks of the registers without lanes.
    pub fn registers(&mut self) -> Vec<String> {
        let plain = self.plain_registers(false);
        self.register_blocks(&plain)
    }

    /// The registers without lanes that only properties use, or the others.
    pub fn plain_registers(&self, stated: bool) -> Vec<usize> {
        let registers = self.module.registers.iter().enumerate();
        let plain = registers.filter(|(_, register)| self.module.shape(register.node).is_plain());
        plain.map(|(index, _)| index).filter(|&index| self.stated[index] == stated).collect()
    }

    /// The values of these registers at power-on, and their always blocks, those without reset first.
    pub fn register_blocks(&mut self, registers: &[usize]) -> Vec<String> {
        let module = self.module;
        let group = |register: &Register| Group {
            clock: register.clock,
            has_reset: register.reset.is_some() && module.clocks[register.clock.0 as usize].reset.is_some(),
            enable: register.enable,
        };
        let mut out: Vec<String> = registers.iter().filter_map(|&register| self.initial_value(register)).collect();
        if !out.is_empty() {
            out.push(String::new());
        }
        let mut groups: Vec<(Group, Vec<usize>)> = Vec::new();
        for &register in registers {
            let key = group(&module.registers[register]);
            match groups.iter_mut().find(|(known, _)| self.is_same_group(*known, key)) {
                Some((_, members)) => members.push(register),
                None => groups.push((key, vec![register])),
            }
        }
        groups.sort_by_key(|(group, _)| group.has_reset);
        out.extend(groups.into_iter().flat_map(|(group, members)| self.register_block(group, &members)));
        out
    }

    fn is_same_group(&self, a: Group, b: Group) -> bool {
        let enable = |group: Group| group.enable.map(|enable| self.spread(enable));
        (a.clock, a.has_reset, enable(a)) == (b.clock, b.has_reset, enable(b))
    }

    /// The operand that is the same in all lanes along these axes: each register has a broadcast of its own.
    fn spread(&self, mut id: NodeId) -> (NodeId, Vec<u32>) {
        let mut axes = Vec::new();
        while let (Form::Inline, &Op::Broadcast { of, axis }) = (self.plan.form(id), &self.module.node(id).op) {
            axes.push(axis);
            id = of;
        }
        (id, axes)
    }

    fn register_block(&mut self, group: Group, members: &[usize]) -> Vec<String> {
        let enable = group.enable.map(|enable| self.value(enable));
        let body = merged(members.iter().flat_map(|&register| self.next_value(register)).collect());
        let resets: Vec<Statement> = members.iter().filter_map(|&register| self.reset_value(register)).collect();
        let body = match (group.has_reset, enable) {
            (false, None) => body,
            (false, Some(enable)) => vec![Statement::If(vec![(enable, body)], Vec::new())],
            (true, None) => vec![after((self.in_reset(group.clock), resets), body)],
            (true, Some(enable)) => {
                vec![Statement::If(vec![(self.in_reset(group.clock), resets), (enable, body)], Vec::new())]
            }
        };
        let events = if group.has_reset { self.events_with_reset(group.clock) } else { self.edge(group.clock) };
        always(&events, &body)
    }

    fn next_value(&mut self, register: usize) -> Vec<Statement> {
        let register = &self.module.registers[register];
        let target = Target {
            name: self.target(register.node),
            assign: "<=",
            hold: Some(register.node),
            states: self.states.of(register.node),
            now: None,
        };
        match self.branch(register.next, &target) {
            body if body.is_empty() => vec![target.keep()],
            body => body,
        }
    }

    /// The value of a register at power-on. Where there is no reset, its reset value is one.
    fn initial_value(&mut self, index: usize) -> Option<String> {
        let register = &self.module.registers[index];
        let value = match &register.initial {
            Some(value) => self.start(register.node, value),
            None if self.module.clocks[register.clock.0 as usize].kind == Reset::PowerOn => {
                self.value_of_reset(index)?
            }
            None => return None,
        };
        Some(format!("initial {} = {value};", self.target(register.node)))
    }

    fn reset_value(&mut self, index: usize) -> Option<Statement> {
        let value = self.value_of_reset(index)?;
        Some(Statement::Assign(format!("{} <= {value};", self.target(self.module.registers[index].node))))
    }

    fn value_of_reset(&mut self, index: usize) -> Option<String> {
        let register = &self.module.registers[index];
        let value = register.reset.as_ref()?.lane(0);
        Some(match self.resets[index] {
            Some(lanes) => self.value(lanes),
            None => self.start(register.node, value),
        })
    }

    /// A value of a register as text.
    fn start(&mut self, register: NodeId, value: &Bits) -> String {
        match self.states.of(register) {
            Some(states) => self.states.name(states, value),
            None => number(value, self.module.node(register).kind, Style::Count),
        }
    }

    /// The statements at the edge of a clock.
    pub fn always_at(&mut self, clock: ClockId, body: &[Statement]) -> Vec<String> {
        always(&self.edge(clock), body)
    }

    /// The edge of a clock at which its registers act.
    pub fn edge(&mut self, clock: ClockId) -> String {
        let edge = match self.module.clocks[clock.0 as usize].edge {
            Edge::Rising => "posedge",
            Edge::Falling => "negedge",
        };
        format!("{edge} {}", self.clock_port(clock))
    }

    /// The events that change the registers of a clock that a reset sets.
    fn events_with_reset(&mut self, clock: ClockId) -> String {
        let (edge, reset) = (self.edge(clock), self.reset_port(clock));
        match self.module.clocks[clock.0 as usize].kind {
            Reset::Asynchronous => format!("{edge} or posedge {reset}"),
            Reset::AsynchronousLow => format!("{edge} or negedge {reset}"),
            Reset::Synchronous | Reset::SynchronousLow | Reset::PowerOn => edge,
        }
    }
}

/// The statements at some events.
fn always(events: &str, body: &[Statement]) -> Vec<String> {
    let mut out = vec![format!("always @({events}) begin")];
    out.extend(lines(body, 1));
    out.extend(["end".to_string(), String::new()]);
    out
}
