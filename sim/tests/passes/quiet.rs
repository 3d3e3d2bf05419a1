//! Loops in which nothing would change.

use tilewright_hdl::{Module, ReadUnderWrite, bits, block, case, row};
use tilewright_sim::Pass;

use crate::passes::{after, is};

block! {
    /// A row of sums that a command changes, and words that are written.
    struct Adder;
    in AdderIn { op: bits(2), write: bits(1), x: bits(8) }
    out AdderOut { all: bits(8), word: bits(8) }
}

impl Adder {
    fn build(&self, m: Module, i: AdderIn) -> AdderOut {
        let sum = m.reg("sum", bits(8).of(row(2048))).reset(0);
        sum.next(case(i.op, [(1, *sum + i.x), (2, *sum ^ i.x)], *sum));
        let words = m.memory("words", 2, bits(8).of(row(2048)), ReadUnderWrite::Old);
        words.write(i.write.of(row(2048)), i.op.trunc(1), i.x.of(row(2048)));
        AdderOut { all: sum.lane(3), word: words.read_async(i.write).lane(3) }
    }
}

#[test]
fn quiet() {
    is(
        &after(&Adder, Pass::Branch),
        r"
        an edge of clk:
        stage 0
          one lane: %6 %v14 %v15
          loop over 2048 lanes: in 2 loops
            a loop: by %v14
              0: by op
                0, 3: nothing
                1:
                  %2 : 2048 x 8 = sum + %0
                  sum <- %2
                2:
                  %1 : 2048 x 8 = sum ^ %0
                  sum <- %1
              1: nothing
            a loop: by %v15
              0: by write
                0: nothing
                1:
                  words[%7] <- %0 if 1
              1: nothing
    ",
    );
}
