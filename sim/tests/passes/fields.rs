//! Wide words, split.

use tilewright_hdl::{Module, ReadUnderWrite, bits, block, cat, lit, row};
use tilewright_sim::{Pass, Passes};

use crate::passes::{after, after_with, is};

block! {
    /// Stores a row and a number in a word.
    struct Words;
    in WordsIn { address: bits(2), x: bits(16) }
    out WordsOut { row: _, low: _ }
}

impl Words {
    fn build(&self, m: Module, i: WordsIn) -> WordsOut {
        let (words, last) = (m.memory("words", 4, 112, ReadUnderWrite::Old), m.reg("last", 112).reset(0));
        let steps = m.reg("steps", bits(32).of(row(3))).reset(7);
        steps.next(*steps + i.x.zext(32));
        words.write(lit(1, 1), i.address, cat![steps.pack(), i.x]);
        last.next(words.read_async(i.address));
        WordsOut { row: last.part(16, 96).unpack(row(3)).xor_all(), low: last.part(0, 16) }
    }
}

#[test]
fn fields() {
    is(
        &after(&Words, Pass::Fields),
        r"
        address      : 2      = input
        x            : 16     = input
        steps        : 3 x 32 = register
        low          : 16     = register
        last[111:16] : 3 x 32 = register
        row          : 32     = xor of 3 lanes of last[111:16]
        %0           : 3 x 2  = 3 times address
        %1           : 32     = zext x
        %2           : 3 x 32 = 3 times %1
        %3           : 96     = 3 lanes of last[111:16] side by side
        last         : 112    = {%3, low}
        %4           : 16     = words[15:0][address]
        %5           : 3 x 32 = words[111:16][%0]
        %6           : 3 x 32 = steps + %2
        at clk:
          low <- %4, 0 after a reset
          last[111:16] <- %5, 0 after a reset
          steps <- %6, 7 after a reset
          words[15:0][address] <- x if 1
          words[111:16][%0] <- steps if 1
        output row = row
        output low = low
    ",
    );
    // Without the pass, the result is that of the previous pass.
    let whole = after_with(&Words, Pass::Fields, &Passes { fields: false, ..Passes::default() });
    assert_eq!(whole, after(&Words, Pass::Lift));
}
