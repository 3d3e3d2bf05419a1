//! The latency of a module, counted in its circuit.

use tilewright_hdl::*;

bundle! {
    struct In<T> { a: T, b: T, go: T, hold: T }
    struct Out<T> { x: T, y: T }
}

/// A block that is described by a function.
#[derive(Clone, PartialEq, Eq, Hash)]
#[allow(unpredictable_function_pointer_comparisons, reason = "a block that is built twice for one function is no harm")]
struct Case(fn(Module, In) -> [Signal; 2]);

impl std::fmt::Debug for Case {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "Case {{ at: {} }}", self.0 as usize)
    }
}

impl Block for Case {
    type In = In;
    type Out = Out;

    fn inputs(&self) -> In<Width> {
        In { a: bits(8), b: bits(8), go: bit(), hold: bit() }
    }

    fn build(&self, m: Module, i: In) -> Out {
        m.ignore(&i);
        let [x, y] = (self.0)(m, i);
        Out { x, y }
    }
}

fn latency(build: fn(Module, In) -> [Signal; 2]) -> Option<String> {
    let latencies = elaborate(&Case(build)).unwrap().latencies();
    latencies.last().unwrap().as_ref().map(ToString::to_string)
}

#[track_caller]
fn is(build: fn(Module, In) -> [Signal; 2], clocks: &str) {
    assert_eq!(latency(build).as_deref(), Some(clocks));
}

#[track_caller]
fn is_none(build: fn(Module, In) -> [Signal; 2]) {
    assert_eq!(latency(build), None);
}

#[test]
fn registers_on_every_path_are_counted() {
    is(|_, i| [i.a + i.b, lit(1, 0)], "0 clocks");
    is(|m, i| [m.pipe("first", i.a), m.pipe("second", i.b)], "1 clock");
    is(|m, i| [m.stages(3, i.go, In { a: i.a + 1, ..i }, |_, now| now).a, lit(1, 0)], "3 clocks with `go`");
    // An enable is not on a path; a register that keeps its value unless one condition is true is enabled by that
    // condition.
    is(
        |m, i| {
            let x = m.reg("held", 8);
            x.when(i.go, i.a ^ i.b);
            [m.pipe_when(i.go, "late", *x), lit(1, 0)]
        },
        "2 clocks with `go`",
    );
    // Constants, and values that no input reaches, have any latency.
    is(
        |m, i| {
            let count = m.reg("count", 8).reset(0);
            count.next(count + 1);
            [m.pipe("first", i.a) + m.pipe("one", lit(8, 1)), *count]
        },
        "1 clock",
    );
}

#[test]
fn a_read_is_a_register() {
    is(
        |m, i| {
            let squares = m.memory("squares", 256, 8, ReadUnderWrite::Any).words((0..256).map(|x| (x * x) & 0xff));
            [squares.read_when(i.go, i.a), m.pipe_when(i.go, "second", i.b)]
        },
        "1 clock with `go`",
    );
    is_none(|m, i| {
        let words = m.memory("words", 256, 8, ReadUnderWrite::Old);
        words.write(i.go, i.a, i.b);
        [words.read(i.a), lit(1, 0)]
    });
}

#[test]
fn what_has_no_single_latency_has_none() {
    is_none(|_, _| [lit(1, 0), lit(1, 1)]);
    is_none(|m, i| [m.pipe("first", i.a) + i.b, lit(1, 0)]);
    is_none(|m, i| [m.pipe("first", i.a), i.b]);
    is_none(|m, i| [m.pipe_when(i.go, "first", i.a), m.pipe_when(i.hold, "second", i.b)]);
    is_none(|m, i| [m.pipe("second", m.pipe_when(i.go, "first", i.a)), lit(1, 0)]);
    is_none(|m, i| [m.pipe_when(!i.hold, "first", i.a), lit(1, 0)]);
    // A counter accumulates the number of its enabled clocks.
    is_none(|m, i| {
        let count = m.reg("count", 8).reset(0);
        count.enable(i.go).next(count + 1);
        [i.a + 1, *count]
    });
    is_none(|m, i| {
        let sum = m.reg("sum", 8).reset(0);
        sum.next(sum + i.a);
        [*sum, lit(1, 0)]
    });
    is_none(|m, i| {
        let other = m.on(Clock::new("other", Period::ns(3)));
        [m.pipe("first", i.a), other.pipe("second", other.synchronize("z", m.pipe("gone", i.go)))]
    });
}

bundle! {
    struct Link<T> { go: T, x: T }
    struct Linked<T> { later: T }
}

/// Two clocks in which `go` is high.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Delay;

impl Block for Delay {
    type In = Link;
    type Out = Linked;

    fn inputs(&self) -> Link<Width> {
        Link { go: bit(), x: bits(8) }
    }

    fn build(&self, m: Module, i: Link) -> Linked {
        m.stages(2, i.go, Linked { later: i.x }, |_, now| now)
    }
}

#[test]
fn instances_count_with_what_is_in_them() {
    is(
        |m, i| {
            let first = m.instance("u_first", &Delay, Link { go: i.hold, x: i.a });
            let second = m.instance("u_second", &Delay, Link { go: i.hold, x: first.later });
            [m.pipe_when(i.hold, "last", second.later), lit(1, 0)]
        },
        "5 clocks with `hold`",
    );
    is_none(|m, i| [m.instance("u_delay", &Delay, Link { go: !i.hold, x: i.a }).later, lit(1, 0)]);
    is_none(|m, i| [m.instance("u_delay", &Delay, Link { go: i.go, x: i.a }).later + i.a, lit(1, 0)]);
}

/// A delay of two clocks that states another latency.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Stated(&'static str, bool);

impl Block for Stated {
    type In = Link;
    type Out = Linked;

    fn inputs(&self) -> Link<Width> {
        Link { go: bit(), x: bits(8) }
    }

    fn build(&self, m: Module, i: Link) -> Linked {
        let Linked { later } = m.stages(2, i.go, Linked { later: i.x }, |_, now| now);
        Linked { later: if self.1 { later } else { later + i.x.any_stage() } }
    }

    fn about(&self) -> ir::About {
        ir::About { latency: self.0.to_owned(), ..ir::About::default() }
    }
}

#[test]
fn a_number_that_is_stated_is_the_one_counted() {
    elaborate(&Stated("2", true)).unwrap();
    elaborate(&Stated("3 clocks, or so", true)).unwrap();
    let text = |stated| elaborate(&stated).unwrap_err().to_string();
    let wrong = text(Stated("3", true));
    assert!(
        wrong.starts_with(
            "`Stated` states a latency of 3, but takes 2 clocks with `go` [T753]\n  --> hdl/tests/latency.rs:"
        ),
        "{wrong}"
    );
    for in_words in ["3 clocks", "1 clock"] {
        assert!(text(Stated(in_words, true)).contains("but takes 2 clocks with `go`"));
    }
    elaborate(&Stated("3 clocks", false)).unwrap(); // words, where none is counted
    let several = text(Stated("2", false));
    assert!(
        several.starts_with(
            "`Stated` states a latency of 2, but has no single latency [T753]\n  --> hdl/tests/latency.rs:"
        ),
        "{several}"
    );
    assert!(several.ends_with(
        "a latency that is a single number is counted and need not be stated; otherwise, describe it in words"
    ));
}
