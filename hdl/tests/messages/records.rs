//! Records that do not fit their targets.

use crate::messages::common::*;
use tilewright_hdl::*;

bundle! {
    struct Entry<T> { resident: T, page: T }
    struct Row<T> { cells: Vec<T> }
    struct Coded<T> { opcode: T, rest: T }
}

fn entry() -> Entry<Width> {
    Entry { resident: bit(), page: bits(8) }
}

#[test]
fn registers_of_records_name_the_field() {
    expect(
        |m, i| {
            let entry = m.reg("entry", entry());
            entry.next(Entry { resident: i.c, page: i.b });
            entry.pack().trunc(8)
        },
        "`next` needs equal widths: `entry_page` has 8 bits, `b` has 7 bits [T101]
         --> [entry.next(Entry { resident: i.c, page: i.b });]
         `entry_page` is made at [let entry = m.reg(\"entry\", entry());]
         `b` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: widen the narrow side with `.zext(8)` or `.sext(8)`, or cut the wide one with `.trunc(7)`",
    );
    expect(
        |m, i| {
            let entry = m.reg("entry", entry()).reset(Entry { resident: -1, page: 256 });
            entry.when(i.a, 0).when(i.c, 7);
            entry.pack().trunc(8)
        },
        "`-1` does not fit in the 1 bit of `entry_resident` [T102]
         --> [let entry = m.reg(\"entry\", entry()).reset(Entry { resident: -1, page: 256 });]
         help: a number takes the width and the sign of the declaration

         `256` does not fit in the 8 bits of `entry_page` [T102]
         --> [let entry = m.reg(\"entry\", entry()).reset(Entry { resident: -1, page: 256 });]
         help: a number takes the width and the sign of the declaration

         the condition of `when` is 1 bit, but `a` has 8 bits [T106]
         --> [entry.when(i.a, 0).when(i.c, 7);]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: compare it, as in `.ne(0)`, or take one `.bit(i)`

         `when` gives a record the number 7, which is not a record [T508]
         --> [entry.when(i.a, 0).when(i.c, 7);]
         help: the only number that means a whole record is 0: each field is 0

         4 problems in this description",
    );
}

#[test]
fn records_driven_twice_or_not_at_all() {
    let text = problems(&Case(|m, i| {
        let wire = m.wire("found", entry());
        wire.drive(Entry { resident: i.c, page: i.a });
        wire.drive(0);
        wire.page
    }));
    assert!(text.starts_with("`found_resident` is driven twice [T302]\n  --> [wire.drive(0);]"), "{text}");
    let text = problems(&Case(|m, _| m.reg("entry", entry()).page));
    assert!(text.contains("register `entry_page` of `Case` is never driven"), "{text}");
}

#[test]
fn words_of_records_name_the_field() {
    expect(
        |m, i| {
            let entries = m
                .memory("entries", 256, entry(), ReadUnderWrite::Old)
                .words([Entry { resident: 1, page: 255 }, Entry { resident: 2, page: 0 }]);
            entries.write(i.c, i.a, Entry { resident: i.c, page: i.b });
            entries.read(i.a).page
        },
        "`2` does not fit in the 1 bit of field `resident` of word 1 of memory `entries` [T102]
         --> [.words([Entry { resident: 1, page: 255 }, Entry { resident: 2, page: 0 }]);]
         help: a number takes the width and the sign of the declaration

         field `page` of memory `entries` has 8 bits, but `b` has 7 bits [T309]
         --> [entries.write(i.c, i.a, Entry { resident: i.c, page: i.b });]
         `entries` is declared at [.memory(\"entries\", 256, entry(), ReadUnderWrite::Old)]
         `b` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: widen it with `.zext(8)` or `.sext(8)`

         2 problems in this description",
    );
    expect(
        |m, i| {
            let entries = m.memory("entries", 256, entry(), ReadUnderWrite::Old).fill(Entry { resident: i.c, page: i.a });
            entries.read_async(i.a).page
        },
        "field `resident` of the contents of memory `entries` is a constant of 1 bit, but `c` is not [T115]
         --> [let entries = m.memory(\"entries\", 256, entry(), ReadUnderWrite::Old).fill(Entry { resident: i.c, page: i.a });]
         help: contents are numbers known while the block is built

         field `page` of the contents of memory `entries` is a constant of 8 bits, but `a` is not [T115]
         --> [let entries = m.memory(\"entries\", 256, entry(), ReadUnderWrite::Old).fill(Entry { resident: i.c, page: i.a });]
         help: contents are numbers known while the block is built

         2 problems in this description",
    );
}

codes! { enum Opcode { Load = 0x03, Store = 0x23 } }

#[test]
fn zero_for_a_record_whose_enum_has_no_code_0() {
    fn coded() -> Coded<Width> {
        Coded { opcode: one_of::<Opcode>(), rest: bits(8) }
    }
    let cases: [(&str, Build); 5] = [
        ("`0` is not a code of `Opcode`, the enum of `held_opcode` [T207]", |m, i| {
            let held = m.reg("held", coded()).reset(0);
            held.when(i.c, Coded { opcode: Opcode::Load.into(), rest: i.a });
            held.rest
        }),
        ("`0` is not a code of `Opcode`, the enum of `held_opcode` [T207]", |m, i| {
            let held = m.reg("held", coded());
            held.when(i.c, 0);
            held.rest
        }),
        ("`0` is not a code of `Opcode`, the enum of `wire_opcode` [T207]", |m, _| {
            let wire = m.wire("wire", coded());
            wire.drive(0);
            wire.rest
        }),
        (
            "`0` is not a code of `Opcode`, the enum of field `opcode` of the contents of memory `words` [T207]",
            |m, i| m.memory("words", 2, coded(), ReadUnderWrite::Old).fill(0).read(i.c).rest,
        ),
        ("`0` is not a code of `Opcode`, the enum of field `opcode` of memory `words` [T207]", |m, i| {
            let words = m.memory("words", 2, coded(), ReadUnderWrite::Old);
            words.write(i.c, i.c, 0);
            words.read(i.c).rest
        }),
    ];
    for (start, build) in cases {
        let text = problems(&Case(build));
        assert!(text.starts_with(start), "{text}");
        assert!(text.ends_with("help: name one of its codes") && text.contains("\n  --> ["), "{text}");
    }
}

#[test]
fn fields_of_no_width() {
    expect(
        |m, i| {
            let nothing = Entry { resident: bits(0), page: bits(8) };
            m.memory("entries", 256, nothing, ReadUnderWrite::Old).read(i.a).page
        },
        "field `resident` of memory `entries` has no bits [T107]
         --> [m.memory(\"entries\", 256, nothing, ReadUnderWrite::Old).read(i.a).page]
         help: a width is at least 1",
    );
    let wide = Entry { resident: 1 << 20, page: 1 << 20 };
    thread_local!(static WIDE: std::cell::Cell<Entry<u32>> = const { std::cell::Cell::new(Entry { resident: 0, page: 0 }) });
    WIDE.set(wide);
    let text =
        problems(&Case(|m, i| m.memory("entries", 256, WIDE.get(), ReadUnderWrite::Old).read(i.a).page.trunc(8)));
    assert!(text.starts_with("memory `entries` has words of 2097152 bits, more than 1048576 [T108]\n"), "{text}");
}

#[test]
fn words_that_a_record_is_not_unpacked_from() {
    expect(
        |_, i| entry().unpack(i.a).page,
        "a record of 9 bits is unpacked from `a`, which has 8 bits [T507]
         --> [|_, i| entry().unpack(i.a).page,]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: a word has exactly the bits of the record's fields, side by side",
    );
}

#[test]
fn lists_of_another_length_than_the_registers() {
    expect(
        |m, i| {
            let row = m.reg("row", Row { cells: vec![bits(8); 2] });
            row.next(Row { cells: vec![i.a, i.a, i.a] });
            row.cells[0]
        },
        "`next` gives a list `cells` of 3 where one of 2 is expected [T504]
         --> [row.next(Row { cells: vec![i.a, i.a, i.a] });]
         help: both records have lists of the same lengths",
    );
}

#[test]
fn a_record_chosen_from_numbers_alone() {
    expect(
        |_, i| {
            let entry: Entry = mux(i.c, 0, 0);
            entry.page
        },
        "`mux` has only numbers to choose a record from [T508]
         --> [let entry: Entry = mux(i.c, 0, 0);]
         help: write one of them as a record",
    );
}

#[test]
fn a_number_in_a_list_of_records() {
    expect(
        |_, i| {
            let entries: [Entry; 1] = select([(i.c, [Entry { resident: i.c, page: i.a }])], [0]);
            entries[0].page
        },
        "a list of records has the number 0 in it [T508]
         --> [let entries: [Entry; 1] = select([(i.c, [Entry { resident: i.c, page: i.a }])], [0]);]
         help: write the record",
    );
}

#[test]
fn pipelines_say_the_condition_once() {
    expect(
        |m, i| {
            let start = Entry { resident: i.c, page: i.a };
            let last = m.stages(3, i.a, start, |_, now| Entry { page: now.page + 1, ..now });
            m.ignore(&last.resident);
            last.page
        },
        "the condition of `stages` is 1 bit, but `a` has 8 bits [T106]
         --> [let last = m.stages(3, i.a, start, |_, now| Entry { page: now.page + 1, ..now });]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: compare it, as in `.ne(0)`, or take one `.bit(i)`",
    );
}

#[test]
fn two_pipelines_of_one_record_need_names() {
    let text = problems(&Case(|m, i| {
        let start = Entry { resident: i.c, page: i.a };
        let first = m.stages(1, None, start, |_, now| now);
        m.stages(1, None, first, |_, now| now).page
    }));
    assert!(
        text.starts_with("net `resident1` has the name of another net [T401]\n  --> [m.stages(1, None, first"),
        "{text}"
    );
    let build = |m: Module, i: In| {
        let first = m.stages(1, None, Entry { resident: i.c, page: i.a }, |_, now| now);
        m.ignore(&first.resident);
        m.within("late", || m.stages(1, None, first, |_, now| now)).page
    };
    elaborate(&Case(build)).unwrap();
}

record! {
    struct Line { resident: bit(), page: bits(8) }
    struct Link { line: Line, jobs: stream(bits(8)) }
    struct Burst { first: bit(), bytes: bits(8).of(row(3)) }
}

#[test]
fn records_without_lanes_are_reported_once() {
    expect(
        |_, i| Line { resident: i.c, page: i.a }.previous(0).page,
        "`.previous` needs a row, but `c` has no lanes [T602]
         --> [|_, i| Line { resident: i.c, page: i.a }.previous(0).page,]
         `c` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: lanes come from a register, a port or a wire that is declared with some, as in `bits(8).of(row(4))`, or from `stack`",
    );
    expect(
        |m, _| {
            let lines = m.reg("lines", Line::widths().of(grid(2, 3)));
            lines.next(lines.rows().previous(0));
            lines.last().page
        },
        "`.last` needs a row, but `lines_resident` has 2 x 3 lanes [T602]
         --> [lines.last().page]
         `lines_resident` is made at [let lines = m.reg(\"lines\", Line::widths().of(grid(2, 3)));]
         help: say along which axis: `.rows()` or `.columns()`",
    );
}

#[test]
fn lanes_of_records_that_do_not_fit() {
    expect(
        |_, i| Line { resident: i.c.of(row(4)), page: i.a.of(row(3)) }.lane(2).page,
        "`.lane` needs a record of equal lanes: field `resident` has 4 lanes, but `page` has 3 lanes [T613]
         --> [|_, i| Line { resident: i.c.of(row(4)), page: i.a.of(row(3)) }.lane(2).page,]
         help: each lane has a whole record: all fields have its lanes",
    );
    expect(
        |m, i| {
            let link = |valid| Link { line: Line { resident: i.c, page: i.a }, jobs: m.offer(valid, i.a).0 };
            let links = stack([link(i.c), link(!i.c)]);
            links.previous(0).line.page
        },
        "`.previous` would move the stream `jobs`, which has a receiver in each lane [T705]
         --> [links.previous(0).line.page]
         help: `.lanes()` of the stream gives the stream of each lane",
    );
    expect(
        |m, i| {
            let lines = m.reg("lines", Line::widths().of(row(4)));
            lines.next(lines.previous(Line { resident: i.c, page: i.b }));
            lines.lane(4).page
        },
        "`shifted` needs equal widths: `lines_page` has 8 bits, `b` has 7 bits [T101]
         --> [lines.next(lines.previous(Line { resident: i.c, page: i.b }));]
         `lines_page` is made at [let lines = m.reg(\"lines\", Line::widths().of(row(4)));]
         `b` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: widen the narrow side with `.zext(8)` or `.sext(8)`, or cut the wide one with `.trunc(7)`

         lane 4 of a signal of 4 lanes [T603]
         --> [lines.lane(4).page]
         help: lanes count from 0

         2 problems in this description",
    );
    expect(
        |m, _| {
            let bursts = m.reg("bursts", Burst { first: bit().of(4), bytes: bits(8).of(grid(4, 3)) });
            bursts.next(bursts.previous(Burst { first: lit(1, 0), bytes: lit(8, 0).of(row(2)) }));
            bursts.lane(0).bytes.lane(0)
        },
        "the edge of `.shifted`, `0`, has 2 lanes, but a row of `bursts_bytes` has 3 lanes [T612]
         --> [bursts.next(bursts.previous(Burst { first: lit(1, 0), bytes: lit(8, 0).of(row(2)) }));]
         help: it is plain, or as one row is",
    );
}
