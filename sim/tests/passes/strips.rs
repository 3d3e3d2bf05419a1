//! The instructions of small circuits.

use tilewright_hdl::{Module, bits, block, bundle, row};
use tilewright_sim::Pass;

use super::late::{Filled, Mixer};
use crate::passes::{after, is};

bundle! {
    pub struct CellOut<T> { pub q: T }
}

block! {
    /// Counts.
    struct Cell;
    out = CellOut { q: bits(8) };
}

impl Cell {
    fn build(&self, m: Module, (): ()) -> CellOut {
        let q = m.reg("q", 8).reset(0);
        q.next(*q + 1);
        CellOut { q: *q }
    }
}

block! {
    /// A row of such cells.
    struct Row;
    out = CellOut { q: bits(8).of(row(64)) };
}

impl Row {
    fn build(&self, m: Module, (): ()) -> CellOut {
        let cells = m.array("u_cell", 64, &Cell, |_| ());
        CellOut { q: cells.q }
    }
}

/// The program in `docs/engine.md`.
#[test]
fn a_loop_over_lanes() {
    is(
        &after(&Row, Pass::Strips),
        r"
        an edge of clk:
        piece 0
        loop v0: i64 = 0
          v1: i64 = add state v0
          v2: i8x16 = load [v1 + 128]              ; q
          v3: i8x16 = add v2 0x01
          store i8x16 [v1 + 128] v3                ; q
          v4: i64 = add v0 16
          v5: i8 = ult i64 v4 64
        again if v5 with v4
    ",
    );
}

#[test]
fn a_sum_of_lanes_and_a_loop_that_uses_it() {
    is(
        &after(&Mixer, Pass::Strips),
        r"
        an edge of clk:
        piece 0
        loop v0: i64 = 0, v1: i8x16 = 0x00
          v2: i64 = add state v0
          v3: i8x16 = load [v2 + 128]              ; u_cell.q
          v4: i8x16 = xor v1 v3
          v5: i64 = add v0 16
          v6: i8 = ult i64 v5 64
        again if v6 with v5 v4
        v7: i8x16 = shuffle v4 v4 by 8 9 10 11 12 13 14 15 0 1 2 3 4 5 6 7
        v8: i8x16 = xor v4 v7
        v9: i8x16 = shuffle v8 v8 by 4 5 6 7 8 9 10 11 12 13 14 15 0 1 2 3
        v10: i8x16 = xor v8 v9
        v11: i8x16 = shuffle v10 v10 by 2 3 4 5 6 7 8 9 10 11 12 13 14 15 0 1
        v12: i8x16 = xor v10 v11
        v13: i8x16 = shuffle v12 v12 by 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 0
        v14: i8x16 = xor v12 v13
        v15: i8 = lane 0 of i8x16 v14
        v16: i64 = zero_extend i8 v15
        store i64 [state + 384] v16              ; all
        v17: i8x16 = splat i8 v15
        loop v18: i64 = 0
          v19: i64 = add state v18
          v20: i8x16 = load [v19 + 128]            ; u_cell.q
          v21: i8x16 = and v20 0x1f
          v22: i16x8 = cast i8x16 v21
          v23: i16x8 = shl v22 3
          v24: i8x16 = cast i16x8 v23
          v25: i8x16 = xor v24 v20
          v26: i8x16 = add v25 v17
          store i8x16 [v19 + 128] v26              ; u_cell.q
          v27: i64 = add v18 16
          v28: i8 = ult i64 v27 64
        again if v28 with v27
    ",
    );
}

#[test]
fn a_memory() {
    is(
        &after(&Filled, Pass::Strips),
        r"
        an edge of clk:
        piece 0
        v0: i64 = load [state]                   ; address
        v1: i64 = add @0 v0
        v2: i8 = load [v1]                       ; words
        v3: i64 = zero_extend i8 v2
        v4: i64 = xor v3 255
        store i64 [state + 16] v4                ; data
        v5: i64 = load [state + 8]               ; word
        v6: i64 = xor v5 255
        v7: i64 = add @0 v0
        v8: i8 = truncate i64 v6
        store i8 [v7] v8                         ; words
    ",
    );
}
