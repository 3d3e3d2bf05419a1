//! Clocks, and paths between them.

use crate::messages::common::*;
use tilewright_hdl::*;

#[test]
fn paths_between_clocks_need_a_crossing() {
    expect(
        |m, i| {
            let slow = m.pipe("slow", i.a);
            m.on(FAST).pipe("fast", slow)
        },
        "`slow` is on clock `clk` but reaches register `fast` on clock `fast` without a crossing [T801]
         --> [m.on(FAST).pipe(\"fast\", slow)]
         `slow` is declared at [let slow = m.pipe(\"slow\", i.a);]
         help: cross with `m.synchronize`, a memory with a port on each clock, or `.quasi_static(reason)`; an input of another clock is declared `bits(n).on(clock)`",
    );
}

#[test]
fn declared_crossings_are_fine() {
    let crossed = |m: Module, i: In| {
        let fast = m.on(FAST);
        let flag = fast.synchronize("flag", m.pipe("slow_flag", i.c));
        let words = m.memory("words", 256, 8, ReadUnderWrite::Old);
        words.write(i.c, i.a, i.a);
        let word = words.on(FAST).read(fast.pipe("address", i.a.quasi_static("the address is held during a read")));
        fast.pipe("both", mux(flag, word, 0))
    };
    elaborate(&Case(crossed)).unwrap();
}

#[test]
fn a_child_may_declare_the_crossing() {
    /// Passes on an input of another clock as stable.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Held;
    impl Block for Held {
        type In = Link;
        type Out = Out;
        fn inputs(&self) -> Link<Width> {
            Link { x: bits(8).on(FAST) }
        }
        fn build(&self, _: Module, i: Link) -> Out {
            Out { out: i.x.quasi_static("written before the start") }
        }
    }
    elaborate(&Case(|m, i| {
        m.ignore(&i);
        let fast = m.on(FAST).pipe("fast", lit(8, 1));
        m.pipe("slow", m.instance("u_held", &Held, Link { x: fast }).out)
    }))
    .unwrap();
}

bundle! {
    struct Pair<T> { left: T, right: T }
}

/// A block of two named clocks and none of its own, described by a function.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
#[allow(unpredictable_function_pointer_comparisons, reason = "a block that is built twice for one function is no harm")]
struct TwoClocks {
    inputs: fn() -> Link<Width>,
    build: fn(Module, Module, Signal) -> (Signal, Signal),
}

impl Block for TwoClocks {
    type In = Link;
    type Out = Pair;

    fn inputs(&self) -> Link<Width> {
        (self.inputs)()
    }

    fn build(&self, m: Module, i: Link) -> Pair {
        m.ignore(&i);
        let (left, right) = (self.build)(m.on(FAST), m.on(SLOW), i.x);
        Pair { left, right }
    }

    fn name(&self) -> String {
        "two_clocks".to_owned()
    }
}

const SLOW: Clock = Clock::new("slow", Period::ns(6));

#[test]
fn inputs_of_a_block_without_a_clock_of_its_own_name_theirs() {
    let build = |fast: Module, slow: Module, x: Signal| (fast.pipe("r", x), slow.pipe("s", !x));
    assert_eq!(
        problems(&TwoClocks { inputs: || Link { x: bits(8) }, build }),
        "input `x` of `TwoClocks` does not say on which clock it is: `fast` or `slow` [T802]
  --> [problems(&TwoClocks { inputs: || Link { x: bits(8) }, build }),]
  register `r` on clock `fast` takes it at [let build = |fast: Module, slow: Module, x: Signal| (fast.pipe(\"r\", x), slow.pipe(\"s\", !x));]
  help: declare it as `bits(n).on(clock)`; only a block with a clock of its own may leave that out"
    );
    let text = problems(&TwoClocks { inputs: || Link { x: bits(8).on(FAST) }, build });
    assert!(text.starts_with("`x` is on clock `fast` but reaches register `s` on clock `slow`"), "{text}");
    // A value that no clock samples, or that any clock may sample, needs no clock.
    let crossed = |fast: Module, slow: Module, x: Signal| {
        let flag = slow.synchronize("flag", x.bit(0));
        (fast.pipe("r", x.quasi_static("held")), slow.pipe("s", x.quasi_static("held")) + flag.zext(8))
    };
    elaborate(&TwoClocks { inputs: || Link { x: bits(8) }, build: crossed }).unwrap();
    let through = |fast: Module, slow: Module, x: Signal| (fast.pipe("r", lit(8, 1)), slow.pipe("s", lit(8, 1)) ^ x);
    elaborate(&TwoClocks { inputs: || Link { x: bits(8) }, build: through }).unwrap();
}

#[test]
fn outputs_that_mix_clocks() {
    let mixed = |fast: Module, slow: Module, x: Signal| {
        let r = fast.pipe("r", x);
        let s = slow.pipe("s", lit(8, 1));
        (r + s, s)
    };
    let block = TwoClocks { inputs: || Link { x: bits(8).on(FAST) }, build: mixed };
    assert_eq!(
        problems(&block),
        "output `left` of `TwoClocks` mixes clocks `fast` and `slow` [T803]
  --> [(r + s, s)]
  `r`, on clock `fast`, is declared at [let r = fast.pipe(\"r\", x);]
  `s`, on clock `slow`, is declared at [let s = slow.pipe(\"s\", lit(8, 1));]
  help: give each clock an output of its own, or cross with `m.synchronize` or `.quasi_static(reason)` before"
    );
    // A parent that passes it on, or samples it, adds no message.
    let parent = |m: Module, _: In| {
        let mixed =
            |fast: Module, slow: Module, _: Signal| (fast.pipe("r", lit(8, 1)) + slow.pipe("s", lit(8, 1)), lit(8, 0));
        let block = TwoClocks { inputs: || Link { x: bits(8) }, build: mixed };
        let out = m.instance("u_two", &block, Link { x: lit(8, 0) });
        let _ = m.on(FAST).pipe("taken", out.left);
        out.left
    };
    let text = problems(&Case(parent));
    assert!(text.starts_with("output `left` of `TwoClocks` mixes") && !text.contains("problems"), "{text}");
}

#[test]
fn logic_that_enters_a_synchronizer() {
    expect(
        |m, i| {
            let r = m.pipe("r", i.a);
            m.on(FAST).synchronize("flag", r.eq(3)).zext(8)
        },
        "`r.eq(3)` enters synchronizer `flag` but is logic, which glitches [T804]
         --> [m.on(FAST).synchronize(\"flag\", r.eq(3)).zext(8)]
         `r.eq(3)` is made at [m.on(FAST).synchronize(\"flag\", r.eq(3)).zext(8)]
         help: put a register on its own clock before the synchronizer, as in `m.pipe(name, value)`",
    );
    // Wiring and an inverter are harmless.
    elaborate(&Case(|m, i| {
        let wire = m.wire("w", 8);
        let cells = m.array("u_cell", 2, &Inverter { registered: true }, |_| Link { x: i.a });
        wire.drive(cat![m.pipe("r", i.b), i.c]);
        let fast = m.on(FAST);
        fast.synchronize("one", !wire.bit(2)).zext(8) ^ fast.synchronize("two", cells.out.lane(1).bit(0)).zext(8)
    }))
    .unwrap();
}

#[test]
fn logic_that_enters_a_synchronizer_in_an_instance_or_comes_from_one() {
    let inside = problems(&Case(|m, i| {
        let build = |fast: Module, _: Module, x: Signal| (fast.synchronize("flag", x.bit(0)), lit(1, 0));
        let block = TwoClocks { inputs: || Link { x: bits(8) }, build };
        m.instance("u_two", &block, Link { x: i.a + 1 }).left.zext(8)
    }));
    assert!(inside.starts_with("`a + 1` enters synchronizer `u_two.flag` but is logic"), "{inside}");
    let build = |m: Module, i: In| {
        /// Compares in the same clock.
        #[derive(Debug, Clone, PartialEq, Eq, Hash)]
        struct IsZero;
        impl Block for IsZero {
            type In = Link;
            type Out = Out;
            fn inputs(&self) -> Link<Width> {
                Link { x: bits(8) }
            }
            fn build(&self, _: Module, i: Link) -> Out {
                Out { out: i.x.eq(0) }
            }
        }
        let zero = m.instance("u_zero", &IsZero, Link { x: m.pipe("r", i.a) }).out;
        m.on(FAST).synchronize("flag", zero).zext(8)
    };
    let text = problems(&Case(build));
    assert!(text.starts_with("`u_zero.out` enters synchronizer `flag` but is logic"), "{text}");
}

#[test]
fn synchronizers_take_one_bit() {
    let text = problems(&Case(|m, i| m.on(FAST).synchronize("flag", i.a).zext(8)));
    assert!(text.starts_with("the condition of `synchronize` is 1 bit, but `a` has 8 bits"), "{text}");
    assert!(!text.contains("problems in this"), "{text}");
}

#[test]
fn an_instance_is_fed_on_its_own_clock() {
    let text = problems(&Case(|m, i| {
        let slow = m.pipe("slow", i.a);
        m.on(FAST).instance("u_inverter", &Inverter { registered: true }, Link { x: slow }).out
    }));
    let message = "`slow` is on clock `clk` but reaches input `x` of `u_inverter` on clock `fast` without a crossing";
    assert!(text.starts_with(message), "{text}");
}

#[test]
fn a_clock_has_one_period() {
    const OTHER: Clock = Clock::new("fast", Period::ns(6));
    /// Takes a clock as a parameter.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Timed(Clock);
    impl Block for Timed {
        type In = Link;
        type Out = Out;
        fn inputs(&self) -> Link<Width> {
            Link { x: bits(8).on(self.0) }
        }
        fn build(&self, m: Module, i: Link) -> Out {
            Out { out: m.on(self.0).pipe("y", i.x) }
        }
        fn name(&self) -> String {
            format!("timed_{}", self.0.period.picoseconds())
        }
    }
    let text = problems(&Case(|m, _| {
        let one = m.instance("u_one", &Timed(FAST), Link { x: lit(8, 1) }).out;
        m.instance("u_two", &Timed(OTHER), Link { x: lit(8, 1) }).out & one
    }));
    let places = [
        "clock `fast` has a period of 6 ns here and of 4 ns elsewhere [T805]",
        "  --> [Link { x: bits(8).on(self.0) }]",
        "  `fast` is first used at [Link { x: bits(8).on(self.0) }]",
        "  help: a clock has one period in the whole design",
    ];
    assert!(text.starts_with(&places.join("\n")), "{text}");
}

#[test]
fn a_clock_runs_in_place_of_one_with_its_period() {
    expect(
        |m, i| m.on(FAST).in_place_of(SLOW, || m.on(SLOW).pipe("slow", i.a.quasi_static("set once"))),
        "clock `slow` has a period of 6 ns, but `fast`, which runs in its place, of 4 ns [T832]
         --> [|m, i| m.on(FAST).in_place_of(SLOW, || m.on(SLOW).pipe(\"slow\", i.a.quasi_static(\"set once\"))),]
         help: a block may rely on the periods of its clocks: make the clock a parameter of the block",
    );
    let own = |m: Module, i: In| m.in_place_of(SLOW, || m.on(SLOW).pipe("slow", i.a));
    let text = problems(&Case(own));
    let message = "clock `slow` has a period of 6 ns, but the default clock, which runs in its place, of 10 ns";
    assert!(text.starts_with(message) && !text.contains("problems"), "{text}");
    elaborate_at(&Case(own), Period::ns(6)).unwrap();
    /// Names a clock that runs in place of its own.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Named;
    impl Block for Named {
        type In = Link;
        type Out = Out;
        fn inputs(&self) -> Link<Width> {
            Link { x: bits(8) }
        }
        fn build(&self, m: Module, i: Link) -> Out {
            Out { out: m.in_place_of(SLOW, || m.on(SLOW).pipe("y", i.x)) }
        }
    }
    let text = problems(&Case(|m, i| {
        let x = i.a.quasi_static("set once");
        m.on(FAST).instance("u_named", &Named, Link { x }).out
    }));
    let lines = [
        "clock `slow` has a period of 6 ns, but `fast`, which runs in its place, of 4 ns [T832]",
        "  --> [Out { out: m.in_place_of(SLOW, || m.on(SLOW).pipe(\"y\", i.x)) }]",
        "  `fast` is given to the instance at [m.on(FAST).instance(\"u_named\", &Named, Link { x }).out]",
    ];
    assert!(text.starts_with(&lines.join("\n")), "{text}");
    /// Has that block on its own clock.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Around;
    impl Block for Around {
        type In = Link;
        type Out = Out;
        fn inputs(&self) -> Link<Width> {
            Link { x: bits(8) }
        }
        fn build(&self, m: Module, i: Link) -> Out {
            m.instance("u_named", &Named, i)
        }
    }
    let text = problems(&Case(|m, i| {
        let x = i.a.quasi_static("set once");
        m.on(FAST).instance("u_around", &Around, Link { x }).out
    }));
    assert!(text.starts_with(&lines[..2].join("\n")), "{text}");
}

#[test]
fn a_clock_runs_in_place_of_one_with_its_reset() {
    const LOW: Clock = Clock::new("low", Period::ns(4)).reset(Reset::AsynchronousLow);
    expect(
        |m, i| m.on(FAST).in_place_of(LOW, || m.on(LOW).pipe("low", i.a.quasi_static("set once"))),
        "clock `low` has an active-low asynchronous reset, but `fast`, which runs in its place, a synchronous reset [T832]
         --> [|m, i| m.on(FAST).in_place_of(LOW, || m.on(LOW).pipe(\"low\", i.a.quasi_static(\"set once\"))),]
         help: give both clocks the same reset, or make the clock a parameter of the block",
    );
}

#[test]
fn a_clock_resets_in_one_way() {
    const OTHER: Clock = Clock::new("fast", Period::ns(4)).reset(Reset::AsynchronousLow);
    expect(
        |m, i| {
            let on = m.on(FAST).pipe("on", i.a.quasi_static("a test"));
            m.on(OTHER).pipe("other", on)
        },
        "clock `fast` has an active-low asynchronous reset here and a synchronous reset elsewhere [T809]
         --> [m.on(OTHER).pipe(\"other\", on)]
         `fast` is first used at [let on = m.on(FAST).pipe(\"on\", i.a.quasi_static(\"a test\"));]
         help: a clock resets in one way in the whole design",
    );
    // A clock that only a width names is known as well.
    let text = problems(&Case(|m, i| {
        let _ = m.reg("on", bits(8).on(FAST)).reset(0).when(lit(1, 1), 1);
        *m.reg("other", bits(8).on(OTHER.reset(Reset::PowerOn))).when(i.a.quasi_static("a test").bit(0), 1)
    }));
    assert!(text.starts_with("clock `fast` has no reset here and a synchronous reset elsewhere [T809]"), "{text}");
}

#[test]
fn a_clock_acts_on_one_edge() {
    const OTHER: Clock = Clock::new("fast", Period::ns(4)).falling();
    expect(
        |m, i| {
            let on = m.on(FAST).pipe("on", i.a.quasi_static("a test"));
            m.on(OTHER).pipe("other", on)
        },
        "clock `fast` acts on its falling edge here and acts on its rising edge elsewhere [T810]
         --> [m.on(OTHER).pipe(\"other\", on)]
         `fast` is first used at [let on = m.on(FAST).pipe(\"on\", i.a.quasi_static(\"a test\"));]
         help: a clock has one edge in the whole design: the opposite one is a clock of its own",
    );
    const INNER: Clock = Clock::new("inner", Period::ns(4)).falling();
    expect(
        |m, i| m.on(FAST).in_place_of(INNER, || m.on(INNER).pipe("inner", i.a.quasi_static("set once"))),
        "clock `inner` acts on its falling edge, but `fast`, which runs in its place, acts on its rising edge [T832]
         --> [|m, i| m.on(FAST).in_place_of(INNER, || m.on(INNER).pipe(\"inner\", i.a.quasi_static(\"set once\"))),]
         help: give both clocks the same edge, or make the clock a parameter of the block",
    );
}

#[test]
fn the_port_of_a_reset_is_no_other_port() {
    block! {
        /// An input with a reset's name.
        struct Taken;
        in TakenIn { rst_n: bit() }
        out TakenOut { count: bits(4) }
    }
    impl Taken {
        fn build(&self, m: Module, i: TakenIn) -> TakenOut {
            TakenOut { count: *m.reg("count", 4).reset(0).when(i.rst_n, 1) }
        }
    }
    elaborate(&Taken).unwrap();
    let clock = DefaultClock::new(DEFAULT_PERIOD).reset(Reset::SynchronousLow);
    let text = elaborate_at(&Taken, clock).unwrap_err().to_string();
    assert!(text.starts_with("input `rst_n` has the name of a reset [T401]"), "{text}");
}

#[test]
#[should_panic(expected = "a clock period is an even number of picoseconds above 0")]
fn periods_that_have_no_half() {
    let _ = Period::ps(3);
}

#[test]
fn a_clock_is_said_to_have_no_reset_before_it_is_used() {
    expect(
        |m, i| {
            let on = m.on(FAST).pipe("on", i.a.quasi_static("a test"));
            m.reset_by_power_on(FAST);
            on
        },
        "clock `fast` has no reset from here on and a synchronous reset before [T809]
         --> [m.reset_by_power_on(FAST);]
         `fast` is first used at [let on = m.on(FAST).pipe(\"on\", i.a.quasi_static(\"a test\"));]
         help: write this line first in the top, whose ports are on other clocks",
    );
}
