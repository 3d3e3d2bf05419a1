//! Enabled parts of a module.

use crate::messages::common::*;
use tilewright_hdl::*;

#[test]
fn what_runs_on_another_clock() {
    expect(
        |m, i| {
            m.ignore(&i);
            m.enabled(i.c, || m.on(FAST).pipe("fast", lit(8, 1)))
        },
        "`enabled` is for what runs on clock `clk`, but what is within runs on clock `fast` [T831]
         --> [m.enabled(i.c, || m.on(FAST).pipe(\"fast\", lit(8, 1)))]
         help: enable it on its own clock: `m.on(clock).enabled(..)`, or a handle that `m.on(clock)` gave",
    );
    // Something on each clock is fine, and so is logic alone, which a helper may be for some of its parameters.
    elaborate(&Case(|m, i| {
        m.enabled(i.c, || {
            let _ = m.on(FAST).pipe("fast", lit(8, 1));
            m.pipe("slow", i.a)
        })
    }))
    .unwrap();
    elaborate(&Case(|m, i| m.enabled(i.c, || !i.a))).unwrap();
}

#[test]
fn an_enable_of_another_clock() {
    let text = problems(&Case(|m, i| {
        let go = m.on(FAST).pipe("go", lit(1, 1));
        m.enabled(go, || {
            let one = m.pipe("one", i.a);
            m.instance("u_inverter", &Inverter { registered: true }, Link { x: one }).out
        })
    }));
    let message = "`go` is on clock `fast` but reaches an `enabled` on clock `clk` without a crossing";
    assert!(text.starts_with(message) && !text.contains("problems"), "{text}");
}

#[test]
fn an_enable_with_other_lanes() {
    expect(
        |m, i| {
            def!(each = i.a.slice(0..4).unpack(row(4)));
            m.enabled(each, || m.pipe("plain", i.a))
        },
        "register `plain` has no lanes, but is enabled by `each`, which has 4 lanes [T612]
         --> [m.enabled(each, || m.pipe(\"plain\", i.a))]
         `each` is made at [def!(each = i.a.slice(0..4).unpack(row(4)));]
         help: an enable is plain, one for all lanes, or has the lanes of everything that is described within",
    );
    let begin = |build: Build, message: &str| {
        let text = problems(&Case(build));
        assert!(text.starts_with(message), "{text}");
    };
    begin(
        |m, i| {
            def!(each = i.a.slice(0..4).unpack(row(4)));
            m.enabled(each, || m.array("u_cell", 2, &Inverter { registered: true }, |_| Link { x: i.a }).out.lane(0))
        },
        "instance `u_cell` has 2 lanes, but is enabled by `each`, which has 4 lanes",
    );
    begin(
        |m, i| {
            def!(each = i.a.slice(0..4).unpack(row(4)));
            m.enabled(each, || {
                let words = m.memory("words", 4, 8, ReadUnderWrite::Any);
                words.write(i.c, i.a.slice(0..2), i.a);
                words.read_async(i.b.slice(0..2))
            })
        },
        "memory `words` has no lanes, but is enabled by `each`, which has 4 lanes",
    );
    begin(
        |m, i| {
            def!(each = i.a.slice(0..4).unpack(row(4)));
            m.enabled(each, || m.assert(i.c, "it is high"));
            i.a
        },
        "an assertion has no lanes, but is enabled by `each`, which has 4 lanes",
    );
    begin(
        |m, i| {
            def!(each = i.a.slice(0..4).unpack(row(4)));
            def!(pair = i.a.slice(0..2).unpack(row(2)));
            m.enabled(each, || m.enabled(pair, || m.pipe("two", i.a.unpack(row(2)))).pack())
        },
        "the enable `pair` has 2 lanes, but is enabled by `each`, which has 4 lanes",
    );
    begin(|m, i| m.enabled(i.a, || m.pipe("one", i.a)), "the condition of `enabled` is 1 bit, but `a` has 8 bits");
}

/// A block that is placed in and outside of enabled parts repeats none of its mistakes.
#[test]
fn a_mistake_in_a_block_is_reported_once() {
    /// Mixes widths.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Wrong;
    impl Block for Wrong {
        type In = Link;
        type Out = Out;
        fn inputs(&self) -> Link<Width> {
            Link { x: bits(8) }
        }
        fn build(&self, m: Module, i: Link) -> Out {
            Out { out: m.pipe("y", i.x + i.x.slice(0..4)) }
        }
    }
    let text = problems(&Case(|m, i| {
        let place = |name: &str, x| m.instance(name, &Wrong, Link { x }).out;
        place("u_one", i.a) ^ m.enabled(i.c, || place("u_two", i.a))
    }));
    assert!(text.starts_with("`+` needs equal widths") && !text.contains("problems"), "{text}");
}
