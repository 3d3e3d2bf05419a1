//! Lanes of one bit, packed.

use tilewright_hdl::{Bits, Module, ReadUnderWrite, bit, bits, block, grid, interleave, row};
use tilewright_sim::{Pass, Passes};

use crate::passes::{after, after_with, is};

block! {
    /// A square of bits that are shifted down, and summed up in a plane of memory.
    struct Square;
    in SquareIn { above: bit().of(128), enable: bit(), address: bits(3) }
    out SquareOut { any: bit() }
}

impl Square {
    fn build(&self, m: Module, i: SquareIn) -> SquareOut {
        let square = grid(128, 128);
        let x = m.reg("x", bit().of(square)).reset(0).enable(i.enable);
        let planes = m.memory("planes", 8, bit().of(square), ReadUnderWrite::Old).fill(Bits::zero(1));
        let word = planes.read_async(i.address);
        x.next(x.rows().previous(i.above));
        planes.write(*x, i.address, !word);
        SquareOut { any: word.rows().or_all().or_all() }
    }
}

#[test]
fn pack() {
    is(
        &after(&Square, Pass::Pack),
        r"
        enable             : 1         = input
        address            : 3         = input
        %0                 : 128       = input
        x, 64 lanes a word : 256 x 64  = register
        %1                 : 256 x 3   = 256 times address
        %2                 : 256 x 64  = not x, 64 lanes a word
        %3                 : 2 x 64    = 2 parts of %0
        %4                 : 256 x 1   = 256 times enable
        x                  : 16384 x 1 = 64 parts of x, 64 lanes a word
        above              : 128 x 1   = 64 parts of %3
        %5                 : 256 x 64  = planes[%1]
        %6                 : 64        = or of 256 lanes of %5
        any                : 1         = any one of %6
        %7                 : 256 x 64  = lane i - 1 of 128 of x, 64 lanes a word else %3, for i to 127, 2 lanes apart
        %8                 : 256 x 64  = %2 & %5
        %9                 : 256 x 64  = not %5
        %10                : 256 x 64  = x, 64 lanes a word & %9
        %11                : 256 x 64  = %10 | %8
        at clk:
          x, 64 lanes a word <- %7 if %4, 0 after a reset
          planes[%1] <- %11 if 1
        output any = any
    ",
    );
    // Without the pass, the result is that of the previous pass.
    let apart = after_with(&Square, Pass::Pack, &Passes { pack_from: u32::MAX, ..Passes::default() });
    assert_eq!(apart, after(&Square, Pass::Fields));
}

block! {
    /// A row whose bits are spread, shifted and read.
    struct Row;
    in RowIn { x: bits(4), a: bit() }
    out RowOut { all: bits(8), one: bit(), numbers: bits(8).of(8) }
}

impl Row {
    fn build(&self, m: Module, i: RowIn) -> RowOut {
        let (half, whole) = (m.reg("half", bit().of(row(4))), m.reg("whole", bit().of(row(8))));
        half.next(i.x.unpack(row(4)) ^ i.a);
        whole.next(interleave([*half, !half]) ^ whole.previous(i.a));
        RowOut { all: whole.pack(), one: whole.lane(3), numbers: whole.zext(8) }
    }
}

#[test]
fn pack_rows() {
    is(
        &after(&Row, Pass::Pack),
        r"
        x                    : 4     = input
        a                    : 1     = input
        half, 4 lanes a word : 4     = register
        all                  : 8     = register
        one                  : 1     = all[3]
        whole                : 8 x 1 = 8 parts of all
        numbers              : 8 x 8 = zext whole
        %0                   : 64    = 8 lanes of numbers side by side
        %1                   : 7     = all[6:0]
        %2                   : 32    = zext half, 4 lanes a word
        %3                   : 4     = not half, 4 lanes a word
        %4                   : 32    = zext %3
        %5                   : 64    = {%4, %2}
        %6                   : 64    = %5 << 2
        %7                   : 64    = %5 | %6
        %8                   : 64    = %7 & 64'h3333333333333333
        %9                   : 64    = %8 << 1
        %10                  : 64    = %8 | %9
        %11                  : 64    = %10 & 64'h5555555555555555
        %12                  : 8     = %11[38:31]
        %13                  : 8     = %11[7:0]
        %14                  : 8     = %13 | %12
        %15                  : 4     = sext a
        %16                  : 4     = x ^ %15
        %17                  : 8     = sext a
        %18                  : 1     = %17[7]
        half                 : 4 x 1 = 4 parts of half, 4 lanes a word
        %19                  : 8     = {%1, %18}
        %20                  : 8     = %14 ^ %19
        at clk:
          half, 4 lanes a word <- %16
          all <- %20
        output all = all
        output one = one
        output numbers = %0
    ",
    );
    let apart = after_with(&Row, Pass::Pack, &Passes { pack_from: u32::MAX, ..Passes::default() });
    assert_eq!(apart, after(&Row, Pass::Fields));
}
