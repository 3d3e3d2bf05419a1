//! A module built node by node: the bare circuit, without the language.

#![allow(dead_code)] // Each test takes what it needs.

use tilewright_hdl::ir::*;
use tilewright_hdl::{Bits, Edge, Loc, Period, ReadUnderWrite, Reset};

/// A module under construction, with a default clock and a reset.
pub struct Build {
    pub module: Module,
}

/// The enable of a register that is always enabled.
const ALWAYS: Option<NodeId> = None;

impl Build {
    #[track_caller]
    pub fn new(name: &str) -> Build {
        let clock = Clock {
            port: "clk".to_owned(),
            reset: Some("rst".to_owned()),
            period: Some(Period::ns(10)),
            name: None,
            kind: Reset::Synchronous,
            edge: Edge::Rising,
        };
        let module = Module {
            name: name.to_owned(),
            about: About::default(),
            parameters: name.to_owned(),
            loc: Loc::caller(),
            clocks: vec![clock],
            inputs: vec![],
            outputs: vec![],
            nodes: vec![],
            registers: vec![],
            memories: vec![],
            instances: vec![],
            properties: vec![],
            records: vec![],
            foreign: None,
            unmodelled: false,
            is_pad: false,
        };
        Build { module }
    }

    #[track_caller]
    pub fn node(&mut self, op: Op, width: u32, shape: Shape) -> NodeId {
        self.module.nodes.push(Node::new(op, width, shape, Loc::caller()));
        NodeId(self.module.nodes.len() as u32 - 1)
    }

    pub fn named(&mut self, name: &str, node: NodeId) -> NodeId {
        self.module.nodes[node.0 as usize].name = Some(name.to_owned());
        node
    }

    pub fn width(&self, node: NodeId) -> u32 {
        self.module.width(node)
    }

    pub fn shape(&self, node: NodeId) -> Shape {
        self.module.shape(node)
    }

    #[track_caller]
    pub fn input(&mut self, name: &str, width: u32, shape: Shape) -> NodeId {
        let node = self.node(Op::Input(self.module.inputs.len() as u32), width, shape);
        let input = Input { name: name.to_owned(), path: name.to_owned(), node, clock: Some(ClockId(0)) };
        self.module.inputs.push(input);
        self.named(name, node)
    }

    pub fn output(&mut self, name: &str, node: NodeId) {
        self.module.outputs.push(Output { name: name.to_owned(), path: name.to_owned(), node, kind: Kind::Number });
    }

    #[track_caller]
    pub fn constant(&mut self, width: u32, value: u64, shape: Shape) -> NodeId {
        self.node(Op::Const(Bits::new(width, value)), width, shape)
    }

    /// A register that keeps its value until [`Build::next`] sets its next value.
    #[track_caller]
    pub fn register(&mut self, name: &str, width: u32, shape: Shape, reset: Option<Init>) -> NodeId {
        let node = self.node(Op::Register(RegisterId(self.module.registers.len() as u32)), width, shape);
        self.module.registers.push(Register {
            node,
            clock: ClockId(0),
            reset,
            enable: ALWAYS,
            next: node,
            initial: None,
            is_synchronizer: false,
            attributes: vec![],
        });
        self.named(name, node)
    }

    /// A register that starts at zero and always takes `next`.
    #[track_caller]
    pub fn delayed(&mut self, name: &str, next: NodeId) -> NodeId {
        let (width, shape) = (self.width(next), self.shape(next));
        let register = self.register(name, width, shape, Some(Init::Same(Bits::zero(width))));
        self.next(register, ALWAYS, next);
        register
    }

    pub fn next(&mut self, register: NodeId, enable: Option<NodeId>, next: NodeId) {
        let register = self.module.registers.iter_mut().find(|it| it.node == register).expect("a register");
        (register.enable, register.next) = (enable, next);
    }

    #[track_caller]
    pub fn not(&mut self, a: NodeId) -> NodeId {
        self.node(Op::Unary(Unary::Not, a), self.width(a), self.shape(a))
    }

    #[track_caller]
    pub fn binary(&mut self, op: Binary, a: NodeId, b: NodeId) -> NodeId {
        let width = match op {
            Binary::Mul | Binary::MulSigned => self.width(a) + self.width(b),
            _ => self.width(a),
        };
        self.node(Op::Binary(op, a, b), width, self.shape(a))
    }

    #[track_caller]
    pub fn and(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.binary(Binary::And, a, b)
    }

    #[track_caller]
    pub fn or(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.binary(Binary::Or, a, b)
    }

    #[track_caller]
    pub fn xor(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.binary(Binary::Xor, a, b)
    }

    #[track_caller]
    pub fn add(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.binary(Binary::Add, a, b)
    }

    #[track_caller]
    pub fn mux(&mut self, select: NodeId, on_true: NodeId, on_false: NodeId) -> NodeId {
        self.node(Op::Mux { select, on_true, on_false }, self.width(on_true), self.shape(on_true))
    }

    #[track_caller]
    pub fn case(&mut self, subject: NodeId, values: &[NodeId], default: NodeId) -> NodeId {
        let key = self.width(subject);
        let arms = (0..).zip(values).map(|(at, &value)| (Bits::new(key, at), value)).collect();
        self.node(Op::Case { subject, arms, default }, self.width(default), self.shape(default))
    }

    /// The value in each of `count` lanes along a new axis.
    #[track_caller]
    pub fn broadcast(&mut self, of: NodeId, axis: u32, count: u32) -> NodeId {
        let shape = self.shape(of).with(axis, count).expect("a third axis");
        self.node(Op::Broadcast { of, axis }, self.width(of), shape)
    }

    /// A plain value in every lane of this shape.
    #[track_caller]
    pub fn everywhere(&mut self, of: NodeId, shape: Shape) -> NodeId {
        match shape {
            Shape::Plain => of,
            Shape::Row(count) => self.broadcast(of, 0, count),
            Shape::Grid(rows, columns) => {
                let row = self.broadcast(of, 0, columns);
                self.broadcast(row, 0, rows)
            }
        }
    }

    #[track_caller]
    pub fn stack(&mut self, parts: &[NodeId], axis: u32) -> NodeId {
        let shape = self.shape(parts[0]).with(axis, parts.len() as u32).expect("a third axis");
        self.node(Op::Stack { parts: parts.to_vec(), axis }, self.width(parts[0]), shape)
    }

    /// `count` lanes along the axis.
    #[track_caller]
    pub fn map(&mut self, of: NodeId, axis: u32, count: u32, index: Affine, edge: Option<NodeId>) -> NodeId {
        let shape = self.shape(of).without(axis).with(axis, count).expect("an axis of the operand");
        self.node(Op::Map { of, axis, index, edge }, self.width(of), shape)
    }

    /// The neighbour with the next lower index along the axis; the first lane has `edge`.
    #[track_caller]
    pub fn previous(&mut self, of: NodeId, axis: u32, edge: NodeId) -> NodeId {
        self.map(of, axis, self.shape(of).extent(axis), Affine::shift(-1), Some(edge))
    }

    #[track_caller]
    pub fn interleave(&mut self, parts: &[NodeId], axis: u32) -> NodeId {
        let part = self.shape(parts[0]);
        let shape =
            part.without(axis).with(axis, part.extent(axis) * parts.len() as u32).expect("an axis of the parts");
        self.node(Op::Interleave { parts: parts.to_vec(), axis }, self.width(parts[0]), shape)
    }

    #[track_caller]
    pub fn lane(&mut self, of: NodeId, axis: u32, index: u32) -> NodeId {
        self.node(Op::Lane { of, axis, index }, self.width(of), self.shape(of).without(axis))
    }

    #[track_caller]
    pub fn pick(&mut self, of: NodeId, axis: u32, index: NodeId) -> NodeId {
        self.node(Op::Pick { of, axis, index }, self.width(of), self.shape(of).without(axis))
    }

    #[track_caller]
    pub fn reduce(&mut self, by: Reduction, of: NodeId, axis: u32) -> NodeId {
        self.node(Op::Reduce { by, of, axis }, self.width(of), self.shape(of).without(axis))
    }

    #[track_caller]
    pub fn pack(&mut self, of: NodeId, axis: u32) -> NodeId {
        let shape = self.shape(of);
        self.node(Op::Pack { of, axis }, self.width(of) * shape.extent(axis), shape.without(axis))
    }

    #[track_caller]
    pub fn unpack(&mut self, of: NodeId, axis: u32, count: u32) -> NodeId {
        let shape = self.shape(of).with(axis, count).expect("a third axis");
        self.node(Op::Unpack { of, axis }, self.width(of) / count, shape)
    }

    #[track_caller]
    pub fn memory(&mut self, name: &str, depth: u32, width: u32, shape: Shape) -> MemoryId {
        self.module.memories.push(Memory {
            name: name.to_owned(),
            depth,
            width,
            shape,
            policy: ReadUnderWrite::Old,
            contents: Contents::Unknown,
            reads: vec![],
            writes: vec![],
            attributes: vec![],
            in_bounds: false,
            loc: Loc::caller(),
        });
        MemoryId(self.module.memories.len() as u32 - 1)
    }

    /// A read port, synchronous or not.
    #[track_caller]
    pub fn read(&mut self, id: MemoryId, synchronous: bool, address: NodeId, enable: Option<NodeId>) -> NodeId {
        let memory = &self.module.memories[id.0 as usize];
        let (port, width, shape) = (memory.reads.len() as u32, memory.width, memory.shape);
        let node = self.node(Op::Read(id, port), width, shape);
        let clock = synchronous.then_some(ClockId(0));
        self.module.memories[id.0 as usize].reads.push(ReadPort { clock, address, enable, node });
        node
    }

    pub fn write(&mut self, id: MemoryId, enable: NodeId, address: NodeId, data: NodeId) {
        let port = WritePort { clock: ClockId(0), enable, address, data };
        self.module.memories[id.0 as usize].writes.push(port);
    }

    /// An instance of module `id`, or an array of them; returns its outputs.
    #[track_caller]
    pub fn instance(&mut self, name: &str, id: u32, child: &Module, shape: Shape, inputs: &[NodeId]) -> Vec<NodeId> {
        let instance = InstanceId(self.module.instances.len() as u32);
        let outputs = (0..).zip(&child.outputs).map(|(port, output)| {
            let shape = shape.beside(child.shape(output.node)).expect("a third axis");
            self.node(Op::Output(instance, port), child.width(output.node), shape)
        });
        let outputs: Vec<NodeId> = outputs.collect();
        self.module.instances.push(Instance {
            name: name.to_owned(),
            module: ModuleId(id),
            shape,
            inputs: inputs.to_vec(),
            outputs: outputs.clone(),
            clocks: vec![ClockId(0); child.clocks.len()],
            loc: Loc::caller(),
        });
        outputs
    }

    #[track_caller]
    pub fn assert(&mut self, condition: NodeId, message: &str) {
        let message = message.to_owned();
        let (directive, clock, loc) = (Directive::Assert, ClockId(0), Loc::caller());
        let values = Vec::new();
        self.module.properties.push(Property { directive, clock, condition, message, values, loc });
    }
}
