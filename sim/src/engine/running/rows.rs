//! Rows for a waveform: its values before each of many edges, stored in memory by one call of generated code. They
//! are collected in the function of the edge, where they are in machine registers.

use std::cell::Cell;

use tilewright_circuit::limbs_for;

use super::Compiled;
use super::prepare::Prepared;
use crate::engine::cranelift::Code;
use crate::engine::function::Maker;
use crate::engine::layout::Place;
use crate::engine::layout::store::Store;
use crate::engine::program::{Triggers, ValueId};
use crate::engine::{Done, LINE};

/// Limbs of all rows together: they should stay in the nearest cache until they are read. For larger circuits, most
/// of a waveform's time is spent on the values, however they are collected.
const LIMBS: usize = 2048;

/// Values that are collected in rows.
pub(super) struct Rows {
    values: Vec<ValueId>,
    /// How many limbs a row has.
    limbs: usize,
    store: Store,
    /// The place of the address of the next row.
    next: Place,
    /// The number of edges requested before there was a function.
    asked: u64,
    /// For an edge, by index.
    code: Option<(usize, Code)>,
}

impl Compiled {
    /// Prepares for collecting these values; returns their index, if all have one lane and there are some, but not
    /// too many.
    pub(super) fn add_rows(&mut self, values: &[ValueId]) -> Option<usize> {
        let circuit = &self.program.circuit;
        if values.is_empty() || values.iter().any(|&id| circuit[id].lanes > 1) {
            return None;
        }
        let limbs: usize = values.iter().map(|&id| limbs_for(circuit[id].width)).sum();
        let limbs = limbs.next_multiple_of(LINE);
        if limbs > LIMBS {
            return None;
        }
        let next = self.layout.place(1, 64);
        self.layout.address(next, 8 * LIMBS);
        self.state.grow(self.layout.size);
        let store = Store::new(8 * LIMBS, self.program.passes.guarded);
        self.rows.push(Rows { values: values.to_vec(), limbs, store, next, asked: 0, code: None });
        Some(self.rows.len() - 1)
    }

    /// Executes at most `count` edges of these clocks, as many as the rows have room for, and returns the rows.
    /// `None` while resets are high, because registers are reset after a function has run, and before there were some
    /// edges.
    pub(super) fn fill_rows(&mut self, index: usize, rising: &[usize], count: u64) -> Option<(Done, &[Cell<u64>])> {
        let rows = &mut self.rows[index];
        rows.asked = rows.asked.saturating_add(count);
        if self.any_reset || rows.asked < self.program.passes.looks_after {
            return None;
        }
        let room = (LIMBS / rows.limbs) as u64;
        self.unready();
        self.looked = false;
        let edge = self.edge(rising);
        let code = self.rows_code(index, edge);
        let Rows { next, limbs, ref store, .. } = self.rows[index];
        self.state.put(next, &[store.address() as u64]);
        let count = count.min(room);
        let edges = count - self.call_with_versions(code, count);
        let changed = self.edges[edge].changes;
        self.edges[edge].pass(edges);
        if edges > 0 {
            self.change(changed);
        }
        let changed = if edges > 0 { changed } else { Triggers::NONE };
        Some((Done { edges, changed }, &self.rows[index].store.limbs()[..edges as usize * limbs]))
    }

    /// The function for an edge that stores a row.
    fn rows_code(&mut self, index: usize, edge: usize) -> Code {
        match self.rows[index].code {
            Some((of, code)) if of == edge => code,
            _ => {
                let code = self.make_rows(index, edge);
                self.rows[index].code = Some((edge, code));
                code
            }
        }
    }

    #[cold]
    fn make_rows(&mut self, index: usize, edge: usize) -> Code {
        let (rising, resets) = self.edges[edge].clocks();
        let program = self.program.clone();
        let check = Maker::new(&program).check(&rising, &resets).map(|check| self.prepare(&check, &[]));
        let Rows { ref values, next, .. } = self.rows[index];
        let mut maker = Maker::new(&program);
        let row = maker.state(64);
        maker.rows(row, values);
        let edge = self.prepare_edge(&maker.edge(&rising).0, &[next]);
        let parts: Vec<Prepared> = check.into_iter().chain([edge]).collect();
        self.compile(&parts)
    }
}
