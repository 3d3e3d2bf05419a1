//! The report of problems: all at once, each at the user's own line.

use crate::messages::common::*;
use tilewright_hdl::*;

/// Even if the language calls itself in a closure, which is its own caller.
#[test]
fn messages_from_closures_name_the_users_line() {
    let cases: [(&str, Build); 5] = [
        ("the condition of `enable`", |m, i| m.pipe_when(i.a, "p", i.a)),
        ("`300` does not fit", |m, _| {
            let block = Inverter { registered: true };
            m.array("u_cell", 2, &block, |_| Link { x: constants(bits(8).of(2), |_| 300) }).out.last()
        }),
        ("`2` does not fit", |m, _| m.fsm("lamp", Lamp::Off).constants(1, |_| 2)),
        ("`case` needs", |m, i| m.fsm("lamp", Lamp::Off).pick(|lamp| if lamp == Lamp::Off { i.a } else { i.b })),
        ("the condition of `when`", |m, i| {
            let lamp = m.fsm("lamp", Lamp::Off);
            lamp.next(|_| when(i.a, Lamp::On));
            *lamp
        }),
    ];
    for (message, build) in cases {
        let text = problems(&Case(build));
        let (first, place) = text.split_once("\n  --> ").expect("a message has a place");
        assert!(first.starts_with(message) && place.starts_with('['), "{text}");
    }
}

#[test]
fn all_problems_are_reported_in_one_go() {
    let text = problems(&Case(|m, i| {
        let r = m.reg("r", 8);
        let _ = i.a + i.b;
        r.slice(0..9)
    }));
    for message in
        ["`+` needs equal widths", "the slice 0..9 is outside of `r`", "register `r` of `Case` is never driven"]
    {
        assert!(text.contains(message), "{message} is missing in {text}");
    }
    assert!(text.ends_with("3 problems in this description"), "{text}");
}
