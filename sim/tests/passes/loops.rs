//! The loops of small circuits: what stands before them, what they carry, and where registers change.

use tilewright_hdl::{Module, ReadUnderWrite, bit, bits, block, grid, row};
use tilewright_sim::Pass;

use crate::passes::{after, is};

block! {
    /// Two rows of registers, of which the second one follows the first.
    struct Following;
    in FollowingIn { x: bits(8), enable: bit() }
    out FollowingOut { all: bits(8) }
}

impl Following {
    fn build(&self, m: Module, i: FollowingIn) -> FollowingOut {
        let first = m.reg("first", bits(8).of(row(16))).reset(0);
        let second = m.reg("second", bits(8).of(row(16))).reset(0);
        first.when(i.enable, *first + i.x);
        second.next(*first);
        FollowingOut { all: second.xor_all() }
    }
}

#[test]
fn a_register_changes_at_once_and_its_old_value_is_loaded_before_if_it_is_needed() {
    is(
        &after(&Following, Pass::Loops),
        r"
        an edge of clk:
        loop over 16 lanes:
          strips of 16
          before all: x enable
          %1 : 16 x 8 = first + %0
          %3 : 16 x 8 = %2 ? %1 : first
          load first, then first <- %3
          second <- first
        ",
    );
}

block! {
    /// A row that shares a number.
    struct Line;
    in LineIn { add: bits(8) }
    out LineOut { sum: bits(8) }
}

impl Line {
    fn build(&self, m: Module, i: LineIn) -> LineOut {
        let q = m.reg("q", bits(8).of(row(32))).reset(0);
        q.next(*q + i.add);
        LineOut { sum: q.xor_all() }
    }
}

block! {
    /// Four such rows: each adds the sum of the one before.
    struct Lines;
    in LinesIn { x: bits(8) }
    out LinesOut { all: bits(8) }
}

impl Lines {
    fn build(&self, m: Module, i: LinesIn) -> LinesOut {
        let lines = m.array("u_line", 4, &Line, |a| {
            let sums = m.pipe("sums", a.sum);
            LineIn { add: sums.previous(i.x) }
        });
        LinesOut { all: lines.sum.xor_all() }
    }
}

#[test]
fn what_a_row_shares_stands_before_its_strips() {
    is(
        &after(&Lines, Pass::Loops),
        r"
        an edge of clk:
        loop over 4 lanes:
          strips of 4
          before all: x
          taken by one load: %1
          %1         : 4 x 8 = lane i - 1 of sums
          u_line.add : 4 x 8 = %2 ? %1 : %0
        loop over 128 lanes:
          rows of 32, strips of 16
          before each row: u_line.add
          carried along a row: u_line.sum
          u_line.sum : 4 x 8   = xor of 32 lanes of u_line.q
          %3         : 128 x 8 = 32 times u_line.add
          %4         : 128 x 8 = u_line.q + %3
          u_line.q <- %4
        loop over 4 lanes:
          strips of 4
          sums <- u_line.sum
        ",
    );
}

block! {
    /// 64 memories with one address.
    struct Memories;
    in MemoriesIn { at: bits(4), write: bit() }
    out MemoriesOut { all: bits(8) }
}

impl Memories {
    fn build(&self, m: Module, i: MemoriesIn) -> MemoriesOut {
        let words = m.memory("words", 16, bits(8).of(row(64)), ReadUnderWrite::Old);
        let word = words.read(i.at);
        words.write(i.write, i.at, word + 1);
        MemoriesOut { all: word.xor_all() }
    }
}

#[test]
fn words_at_one_address_are_found_before_the_loop() {
    is(
        &after(&Memories, Pass::Loops),
        r"
        an edge of clk:
        loop over 64 lanes:
          strips of 16
          before all: at write
          found before all: words[at]
          taken by one load: %1
          %1 : 64 x 8 = words[%0] as stored
          %3 : 64 x 8 = words_read + 1
          words_read <- %1
          words[%0] <- %3 if %2
        ",
    );
}

block! {
    /// Three rows that take lanes of another one: the next one's, and each lane twice or five times.
    struct Takers;
    in TakersIn { x: bits(8) }
    out TakersOut { all: bits(8) }
}

impl Takers {
    fn build(&self, m: Module, i: TakersIn) -> TakersOut {
        let words = m.reg("words", bits(8).of(row(16))).reset(0);
        words.next(*words + i.x);
        let next = m.pipe("next", words.following(0));
        let pairs = m.pipe("pairs", words.take(16, |lane| lane / 2));
        let fifths = m.pipe("fifths", words.take(20, |lane| lane / 5));
        TakersOut { all: (next ^ pairs).xor_all() ^ fifths.xor_all() }
    }
}

#[test]
fn lanes_of_others_are_taken_together_where_that_is_possible() {
    is(
        &after(&Takers, Pass::Loops),
        r"
        an edge of clk:
        loop over 20 lanes:
          strips of 16, the last with 4 lanes
          taken lane by lane: %8
          %8 : 20 x 8 = lane %7 of words
          fifths <- %8
        loop over 16 lanes:
          strips of 16
          before all: x
          taken by one load: %2
          taken by some loads: %6
          %1 : 16 x 8 = words + %0
          %2 : 16 x 8 = lane i + 1 of words
          %4 : 16 x 8 = %3 ? %2 : 0
          next <- %4
          %6 : 16 x 8 = lane %5 of words
          words <- %1, at the end
          pairs <- %6
        ",
    );
}

block! {
    /// Six wide words: each takes the one before and the one behind. Beside them rows of three, each with a number.
    struct Numbered;
    in NumberedIn { x: bits(70), at: bits(2) }
    out NumberedOut { all: bits(70) }
}

impl Numbered {
    fn build(&self, m: Module, i: NumberedIn) -> NumberedOut {
        let words = m.reg("words", bits(70).of(row(6))).reset(0);
        words.next(words.previous(i.x) ^ words.following(0));
        let numbers = m.reg("numbers", bits(2).of(row(6))).reset(0);
        numbers.next(numbers.previous(i.at));
        let threes = m.reg("threes", bits(70).of(grid(6, 3))).reset(0);
        threes.next(!*threes);
        let picked = m.pipe("picked", threes.columns().pick(*numbers));
        NumberedOut { all: words.xor_all() ^ picked.xor_all() }
    }
}

#[test]
fn numbers_of_lanes_that_may_not_exist_are_kept_among_those_that_do() {
    is(
        &after(&Numbered, Pass::Loops),
        r"
        an edge of clk:
        loop over 6 lanes, the last first:
          strips of 4, the last with 2 lanes
          before all: x at
          taken by one load: %9
          taken lane by lane: %0 (at most lane 5) %4 (or its own) %17 (at most lane 17)
          %0  : 6 x 70 = lane i + 1 of words
          %2  : 6 x 70 = %1 ? %0 : 0
          %4  : 6 x 70 = lane i - 1 of words
          %6  : 6 x 70 = %5 ? %4 : %3
          %7  : 6 x 70 = %6 ^ %2
          words <- %7, at the end
          %9  : 6 x 2  = lane i - 1 of numbers
          %10 : 6 x 2  = %5 ? %9 : %8
          %13 : 6 x 1  = numbers < 3
          %14 : 6 x 2  = %13 ? numbers : 0
          numbers <- %10
          %15 : 6 x 32 = zext %14
          %16 : 6 x 32 = %15 + %12
          %17 : 6 x 70 = lane %16 of threes
          %18 : 6 x 70 = %13 ? %17 : 0
          picked <- %18
        loop over 18 lanes:
          strips of 4, the last with 2 lanes
          %11 : 18 x 70 = not threes
          threes <- %11
        ",
    );
}
