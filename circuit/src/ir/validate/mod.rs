//! The rules that every circuit satisfies, on which simulators and printers rely without checking.
//!
//! The elaboration checks a description with better messages. This is the last check, and the only one for an edited
//! circuit.

mod lanes;
mod loops;
mod names;
mod nodes;
mod objects;
mod ports;
mod size;

use super::{ClockId, Module, NodeId, Shape};
use crate::loc::Loc;
use crate::mistake::Mistake;
use crate::names::bits_text;
use crate::netlist::Netlist;
use crate::problem::Problem;
use std::fmt;

/// Every violated rule in these modules; the last module is the top.
pub(super) fn validate(modules: &[Module]) -> Vec<Problem> {
    let mut problems = Vec::new();
    if modules.is_empty() {
        problems.push(problem(Loc::caller(), "a design has at least one module, its top"));
    }
    for (index, module) in modules.iter().enumerate() {
        let mut rules = Rules { done: &modules[..index], module, problems: &mut problems };
        rules.nodes();
        rules.ports();
        rules.registers();
        rules.memories();
        rules.properties();
        rules.instances();
        rules.names();
    }
    names::modules(modules, &mut problems);
    ports::top(modules, &mut problems);
    // These checks follow ids without testing them; the last one goes from lane to lane.
    if problems.is_empty() {
        size::check(modules, &mut problems);
    }
    if problems.is_empty() {
        loops::check(modules, &mut problems);
    }
    problems
}

fn problem(loc: Loc, message: impl Into<String>) -> Problem {
    Problem::new(Mistake::BrokenRule, loc, message)
        .help("this circuit was edited: each part must follow the rules of `tilewright_hdl::ir`")
}

/// The rules of one module.
struct Rules<'a> {
    /// The earlier modules.
    done: &'a [Module],
    module: &'a Module,
    problems: &'a mut Vec<Problem>,
}

/// The requirements on a referenced node.
#[derive(Clone, Copy)]
struct Needs {
    /// In bits; `None` allows any width.
    width: Option<u32>,
    shape: Shape,
}

impl Needs {
    /// A value of this width and shape.
    fn of(width: u32, shape: Shape) -> Needs {
        Needs { width: Some(width), shape }
    }

    /// A value of any width, of this shape.
    fn shape(shape: Shape) -> Needs {
        Needs { width: None, shape }
    }
}

impl<'a> Rules<'a> {
    fn report(&mut self, loc: Loc, message: impl Into<String>) {
        self.problems.push(problem(loc, message));
    }

    /// Reports `message` unless `holds`.
    fn rule(&mut self, holds: bool, loc: Loc, message: impl FnOnce() -> String) {
        if !holds {
            self.report(loc, message());
        }
    }

    /// An object of this module for messages, such as `counter.count`; most are never printed.
    fn of<N: fmt::Display>(&self, name: N) -> impl fmt::Display + use<'a, N> {
        let module = &self.module.name;
        fmt::from_fn(move |f| write!(f, "`{module}.{name}`"))
    }

    /// A node for messages.
    fn node(&self, id: NodeId) -> Named<'a> {
        Named { module: self.module, id }
    }

    /// Checks that `role` of `owner`, node `id`, exists and meets the requirements.
    fn refers(&mut self, loc: Loc, role: impl fmt::Display, owner: &dyn fmt::Display, id: NodeId, needs: Needs) {
        let Some(node) = self.module.nodes.get(id.0 as usize) else {
            let count = self.module.nodes.len();
            return self.report(loc, format!("{role} of {owner} is node {} of {count}", id.0));
        };
        let text = self.node(id);
        if let Some(width) = needs.width.filter(|width| *width != node.width) {
            let (has, needs) = (bits_text(node.width), bits_text(width));
            self.report(loc, format!("{role} of {owner}, {text}, has {has}, not {needs}"));
        }
        if node.shape != needs.shape {
            let text = format!("{role} of {owner}, {text}, has {}", node.shape);
            let needs = match needs.shape {
                Shape::Plain => "but must be plain".to_owned(),
                needs => format!("not {needs}"),
            };
            self.report(loc, format!("{text}, {needs}"));
        }
    }

    /// Like [`Rules::refers`], for a node that has this shape or is plain.
    fn refers_or_plain(
        &mut self,
        loc: Loc,
        role: impl fmt::Display,
        owner: &dyn fmt::Display,
        id: NodeId,
        needs: Needs,
    ) {
        let is_plain = self.module.nodes.get(id.0 as usize).is_some_and(|node| node.shape.is_plain());
        let shape = if is_plain { Shape::Plain } else { needs.shape };
        self.refers(loc, role, owner, id, Needs { shape, ..needs });
    }

    /// Checks that `owner` runs on a clock of this module.
    fn clock(&mut self, loc: Loc, owner: &dyn fmt::Display, clock: ClockId) {
        let count = self.module.clocks.len();
        self.rule((clock.0 as usize) < count, loc, || format!("the clock of {owner} is clock {} of {count}", clock.0));
    }
}

/// A node's name for messages, such as `counter.count`; most are never printed.
#[derive(Clone, Copy)]
struct Named<'a> {
    module: &'a Module,
    id: NodeId,
}

impl fmt::Display for Named<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "`{}.{}`", self.module.name, self.module.describe(self.id))
    }
}
