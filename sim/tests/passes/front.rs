//! From a design to a program.

use tilewright_hdl::{Module, bit, bits, block, bundle, constants, stack};
use tilewright_sim::{Pass, Passes};

use crate::passes::{after, after_with, is};

block! {
    /// A running sum.
    struct Cell;
    in CellIn { x: bits(8), op: bits(8) }
    out CellOut { sum: _ }
}

impl Cell {
    fn build(&self, m: Module, i: CellIn) -> CellOut {
        let sum = m.reg("sum", 8).reset(0);
        let mask = (i.op ^ 0x55) & (i.op + 1) & (i.op + 2);
        sum.next(sum + (i.x & mask));
        CellOut { sum: *sum }
    }
}

bundle! {
    pub struct TopIn<T> { pub op: T, pub go: T }
    pub struct TopOut<T> { pub y: T }
}

block! {
    /// Cells, written one by one or as an array.
    struct Top { array: bool }
    in = TopIn { op: bits(8), go: bit() };
    out = TopOut { y: bits(8) };
}

impl Top {
    fn build(&self, m: Module, i: TopIn) -> TopOut {
        let x = i.op.slice(0..7).zext(8);
        m.ignore(&i.go);
        if self.array {
            let cells = m.array("u_cell", 4, &Cell, |_| CellIn { x: constants(bits(8).of(4), u64::from), op: i.op });
            return TopOut { y: cells.sum.xor_all() };
        }
        let cells: Vec<_> =
            (0..4).map(|n| m.instance(&format!("u_cell{n}"), &Cell, CellIn { x: x + n, op: i.op }).sum).collect();
        TopOut { y: cells.into_iter().reduce(|all, sum| all ^ sum).unwrap() }
    }
}

#[test]
fn siblings() {
    is(
        &after(&Top { array: false }, Pass::Siblings),
        r"
        op          : 8     = input
        go          : 1     = input
        %0          : 7     = op[6:0]
        %1          : 8     = zext %0
        %2          : 8     = %1 + 0
        %3          : 8     = lane 0 of 4 of u_cell0.sum
        %4          : 8     = %1 + 1
        %5          : 8     = lane 1 of 4 of u_cell0.sum
        %6          : 8     = %1 + 2
        %7          : 8     = lane 2 of 4 of u_cell0.sum
        %8          : 8     = %1 + 3
        %9          : 8     = lane 3 of 4 of u_cell0.sum
        %10         : 8     = %3 ^ %5
        %11         : 8     = %10 ^ %7
        y           : 8     = %11 ^ %9
        %12         : 4 x 8 = lanes %2, %4, %6, %8
        %13         : 4 x 8 = lanes 4 times op
        u_cell0.x   : 4 x 8 = %12
        u_cell0.op  : 4 x 8 = %13
        u_cell0.sum : 4 x 8 = register
        %14         : 4 x 8 = u_cell0.op ^ 8'h55
        %15         : 4 x 8 = u_cell0.op + 1
        %16         : 4 x 8 = %14 & %15
        %17         : 4 x 8 = u_cell0.op + 2
        %18         : 4 x 8 = %16 & %17
        %19         : 4 x 8 = u_cell0.x & %18
        %20         : 4 x 8 = u_cell0.sum + %19
        at clk:
          u_cell0.sum <- %20, 0 after a reset
        output y = y
    ",
    );
}

#[test]
fn uniform() {
    is(
        &after(&Top { array: true }, Pass::Uniform),
        r"
        op         : 8     = input
        go         : 1     = input
        u_cell.sum : 4 x 8 = register
        u_cell.x   : 4 x 8 = lanes 0, 1, 2, 3
        y          : 8     = xor of 4 lanes of u_cell.sum
        %0         : 8     = op + 2
        %1         : 8     = op + 1
        %2         : 8     = op ^ 8'h55
        %3         : 8     = %2 & %1
        %4         : 8     = %3 & %0
        %5         : 4 x 8 = 4 times %4
        %6         : 4 x 8 = u_cell.x & %5
        u_cell.op  : 4 x 8 = 4 times op
        %7         : 4 x 8 = u_cell.sum + %6
        at clk:
          u_cell.sum <- %7, 0 after a reset
        output y = y
    ",
    );
    is(
        &after_with(&Top { array: true }, Pass::Uniform, &Passes { uniform: false, ..Passes::default() }),
        r"
        op         : 8     = input
        go         : 1     = input
        u_cell.sum : 4 x 8 = register
        u_cell.x   : 4 x 8 = lanes 0, 1, 2, 3
        y          : 8     = xor of 4 lanes of u_cell.sum
        u_cell.op  : 4 x 8 = 4 times op
        %0         : 4 x 8 = u_cell.op + 2
        %1         : 4 x 8 = u_cell.op + 1
        %2         : 4 x 8 = u_cell.op ^ 8'h55
        %3         : 4 x 8 = %2 & %1
        %4         : 4 x 8 = %3 & %0
        %5         : 4 x 8 = u_cell.x & %4
        %6         : 4 x 8 = u_cell.sum + %5
        at clk:
          u_cell.sum <- %6, 0 after a reset
        output y = y
    ",
    );
}

block! {
    /// Duplicate expressions, and expressions without effect.
    struct Twice;
    in PairIn { a: bits(8), b: bits(8) }
    out PairOut { y: _, z: _ }
}

impl Twice {
    fn build(&self, _: Module, i: PairIn) -> PairOut {
        let sum = (i.a + i.b).named("sum");
        let again = (i.a + i.b).named("again");
        PairOut { y: sum ^ again, z: (again & 0xff) + (tilewright_hdl::lit(8, 3) - 3) }
    }
}

#[test]
fn flatten() {
    is(
        &after(&Twice, Pass::Flatten),
        r"
        a     : 8 = input
        b     : 8 = input
        sum   : 8 = a + b
        again : 8 = a + b
        y     : 8 = sum ^ again
        %0    : 8 = again & 8'hff
        %1    : 8 = 3 - 3
        z     : 8 = %0 + %1
        output y = y
        output z = z
    ",
    );
}

#[test]
fn share() {
    is(
        &after(&Twice, Pass::Share),
        r"
        a   : 8 = input
        b   : 8 = input
        %0  : 8 = 3 - 3
        sum : 8 = a + b
        y   : 8 = sum ^ sum
        %1  : 8 = sum & 8'hff
        z   : 8 = %1 + %0
        output y = y
        output z = z
    ",
    );
}

#[test]
fn fold() {
    is(
        &after(&Twice, Pass::Fold),
        r"
        a : 8 = input
        b : 8 = input
        z : 8 = a + b
        output y = 0
        output z = z
    ",
    );
}

block! {
    /// Lanes of an array that are computed one by one.
    struct Lifted;
    in = TopIn { op: bits(8), go: bit() };
    out = TopOut { y: bits(8) };
}

impl Lifted {
    fn build(&self, m: Module, i: TopIn) -> TopOut {
        m.ignore(&i.go);
        let first = m.array("u_first", 4, &Cell, |_| CellIn { x: constants(bits(8).of(4), u64::from), op: i.op });
        let second = m.array("u_second", 4, &Cell, |_| {
            let each = first.sum.to_vec().into_iter().map(|sum| sum + i.op);
            CellIn { x: stack(each), op: i.op }
        });
        TopOut { y: second.sum.xor_all() }
    }
}

#[test]
fn lift() {
    is(
        &after(&Lifted, Pass::Lift),
        r"
        op           : 8     = input
        go           : 1     = input
        u_first.sum  : 4 x 8 = register
        u_second.sum : 4 x 8 = register
        u_first.x    : 4 x 8 = lanes 0, 1, 2, 3
        y            : 8     = xor of 4 lanes of u_second.sum
        u_first.op   : 4 x 8 = 4 times op
        %0           : 8     = op + 2
        %1           : 8     = op + 1
        %2           : 8     = op ^ 8'h55
        %3           : 8     = %2 & %1
        %4           : 8     = %3 & %0
        %5           : 4 x 8 = 4 times %4
        %6           : 4 x 8 = u_first.x & %5
        %7           : 4 x 8 = u_first.sum + %6
        u_second.x   : 4 x 8 = u_first.sum + u_first.op
        %8           : 4 x 8 = u_second.x & %5
        %9           : 4 x 8 = u_second.sum + %8
        at clk:
          u_first.sum <- %7, 0 after a reset
          u_second.sum <- %9, 0 after a reset
        output y = y
    ",
    );
}
