//! From a program to the functions of generated code.

use tilewright_hdl::{Bits, Module, bit, bits, block, case, cat, row};
use tilewright_sim::{Pass, Passes};

use crate::passes::{after, after_with, is};

block! {
    /// A counter, a table and a rotation.
    struct Counter;
    in CounterIn { enable: bit(), from: bits(16) }
    out CounterOut { count: _, code: _, turned: _ }
}

impl Counter {
    fn build(&self, m: Module, i: CounterIn) -> CounterOut {
        let count = m.reg("count", 8).reset(0);
        count.enable(i.enable).next(count + 1);
        let code = m.reg("code", 8);
        let keys = (0..8u64).map(|key| (key, tilewright_hdl::lit(8, key * key)));
        code.next(case(count.slice(0..3), keys, Bits::zero(8)));
        let turned = m.reg("turned", 16).reset(1);
        turned.next(cat![turned.slice(0..15), turned.bit(15)] ^ i.from);
        CounterOut { count: *count, code: *code, turned: *turned }
    }
}

#[test]
fn edge() {
    is(
        &after(&Counter, Pass::Edge),
        r"
        an edge of clk:
        count  : 8  = register
        %0     : 8  = count + 1
        enable : 1  = input
        %1     : 3  = count[2:0]
        %2     : 8  = case %1 { 1: 1, 2: 4, 3: 9, 4: 8'h10, 5: 8'h19, 6: 8'h24, 7: 8'h31, else 0 }
        from   : 16 = input
        turned : 16 = register
        %3     : 1  = turned[15]
        %4     : 15 = turned[14:0]
        %5     : 16 = {%4, %3}
        %6     : 16 = %5 ^ from
          count <- %0 if enable
          code <- %2
          turned <- %6
    ",
    );
}

#[test]
fn hold() {
    is(
        &after(&Counter, Pass::Hold),
        r"
        an edge of clk:
        count  : 8  = register
        %0     : 3  = count[2:0]
        %1     : 8  = case %0 { 1: 1, 2: 4, 3: 9, 4: 8'h10, 5: 8'h19, 6: 8'h24, 7: 8'h31, else 0 }
        from   : 16 = input
        turned : 16 = register
        %2     : 1  = turned[15]
        %3     : 15 = turned[14:0]
        %4     : 16 = {%3, %2}
        %5     : 16 = %4 ^ from
          code <- %1
          turned <- %5
    ",
    );
}

#[test]
fn lower() {
    is(
        &after(&Counter, Pass::Lower),
        r"
        an edge of clk:
        count  : 8     = register
        %0     : 8     = count + 1
        enable : 1     = input
        %1     : 3     = count[2:0]
        %2     : 8 x 8 = lanes 0, 1, 4, 9, 8'h10, 8'h19, 8'h24, 8'h31
        %3     : 8     = lane %1 of %2
        from   : 16    = input
        turned : 16    = register
        %4     : 16    = turned rotated left by 1
        %5     : 16    = %4 ^ from
          count <- %0 if enable
          code <- %3
          turned <- %5
    ",
    );
}

#[test]
fn sequence() {
    is(
        &after_with(&Counter, Pass::Sequence, &Passes { longest: 8, ..Passes::default() }),
        r"
        an edge of clk:
        piece 0
          %1 : 1 = enable
          %0 : 8 = count + 1
          %2 : 3 = count[2:0]
          count <- %0 if %1
        piece 1
          %4 : 8 = lane %2 of %3
          code <- %4
          %5 : 16 = turned rotated left by 1
          %6 : 16 = %5 ^ from
        piece 2
          turned <- %6
    ",
    );
}

block! {
    /// Applies an opcode to its neighbour's value.
    struct Cell;
    in CellIn { op: bits(2), left: bits(8) }
    out CellOut { q: _ }
}

impl Cell {
    fn build(&self, m: Module, i: CellIn) -> CellOut {
        let q = m.reg("q", 8).reset(0);
        let [sum, both] = [q + i.left, q & i.left];
        let next = case(i.op, [(1, sum), (2, (sum - 1) ^ both), (3, (both + 3) & !sum)], q);
        q.next(next);
        CellOut { q: *q }
    }
}

block! {
    /// A row of cells, each with the one before it.
    struct Row { lanes: u32 }
    in RowIn { op: bits(2), seed: bits(8) }
    out RowOut { all: _ }
}

impl Row {
    fn build(&self, m: Module, i: RowIn) -> RowOut {
        let cells = m.array("u_cell", self.lanes, &Cell, |a| CellIn { op: i.op, left: a.q.previous(i.seed) });
        RowOut { all: m.pipe("all", cells.q.xor_all()) }
    }
}

#[test]
fn lower_neighbours_and_lanes_that_pad() {
    is(
        &after(&Row { lanes: 5 }, Pass::Lower),
        r"
        an edge of clk:
        u_cell.q    : 5 x 8 = register
        %0          : 5 x 1 = lanes 5 times 1
        %1          : 5 x 8 = %0 ? u_cell.q : 0
        %2          : 8     = xor of 5 lanes of %1
        seed        : 8     = input
        %3          : 5 x 8 = 5 times seed
        %4          : 5 x 8 = lane i - 1 of u_cell.q
        %5          : 5 x 1 = lanes 0, 4 times 1
        u_cell.left : 5 x 8 = %5 ? %4 : %3
        %6          : 5 x 8 = u_cell.q + u_cell.left
        %7          : 5 x 8 = not %6
        %8          : 5 x 8 = u_cell.q & u_cell.left
        %9          : 5 x 8 = %8 + 3
        %10         : 5 x 8 = %9 & %7
        %11         : 5 x 8 = %6 - 1
        %12         : 5 x 8 = %11 ^ %8
        op          : 2     = input
        u_cell.op   : 5 x 2 = 5 times op
        %13         : 5 x 8 = case u_cell.op { 1: %6, 2: %12, 3: %10, else u_cell.q }
          all <- %2
          u_cell.q <- %13
    ",
    );
}

#[test]
fn plan() {
    is(
        &after(&Row { lanes: 64 }, Pass::Plan),
        r"
        an edge of clk:
        stage 0
          loop over 64 lanes, the last first:
            %0          : 8      = xor of 64 lanes of u_cell.q
            %2          : 64 x 8 = lane i - 1 of u_cell.q
            u_cell.left : 64 x 8 = %3 ? %2 : %1
            %4          : 64 x 8 = u_cell.q + u_cell.left
            %5          : 64 x 8 = not %4
            %6          : 64 x 8 = u_cell.q & u_cell.left
            %7          : 64 x 8 = %6 + 3
            %8          : 64 x 8 = %7 & %5
            %9          : 64 x 8 = %4 - 1
            %10         : 64 x 8 = %9 ^ %6
            %11         : 64 x 8 = case u_cell.op { 1: %4, 2: %10, 3: %8, else u_cell.q }
            u_cell.q <- %11
        live out: %0
    ",
    );
}

block! {
    /// A rod of cells; each takes the sum of its neighbours' old values.
    struct Heat;
    in HeatIn { ends: bits(8) }
    out HeatOut { all: _ }
}

impl Heat {
    fn build(&self, m: Module, i: HeatIn) -> HeatOut {
        let heat = m.reg("heat", bits(8).of(row(64)));
        let flow = m.reg("flow", bits(8).of(row(64)));
        heat.next(heat.previous(i.ends) + heat.following(i.ends));
        flow.next(flow.following(i.ends));
        HeatOut { all: (*heat ^ *flow).xor_all() }
    }
}

/// When an ascending loop is at a lane, the lane below has already changed: `heat` has to wait for the end, `flow`
/// does not.
#[test]
fn plan_of_a_register_with_neighbours_on_both_sides() {
    is(
        &after(&Heat, Pass::Plan),
        r"
        an edge of clk:
        stage 0
          loop over 64 lanes:
            %1 : 64 x 8 = lane i + 1 of heat
            %3 : 64 x 8 = %2 ? %1 : %0
            %4 : 64 x 8 = lane i - 1 of heat
            %6 : 64 x 8 = %5 ? %4 : %0
            %7 : 64 x 8 = %6 + %3
            %8 : 64 x 8 = lane i + 1 of flow
            %9 : 64 x 8 = %2 ? %8 : %0
            heat <- %7
            flow <- %9
        hazards, changed at the end: heat
    ",
    );
}

#[test]
fn branch() {
    is(
        &after(&Row { lanes: 64 }, Pass::Branch),
        r"
        an edge of clk:
        stage 0
          loop over 64 lanes, the last first: by op
            0:
              %0 : 8 = xor of 64 lanes of u_cell.q
            1:
              %0          : 8      = xor of 64 lanes of u_cell.q
              %2          : 64 x 8 = lane i - 1 of u_cell.q
              u_cell.left : 64 x 8 = %3 ? %2 : %1
              %4          : 64 x 8 = u_cell.q + u_cell.left
              u_cell.q <- %4
            2:
              %0          : 8      = xor of 64 lanes of u_cell.q
              %2          : 64 x 8 = lane i - 1 of u_cell.q
              u_cell.left : 64 x 8 = %3 ? %2 : %1
              %4          : 64 x 8 = u_cell.q + u_cell.left
              %6          : 64 x 8 = u_cell.q & u_cell.left
              %9          : 64 x 8 = %4 - 1
              %10         : 64 x 8 = %9 ^ %6
              u_cell.q <- %10
            3:
              %0          : 8      = xor of 64 lanes of u_cell.q
              %2          : 64 x 8 = lane i - 1 of u_cell.q
              u_cell.left : 64 x 8 = %3 ? %2 : %1
              %4          : 64 x 8 = u_cell.q + u_cell.left
              %5          : 64 x 8 = not %4
              %6          : 64 x 8 = u_cell.q & u_cell.left
              %7          : 64 x 8 = %6 + 3
              %8          : 64 x 8 = %7 & %5
              u_cell.q <- %8
        live out: %0
    ",
    );
}
