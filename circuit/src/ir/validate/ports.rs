//! The rules of clocks, ports and instances.

use super::{Needs, Rules, problem};
use crate::ir::{Instance, InstanceId, Kind, Module, Node, NodeId, Op, Shape};
use crate::limits::WIDEST;
use crate::loc::Loc;
use crate::problem::Problem;
use std::fmt;

/// Checks that every clock of the top module has a period, because no parent drives it.
pub(super) fn top(modules: &[Module], problems: &mut Vec<Problem>) {
    if let Some(top) = modules.last() {
        for clock in top.clocks.iter().filter(|clock| clock.period.is_none()) {
            problems
                .push(problem(top.loc, format!("clock `{}` of the top, `{}`, has no period", clock.port, top.name)));
        }
    }
}

impl Rules<'_> {
    pub(super) fn ports(&mut self) {
        let loc = self.module.loc;
        for (index, clock) in self.module.clocks.iter().enumerate() {
            let owner = self.of(&clock.port);
            self.rule(clock.reset.is_none() || clock.kind.has_port(), loc, || {
                format!("{owner} is a clock without a reset, but has a reset port")
            });
            self.rule(clock.name.is_none() || clock.period.is_some(), loc, || {
                format!("{owner} is a clock with a name, but has no period")
            });
            self.rule(clock.name.is_some() || index == 0, loc, || {
                format!("{owner} is a default clock, but not the first clock of its module")
            });
        }
        for (index, input) in (0..).zip(&self.module.inputs) {
            let owner = self.of(&input.name);
            if let Some(node) = self.is_node(loc, &owner, input.node, &Op::Input(index)) {
                self.packed_width(loc, &owner, node);
                self.rule(node.name.as_ref() == Some(&input.name), loc, || {
                    format!("the node of input {owner} has another name")
                });
            }
            input.clock.into_iter().for_each(|clock| self.clock(loc, &owner, clock));
        }
        for output in &self.module.outputs {
            let (owner, node) = (self.of(&output.name), self.module.nodes.get(output.node.0 as usize));
            let shape = node.map_or(Shape::Plain, |node| node.shape);
            self.refers(loc, "the driver", &owner, output.node, Needs::shape(shape));
            if let Some(node) = node {
                self.packed_width(loc, &owner, node);
                if let Kind::Code(names) = output.kind {
                    self.codes(loc, node.width, names);
                }
            }
        }
    }

    pub(super) fn instances(&mut self) {
        for (id, instance) in (0..).map(InstanceId).zip(&self.module.instances) {
            let owner = self.of(&instance.name);
            self.rule(instance.shape.lanes() > 0, instance.loc, || format!("{owner} is an array without lanes"));
            let count = self.done.len();
            match self.done.get(instance.module.0 as usize) {
                Some(child) => self.instance(id, instance, child, &owner),
                None => self.report(
                    instance.loc,
                    format!("{owner} is an instance of module {}, but only {count} come before", instance.module.0),
                ),
            }
        }
    }

    /// Checks that a port's lanes side by side are no wider than a plain value may be, because they are printed that
    /// way.
    fn packed_width(&mut self, loc: Loc, owner: &dyn fmt::Display, node: &Node) {
        let width = u64::from(node.width) * u64::from(node.shape.lanes());
        self.rule(node.shape.is_plain() || width <= WIDEST.into(), loc, || {
            format!("port {owner} has {width} bits in its {}, more than {WIDEST}", node.shape)
        });
    }

    /// The requirements, in an instance, on a port of the child whose node is `node`, if they can be met.
    fn port(
        &mut self,
        instance: &Instance,
        child: &Module,
        name: &str,
        node: NodeId,
        owner: &dyn fmt::Display,
    ) -> Option<Needs> {
        // A missing node is the child's problem.
        let node = child.nodes.get(node.0 as usize)?;
        let shape = instance.shape.beside(node.shape);
        self.rule(shape.is_some(), instance.loc, || {
            let (array, port) = (instance.shape, node.shape);
            format!("{owner} is an array of {array}, and its port `{name}` has {port}: more than two axes in all")
        });
        shape.map(|shape| Needs::of(node.width, shape))
    }

    fn instance(&mut self, id: InstanceId, instance: &Instance, child: &Module, owner: &dyn fmt::Display) {
        let loc = instance.loc;
        let mut as_many = |what: &str, has: usize, needs: usize| {
            self.rule(has == needs, loc, || {
                format!("{owner} has {has} {what}, but its module `{}` has {needs}", child.name)
            });
        };
        as_many("inputs", instance.inputs.len(), child.inputs.len());
        as_many("outputs", instance.outputs.len(), child.outputs.len());
        as_many("clocks", instance.clocks.len(), child.clocks.len());
        for (port, driver) in child.inputs.iter().zip(&instance.inputs) {
            if let Some(needs) = self.port(instance, child, &port.name, port.node, owner) {
                self.refers(loc, format_args!("input `{}`", port.name), owner, *driver, needs);
            }
        }
        for ((index, port), node) in (0..).zip(&child.outputs).zip(&instance.outputs) {
            let name = format_args!("output `{}` of {owner}", port.name);
            if self.is_node(loc, &name, *node, &Op::Output(id, index)).is_some()
                && let Some(needs) = self.port(instance, child, &port.name, port.node, owner)
            {
                self.refers(loc, format_args!("output `{}`", port.name), owner, *node, needs);
            }
        }
        for (clock, driver) in child.clocks.iter().zip(&instance.clocks) {
            self.clock(loc, owner, *driver);
            let Some(driver) = self.module.clocks.get(driver.0 as usize) else { continue };
            let is_equal = clock.period.is_none() || driver.period.is_none_or(|period| clock.period == Some(period));
            self.rule(is_equal, loc, || {
                format!("clock `{}` of {owner} is driven by `{}`, which has another period", clock.port, driver.port)
            });
            self.rule(clock.edge == driver.edge, loc, || {
                let (edge, other) = (clock.edge.words(), driver.edge.words());
                format!("clock `{}` of {owner} {edge}, but `{}`, which drives it, {other}", clock.port, driver.port)
            });
            self.rule(clock.reset.is_none() || driver.reset.is_some(), loc, || {
                format!(
                    "clock `{}` of {owner} has a reset, but `{}`, which drives it, has none",
                    clock.port, driver.port
                )
            });
            self.rule(clock.reset.is_none() || driver.reset.is_none() || clock.kind == driver.kind, loc, || {
                let (kind, other) = (clock.kind.words(), driver.kind.words());
                format!(
                    "clock `{}` of {owner} has {kind}, but `{}`, which drives it, has {other}",
                    clock.port, driver.port
                )
            });
        }
    }
}
