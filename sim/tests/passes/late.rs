//! Work that is postponed, and work that is left out at the start.

use tilewright_hdl::{Bits, Module, ReadUnderWrite, bits, block, row};
use tilewright_sim::{Pass, Passes};

use crate::passes::{after, after_with, is};

block! {
    /// Uses the common value of all cells.
    struct Mix;
    in MixIn { all: bits(8) }
    out MixOut { q: _ }
}

impl Mix {
    fn build(&self, m: Module, i: MixIn) -> MixOut {
        let q = m.reg("q", 8).reset(0);
        q.next(((q << 3) ^ q) + i.all);
        MixOut { q: *q }
    }
}

block! {
    /// A row whose cells see their sum.
    pub(super) struct Mixer;
    out MixerOut { all: _ }
}

impl Mixer {
    fn build(&self, m: Module, (): ()) -> MixerOut {
        let mut all = None;
        m.array("u_cell", 64, &Mix, |a| {
            let sum = a.q.xor_all();
            all = Some(sum);
            MixIn { all: sum }
        });
        MixerOut { all: all.expect("the array is made") }
    }
}

#[test]
fn postpone() {
    is(
        &after_with(&Mixer, Pass::Plan, &Passes { postpone: false, ..Passes::default() }),
        r"
        an edge of clk:
        stage 0
          loop over 64 lanes:
            all : 8      = xor of 64 lanes of u_cell.q
            %0  : 64 x 5 = u_cell.q[4:0]
            %1  : 64 x 8 = {%0, 0}
            %2  : 64 x 8 = %1 ^ u_cell.q
        stage 1
          loop over 64 lanes:
            %3 : 64 x 8 = %2 + u_cell.all
            u_cell.q <- %3
        live out: all %2
    ",
    );
    is(
        &after(&Mixer, Pass::Plan),
        r"
        an edge of clk:
        stage 0
          loop over 64 lanes:
            all : 8 = xor of 64 lanes of u_cell.q
        stage 1
          loop over 64 lanes:
            %0 : 64 x 5 = u_cell.q[4:0]
            %1 : 64 x 8 = {%0, 0}
            %2 : 64 x 8 = %1 ^ u_cell.q
            %3 : 64 x 8 = %2 + u_cell.all
            u_cell.q <- %3
        live out: all
    ",
    );
}

block! {
    /// A memory full of ones.
    pub(super) struct Filled;
    in FilledIn { address: bits(4), word: bits(8) }
    out FilledOut { data: _ }
}

impl Filled {
    fn build(&self, m: Module, i: FilledIn) -> FilledOut {
        let words = m.memory("words", 16, 8, ReadUnderWrite::Old).fill(Bits::ones(8));
        words.write(tilewright_hdl::lit(1, 1), i.address, i.word);
        FilledOut { data: words.read(i.address) }
    }
}

#[test]
fn lower_memories_that_are_full_of_a_word() {
    is(
        &after(&Filled, Pass::Lower),
        r"
        an edge of clk:
        address : 4 = input
        %0      : 8 = words[address] as stored
        %1      : 8 = %0 ^ 8'hff
        word    : 8 = input
        %2      : 8 = word ^ 8'hff
          data <- %1
          words[address] <- %2 if 1
    ",
    );
}

block! {
    /// Rows that each take the previous one, which is half or twice as long.
    struct Levels { widen: bool }
    in LevelsIn { x: bits(8) }
    out LevelsOut { last: bits(8) }
}

impl Levels {
    fn build(&self, m: Module, i: LevelsIn) -> LevelsOut {
        let [short, middle, long] = [4, 8, 16].map(|lanes| m.reg(&format!("row{lanes}"), bits(8).of(row(lanes))));
        let first = if self.widen { short } else { long };
        first.next(first + i.x);
        if self.widen {
            middle.next(short.take(8, |lane| lane / 2) + 1);
            long.next(middle.take(16, |lane| lane / 2) + 2);
        } else {
            middle.next(long.take(8, |lane| lane * 2) + 1);
            short.next(middle.take(4, |lane| lane * 2) + 2);
        }
        LevelsOut { last: if self.widen { long.lane(3) } else { short.lane(3) } }
    }
}

#[test]
fn loops_run_before_those_that_change_what_they_look_at() {
    for (widen, order) in [(true, ["16", "8", "4"]), (false, ["4", "8", "16"])] {
        let plan = after(&Levels { widen }, Pass::Plan);
        let loops = plan.lines().filter_map(|line| line.trim().strip_prefix("loop over "));
        let loops: Vec<&str> = loops.map(|rest| rest.split(' ').next().unwrap()).collect();
        assert_eq!(loops, order, "{plan}");
        assert!(!plan.contains("hazards"), "{plan}");
    }
}
