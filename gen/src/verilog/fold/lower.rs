//! First, lanes that Verilog cannot express become plain. A port with lanes becomes a vector, lane 0 lowest, and so
//! does a child's port. A memory with lanes and one address becomes a memory of wide words whose enables are write
//! masks. Reset values for each lane become constants for each lane.

use tilewright_circuit::ir::{Contents, Design, Init, InstanceId, MemoryId, Module, Node, NodeId, Op, Shape};
use tilewright_circuit::{Bits, index_width};

/// Wider vectors are avoided: tools limit their width.
pub const WIDEST_VECTOR: u64 = 65_536;

/// The module with vectors instead of lanes at its borders, and for each register its reset constant, if that differs
/// between lanes.
pub fn lower(design: &Design, module: &Module) -> (Module, Vec<Option<NodeId>>) {
    let mut lower = Lower { design, module: module.clone() };
    lower.inputs();
    lower.instances();
    lower.memories();
    let resets = lower.resets();
    lower.outputs();
    (lower.module, resets)
}

/// The width of a value with all its lanes side by side.
pub fn packed_width(module: &Module, id: NodeId) -> u32 {
    module.width(id) * module.shape(id).lanes()
}

struct Lower<'a> {
    design: &'a Design,
    module: Module,
}

impl Lower<'_> {
    fn add(&mut self, node: Node) -> NodeId {
        self.module.nodes.push(node);
        NodeId(self.module.nodes.len() as u32 - 1)
    }

    /// The lanes of `of` side by side, except along the first `kept` axes.
    fn packed(&mut self, mut of: NodeId, kept: u32) -> NodeId {
        while self.module.shape(of).axes() > kept {
            let node = self.module.node(of);
            let (shape, loc) = (node.shape, node.loc);
            let axis = shape.axes() - 1;
            let width = node.width * shape.extent(axis);
            of = self.add(Node::new(Op::Pack { of, axis }, width, shape.without(axis), loc));
        }
        of
    }

    /// Computes `id` from a vector that has all but its first `kept` axes side by side; returns the value of the
    /// vector, the present operator.
    fn unpack(&mut self, id: NodeId, kept: u32) -> NodeId {
        let Node { op, width, shape, name, loc, .. } = self.module.node(id).clone();
        let first = match (shape, kept) {
            (Shape::Grid(rows, _), 1) => Shape::Row(rows),
            _ => Shape::Plain,
        };
        let vector = Node { name, ..Node::new(op, width * (shape.lanes() / first.lanes()), first, loc) };
        let vector = self.add(vector);
        let mut of = vector;
        if let (Shape::Grid(rows, columns), Shape::Plain) = (shape, first) {
            let rows = Node::new(Op::Unpack { of, axis: 0 }, width * columns, Shape::Row(rows), loc);
            of = self.add(rows);
        }
        let node = &mut self.module.nodes[id.0 as usize];
        (node.op, node.name) = (Op::Unpack { of, axis: shape.axes() - 1 }, None);
        vector
    }

    fn inputs(&mut self) {
        for index in 0..self.module.inputs.len() {
            let id = self.module.inputs[index].node;
            if !self.module.shape(id).is_plain() {
                self.module.inputs[index].node = self.unpack(id, 0);
            }
        }
    }

    /// A node with the name of its port leaves the name to the port.
    fn outputs(&mut self) {
        for index in 0..self.module.outputs.len() {
            let id = self.module.outputs[index].node;
            if self.module.shape(id).is_plain() {
                continue;
            }
            if self.module.node(id).name.as_ref() == Some(&self.module.outputs[index].name) {
                let name = free_name(&self.module, &format!("{}_lane", self.module.outputs[index].name));
                self.module.nodes[id.0 as usize].name = Some(name);
            }
            self.module.outputs[index].node = self.packed(id, 0);
        }
    }

    fn instances(&mut self) {
        for index in 0..self.module.instances.len() {
            let instance = self.module.instances[index].clone();
            let (child, axes) = (self.design.module(instance.module), instance.shape.axes());
            for (port, input) in child.inputs.iter().enumerate() {
                if !child.shape(input.node).is_plain() {
                    let packed = self.packed(instance.inputs[port], axes);
                    self.module.instances[index].inputs[port] = packed;
                }
            }
            for (port, output) in child.outputs.iter().enumerate() {
                if !child.shape(output.node).is_plain() {
                    let vector = self.unpack(instance.outputs[port], axes);
                    debug_assert_eq!(self.module.node(vector).op, Op::Output(InstanceId(index as u32), port as u32));
                    self.module.instances[index].outputs[port] = vector;
                }
            }
        }
    }

    fn memories(&mut self) {
        for index in 0..self.module.memories.len() {
            let memory = &self.module.memories[index];
            let addresses = memory.reads.iter().map(|read| read.address);
            let mut addresses = addresses.chain(memory.writes.iter().map(|write| write.address));
            let width = u64::from(memory.width) * u64::from(memory.shape.lanes());
            // Beyond the depth a read is gated; lanes of a word that are read at different times cannot share the
            // gate.
            let is_gated = u64::from(memory.depth) < 1 << index_width(memory.depth.into());
            let is_masked = |enable: &NodeId| !self.module.shape(*enable).is_plain();
            let splits = is_gated && memory.reads.iter().any(|read| read.enable.as_ref().is_some_and(is_masked));
            let is_wide = addresses.all(|address| self.module.shape(address).is_plain()) && width <= WIDEST_VECTOR;
            let is_wide = is_wide && !splits;
            match memory.shape.is_plain() {
                true => {}
                false if is_wide => self.widen(index),
                false => self.spread_ports(index),
            }
        }
    }

    /// One memory of wide words.
    fn widen(&mut self, index: usize) {
        let mut memory = self.module.memories[index].clone();
        let lanes = memory.shape.lanes();
        memory.contents = wide_contents(&memory.contents, memory.width, lanes);
        (memory.width, memory.shape) = (memory.width * lanes, Shape::Plain);
        for (port, read) in (0..).zip(&mut memory.reads) {
            debug_assert_eq!(self.module.node(read.node).op, Op::Read(MemoryId(index as u32), port));
            read.node = self.unpack(read.node, 0);
            read.enable = read.enable.map(|enable| self.packed(enable, 0));
        }
        for write in &mut memory.writes {
            (write.enable, write.data) = (self.packed(write.enable, 0), self.packed(write.data, 0));
        }
        self.module.memories[index] = memory;
    }

    /// One memory for each lane: what all lanes share is broadcast.
    fn spread_ports(&mut self, index: usize) {
        let mut memory = self.module.memories[index].clone();
        let shape = memory.shape;
        for read in &mut memory.reads {
            read.address = self.spread(read.address, shape);
            read.enable = read.enable.map(|enable| self.spread(enable, shape));
        }
        for write in &mut memory.writes {
            (write.enable, write.address) = (self.spread(write.enable, shape), self.spread(write.address, shape));
        }
        self.module.memories[index] = memory;
    }

    fn spread(&mut self, mut of: NodeId, shape: Shape) -> NodeId {
        while self.module.shape(of).axes() < shape.axes() {
            let Node { width, loc, .. } = *self.module.node(of);
            // The last axis first.
            let shape = match (self.module.shape(of), shape) {
                (Shape::Plain, Shape::Grid(_, columns)) => Shape::Row(columns),
                _ => shape,
            };
            of = self.add(Node::new(Op::Broadcast { of, axis: 0 }, width, shape, loc));
        }
        of
    }

    fn resets(&mut self) -> Vec<Option<NodeId>> {
        let registers = self.module.registers.clone();
        let resets = registers.iter().map(|register| {
            // Without a reset, a register with a value at power-on never takes the other one.
            let has_reset = self.module.clocks[register.clock.0 as usize].kind.has_port();
            let reset = register.reset.as_ref().filter(|_| has_reset || register.initial.is_none())?;
            self.reset(register.node, reset)
        });
        resets.collect()
    }

    /// The constants of the lanes, if they differ.
    fn reset(&mut self, register: NodeId, reset: &Init) -> Option<NodeId> {
        let Init::Each(values) = reset else { return None };
        if values.iter().all(|value| *value == values[0]) {
            return None;
        }
        let Node { width, shape, loc, .. } = *self.module.node(register);
        let node = |op, shape| Node::new(op, width, shape, loc);
        let parts: Vec<NodeId> =
            values.iter().map(|value| self.add(node(Op::Const(value.clone()), Shape::Plain))).collect();
        Some(match shape {
            Shape::Grid(_, columns) => {
                let rows = parts
                    .chunks(columns as usize)
                    .map(|row| self.add(node(Op::Stack { parts: row.to_vec(), axis: 0 }, Shape::Row(columns))));
                let parts = rows.collect();
                self.add(node(Op::Stack { parts, axis: 0 }, shape))
            }
            _ => self.add(node(Op::Stack { parts, axis: 0 }, shape)),
        })
    }
}

/// The name, followed by as many `_` as make it unique in the module.
fn free_name(module: &Module, wanted: &str) -> String {
    let clocks = module.clocks.iter().flat_map(|clock| [Some(&clock.port), clock.reset.as_ref()]).flatten();
    let ports = module.inputs.iter().map(|port| &port.name).chain(module.outputs.iter().map(|port| &port.name));
    let nodes = module.nodes.iter().filter_map(|node| node.name.as_ref());
    let objects = module.memories.iter().map(|memory| &memory.name);
    let objects = objects.chain(module.instances.iter().map(|instance| &instance.name));
    let taken: Vec<&String> = clocks.chain(ports).chain(nodes).chain(objects).collect();
    let mut name = wanted.to_owned();
    while taken.iter().any(|taken| taken.eq_ignore_ascii_case(&name)) {
        name.push('_');
    }
    name
}

fn wide_contents(contents: &Contents, width: u32, lanes: u32) -> Contents {
    let repeated = |word: &Bits| Bits::join(&vec![word.clone(); lanes as usize]);
    match contents {
        Contents::Unknown => Contents::Unknown,
        Contents::Fill(word) => Contents::Fill(repeated(word)),
        Contents::Words(words) => Contents::Words(words.iter().map(repeated).collect()),
        Contents::Each(each) => {
            let count = each.iter().map(Vec::len).max().unwrap_or(0);
            let word = |address| {
                let words = each.iter().map(|words: &Vec<Bits>| words.get(address).cloned());
                let words: Vec<Bits> = words.map(|word| word.unwrap_or_else(|| Bits::zero(width))).collect();
                Bits::join(&words)
            };
            Contents::Words((0..count).map(word).collect())
        }
    }
}
