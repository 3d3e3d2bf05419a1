//! Lanes of one bit, packed.

use tilewright_hdl::{Bits, Module, ReadUnderWrite, bit, bits, block, grid};
use tilewright_sim::{Pass, Passes};

use crate::{after, after_with, is};

block! {
    /// A square of bits that are moved down, and summed up in a plane of memory.
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
    // Without the pass it is as the one before has left it.
    let apart = after_with(&Square, Pass::Pack, &Passes { pack_from: u32::MAX, ..Passes::default() });
    assert_eq!(apart, after(&Square, Pass::Fields));
}
