//! The common mechanism of all rewriting: value numbering under rules.
//!
//! A [`Rewriter`] builds a circuit. Adding an operation returns the number of its value: that of an earlier cell if
//! one computes the same, after all [`rules`] have been applied. So a circuit that is passed through, operation by
//! operation, becomes smaller and computes the same.

mod rebuild;
mod rules;

use std::collections::hash_map::Entry;

use rustc_hash::{FxBuildHasher, FxHashMap};
use tilewright_circuit::ir::Relation;
use tilewright_circuit::{Bits, Loc};

use crate::engine::Passes;
use crate::engine::program::{Cell, Circuit, Kind, Program, ValueId};

pub(crate) use rebuild::rebuild;

/// The result of a rule.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Rewrite {
    /// The operation equals an existing value.
    Same(ValueId),
    /// Another operation computes it; all rules are applied to that again.
    As(Kind),
}

/// Builds a circuit in which no two cells compute the same.
#[derive(Debug, Clone)]
pub(crate) struct Rewriter {
    circuit: Circuit,
    /// The cells, by their operations.
    known: FxHashMap<Cell, ValueId>,
    passes: Passes,
    /// The place in the description of added cells.
    loc: Option<Loc>,
}

impl Rewriter {
    /// An empty circuit, with the rules that the passes enable.
    pub fn new(passes: &Passes) -> Rewriter {
        Rewriter { circuit: Circuit::default(), known: FxHashMap::default(), passes: passes.clone(), loc: None }
    }

    /// A rewriter with this circuit, and without rules.
    #[cfg(test)]
    pub fn of(circuit: Circuit) -> Rewriter {
        Rewriter { circuit, ..Rewriter::new(&Passes::none()) }
    }

    /// A rewriter with an empty circuit, and the same rules.
    pub fn empty(&self) -> Rewriter {
        Rewriter::new(&self.passes)
    }

    /// The circuit so far.
    pub fn circuit(&self) -> &Circuit {
        &self.circuit
    }

    /// The circuit, complete.
    pub fn finish(self) -> Circuit {
        self.circuit
    }

    /// Sets the place in the description of cells added from now on.
    pub fn at(&mut self, loc: Option<Loc>) -> &mut Self {
        self.loc = loc;
        self
    }

    /// Adds a value that is set from outside the circuit.
    pub fn state(&mut self, lanes: u32, width: u32) -> ValueId {
        self.circuit.push(Cell::new(Kind::State, lanes, width), self.loc)
    }

    /// The value of an operation on values of this circuit, which is not state.
    pub fn number(&mut self, cell: Cell) -> ValueId {
        self.number_or_find(cell).0
    }

    /// Like [`Rewriter::number`]; also returns whether the operation must still be computed, or is one of its
    /// operands.
    pub fn number_or_find(&mut self, cell: Cell) -> (ValueId, bool) {
        match self.reduce(cell) {
            Ok(same) => (same, false),
            Err(cell) => (self.share(cell), true),
        }
    }

    /// The result of an operation, if it is known.
    pub fn known(&mut self, cell: Cell) -> Option<Bits> {
        match self.reduce(cell) {
            Ok(same) => self.circuit.constant(same).cloned(),
            Err(Cell { kind: Kind::Const(bits), .. }) => Some(bits),
            Err(_) => None,
        }
    }

    /// The value that equals an operation, or the simplest operation that computes it.
    fn reduce(&mut self, mut cell: Cell) -> Result<ValueId, Cell> {
        loop {
            match rules::apply(self, &cell) {
                Some(Rewrite::Same(id)) => return Ok(id),
                Some(Rewrite::As(kind)) => cell.kind = kind,
                None => return Err(cell),
            }
        }
    }

    /// Like [`Rewriter::number`], from the parts of a cell.
    pub fn add(&mut self, kind: Kind, lanes: u32, width: u32) -> ValueId {
        self.number(Cell::new(kind, lanes, width))
    }

    /// Adds a cell as it is.
    pub fn push(&mut self, cell: Cell) -> ValueId {
        self.circuit.push(cell, self.loc)
    }

    /// Adds a copy of a cell, for a second use.
    pub fn copy(&mut self, id: ValueId) -> ValueId {
        let Cell { lanes, width, .. } = self.circuit[id];
        self.push(Cell::new(Kind::Alias(id), lanes, width))
    }

    /// From now on, only variants of existing cells are added. The rules add no new operations then, and do not use
    /// any earlier cell, which may be computed elsewhere.
    pub fn vary(&mut self) {
        self.passes = Passes { fold: true, share: true, uniform: false, lift: false, ..self.passes };
        self.known.clear();
    }

    /// Drops all cells after the first `cells`.
    pub fn truncate(&mut self, cells: usize) {
        self.circuit.truncate(cells);
        self.known.clear();
    }

    /// A constant in all lanes.
    pub fn constant(&mut self, bits: Bits, lanes: u32) -> ValueId {
        let width = bits.width();
        self.add(Kind::Const(bits), lanes, width)
    }

    /// 1 bit: whether a value is less than a number, both unsigned.
    pub fn below(&mut self, value: ValueId, limit: u32) -> ValueId {
        let Cell { lanes, width, .. } = self.circuit[value];
        if width < u32::BITS && limit >> width > 0 {
            return self.constant(Bits::new(1, 1), lanes);
        }
        let limit = self.constant(Bits::new(width, limit.into()), lanes);
        self.add(Kind::Compare(Relation::Lt, false, value, limit), lanes, 1)
    }

    /// The earlier cell that computes the same, or a new one.
    fn share(&mut self, cell: Cell) -> ValueId {
        if !self.passes.share {
            return self.push(cell);
        }
        match self.known.entry(cell) {
            Entry::Occupied(known) => *known.get(),
            Entry::Vacant(new) => {
                let id = self.circuit.push(new.key().clone(), self.loc);
                *new.insert(id)
            }
        }
    }
}

/// Rewrites the circuit of a program.
pub(crate) fn simplify(program: &mut Program) {
    let mut rewriter = Rewriter::new(&program.passes);
    let states = program.circuit.cells().filter(|(_, cell)| cell.kind == Kind::State);
    let state = |(id, cell): (ValueId, &Cell)| (id, rewriter.at(program.circuit.loc(id)).state(cell.lanes, cell.width));
    let mut became = FxHashMap::with_capacity_and_hasher(program.circuit.len(), FxBuildHasher);
    became.extend(states.map(state));
    let mut roots = Vec::new();
    program.rewrite_roots(|value| roots.push(*value));
    rebuild(&program.circuit, roots, &mut became, &mut rewriter, Rewriter::number);
    program.circuit = rewriter.finish();
    program.rewrite_roots(|value| *value = became[value]);
}
