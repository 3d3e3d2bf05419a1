//! What of a module is edited, and the mutants found so far.

use crate::same::is_guard;
use crate::{Mutant, block};
use tilewright_hdl::Bits;
use tilewright_hdl::Loc;
use tilewright_hdl::ir::{Directive, Init, Module, Node, NodeId, Op, Property, Unary};

/// A module that mutants are made of.
pub(crate) struct Sites<'a> {
    pub module: &'a Module,
    found: Vec<Mutant>,
}

impl<'a> Sites<'a> {
    pub fn of(module: &'a Module) -> Sites<'a> {
        Sites { module, found: Vec::new() }
    }

    pub fn into_mutants(self) -> Vec<Mutant> {
        self.found
    }

    /// Adds the mutant that an edit makes.
    pub fn add(&mut self, what: &str, loc: Loc, change: impl Into<String>, edit: impl FnOnce(&mut Module)) {
        let mut module = self.module.clone();
        edit(&mut module);
        let (what, change) = (what.to_owned(), change.into());
        let alike = |mutant: &&Mutant| (mutant.loc, &mutant.what, &mutant.change) == (loc, &what, &change);
        let nth = self.found.iter().filter(alike).count();
        self.found.push(Mutant { block: block(self.module).to_owned(), what, loc, change, nth, module });
    }
}

/// Whether what can be observed depends on the node, for each node of the module: an output, an instance, what the inputs are assumed to
/// be, or the count of a cover. What only assertions look at is left out: they hold in a block that is right, whatever it is given, so no
/// test could tell one that says less.
pub(crate) fn observed(module: &Module) -> Vec<bool> {
    let mut observed = vec![false; module.nodes.len()];
    let mut left: Vec<NodeId> = module.outputs.iter().map(|output| output.node).collect();
    left.extend(module.instances.iter().flat_map(|instance| instance.inputs.iter().copied()));
    let stated = module.properties.iter().filter(|property| property.directive != Directive::Assert);
    left.extend(stated.flat_map(Property::nodes));
    while let Some(id) = left.pop() {
        if std::mem::replace(&mut observed[id.0 as usize], true) {
            continue;
        }
        let op = &module.node(id).op;
        op.for_each_operand(|operand| left.push(operand));
        match *op {
            Op::Register(register) if !is_guard(module, id) => {
                let register = &module.registers[register.0 as usize];
                left.extend(register.enable.into_iter().chain([register.next]));
            }
            Op::Read(memory, port) => {
                let memory = &module.memories[memory.0 as usize];
                let read = &memory.reads[port as usize];
                left.extend(read.enable.into_iter().chain([read.address]));
                left.extend(memory.writes.iter().flat_map(|write| [write.enable, write.address, write.data]));
            }
            _ => {}
        }
    }
    observed
}

/// A new node of the shape and place of another.
pub(crate) fn beside(module: &mut Module, id: NodeId, width: u32, op: Op) -> NodeId {
    let Node { shape, loc, .. } = *module.node(id);
    module.nodes.push(Node::new(op, width, shape, loc));
    NodeId(module.nodes.len() as u32 - 1)
}

/// A condition inverted.
pub(crate) fn not(module: &mut Module, condition: NodeId) -> NodeId {
    beside(module, condition, 1, Op::Unary(Unary::Not, condition))
}

/// A constant in the place of a condition.
pub(crate) fn always(module: &mut Module, condition: NodeId, holds: bool) -> NodeId {
    beside(module, condition, 1, Op::Const(Bits::new(1, holds.into())))
}

/// Numbers near another one: the next, the one before, and the one with the highest bit inverted, as far as they differ.
pub(crate) fn near(bits: &Bits) -> Vec<(&'static str, Bits)> {
    let width = bits.width();
    if width == 1 {
        return vec![("one more", bits.not())];
    }
    let high = bits.slice(width - 1..width).not().concat(&bits.slice(0..width - 1));
    let mut all = vec![("one more", plus_one(bits)), ("one less", plus_one(&bits.not()).not())];
    if width > 2 {
        all.push(("highest bit inverted", high));
    }
    all
}

/// The next number, modulo 2 to the width.
fn plus_one(bits: &Bits) -> Bits {
    let mut carry = true;
    let add = |limb: &u64| {
        let (sum, overflows) = limb.overflowing_add(carry.into());
        carry = overflows;
        sum
    };
    let limbs: Vec<u64> = bits.limbs().iter().map(add).collect();
    Bits::from_limbs(bits.width(), &limbs)
}

/// What registers hold after a reset, changed as [`near`] does in every lane.
pub(crate) fn near_init(init: &Init) -> Vec<(&'static str, Init)> {
    match init {
        Init::Same(bits) => near(bits).into_iter().map(|(change, bits)| (change, Init::Same(bits))).collect(),
        Init::Each(values) => vec![("one more", Init::Each(values.iter().map(plus_one).collect()))],
    }
}
