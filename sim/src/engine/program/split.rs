//! Single lanes of nodes, for lanes that depend on each other within a clock: evaluated all at once, they would form
//! a cycle.

use tilewright_circuit::ir::{MemoryId, Module, Node, NodeId, Op};

use super::flatten::{self, Body, Flatten};
use super::{Axis, Cell, Kind, ValueId};

impl Body {
    /// The cell of one lane of a node, if it has cells for its lanes; for a plain node, its only cell.
    pub(super) fn at(&self, node: NodeId, lane: u32) -> ValueId {
        match self.split[node.0 as usize] {
            Some(first) => ValueId(first + lane),
            None => self.whole(node),
        }
    }
}

impl Flatten<'_> {
    /// Whether each lane of a node is computed separately.
    pub(super) fn is_split(&self, body: &Body, id: NodeId) -> bool {
        self.unrolled.nodes.get(&body.key).is_some_and(|nodes| nodes.contains(&id))
    }

    /// Fills in the cells of a node's single lanes, each with the fewest dependencies.
    pub(super) fn split(&mut self, body: &Body, module: &Module, id: NodeId, memories: &[u32]) {
        for lane in 0..module.node(id).shape.lanes() {
            let kind = self.lane_kind(body, module, id, memories, lane);
            self.flat.program.circuit.set_kind(body.at(id, lane), kind);
        }
    }

    /// The operation of one lane of a node.
    fn lane_kind(&mut self, body: &Body, module: &Module, id: NodeId, memories: &[u32], lane: u32) -> Kind {
        let node = module.node(id);
        let shape = node.shape;
        let (along, across) = (|axis| shape.along(axis, lane), |axis| shape.across(axis, lane));
        match &node.op {
            Op::Broadcast { of, axis } => Kind::Alias(body.at(*of, across(*axis))),
            Op::Stack { parts, axis } => Kind::Alias(body.at(parts[along(*axis) as usize], across(*axis))),
            Op::Map { of, axis, index, edge } => {
                let from = module.node(*of).shape;
                match (index.source(along(*axis), from.extent(*axis)), edge) {
                    (Some(source), _) => Kind::Alias(body.at(*of, from.lane(*axis, source, across(*axis)))),
                    (None, edge) => Kind::Alias(body.at(edge.expect("a lane outside has an edge"), across(*axis))),
                }
            }
            Op::Interleave { parts, axis } => {
                let (number, k) = (along(*axis), parts.len() as u32);
                let part = parts[(number % k) as usize];
                Kind::Alias(body.at(part, module.node(part).shape.lane(*axis, number / k, across(*axis))))
            }
            Op::Lane { of, axis, index } => Kind::Alias(body.at(*of, module.node(*of).shape.lane(*axis, *index, lane))),
            Op::Pick { of, axis, index } => {
                let (of, axis) = self.lanes_along(body, module, *of, *axis, lane);
                Kind::Pick { of, axis, index: body.at(*index, lane) }
            }
            Op::Reduce { by, of, axis } => {
                let (of, axis) = self.lanes_along(body, module, *of, *axis, lane);
                Kind::Reduce { by: *by, of, axis }
            }
            Op::Pack { of, axis } => {
                let (of, axis) = self.lanes_along(body, module, *of, *axis, lane);
                Kind::Pack { of, axis }
            }
            Op::Unpack { of, axis } => Kind::Slice(body.at(*of, across(*axis)), along(*axis) * node.width),
            Op::Read(memory, port) if self.is_split(body, id) => {
                self.lane_of_read(body, module, (*memory, *port), memories, lane)
            }
            Op::Input(_) | Op::Register(_) | Op::Read(..) | Op::Output(..) => self.lane_of_whole(body, node, id, lane),
            _ if !self.is_split(body, id) => self.lane_of_whole(body, node, id, lane),
            _ => flatten::elementwise(node, |operand| body.at(*operand, lane)),
        }
    }

    /// One lane of an asynchronous read whose address depends on other lanes of it: all lanes read where this one
    /// does.
    fn lane_of_read(
        &mut self,
        body: &Body,
        module: &Module,
        (memory, port): (MemoryId, u32),
        memories: &[u32],
        lane: u32,
    ) -> Kind {
        let read = &module.memories[memory.0 as usize].reads[port as usize];
        let (data, address) = (module.node(read.node), module.node(read.address));
        let axis = Axis::last(data.shape.lanes());
        let lanes = body.lanes * axis.count;
        let circuit = &mut self.flat.program.circuit;
        let everywhere = Kind::Broadcast { of: body.at(read.address, lane), axis };
        let everywhere = circuit.push(Cell::new(everywhere, lanes, address.width), Some(address.loc));
        let word = Kind::Read { memory: memories[memory.0 as usize], address: everywhere };
        let of = circuit.push(Cell::new(word, lanes, data.width), Some(data.loc));
        Kind::Lane { of, axis, index: lane }
    }

    /// One lane of an operation that is not computed lane by lane here.
    fn lane_of_whole(&self, body: &Body, node: &Node, id: NodeId, lane: u32) -> Kind {
        match &self.flat.program.circuit[body.whole(id)].kind {
            Kind::Const(bits) => Kind::Const(bits.clone()),
            // The instances of an unrolled array.
            Kind::Stack { parts, inner: 1 } => Kind::Alias(parts[lane as usize]),
            Kind::Stack { parts, inner } => {
                let (of, axis) = (parts[(lane / inner) as usize], Axis::last(*inner));
                Kind::Lane { of, axis, index: lane % inner }
            }
            _ => Kind::Lane { of: body.whole(id), axis: Axis::last(node.shape.lanes()), index: lane },
        }
    }

    /// The lanes of a node along an axis, at a lane of the shape without it, as a row.
    fn lanes_along(&mut self, body: &Body, module: &Module, of: NodeId, axis: u32, across: u32) -> (ValueId, Axis) {
        let node = module.node(of);
        let count = node.shape.extent(axis);
        let lanes = (0..count).map(|along| body.at(of, node.shape.lane(axis, along, across)));
        (self.row(body, node, lanes.collect()), Axis::last(count))
    }

    /// Cells for single lanes of a node side by side.
    pub(super) fn row(&mut self, body: &Body, node: &Node, parts: Vec<ValueId>) -> ValueId {
        let lanes = body.lanes * parts.len() as u32;
        let cell = Cell::new(Kind::Stack { parts, inner: 1 }, lanes, node.width);
        self.flat.program.circuit.push(cell, Some(node.loc))
    }

    /// The input of an array's element from a node: the element's lanes of it.
    pub(super) fn element_input(
        &mut self,
        body: &Body,
        module: &Module,
        id: NodeId,
        element: u32,
        lanes: u32,
    ) -> ValueId {
        let first = element * lanes;
        match lanes {
            1 => body.at(id, first),
            _ => self.row(body, module.node(id), (first..first + lanes).map(|lane| body.at(id, lane)).collect()),
        }
    }
}
