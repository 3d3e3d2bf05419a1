//! The circuit of operations: the result of flattening a design, which every pass rewrites and from which code is
//! made.

use std::ops::Index;

use tilewright_circuit::{Bits, Loc};

use super::Kind;

/// The index of a value in a [`Circuit`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ValueId(pub u32);

impl ValueId {
    /// The id as an index.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A value: its operation and its shape. Two equal cells of a circuit compute the same, unless they are state.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Cell {
    /// Its operation.
    pub kind: Kind,
    /// The number of lanes, at least 1.
    pub lanes: u32,
    /// The width of a lane in bits, at least 1.
    pub width: u32,
}

impl Cell {
    /// A cell with this number of lanes of this width.
    pub fn new(kind: Kind, lanes: u32, width: u32) -> Cell {
        Cell { kind, lanes, width }
    }
}

/// Values, each computed from others. The objects that it reads and changes (registers, memories, ports) are stored
/// beside it.
#[derive(Debug, Clone, Default)]
pub struct Circuit {
    cells: Vec<Cell>,
    /// For each cell its place in the description.
    locs: Vec<Option<Loc>>,
}

impl Circuit {
    /// The number of cells.
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// Whether there are no cells.
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// All ids, in sequence.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = ValueId> + use<> {
        (0..self.cells.len() as u32).map(ValueId)
    }

    /// All cells, in sequence.
    pub fn cells(&self) -> impl Iterator<Item = (ValueId, &Cell)> {
        (0..).map(ValueId).zip(&self.cells)
    }

    /// Adds a cell.
    pub fn push(&mut self, cell: Cell, loc: Option<Loc>) -> ValueId {
        self.cells.push(cell);
        self.locs.push(loc);
        ValueId(self.cells.len() as u32 - 1)
    }

    /// Replaces the operation of a value.
    pub fn set_kind(&mut self, id: ValueId, kind: Kind) {
        self.cells[id.index()].kind = kind;
    }

    /// Drops all cells after the first `cells`.
    pub fn truncate(&mut self, cells: usize) {
        self.cells.truncate(cells);
        self.locs.truncate(cells);
    }

    /// The place of a value in the description.
    pub fn loc(&self, id: ValueId) -> Option<Loc> {
        self.locs[id.index()]
    }

    /// The value in every lane, if it is constant.
    pub fn constant(&self, id: ValueId) -> Option<&Bits> {
        match &self[id].kind {
            Kind::Const(bits) => Some(bits),
            _ => None,
        }
    }

    /// The flag's known value, if it is constant in every lane.
    pub fn known(&self, flag: ValueId) -> Option<bool> {
        self.constant(flag).map(|bits| !bits.is_zero())
    }

    /// Everything that these values are computed from, and they themselves, each after its operands.
    pub fn needed(&self, roots: impl IntoIterator<Item = ValueId>) -> Vec<ValueId> {
        let mut seen = vec![false; self.cells.len()];
        let mut order = Vec::new();
        let mut open: Vec<(ValueId, bool)> = Vec::new();
        for root in roots {
            open.push((root, false));
            while let Some((id, is_done)) = open.pop() {
                if is_done {
                    order.push(id);
                } else if !std::mem::replace(&mut seen[id.index()], true) {
                    open.push((id, true));
                    self[id].kind.for_each_operand(|operand| open.push((operand, false)));
                }
            }
        }
        order
    }
}

impl Index<ValueId> for Circuit {
    type Output = Cell;

    fn index(&self, id: ValueId) -> &Cell {
        &self.cells[id.index()]
    }
}
