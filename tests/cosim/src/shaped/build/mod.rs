//! Turns a [`Spec`] into modules, node by node.

mod chain;
#[path = "../../../../../hdl/tests/shapes/build.rs"]
mod circuit;
mod finish;
mod fit;
mod instances;
mod lanes;
mod memory;
mod operators;
mod registers;
mod statements;

use super::spec::*;
use crate::build::names::{Kind, Namer};
use crate::features::Feature;
use crate::reduce::sweep::drop_unused;
use crate::stimulus::Numbers;
use circuit::Build;
use tilewright_hdl::Period;
use tilewright_hdl::ir::*;

/// The modules of a description, the top last, which has this name.
pub fn modules(spec: &Spec, name: &str) -> Vec<Module> {
    let mut modules: Vec<Module> = Vec::new();
    let top = spec.parts.len() - 1;
    for (index, part) in spec.parts.iter().enumerate() {
        let name = if index == top { name.to_owned() } else { format!("{name}_part{index}") };
        let module = Builder::new(spec, part, index, &modules, &name).module();
        modules.push(module);
    }
    drop_unused(&mut modules);
    modules
}

/// A module under construction.
struct Builder<'a> {
    spec: &'a Spec,
    part: &'a Part,
    /// The parts before.
    done: &'a [Module],
    is_top: bool,
    build: Build,
    /// What there is to pick from.
    values: Vec<NodeId>,
    /// The shapes to pick from, the plain one first.
    shapes: Vec<Shape>,
    namer: Namer,
    /// Which values get a name.
    naming: Option<Numbers>,
    late: Vec<Late>,
}

/// What may be a value of a later step.
enum Late {
    Next(NodeId, Pick),
    Updates(NodeId, Vec<(Pick, Pick)>),
    Data { memory: usize, port: usize, data: Pick },
}

impl<'a> Builder<'a> {
    fn new(spec: &'a Spec, part: &'a Part, index: usize, done: &'a [Module], name: &str) -> Builder<'a> {
        let mut build = Build::new(name);
        let is_top = index + 1 == spec.parts.len();
        if !is_top {
            build.module.clocks[0].period = None;
        }
        build.module.clocks.extend(spec.second_period.map(|period| Clock {
            port: "second_clk".to_owned(),
            reset: Some("second_rst".to_owned()),
            period: Some(Period::ps(period)),
            name: Some("second"),
            kind: tilewright_hdl::Reset::Synchronous,
            edge: tilewright_hdl::Edge::Rising,
        }));
        let mut shapes = vec![Shape::Plain];
        for &shape in &part.shapes {
            shapes.push(shape);
            shapes.extend((0..shape.axes()).map(|axis| shape.without(axis)));
        }
        shapes.dedup();
        let mut namer = Namer::new(spec.names, name, index, !is_top);
        // What is in a module is not called as it is.
        namer.remember(name);
        let naming = (spec.names != 0).then_some(Numbers(spec.names ^ index as u64));
        let (values, late) = (Vec::new(), Vec::new());
        Builder { spec, part, done, is_top, build, values, shapes, namer, naming, late }
    }

    fn module(mut self) -> Module {
        for (number, &(width, shape)) in self.part.inputs.iter().enumerate() {
            let (name, shape) = (self.name(&format!("in_{number}"), Kind::Input), self.shape(shape));
            let input = self.build.input(&name, width, shape);
            self.values.push(input);
        }
        if self.values.is_empty() {
            let zero = self.build.constant(1, 0, Shape::Plain);
            self.values.push(zero);
        }
        for (number, step) in self.part.steps.iter().enumerate() {
            self.step(number, step);
        }
        self.finish()
    }

    fn step(&mut self, number: usize, step: &Step) {
        let clock = self.clock(step.second);
        match &step.make {
            Make::Broadcast { .. }
            | Make::Stack { .. }
            | Make::Map { .. }
            | Make::Interleave { .. }
            | Make::Lane { .. }
            | Make::PickLane { .. }
            | Make::Reduce { .. }
            | Make::ReduceAll { .. }
            | Make::Pack { .. }
            | Make::Unpack { .. }
            | Make::Apart { .. } => {
                let value = self.lanes(&step.make);
                self.push(number, value);
            }
            Make::Chain { width, shape, links } => self.chain(number, *width, *shape, links),
            Make::Ladder { of, axis, fold } => self.ladder(number, *of, *axis, *fold),
            Make::Register { start, enable, next, link } => {
                self.register(number, clock, *start, *enable, *next, link.as_ref());
            }
            Make::Chosen { start, updates } => {
                Feature::UpdatesInShapes.used();
                let register = self.started(number, clock, *start);
                self.late.push(Late::Updates(register, updates.clone()));
                self.values.push(register);
            }
            Make::Record { fields, held } => self.record(number, clock, fields, *held),
            Make::Memory(memory) => self.memory(number, clock, memory),
            Make::Instance { part, shape, copies, inputs } => {
                self.instances(number, clock, *part, *shape, *copies, inputs);
            }
            Make::Assert(of) => {
                let condition = self.always(*of);
                let directive = [Directive::Assert, Directive::Assume, Directive::Cover][number % 3];
                self.states(directive, clock, condition, "this always holds");
            }
            Make::Never(of, pattern) => self.compared(Directive::Assert, clock, *of, *pattern),
            Make::Sometimes(of, pattern) => self.compared(Directive::Cover, clock, *of, *pattern),
            Make::Past(of) => self.past(number, clock, *of),
            other => {
                let value = self.operator(other);
                let value = if let Make::Name(_) = other { self.named(number, value) } else { value };
                self.push(number, value);
            }
        }
    }

    /// The clock of what holds state.
    fn clock(&self, second: bool) -> ClockId {
        ClockId((second && self.spec.second_period.is_some()).into())
    }

    /// A name that nothing in the module has.
    fn name(&mut self, plain: &str, kind: Kind) -> String {
        self.namer.legal(plain, kind)
    }

    /// Gives a value a name, if it has none.
    fn named(&mut self, number: usize, value: NodeId) -> NodeId {
        if self.build.module.node(value).name.is_none() {
            let name = self.name(&format!("n{number}"), Kind::Inner);
            self.build.named(&name, value);
        }
        value
    }

    /// Adds a value to pick from; some get a name.
    fn push(&mut self, number: usize, value: NodeId) {
        if self.naming.as_mut().is_some_and(|numbers| numbers.draw().is_multiple_of(4)) {
            self.named(number, value);
        }
        let value = self.cut(value, WIDEST);
        self.values.push(value);
    }
}
