//! `mux`, `select` and `case`.

use crate::messages::common::*;
use tilewright_hdl::*;

#[test]
fn choices_between_records_name_the_users_line() {
    let text = problems(&Case(|_, i| mux(i.c, Out { out: i.a }, Out { out: i.b }).out));
    assert!(text.contains("`mux` needs equal widths") && !text.contains("select.rs"), "{text}");
    let text = problems(&Case(|_, i| select([(i.a, i.a)], i.a)));
    assert!(text.contains("the condition of `select` is 1 bit") && !text.contains("select.rs"), "{text}");
}

#[test]
fn conditions_of_more_than_one_bit() {
    expect(
        |_, i| mux(i.a, i.b, i.b),
        "the condition of `mux` is 1 bit, but `a` has 8 bits [T106]
         --> [|_, i| mux(i.a, i.b, i.b),]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: compare it, as in `.ne(0)`, or take one `.bit(i)`",
    );
}

#[test]
fn choices_that_leave_something_open() {
    expect(
        |_, i| mux(i.c, 1, 0),
        "`mux` has only integers to choose from, which leaves its width unknown [T114]
         --> [|_, i| mux(i.c, 1, 0),]
         help: give one a width, as in `lit(8, 1)`",
    );
    expect(
        |_, i| mux(i.c, i.a.low(), i.b.low()),
        "`mux` has only low bits to choose from, which leaves its width unknown [T114]
         --> [|_, i| mux(i.c, i.a.low(), i.b.low()),]
         help: give one a width, as in `.trunc(8)`",
    );
    let widths = problems(&Case(|_, i| mux(i.c, Bits::new(8, 1), Bits::new(7, 1))));
    assert!(widths.contains("8 bits") && widths.contains("7'h01") && widths.contains("let widths ="), "{widths}");
    elaborate(&Case(|_, i| mux(i.c, Bits::new(8, 3), 0))).expect("one width is enough");
    assert!(
        problems(&Case(|_, i| case(i.c, [(2, i.a)], 0)))
            .starts_with("the key 2 of `case` does not fit in 1 bit [T208]")
    );
    assert!(
        problems(&Case(|_, i| case(i.a, [(2, i.a), (2, i.a)], 0)))
            .starts_with("the key 2 of `case` occurs twice [T209]")
    );
}

codes! { enum Side { Left, Right } }

#[test]
fn arms_that_are_never_chosen() {
    expect(
        |_, i| choose!(i.c.code::<Side>(), Side { Left | Right => i.a, Left => 1 }),
        "`choose!` has two arms for `Side::Left` [T209]
         --> [|_, i| choose!(i.c.code::<Side>(), Side { Left | Right => i.a, Left => 1 }),]
         help: each code is named once; `_` is for the rest",
    );
    let cases: [(&str, Build); 2] = [
        (
            "the arm `_` of `choose!` is never chosen: each code of `Side` has an arm [T209]",
            |_, i| choose!(i.c.code::<Side>(), Side { Left => i.a, Right => 1, _ => 2 }),
        ),
        (
            "`choose!` has two arms `_` [T209]",
            |_, i| choose!(i.c.code::<Side>(), Side { _ => i.a, Right => 1, _ => 2 }),
        ),
    ];
    for (start, build) in cases {
        let text = problems(&Case(build));
        assert!(text.starts_with(start), "{text}");
    }
}

#[test]
fn what_is_wrong_with_a_code_as_a_signal_names_the_users_line() {
    let text = problems(&Case(|_, i| {
        let side: Signal = Side::Right.into();
        mux(i.c, i.a, side)
    }));
    assert!(text.starts_with("`mux` needs equal widths: `a` has 8 bits, `Side::Right` has 1 bit [T101]\n"), "{text}");
    assert!(text.contains("let side: Signal = Side::Right.into();"), "{text}");
}
