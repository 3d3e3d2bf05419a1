//! Random edits of a circuit: many break a rule, and some make another circuit that keeps them all.

use crate::stimulus::Numbers;
use tilewright_hdl::ir::{
    Binary, ClockId, Init, InstanceId, MemoryId, Module, ModuleId, NodeId, Op, Reduction, RegisterId, Relation, Shape,
    Shift, Unary,
};

/// Edits one thing of a circuit.
pub fn edit(modules: &mut [Module], numbers: &mut Numbers) {
    let others = modules.len() as u32;
    let Some(module) = pick(modules, numbers) else { return };
    match below(numbers, 12) {
        0..=4 => operand(module, numbers),
        5 => operator(module, numbers),
        6 => number(module, numbers),
        7 => shape(module, numbers),
        8 => register(module, numbers),
        9 => memory(module, numbers),
        10 => instance(module, others, numbers),
        _ => end(module, numbers),
    }
}

fn below(numbers: &mut Numbers, limit: usize) -> usize {
    (numbers.draw() % limit.max(1) as u64) as usize
}

fn pick<'a, T>(of: &'a mut [T], numbers: &mut Numbers) -> Option<&'a mut T> {
    let index = below(numbers, of.len());
    of.get_mut(index)
}

/// A number near another, or at the ends of what there is.
fn near(was: u32, limit: u32, numbers: &mut Numbers) -> u32 {
    let near = [was.wrapping_add(1), was.wrapping_sub(1), 0, 1, limit, limit.wrapping_sub(1), 1 << 20, u32::MAX];
    match below(numbers, 3) {
        0 => near[below(numbers, near.len())],
        _ => below(numbers, limit as usize + 1) as u32,
    }
}

/// A node in place of another: most often one of its shape, which may keep all rules.
fn node(module: &Module, was: NodeId, numbers: &mut Numbers) -> NodeId {
    let shape = |id: usize| module.nodes.get(id).map(|node| (node.width, node.shape));
    let alike: Vec<usize> = (0..module.nodes.len()).filter(|&id| shape(id) == shape(was.0 as usize)).collect();
    if alike.is_empty() || below(numbers, 5) == 0 {
        return NodeId(near(was.0, module.nodes.len() as u32, numbers));
    }
    NodeId(alike[below(numbers, alike.len())] as u32)
}

/// Replaces a node by what [`node`] gives.
fn replace(module: &mut Module, numbers: &mut Numbers, of: impl Fn(&mut Module) -> Option<&mut NodeId>) {
    let Some(was) = of(module).copied() else { return };
    let new = node(module, was, numbers);
    *of(module).expect("it was there") = new;
}

/// The nodes that an operation names.
pub(crate) fn operands(op: &mut Op) -> Vec<&mut NodeId> {
    let mut all = Vec::new();
    op.for_each_operand_mut(|operand| all.push(operand));
    all
}

/// An operation takes another operand.
fn operand(module: &mut Module, numbers: &mut Numbers) {
    let (id, which) = (below(numbers, module.nodes.len()), numbers.draw() as usize);
    replace(module, numbers, |module| {
        let mut all = operands(&mut module.nodes.get_mut(id)?.op);
        let count = all.len();
        (count > 0).then(|| all.swap_remove(which % count))
    });
}

/// An operator becomes another, whose rules may be others.
fn operator(module: &mut Module, numbers: &mut Numbers) {
    let Some(node) = pick(&mut module.nodes, numbers) else { return };
    let which = numbers.draw() as usize;
    let any = |count: usize| which % count;
    match &mut node.op {
        Op::Unary(op, _) => *op = [Unary::Not, Unary::AllOnes, Unary::AnyOne, Unary::Parity][any(4)],
        Op::Binary(op, ..) => {
            use Binary::{Add, And, Mul, MulSigned, Or, Sub, Xor};
            *op = [Add, Sub, And, Or, Xor, Mul, MulSigned][any(7)];
        }
        Op::Compare { relation, signed, .. } => {
            use Relation::{Eq, Ge, Gt, Le, Lt, Ne};
            *relation = [Eq, Ne, Lt, Le, Gt, Ge][any(6)];
            *signed = (which / 6).is_multiple_of(2);
        }
        Op::Shift(op, ..) => *op = [Shift::Left, Shift::Right, Shift::RightSigned][any(3)],
        Op::Reduce { by: op, .. } => {
            use Reduction::{Add, And, Max, Min, Or, Xor};
            *op = [And, Or, Xor, Add, Min, Max][any(6)];
        }
        Op::Extend { signed, .. } => *signed = !*signed,
        Op::Const(bits) => *bits = numbers.bits(bits.width() + u32::from(which.is_multiple_of(8))),
        _ => {}
    }
}

/// A number within an operation changes.
fn number(module: &mut Module, numbers: &mut Numbers) {
    let (registers, memories, instances) = (module.registers.len(), module.memories.len(), module.instances.len());
    let inputs = module.inputs.len() as u32;
    let Some(node) = pick(&mut module.nodes, numbers) else { return };
    let width = node.width;
    match &mut node.op {
        Op::Slice { low, .. } => *low = near(*low, width, numbers),
        Op::Repeat(_, times) => *times = near(*times, 8, numbers),
        Op::Lane { index, .. } => *index = near(*index, 20, numbers),
        Op::Map { index, axis, .. } => match below(numbers, 5) {
            0 => index.mul = near(index.mul as u32, 4, numbers) as i32,
            1 => index.div = near(index.div, 4, numbers),
            2 => *axis = near(*axis, 1, numbers),
            _ => index.add = near(index.add as u32, 20, numbers) as i32,
        },
        Op::Broadcast { axis, .. }
        | Op::Pick { axis, .. }
        | Op::Reduce { axis, .. }
        | Op::Pack { axis, .. }
        | Op::Unpack { axis, .. } => *axis = near(*axis, 1, numbers),
        Op::Input(port) => *port = near(*port, inputs, numbers),
        Op::Register(id) => *id = RegisterId(near(id.0, registers as u32, numbers)),
        Op::Read(id, port) => match below(numbers, 2) {
            0 => *id = MemoryId(near(id.0, memories as u32, numbers)),
            _ => *port = near(*port, 2, numbers),
        },
        Op::Output(id, port) => match below(numbers, 2) {
            0 => *id = InstanceId(near(id.0, instances as u32, numbers)),
            _ => *port = near(*port, 4, numbers),
        },
        Op::Case { arms, .. } => {
            if let Some((key, _)) = pick(arms, numbers) {
                *key = numbers.bits(key.width());
            }
        }
        Op::Concat(parts) | Op::Stack { parts, .. } | Op::Interleave { parts, .. } => {
            match (below(numbers, 2), parts.last().copied()) {
                (0, Some(last)) => parts.push(last),
                _ => drop(parts.pop()),
            }
        }
        _ => {}
    }
}

/// A node gets another width, or other lanes.
fn shape(module: &mut Module, numbers: &mut Numbers) {
    let other = pick(&mut module.nodes, numbers).map(|node| (node.width, node.shape));
    let (Some(node), Some((width, shape))) = (pick(&mut module.nodes, numbers), other) else { return };
    match below(numbers, 4) {
        0 => node.width = near(node.width, width, numbers),
        1 => node.shape = shape,
        2 => node.shape = other_shape(node.shape, numbers),
        _ => (node.width, node.shape) = (width, shape),
    }
}

/// Another number of lanes along an axis, or the axes the other way round.
fn other_shape(shape: Shape, numbers: &mut Numbers) -> Shape {
    match (shape, below(numbers, 3)) {
        (Shape::Grid(rows, columns), 0) => Shape::Grid(columns, rows),
        (Shape::Grid(rows, columns), 1) => Shape::Grid(near(rows, 8, numbers), columns),
        (Shape::Grid(rows, columns), _) => Shape::Grid(rows, near(columns, 8, numbers)),
        _ => Shape::Row(near(shape.lanes(), 20, numbers)),
    }
}

fn register(module: &mut Module, numbers: &mut Numbers) {
    let id = below(numbers, module.registers.len());
    let clocks = module.clocks.len() as u32;
    match below(numbers, 5) {
        0 => replace(module, numbers, |module| Some(&mut module.registers.get_mut(id)?.next)),
        1 => replace(module, numbers, |module| module.registers.get_mut(id)?.enable.as_mut()),
        2 => replace(module, numbers, |module| Some(&mut module.registers.get_mut(id)?.node)),
        which => {
            let Some(register) = module.registers.get_mut(id) else { return };
            match (which, &register.reset) {
                (3, Some(reset)) => register.reset = Some(init(reset, numbers)),
                _ => register.clock = ClockId(near(register.clock.0, clocks, numbers)),
            }
        }
    }
}

/// Other values after a reset: one, or one a lane.
fn init(was: &Init, numbers: &mut Numbers) -> Init {
    match was {
        Init::Each(values) if below(numbers, 2) == 0 => {
            Init::Each(values.iter().map(|value| numbers.bits(value.width())).collect())
        }
        was => Init::Same(numbers.bits(was.lane(0).width())),
    }
}

fn memory(module: &mut Module, numbers: &mut Numbers) {
    let (id, port) = (below(numbers, module.memories.len()), below(numbers, 3));
    let clocks = module.clocks.len() as u32;
    match below(numbers, 6) {
        0 => replace(module, numbers, |module| Some(&mut module.memories.get_mut(id)?.writes.get_mut(port)?.address)),
        1 => replace(module, numbers, |module| Some(&mut module.memories.get_mut(id)?.writes.get_mut(port)?.data)),
        2 => replace(module, numbers, |module| Some(&mut module.memories.get_mut(id)?.writes.get_mut(port)?.enable)),
        3 => replace(module, numbers, |module| Some(&mut module.memories.get_mut(id)?.reads.get_mut(port)?.address)),
        which => {
            let Some(memory) = module.memories.get_mut(id) else { return };
            match (which, memory.writes.get_mut(port)) {
                (4, Some(write)) => write.clock = ClockId(near(write.clock.0, clocks, numbers)),
                (4, None) => memory.width = near(memory.width, 64, numbers),
                _ => memory.depth = near(memory.depth, memory.depth, numbers),
            }
        }
    }
}

fn instance(module: &mut Module, modules: u32, numbers: &mut Numbers) {
    let (id, port) = (below(numbers, module.instances.len()), below(numbers, 4));
    let clocks = module.clocks.len() as u32;
    match below(numbers, 5) {
        0 | 1 => replace(module, numbers, |module| module.instances.get_mut(id)?.inputs.get_mut(port)),
        2 => replace(module, numbers, |module| module.instances.get_mut(id)?.outputs.get_mut(port)),
        which => {
            let Some(instance) = module.instances.get_mut(id) else { return };
            match (which, instance.clocks.get_mut(port)) {
                (3, Some(clock)) => *clock = ClockId(near(clock.0, clocks, numbers)),
                (3, None) => instance.module = ModuleId(near(instance.module.0, modules, numbers)),
                _ => instance.shape = other_shape(instance.shape, numbers),
            }
        }
    }
}

/// An output, or an assertion, takes another value.
fn end(module: &mut Module, numbers: &mut Numbers) {
    let id = below(numbers, module.outputs.len() + module.properties.len());
    replace(module, numbers, |module| match module.outputs.len() {
        outputs if id < outputs => module.outputs.get_mut(id).map(|output| &mut output.node),
        outputs => module.properties.get_mut(id - outputs).map(|property| &mut property.condition),
    });
}
