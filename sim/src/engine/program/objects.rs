//! The objects that an instance reads and changes: registers, memories, properties.

use tilewright_circuit::ir::{self, Binary, ClockId, Directive, Module, NodeId, Piece, Property, Shape};
use tilewright_circuit::{Bits, Loc};

use super::flatten::{Body, Flatten};
use super::{Assert, Axis, Cell, Cover, Display, Kind, Memory, ReadPort, Register, UnitId, ValueId, WritePort};

impl Flatten<'_> {
    /// Adds registers, memories and properties; returns the program's memory for each memory of the module.
    pub(super) fn state(&mut self, body: &Body, module: &Module) -> Vec<u32> {
        let clock = |id: ClockId| body.clocks[id.0 as usize];
        for register in &module.registers {
            self.flat.program.registers.push(Register {
                value: body.whole(register.node),
                clock: clock(register.clock),
                reset: register.reset.clone(),
                initial: register.initial.clone(),
                enable: register.enable.map(|node| body.whole(node)),
                next: body.whole(register.next),
                unit: body.unit,
            });
        }
        module.properties.iter().for_each(|property| self.property(body, module, property));
        module.memories.iter().map(|memory| self.memory(body, module, memory)).collect()
    }

    /// Adds an assertion, a display, or a counter for a cover.
    fn property(&mut self, body: &Body, module: &Module, property: &Property) {
        let Property { directive, condition, ref message, loc, .. } = *property;
        let (clock, of) = (body.clocks[property.clock.0 as usize], body.whole(condition));
        let (group, scopes) = (module.node(condition).shape.lanes(), body.scopes.clone());
        if directive == Directive::Cover {
            let counter = self.counter(clock, of, body.lanes * group, loc, body.unit);
            self.flat.program.covers.push(Cover { clock, counter, name: message.clone(), loc, group, scopes });
            return;
        }
        if directive == Directive::Display {
            let values = property.values.iter().map(|shown| (body.whole(shown.node), shown.kind)).collect();
            let pieces = Piece::of(message).expect("the text of a display in a design is sound");
            let display = Display { clock, condition: of, pieces, values, loc, group, scopes };
            self.flat.program.displays.push(display);
            return;
        }
        let is_assumption = directive == Directive::Assume;
        let message = message.clone();
        self.flat.program.asserts.push(Assert { clock, condition: of, message, is_assumption, loc, group, scopes });
    }

    /// A register that counts the edges at which a condition is high.
    fn counter(&mut self, clock: u32, condition: ValueId, lanes: u32, loc: Loc, unit: Option<UnitId>) -> ValueId {
        let circuit = &mut self.flat.program.circuit;
        let mut add = |kind| circuit.push(Cell::new(kind, lanes, u64::BITS), Some(loc));
        let (value, one) = (add(Kind::State), add(Kind::Const(Bits::new(u64::BITS, 1))));
        let next = add(Kind::Binary(Binary::Add, value, one));
        let (reset, initial, enable) = (None, Some(Bits::zero(u64::BITS)), Some(condition));
        self.flat.program.registers.push(Register { value, clock, reset, initial, enable, next, unit });
        value
    }

    /// Adds a memory.
    fn memory(&mut self, body: &Body, module: &Module, memory: &ir::Memory) -> u32 {
        let index = self.flat.program.memories.len() as u32;
        let clock = |id: ClockId| body.clocks[id.0 as usize];
        let (mut reads, mut writes) = (Vec::new(), Vec::new());
        for (port, read) in (0..).zip(&memory.reads) {
            let address = self.in_lanes(body, module, read.address, memory.shape);
            match read.clock {
                None => {
                    self.addresses.insert((index, port), address);
                }
                Some(id) => {
                    let enable = read.enable.map(|enable| self.in_lanes(body, module, enable, memory.shape));
                    reads.push(ReadPort { clock: clock(id), address, enable, value: body.whole(read.node) });
                }
            }
        }
        for write in &memory.writes {
            let [enable, address] =
                [write.enable, write.address].map(|node| self.in_lanes(body, module, node, memory.shape));
            writes.push(WritePort { clock: clock(write.clock), enable, address, data: body.whole(write.data) });
        }
        self.flat.program.memories.push(Memory {
            lanes: body.lanes * memory.shape.lanes(),
            depth: memory.depth,
            width: memory.width,
            policy: memory.policy,
            contents: memory.contents.clone(),
            reads,
            writes,
            unit: body.unit,
        });
        index
    }

    /// A node in all lanes of a shape, even if it is plain.
    fn in_lanes(&mut self, body: &Body, module: &Module, id: NodeId, shape: Shape) -> ValueId {
        let (node, of) = (module.node(id), body.whole(id));
        if node.shape == shape {
            return of;
        }
        let axis = Axis::last(shape.lanes());
        let cell = Cell::new(Kind::Broadcast { of, axis }, body.lanes * axis.count, node.width);
        self.flat.program.circuit.push(cell, Some(node.loc))
    }
}
