//! Makes a circuit that fails smaller, node by node, for as long as it fails in the same way: what is left of a design of a
//! hundred nodes is often five.

pub(crate) mod sweep;
mod text;

use crate::edit::operands;
use tilewright_hdl::Bits;
use tilewright_hdl::ir::{
    ClockId, Contents, Design, Init, Input, Module, Node, NodeId, Op, ReadPort, Register, WritePort,
};

pub use text::text;

/// The circuit made smaller, with what fails in it; `fails` says what is wrong with a circuit, if anything is.
pub fn reduce(modules: Vec<Module>, what: String, fails: impl Fn(&Design) -> Option<String>) -> (Vec<Module>, String) {
    let kind = kind_of(&what);
    let mut found = Reducer { modules, what, kind, fails };
    loop {
        let before = size(&found.modules);
        found.pass();
        if size(&found.modules) >= before {
            return (found.modules, found.what);
        }
    }
}

/// What a message begins with, up to the first name or number.
fn kind_of(what: &str) -> String {
    what.chars().take_while(|c| *c != '`' && !c.is_ascii_digit()).collect()
}

/// How much there is to remove.
fn size(modules: &[Module]) -> usize {
    let of = |module: &Module| {
        let nodes = module.nodes.iter().map(|node| {
            let named = usize::from(node.name.is_some());
            let constant = usize::from(!matches!(node.op, Op::Const(_)));
            2 + named + constant + operands(&mut node.op.clone()).len()
        });
        let writes: usize = module.memories.iter().map(|memory| memory.writes.len() + 1).sum();
        let options =
            module.registers.iter().map(|it| usize::from(it.enable.is_some()) + usize::from(it.reset.is_some()));
        let ports = module.inputs.len() + module.outputs.len() + module.properties.len() + module.instances.len();
        nodes.sum::<usize>() + writes + options.sum::<usize>() + ports
    };
    modules.iter().map(of).sum()
}

struct Reducer<F> {
    modules: Vec<Module>,
    what: String,
    kind: String,
    fails: F,
}

impl<F: Fn(&Design) -> Option<String>> Reducer<F> {
    /// Keeps an edit if the circuit fails as before.
    fn attempt(&mut self, edit: impl FnOnce(&mut Vec<Module>)) -> bool {
        let mut modules = self.modules.clone();
        edit(&mut modules);
        sweep::sweep(&mut modules);
        if size(&modules) >= size(&self.modules) {
            return false;
        }
        let Ok(design) = Design::new(modules.clone()) else { return false };
        match (self.fails)(&design).filter(|what| kind_of(what) == self.kind) {
            Some(what) => {
                (self.modules, self.what) = (modules, what);
                true
            }
            None => false,
        }
    }

    /// Tries an edit at each of so many places, the last first; there are fewer places after each that is kept.
    fn each(&mut self, at: usize, count: impl Fn(&Module) -> usize, edit: impl Fn(&mut Vec<Module>, usize)) {
        let mut place = self.modules.get(at).map_or(0, &count);
        while place > 0 {
            place -= 1;
            if place < self.modules.get(at).map_or(0, &count) {
                self.attempt(|modules| edit(modules, place));
            }
        }
    }

    fn pass(&mut self) {
        for at in (0..self.modules.len()).rev() {
            self.each(at, |module| module.outputs.len(), |modules, place| sweep::drop_output(modules, at, place));
            self.each(
                at,
                |module| module.properties.len(),
                |modules, place| {
                    modules[at].properties.remove(place);
                },
            );
            let nodes = |module: &Module| module.nodes.len();
            self.each(at, nodes, |modules, place| {
                let module = &mut modules[at];
                let zero = Op::Const(Bits::zero(module.nodes[place].width));
                replace(module, place, (zero, None));
            });
            for which in 0..4 {
                self.each(at, nodes, |modules, place| bypass(&mut modules[at], place, which));
            }
            if at + 1 == self.modules.len() {
                self.each(at, nodes, |modules, place| to_input(&mut modules[at], place));
            }
            self.each(at, nodes, |modules, place| {
                let node = &mut modules[at].nodes[place];
                if !matches!(node.op, Op::Input(_) | Op::Register(_)) {
                    node.name = None;
                }
            });
            self.each(at, nodes, |modules, place| shorten(&mut modules[at].nodes[place]));
            for option in OPTIONS {
                self.each(
                    at,
                    |module| module.registers.len(),
                    |modules, place| {
                        option(&mut modules[at].registers[place]);
                    },
                );
            }
            self.memories(at);
        }
    }

    fn memories(&mut self, at: usize) {
        for memory in 0..self.modules.get(at).map_or(0, |module| module.memories.len()) {
            let of = |module: &Module| module.memories.get(memory).map_or(0, |memory| memory.writes.len());
            self.each(at, of, |modules, place| {
                modules[at].memories[memory].writes.remove(place);
            });
            self.attempt(|modules| {
                if let Some(memory) = modules.get_mut(at).and_then(|module| module.memories.get_mut(memory)) {
                    memory.contents = Contents::Unknown;
                    memory.reads.iter_mut().for_each(|ReadPort { enable, .. }| *enable = None);
                }
            });
        }
    }
}

const OPTIONS: [fn(&mut Register); 3] = [
    |register| register.enable = None,
    |register| register.reset = None,
    |register| {
        let zero = register.reset.as_ref().map(|reset| Bits::zero(reset.lane(0).width()));
        register.reset = zero.map(Init::Same);
    },
];

/// Whoever reads a node reads one of its operands, if that is alike.
fn bypass(module: &mut Module, place: usize, which: usize) {
    let node = module.nodes[place].clone();
    let mut op = node.op.clone();
    let with = operands(&mut op).get(which).map(|id| **id);
    let Some(with) = with.filter(|id| {
        let other = module.node(*id);
        (other.width, other.shape) == (node.width, node.shape) && id.0 as usize != place
    }) else {
        return;
    };
    redirect(module, place, with);
}

/// Whoever reads a node reads another one.
fn redirect(module: &mut Module, place: usize, with: NodeId) {
    let outputs = module.outputs.iter_mut().map(|output| &mut output.node);
    outputs.filter(|id| id.0 as usize == place).for_each(|id| *id = with);
    sweep::for_each_use(module, |id| {
        if id.0 as usize == place {
            *id = with;
        }
    });
}

/// A new node with this operation and name takes the place of another.
fn replace(module: &mut Module, place: usize, (op, name): (Op, Option<String>)) {
    let id = NodeId(module.nodes.len() as u32);
    module.nodes.push(Node { op, name, ..module.nodes[place].clone() });
    redirect(module, place, id);
}

/// A node becomes an input.
fn to_input(module: &mut Module, place: usize) {
    if matches!(module.nodes[place].op, Op::Input(_) | Op::Const(_)) {
        return;
    }
    let clock = module.clocks.first().map(|_| ClockId(0));
    let (name, port) = (format!("free{place}"), module.inputs.len() as u32);
    replace(module, place, (Op::Input(port), Some(name.clone())));
    let node = NodeId(module.nodes.len() as u32 - 1);
    module.inputs.push(Input { name: name.clone(), path: name, node, clock });
}

/// A choice loses an arm.
fn shorten(node: &mut Node) {
    match &mut node.op {
        Op::Select { arms, .. } => drop(arms.pop()),
        Op::Case { arms, .. } => drop(arms.pop()),
        _ => {}
    }
}

/// The nodes that a port that writes reads.
fn of_write(port: &mut WritePort) -> [&mut NodeId; 3] {
    [&mut port.enable, &mut port.address, &mut port.data]
}
