//! Lists in bundles, and lanes of arrays, of the wrong length.

use crate::messages::common::*;
use tilewright_hdl::*;

bundle! {
    struct Row<T> { cells: Vec<T> }
    struct Rows<T> { rows: Vec<Row<T>>, first: T }
}

/// Adds up two rows of two bytes.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Adder;

impl Block for Adder {
    type In = Rows;
    type Out = Out;

    fn inputs(&self) -> Rows<Width> {
        let row = || Row { cells: vec![bits(8), bits(8)] };
        Rows { rows: vec![row(), row()], first: bit() }
    }

    fn build(&self, m: Module, i: Rows) -> Out {
        m.ignore(&i.first);
        let cells = i.rows.iter().flat_map(|row| row.cells.iter().copied());
        Out { out: cells.reduce(|sum, cell| sum + cell).unwrap() }
    }
}

/// Rows with these numbers of cells.
fn rows(lengths: &[usize], i: &In) -> Rows {
    Rows { rows: lengths.iter().map(|&n| Row { cells: vec![i.a; n] }).collect(), first: i.c }
}

#[test]
fn an_instance_fed_a_shorter_list() {
    expect(
        |m, i| m.instance("u_adder", &Adder, rows(&[2, 1], &i)).out,
        "input `rows.1.cells` of `u_adder` is a list of 2, but is fed a list of 1 [T504]
         --> [|m, i| m.instance(\"u_adder\", &Adder, rows(&[2, 1], &i)).out,]
         `rows.1.cells` is declared at [let row = || Row { cells: vec![bits(8), bits(8)] };]
         help: feed as many as the block declares",
    );
}

#[test]
fn an_instance_fed_a_longer_list() {
    expect(
        |m, i| {
            let unused = (!i.a).named("unused");
            let more =
                Rows { rows: vec![Row { cells: vec![i.a; 2] }, Row { cells: vec![i.a, i.a, unused] }], first: i.c };
            m.instance("u_adder", &Adder, more).out
        },
        "input `rows.1.cells` of `u_adder` is a list of 2, but is fed a list of 3 [T504]
         --> [m.instance(\"u_adder\", &Adder, more).out]
         `rows.1.cells` is declared at [let row = || Row { cells: vec![bits(8), bits(8)] };]
         help: feed as many as the block declares",
    );
    let text = problems(&Case(|m, i| m.instance("u_adder", &Adder, rows(&[2, 2, 2], &i)).out));
    assert!(text.starts_with("input `rows` of `u_adder` is a list of 2, but is fed a list of 3 [T504]\n"), "{text}");
    let text = problems(&Case(|m, i| m.instance("u_adder", &Adder, rows(&[], &i)).out));
    assert!(text.starts_with("input `rows` of `u_adder` is a list of 2, but is fed a list of 0 [T504]\n"), "{text}");
}

#[test]
fn an_array_fed_a_list_of_another_length() {
    expect(
        |m, i| m.array("u_adders", 3, &Adder, |_| rows(&[2, 3], &i)).out.lane(0),
        "input `rows.1.cells` of `u_adders` is a list of 2, but is fed a list of 3 [T504]
         --> [|m, i| m.array(\"u_adders\", 3, &Adder, |_| rows(&[2, 3], &i)).out.lane(0),]
         `rows.1.cells` is declared at [let row = || Row { cells: vec![bits(8), bits(8)] };]
         help: feed as many as the block declares",
    );
}

#[test]
fn lanes_fed_lists_of_different_lengths() {
    expect(
        |m, i| m.array("u_adders", 2, &Adder, |_| stack([rows(&[2, 2], &i), rows(&[2, 1], &i)])).out.lane(0),
        "lane 1 of a stack has a list `rows.1.cells` of 1, but lane 0 one of 2 [T504]
         --> [|m, i| m.array(\"u_adders\", 2, &Adder, |_| stack([rows(&[2, 2], &i), rows(&[2, 1], &i)])).out.lane(0),]
         help: give every lane lists of the same length",
    );
    let text = problems(&Case(|m, i| {
        m.array("u_adders", 2, &Adder, |_| stack([rows(&[2, 2], &i), rows(&[2, 3], &i)])).out.lane(0)
    }));
    assert!(
        text.starts_with("lane 1 of a stack has a list `rows.1.cells` of 3, but lane 0 one of 2 [T504]\n"),
        "{text}"
    );
}

#[test]
fn choices_between_lists_of_different_lengths() {
    expect(
        |_, i| mux(i.c, rows(&[1, 2], &i), rows(&[1, 1], &i)).rows[1].cells[1],
        "`mux` gives a list `rows.1.cells` of 1 where one of 2 is expected [T504]
         --> [|_, i| mux(i.c, rows(&[1, 2], &i), rows(&[1, 1], &i)).rows[1].cells[1],]
         help: both records have lists of the same lengths",
    );
    let text = problems(&Case(|_, i| mux(i.c, rows(&[1], &i), rows(&[1, 1], &i)).first));
    assert!(text.starts_with("`mux` gives a list `rows` of 2 where one of 1 is expected [T504]\n"), "{text}");
    let text = problems(&Case(|_, i| mux(i.c, vec![i.a, i.a], vec![i.a])[1]));
    assert!(text.starts_with("`mux` gives a list of 1 where one of 2 is expected [T504]\n"), "{text}");
}

#[test]
fn lanes_of_an_array_of_another_length() {
    expect(
        |m, i| {
            let short = m.array("u_short", 3, &Inverter { registered: true }, |_| Link { x: i.a });
            let long = m.array("u_long", 4, &Inverter { registered: true }, |_| Link { x: short.out });
            long.out.last()
        },
        "input `x` of `u_long` has 4 lanes, but `u_short.out` has 3 lanes [T503]
         --> [let long = m.array(\"u_long\", 4, &Inverter { registered: true }, |_| Link { x: short.out });]
         `x` is declared at [Link { x: bits(8) }]
         `u_short.out` is made at [let short = m.array(\"u_short\", 3, &Inverter { registered: true }, |_| Link { x: i.a });]
         help: feed a plain signal, the same for all lanes, or one lane for each; `stack` makes a row of signals",
    );
    let derived = problems(&Case(|m, i| {
        let short = m.array("u_short", 3, &Inverter { registered: true }, |_| Link { x: i.a });
        let shifted = short.out.previous(i.a);
        m.array("u_long", 2, &Inverter { registered: true }, |_| Link { x: shifted }).out.last()
    }));
    assert!(
        derived.starts_with("input `x` of `u_long` has 2 lanes, but `u_short.out.shifted(1, ..)` has 3 lanes"),
        "{derived}"
    );
}

#[test]
#[should_panic(
    expected = "input `rows.1.cells` is a list of 2, but a list of 1 is given, at hdl/tests/messages/lists.rs:"
)]
fn a_script_with_a_shorter_list() {
    let mut script = Script::new(&Adder, Period::ns(10));
    let row = |n| Row { cells: vec![1; n] };
    script.clock(&Rows { rows: vec![row(2), row(1)], first: 1 });
}
