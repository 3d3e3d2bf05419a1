//! The instances in a module: single ones, arrays, and separate ones that run as an array.

use std::collections::HashMap;

use tilewright_circuit::ir::{ClockId, Design, Instance, Module, ModuleId, Shape};

use super::flatten::{Body, Entered, Flatten, Key};
use super::hierarchy::{Replication, ScopeId};
use super::{Cell, Kind, UnitId, ValueId};

/// The flattened form of an instance.
#[derive(Debug, Clone)]
pub(super) enum Children {
    /// The base of its body, or the bases of its bodies if it is an unrolled array.
    Bases(Vec<u32>),
    /// A lane of an array of separate instances.
    Sibling { base: u32, lane: u32, of: u32 },
}

/// The least number of instances of a module that run in lanes.
const SIBLINGS: usize = 4;
/// The least number of nodes for each port of such a module.
const NODES_A_PORT: usize = 3;

impl Flatten<'_> {
    /// Enters all instances; siblings together.
    pub(super) fn instances(&mut self, body: &Body, module: &Module) -> Vec<Children> {
        // In an array there are lanes enough, and those of siblings would not be adjacent.
        let is_worth_it = self.flat.program.passes.siblings && (body.lanes as usize) < SIBLINGS;
        let groups = if is_worth_it { siblings(self.design, module) } else { HashMap::new() };
        let mut children: Vec<Option<Children>> = vec![None; module.instances.len()];
        for index in 0..module.instances.len() {
            if children[index].is_some() {
                continue;
            }
            let instance = &module.instances[index];
            let key = key_of(&body.key, instance);
            match groups.get(&kind(instance)) {
                Some(siblings) if instance.shape.is_plain() && !self.unrolled.arrays.contains(&key) => {
                    let base = self.siblings(body, module, siblings, key);
                    let of = siblings.len() as u32;
                    for (&sibling, lane) in siblings.iter().zip(0..) {
                        children[sibling] = Some(Children::Sibling { base, lane, of });
                    }
                }
                _ => children[index] = Some(Children::Bases(self.instance(body, module, instance))),
            }
        }
        // In the sequence of declaration, from which siblings were removed.
        let numbers: HashMap<&str, usize> =
            module.instances.iter().enumerate().map(|(number, instance)| (instance.name.as_str(), number)).collect();
        let mut scopes = std::mem::take(&mut self.flat.program.hierarchy.scopes);
        for parent in &body.scopes {
            let mut children = std::mem::take(&mut scopes[parent.0 as usize].children);
            children.sort_by_key(|child| numbers.get(scopes[child.0 as usize].name.as_str()));
            scopes[parent.0 as usize].children = children;
        }
        self.flat.program.hierarchy.scopes = scopes;
        children.into_iter().map(|child| child.expect("each is entered")).collect()
    }

    /// Enters instances of one module as an array; returns its base.
    fn siblings(&mut self, body: &Body, module: &Module, siblings: &[usize], key: Key) -> u32 {
        let instances: Vec<&Instance> = siblings.iter().map(|&index| &module.instances[index]).collect();
        let of = siblings.len() as u32;
        let lanes = body.lanes * of;
        let inputs = (0..instances[0].inputs.len()).map(|port| {
            let parts: Vec<ValueId> = instances.iter().map(|instance| body.whole(instance.inputs[port])).collect();
            let inner = module.node(instances[0].inputs[port]).shape.lanes();
            let circuit = &mut self.flat.program.circuit;
            let (width, loc) = (circuit[parts[0]].width, circuit.loc(parts[0]));
            circuit.push(Cell::new(Kind::Stack { parts, inner }, lanes * inner, width), loc)
        });
        let inputs = inputs.collect();
        let mut scopes = Vec::new();
        for &parent in &body.scopes {
            for (index, instance) in (0..).zip(&instances) {
                let replication = Replication::Sibling { index, of };
                scopes.push(self.scope(Some(parent), instance.name.clone(), instance.module, replication, lanes));
            }
        }
        for instance in &instances {
            for &node in &instance.outputs {
                self.flat.array_outputs.push((body.whole(node), key.clone()));
            }
        }
        let clocks = instances[0].clocks.iter().map(|clock| body.clocks[clock.0 as usize]).collect();
        self.enter(Entered { module: instances[0].module, key, scopes, lanes, unit: body.unit, inputs, clocks })
    }

    /// Enters an instance, as often as it is unrolled; returns the bases.
    fn instance(&mut self, body: &Body, module: &Module, instance: &Instance) -> Vec<u32> {
        let (key, shape) = (key_of(&body.key, instance), instance.shape);
        let is_unrolled = !shape.is_plain() && self.unrolled.arrays.contains(&key);
        let elements = is_unrolled.then(|| self.element_inputs(body, module, instance));
        let clocks: Vec<u32> = instance.clocks.iter().map(|clock| body.clocks[clock.0 as usize]).collect();
        let is_apart = self.unrolled.apart.contains(&key);
        let mut enter = |replication, lanes, inputs| {
            let scope = |parent: &ScopeId| {
                self.scope(Some(*parent), instance.name.clone(), instance.module, replication, lanes)
            };
            let scopes = body.scopes.iter().map(scope).collect();
            let unit = if is_apart { Some(UnitId(self.units)) } else { body.unit };
            self.units += u32::from(is_apart);
            let (module, key, clocks) = (instance.module, key.clone(), clocks.clone());
            self.enter(Entered { module, key, scopes, lanes, unit, inputs, clocks })
        };
        let whole = || instance.inputs.iter().map(|&node| body.whole(node)).collect();
        match (shape, elements) {
            (Shape::Plain, _) => vec![enter(Replication::Single, body.lanes, whole())],
            (_, Some(elements)) => {
                let element = |(index, inputs)| enter(Replication::Element(shape, index), body.lanes, inputs);
                (0..).zip(elements).map(element).collect()
            }
            (_, None) => {
                let base = enter(Replication::Whole(shape), body.lanes * shape.lanes(), whole());
                for &node in &instance.outputs {
                    self.flat.array_outputs.push((body.whole(node), key.clone()));
                }
                vec![base]
            }
        }
    }
}

impl Flatten<'_> {
    /// The inputs of each element of an unrolled array.
    fn element_inputs(&mut self, body: &Body, module: &Module, instance: &Instance) -> Vec<Vec<ValueId>> {
        let count = instance.shape.lanes();
        let mut elements = Vec::new();
        for element in 0..count {
            let inputs = instance.inputs.iter();
            let inputs = inputs.map(|&id| {
                let lanes = module.node(id).shape.lanes() / count;
                self.element_input(body, module, id, element, lanes)
            });
            elements.push(inputs.collect());
        }
        elements
    }
}

/// The common properties of siblings: the module and its clocks.
fn kind(instance: &Instance) -> (ModuleId, &[ClockId]) {
    (instance.module, &instance.clocks)
}

/// The instances of a module that are of one kind, if running them together is better.
fn siblings<'a>(design: &Design, module: &'a Module) -> HashMap<(ModuleId, &'a [ClockId]), Vec<usize>> {
    let mut groups: HashMap<_, Vec<usize>> = HashMap::new();
    for (index, instance) in module.instances.iter().enumerate().filter(|(_, instance)| instance.shape.is_plain()) {
        groups.entry(kind(instance)).or_default().push(index);
    }
    groups.retain(|_, siblings| {
        let instance = &module.instances[siblings[0]];
        let ports = instance.inputs.len() + instance.outputs.len();
        siblings.len() >= SIBLINGS && nodes(design, instance.module) >= NODES_A_PORT * ports
    });
    groups
}

/// The approximate number of nodes of a module with everything in it.
fn nodes(design: &Design, id: ModuleId) -> usize {
    let module = design.module(id);
    module.nodes.len() + module.instances.iter().map(|instance| nodes(design, instance.module)).sum::<usize>()
}

/// The name of an array.
pub(super) fn key_of(parent: &Key, instance: &Instance) -> Key {
    parent.iter().cloned().chain([instance.name.clone()]).collect()
}
