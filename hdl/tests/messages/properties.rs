//! Assertions, assumptions, covers, past values; initial values and attributes.

use crate::messages::common::*;
use tilewright_hdl::*;

#[test]
fn statements_are_about_one_bit() {
    for (word, text) in [
        (
            "assert",
            problems(&Case(|m, i| {
                m.assert(i.a, "a");
                i.a
            })),
        ),
        (
            "assume",
            problems(&Case(|m, i| {
                m.assume(i.a, "a");
                i.a
            })),
        ),
        (
            "cover",
            problems(&Case(|m, i| {
                m.cover("a", i.a);
                i.a
            })),
        ),
        ("rose", problems(&Case(|m, i| m.rose(i.a)))),
        ("fell", problems(&Case(|m, i| m.fell(i.a)))),
    ] {
        let first = format!("the condition of `{word}` is 1 bit, but `a` has 8 bits [T106]\n");
        assert!(text.starts_with(&first) && text.contains(&format!("m.{word}(")), "{text}");
    }
}

#[test]
fn a_cover_has_a_name_of_its_own() {
    expect(
        |m, i| {
            m.cover("a is 3", i.a.eq(3));
            m.cover("a is 3", i.a.gt(3));
            i.a
        },
        "a second cover is called `a is 3` [T901]
         --> [m.cover(\"a is 3\", i.a.gt(3));]
         the first one is stated at [m.cover(\"a is 3\", i.a.eq(3));]
         help: give each cover its own name: a test asks for it by name",
    );
    // An assertion may combine several conditions.
    elaborate(&Case(|m, i| {
        m.assert(i.a.ne(3), "no threes");
        m.assert(i.b.ne(3), "no threes");
        m.cover("no threes", i.c);
        i.a
    }))
    .unwrap();
}

#[test]
fn statements_and_pasts_belong_to_a_clock() {
    for (what, text) in [
        (
            "an assertion",
            problems(&Case(|m, i| {
                m.on(FAST).assert(m.pipe("slow", i.c), "c");
                i.a
            })),
        ),
        (
            "an assumption",
            problems(&Case(|m, i| {
                m.on(FAST).assume(m.pipe("slow", i.c), "c");
                i.a
            })),
        ),
        (
            "a cover",
            problems(&Case(|m, i| {
                m.on(FAST).cover("c", m.pipe("slow", i.c));
                i.a
            })),
        ),
        (
            "register `slow_past`",
            problems(&Case(|m, i| {
                let slow = m.pipe("slow", i.a);
                m.on(FAST).past(slow)
            })),
        ),
    ] {
        let first = format!("`slow` is on clock `clk` but reaches {what} on clock `fast` without a crossing [T801]\n");
        assert!(text.starts_with(&first), "{text}");
    }
}

#[test]
fn a_past_has_the_name_of_its_signal_or_says_what_it_is_of() {
    expect(
        |m, i| m.past(i.a + 1) & m.past(i.b),
        "`&` needs equal widths: `past(a + 1)` has 8 bits, `past(b)` has 7 bits [T101]
         --> [|m, i| m.past(i.a + 1) & m.past(i.b),]
         `past(a + 1)` is made at [|m, i| m.past(i.a + 1) & m.past(i.b),]
         `past(b)` is made at [|m, i| m.past(i.a + 1) & m.past(i.b),]
         help: widen the narrow side with `.zext(8)` or `.sext(8)`, or cut the wide one with `.trunc(7)`",
    );
    let design = elaborate(&Case(|m, i| {
        def!(a_past = !i.a);
        // The same past value again is the same register.
        m.past(i.a) & m.past(i.a) & m.past(a_past) & m.past(m.past(i.a)) & m.past(i.a + 1) & m.past(i.a + 2)
    }))
    .unwrap();
    let registers = design.top().registers.iter().map(|register| design.top().register_name(register));
    assert_eq!(registers.collect::<Vec<_>>(), ["a_past_2", "a_past_past", "a_past_2_past", "past", "past_2"]);
}

#[test]
fn initial_values() {
    expect(
        |m, i| {
            let r = m.reg("r", 8).initial(i.a);
            r.next(i.a);
            *r
        },
        "the initial value of `r` is not a constant of 8 bits [T115]
         --> [let r = m.reg(\"r\", 8).initial(i.a);]
         help: the initial value is a number known while the block is built",
    );
    expect(
        |m, i| {
            let r = m.reg("r", 8).initial(1);
            r.initial(2).next(i.a);
            *r
        },
        "`r` is given an initial value twice [T303]
         --> [r.initial(2).next(i.a);]
         the first time is at [let r = m.reg(\"r\", 8).initial(1);]
         `r` is declared at [let r = m.reg(\"r\", 8).initial(1);]
         help: give it once",
    );
    expect(
        |m, i| {
            let r = m.reg("r", 8).reset(1);
            r.reset(2).next(i.a);
            *r
        },
        "`r` is given a reset value twice [T303]
         --> [r.reset(2).next(i.a);]
         the first time is at [let r = m.reg(\"r\", 8).reset(1);]
         `r` is declared at [let r = m.reg(\"r\", 8).reset(1);]
         help: give it once",
    );
    assert!(
        problems(&Case(|m, i| {
            let r = m.reg("r", 8).initial(256);
            r.next(i.a);
            *r
        }))
        .starts_with("`256` does not fit in 8 bits"),
    );
}

#[test]
fn attributes() {
    let text = problems(&Case(|m, i| {
        let r = m.reg("r", 8).attribute("no name", "1").attribute("keep", "1").attribute("keep", "1");
        r.next(i.a);
        let words = m.memory("words", 4, 8, ReadUnderWrite::Old).attribute("begin", "1").attribute("mark", "a *) b");
        words.read_async(i.b.trunc(2)) + *r
    }));
    for part in [
        "`no name` cannot be the name of an attribute [T403]\n",
        "the attribute `keep` is given twice [T303]\n",
        "`begin` cannot be",
        "the value of the attribute `mark` would end it: `a *) b` [T406]\n",
    ] {
        assert!(text.contains(part), "{text}");
    }
    assert!(text.ends_with("4 problems in this description"), "{text}");
}

#[test]
fn the_text_of_a_display_has_a_place_for_each_value() {
    expect(
        |m, i| {
            m.display(i.c, "a is {}, b is {:x}", &[i.a]);
            i.a
        },
        r#"the number of values of a `display` is 1, but its text shows 2: "a is {}, b is {:x}" [T911]
         --> [m.display(i.c, "a is {}, b is {:x}", &[i.a]);]
         help: a value is `{}`, `{:x}` or `{:b}`; a brace is `{{` or `}}`"#,
    );
    let begin = |build: Build, message: &str| {
        let text = problems(&Case(build));
        assert!(text.starts_with(message) && !text.contains("problems"), "{text}");
    };
    begin(
        |m, i| {
            m.display(i.c, "{:o}", &[i.a]);
            i.a
        },
        "`{:o}` is no form of a value in the text of a `display`: \"{:o}\" [T911]",
    );
    begin(
        |m, i| {
            m.display(i.c, "50 {", &[]);
            i.a
        },
        "a `{` stands alone in the text of a `display`: \"50 {\" [T911]",
    );
    begin(
        |m, i| {
            m.display(i.a, "", &[]);
            i.a
        },
        "the condition of `display` is 1 bit, but `a` has 8 bits [T106]",
    );
    begin(
        |m, i| {
            m.display(i.c, "{}", &[i.a.unpack(row(4))]);
            i.a
        },
        "`display` needs equal shapes: `c` has no lanes, `a.unpack()` has 4 lanes [T601]",
    );
    begin(
        |m, i| {
            let fast = m.on(FAST).pipe("fast", lit(8, 1));
            m.display(i.c, "{}", &[fast]);
            m.pipe("late", i.a)
        },
        "`fast` is on clock `fast` but reaches a display on clock `clk` without a crossing [T801]",
    );
}
