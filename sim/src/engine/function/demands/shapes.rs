//! The shapes of operations and of their operands.

use tilewright_circuit::index_width;
use tilewright_circuit::ir::{Binary, Unary};

use crate::engine::program::{Axis, Cell, Circuit, Kind, Lowered, Piece, ValueId};

/// The shape of a memory.
#[derive(Debug, Clone, Copy)]
pub(super) struct MemoryShape {
    pub lanes: u32,
    pub depth: u32,
    pub width: u32,
}

impl MemoryShape {
    /// Bits of an address.
    pub fn address(self) -> u32 {
        index_width(self.depth.into())
    }
}

/// Compares the shapes of a circuit's values.
pub(super) struct Shapes<'a> {
    pub circuit: &'a Circuit,
    pub memories: &'a [MemoryShape],
}

impl Shapes<'_> {
    pub fn is(&self, id: ValueId, lanes: u32, width: u32) -> bool {
        let cell = &self.circuit[id];
        (cell.lanes, cell.width) == (lanes, width)
    }

    /// Whether a register, or the data of a read, can take this value.
    pub fn can_take(&self, state: ValueId, next: ValueId, enable: Option<ValueId>) -> bool {
        let Cell { lanes, width, .. } = self.circuit[state];
        self.is(next, lanes, width) && enable.is_none_or(|enable| self.is(enable, lanes, 1))
    }

    /// Whether a write port of a memory can take these values.
    pub fn can_write(&self, memory: u32, enable: ValueId, address: ValueId, data: ValueId) -> bool {
        self.memories.get(memory as usize).is_some_and(|memory| {
            self.is(data, memory.lanes, memory.width)
                && self.is(address, memory.lanes, memory.address())
                && self.is(enable, memory.lanes, 1)
        })
    }

    /// Whether the operands of an operation fit.
    pub fn fit(&self, cell: &Cell) -> bool {
        let Cell { ref kind, lanes, width } = *cell;
        let (lanes_of, width_of) = (|id: ValueId| self.circuit[id].lanes, |id: ValueId| self.circuit[id].width);
        let same = |id: ValueId| self.is(id, lanes, width);
        let flag = |id: ValueId| self.is(id, lanes, 1);
        let in_lanes = |id: ValueId| lanes_of(id) == lanes;
        // The shape without an axis; with one, the groups of lanes.
        let less = |id: ValueId, axis: Axis| {
            lanes_of(id).checked_mul(axis.count) == Some(lanes) && lanes_of(id).is_multiple_of(axis.inner)
        };
        let more = |id: ValueId, axis: Axis| {
            lanes.checked_mul(axis.count) == Some(lanes_of(id)) && lanes.is_multiple_of(axis.inner)
        };
        let wide = |id: ValueId| width_of(id) == width;
        match kind {
            Kind::State => true,
            Kind::Const(bits) => bits.width() == width,
            Kind::Alias(of) | Kind::Unary(Unary::Not, of) => same(*of),
            Kind::Unary(_, of) => in_lanes(*of) && width == 1,
            Kind::Binary(Binary::Mul | Binary::MulSigned, a, b) => {
                in_lanes(*a) && in_lanes(*b) && width_of(*a).checked_add(width_of(*b)) == Some(width)
            }
            Kind::Binary(_, a, b) => same(*a) && same(*b),
            Kind::Compare(_, _, a, b) => in_lanes(*a) && self.is(*b, lanes, width_of(*a)) && width == 1,
            Kind::Shift(_, of, by) => same(*of) && in_lanes(*by),
            Kind::Mux { select, on_true, on_false } => flag(*select) && same(*on_true) && same(*on_false),
            Kind::Select { arms, default } => {
                arms.iter().all(|(condition, value)| flag(*condition) && same(*value)) && same(*default)
            }
            Kind::Case { subject, arms, default } => {
                let key = width_of(*subject);
                in_lanes(*subject)
                    && arms.iter().all(|(bits, value)| bits.width() == key && same(*value))
                    && same(*default)
            }
            Kind::Slice(of, low) => in_lanes(*of) && low.checked_add(width).is_some_and(|high| high <= width_of(*of)),
            Kind::Concat(parts) => {
                parts.iter().all(|part| in_lanes(*part))
                    && parts.iter().map(|part| u64::from(width_of(*part))).sum::<u64>() == u64::from(width)
            }
            Kind::Repeat(of, n) => in_lanes(*of) && width_of(*of).checked_mul(*n) == Some(width),
            Kind::Extend(of, _) => in_lanes(*of) && width_of(*of) <= width,
            Kind::Read { memory, address } => self.reads(cell, *memory, *address),
            Kind::Broadcast { of, axis } => less(*of, *axis) && wide(*of),
            Kind::Stack { parts, inner } => {
                let axis = Axis { count: parts.len() as u32, inner: *inner };
                !parts.is_empty() && parts.iter().all(|part| less(*part, axis) && wide(*part))
            }
            Kind::Map { of, axis, count, index, edge } => {
                let to = Axis { count: *count, ..*axis };
                let is_whole = |axis: Axis, lanes: u32| axis.lanes() > 0 && lanes.is_multiple_of(axis.lanes());
                is_whole(*axis, lanes_of(*of))
                    && is_whole(to, lanes)
                    && lanes_of(*of) / axis.lanes() == lanes / to.lanes()
                    && wide(*of)
                    && index.div > 0
                    && match edge {
                        Some(edge) => less(*edge, to) && wide(*edge),
                        None => (0..*count).all(|lane| index.source(lane, axis.count).is_some()),
                    }
            }
            Kind::Interleave { parts, axis } => {
                parts.first().is_some_and(|first| lanes_of(*first).is_multiple_of(axis.lanes()))
                    && parts
                        .iter()
                        .all(|part| wide(*part) && lanes_of(*part).checked_mul(parts.len() as u32) == Some(lanes))
            }
            Kind::Lane { of, axis, index } => more(*of, *axis) && wide(*of) && *index < axis.count,
            Kind::Pick { of, axis, index } => more(*of, *axis) && wide(*of) && in_lanes(*index),
            Kind::Reduce { of, axis, .. } => more(*of, *axis) && wide(*of),
            Kind::Pack { of, axis } => more(*of, *axis) && width_of(*of).checked_mul(axis.count) == Some(width),
            Kind::Unpack { of, axis } => less(*of, *axis) && width.checked_mul(axis.count) == Some(width_of(*of)),
            Kind::Lowered(lowered) => match *lowered {
                Lowered::Gather { of, at } => wide(of) && in_lanes(at),
                Lowered::Slide { of, .. } => same(of),
                Lowered::Word { memory, address } => self.reads(cell, memory, address),
                Lowered::WordOf { memory, address, at } => {
                    let memory = self.memories.get(memory as usize);
                    memory.is_some_and(|memory| memory.width == width && self.is(address, 1, memory.address()))
                        && in_lanes(at)
                }
                Lowered::Rotate { of, left } => same(of) && left < width,
                Lowered::Assemble { ref of, ref pieces } => {
                    let is_in = |piece: &Piece| {
                        let high = piece.low.checked_add(piece.width);
                        of.get(piece.of as usize).is_some_and(|&of| high.is_some_and(|high| high <= width_of(of)))
                    };
                    of.iter().all(|of| in_lanes(*of))
                        && pieces.iter().all(is_in)
                        && pieces.iter().map(|piece| u64::from(piece.width)).sum::<u64>() == u64::from(width)
                }
            },
        }
    }

    /// Whether a cell is the word of a memory at that address.
    fn reads(&self, cell: &Cell, memory: u32, address: ValueId) -> bool {
        let memory = self.memories.get(memory as usize);
        memory.is_some_and(|memory| {
            (memory.lanes, memory.width) == (cell.lanes, cell.width) && self.is(address, cell.lanes, memory.address())
        })
    }
}
