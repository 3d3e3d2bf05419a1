//! Rows and grids of records.

use tilewright_hdl::*;
use tilewright_sim::{example, traced};

codes! {
    enum Kind { Nothing, Read, Write }
}

record! {
    /// A word on a bus, with bytes of its own in each lane.
    struct Word { kind: one_of::<Kind>(), level: bits(6).signed(), bytes: bits(4).of(row(2)), parts: [bits(3); 2] }
}

/// A row of words: lane `i` has `i` in most of its fields.
fn words(count: u32) -> Word {
    stack((0..count).map(|lane| Word {
        kind: lit(2, lane % 3).code::<Kind>(),
        level: lit(bits(6).signed(), -i64::from(lane)),
        bytes: stack([lit(4, lane), lit(4, 15 - lane)]),
        parts: vec![lit(3, lane), lit(3, 7 - lane)],
    }))
}

/// The same word in all fields.
fn equal(left: &Word, right: &Word) -> Signal {
    left.kind.eq(right.kind)
        & left.level.eq(right.level)
        & left.bytes.eq(right.bytes).and_all()
        & left.parts[0].eq(right.parts[0])
        & left.parts[1].eq(right.parts[1])
}

/// Every method gives in every lane the record of the lane that it names.
#[test]
fn a_row_of_records_moves_as_a_row_of_signals() {
    example(|m| {
        let row = words(5);
        let lanes = row.to_vec();
        assert_eq!((row.count(), lanes.len()), (5, 5));
        let edge = lanes[3].clone();
        let check = |moved: Word, from: &[Option<usize>]| {
            assert_eq!(moved.count() as usize, from.len());
            for (lane, from) in moved.to_vec().iter().zip(from) {
                m.assert(equal(lane, from.map_or(&edge, |from| &lanes[from])), "the lane that is named");
            }
        };
        check(row.previous(&edge), &[None, Some(0), Some(1), Some(2), Some(3)]);
        check(row.following(&edge), &[Some(1), Some(2), Some(3), Some(4), None]);
        check(row.shifted(-3, &edge), &[Some(3), Some(4), None, None, None]);
        check(row.take(3, |i| 2 * i), &[Some(0), Some(2), Some(4)]);
        check(row.take_or(3, |i| 3 * i - 1, &edge), &[None, Some(2), None]);
        check(row.reversed(), &[4, 3, 2, 1, 0].map(Some));
        m.assert(equal(&row.last(), &lanes[4]) & equal(&row.lane(1), &lanes[1]), "one lane");
        m.assert(equal(&row.pick(lit(3, 2)), &lanes[2]), "a lane that a signal selects");
        m.assert(row.pick(lit(3, 6)).level.eq(0), "there is no lane 6");
        m.assert(row.previous(0).lane(0).kind.is(Kind::Nothing), "0 is a record of zeros");
    });
}

record! {
    struct Dot { x: bits(4), y: bits(4) }
}

#[test]
fn a_grid_of_records_is_a_sequence_of_rows_or_of_columns() {
    example(|m| {
        let dots = constants(Dot::widths().of(grid(2, 3)), |lane| Dot { x: lane % 3, y: lane / 3 });
        assert_eq!((dots.rows().count(), dots.columns().count()), (2, 3));
        m.assert(dots.rows().last().y.eq(1).and_all() & dots.columns().lane(2).x.eq(2).and_all(), "an element");
        let right = Dot { x: 9, y: 8 };
        m.assert(dots.columns().following(right).rows().lane(1).x.pack().eq(0x921), "the edge");
        m.assert(dots.rows().previous(right).y.rows().lane(0).eq(8).and_all(), "the edge of a record of numbers");
        m.assert(dots.columns().pick(lit(2, 1)).x.eq(1).and_all(), "a column that a signal selects");
        let x = |dots: Vec<Dot>| dots.iter().map(|dot| dot.x.pack()).collect::<Vec<_>>();
        m.assert(concat(&x(dots.rows().to_vec())).eq(0x210_210), "all rows");
    });
}

record! {
    /// What goes from a cell to the next.
    struct Passed { valid: bit(), sum: bits(8) }
}

block! {
    /// Adds its number to what passes.
    struct Cell;
    in CellIn { number: bits(8), before: Passed }
    out CellOut { passed: Passed }
}

impl Cell {
    fn build(&self, m: Module, i: CellIn) -> CellOut {
        let next = Passed { sum: i.before.sum + i.number, ..i.before };
        def!(passed = m.reg(Passed::widths()).reset(0));
        passed.next(next);
        CellOut { passed: *passed }
    }
}

/// An array whose instances are chained by records, in both directions.
#[test]
fn an_array_is_chained_by_records() {
    let run = traced(|m| {
        let numbers = constants(bits(8).of(row(3)), |lane| lane + 1);
        let start = Passed { valid: lit(1, 1), sum: lit(8, 10) };
        let forth =
            m.array("u_forth", 3, &Cell, |cells| CellIn { number: numbers, before: cells.passed.previous(start) });
        let back = m.array("u_back", 3, &Cell, |cells| CellIn { number: numbers, before: cells.passed.following(0) });
        def!(last = forth.passed.last());
        def!(first = back.passed.lane(0));
    });
    assert_eq!(run.values("last_sum"), [0, 3, 5, 16]);
    assert_eq!(run.values("last_valid"), [0, 0, 0, 1]);
    assert_eq!(run.values("first_sum"), [0, 1, 3, 6, 6]);
    assert_eq!(run.values("first_valid"), [0, 0, 0, 0, 0]);
}
