//! One mistake is one problem: a stand-in causes no false ones.

use crate::messages::common::{FAST, Inverter, Lamp, Link};
use tilewright_hdl::*;

bundle! {
    struct Given<T> { a: T, b: T, c: T, words: Stream<T, T> }
    struct Made<T> { out: T, next: T, lamp: T, number: T }
    struct Point<T> { x: T, y: T }
    struct Points<T> { all: Vec<T> }
}

type Describe = fn(Module, Given) -> Signal;

/// A block whose 8-bit output another block takes, and which uses all its inputs.
#[derive(Clone, PartialEq, Eq, Hash)]
#[allow(unpredictable_function_pointer_comparisons, reason = "a block that is built twice for one function is no harm")]
struct First(Describe);

impl std::fmt::Debug for First {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "First {{ at: {} }}", self.0 as usize)
    }
}

impl Block for First {
    type In = Given;
    type Out = Made;

    fn inputs(&self) -> Given<Width> {
        Given { a: bits(8), b: bits(2), c: bit(), words: stream(8) }
    }

    fn build(&self, m: Module, i: Given) -> Made {
        // A value derived from it is registered, added to, compared, chosen, and read as another kind.
        let value = (self.0)(m, i);
        def!(held = m.reg(8).reset(0).when(value.eq(3), value).when(i.c, value + 1).when(i.b.eq(1), i.a));
        def!(driven = m.wire(8));
        driven.drive(mux(i.c, value, i.words.payload));
        def!(lamp = m.reg(one_of::<Lamp>()).reset(Lamp::Off));
        lamp.next(value.part(0, 1).code::<Lamp>());
        let number = (value.signed() - 3).gt(-120);
        let _ = case(value, [(200, i.a), (100, value)], value);
        let below = m.instance("u_below", &Inverter { registered: true }, Link { x: value }).out;
        Made { out: cat![value, lit(8, 0)].part(8, 8), next: held + *driven + below, lamp: *lamp, number }
    }

    fn outputs(&self) -> Vec<(String, Width)> {
        let widths = Made { out: bits(8), next: bits(8), lamp: one_of::<Lamp>(), number: bit() };
        widths.leaves()
    }

    fn name(&self) -> String {
        "first".to_owned()
    }
}

/// Takes the outputs of the other one as they are declared.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Whole(First);

impl Block for Whole {
    type In = Given;
    type Out = Link;

    fn inputs(&self) -> Given<Width> {
        self.0.inputs()
    }

    fn build(&self, m: Module, i: Given) -> Link {
        let made = m.instance("u_first", &self.0, i);
        Link { x: mux(made.number & made.lamp.is(Lamp::On), made.out + made.next, 255) }
    }

    fn outputs(&self) -> Vec<(String, Width)> {
        Link { x: bits(8) }.leaves()
    }

    fn name(&self) -> String {
        "whole".to_owned()
    }
}

#[track_caller]
fn one(message: &str, describe: Describe) {
    let problems = elaborate(&Whole(First(describe))).expect_err(message);
    assert!(problems.0.len() == 1 && problems.0[0].message.starts_with(message), "for `{message}`:\n{problems}");
}

/// The valid remainder of a description.
fn taken(i: &Given) -> Signal {
    i.words.take_when(1).taken & i.words.bit(0)
}

#[test]
fn a_description_without_a_mistake() {
    elaborate(&Whole(First(|_, i| i.a | taken(&i).repeat(8)))).unwrap();
}

#[test]
fn of_choices() {
    one("`mux` has only integers", |_, i| mux(taken(&i), 0, 200));
    one("`case` has only integers", |_, i| case(i.a & taken(&i).repeat(8), [(0, 1), (1, 2)], 200));
    one("`select` has only integers", |_, i| select([(taken(&i), 200)], 0));
    one("`mux` has only low bits", |_, i| mux(taken(&i), i.a.low(), i.words.low()));
    one("the condition of `mux` is 1 bit", |_, i| mux(i.b, i.a, taken(&i).repeat(8)));
    one("the key 900 of `case` does not fit", |_, i| case(i.a, [(900, i.a), (0, i.a)], taken(&i).repeat(8)));
    one("the key 4 of `case` occurs twice", |_, i| case(i.a, [(4, i.a), (4, i.a)], taken(&i).repeat(8)));
    one("`mux` needs equal widths", |_, i| mux(taken(&i), i.a, i.b));
    one("`mux` mixes", |_, i| mux(taken(&i), i.a.signed(), i.words.payload).bits());
    one("`mux` gives a record the number 5", |_, i| mux(taken(&i), Point { x: i.a, y: i.b }, 5).x);
    one("`mux` gives a list", |_, i| {
        mux(taken(&i), Points { all: vec![i.a, i.a] }, Points { all: vec![i.words.payload] }).all[0]
    });
    one("`choose` needs a code of `Lamp`", |_, i| {
        (i.c & taken(&i)).choose(|lamp: Lamp| if lamp == Lamp::On { i.a } else { i.words.payload })
    });
    one("`is_code` needs a code", |_, i| (i.a.is_code() & taken(&i)).repeat(8));
}

#[test]
#[expect(clippy::reversed_empty_ranges, reason = "that is one of the mistakes")]
fn of_widths() {
    one("the slice 7..4", |_, i| i.a.slice(7..4) | taken(&i));
    one("the slice 7..4", |_, i| i.a.slice(7..4) | taken(&i).repeat(8));
    one("the slice 4..12", |_, i| i.a.slice(4..12) | taken(&i).repeat(8));
    one("`.trunc(9)` cannot cut", |_, i| i.a.trunc(9) ^ taken(&i).repeat(9));
    one("`.trunc(0)` cannot cut", |_, i| i.a.trunc(0) ^ taken(&i).repeat(8));
    one("`.zext(4)` cannot widen", |_, i| i.a.zext(4) ^ taken(&i).repeat(8));
    one("`.repeat(0)`", |_, i| i.a.repeat(0) ^ taken(&i).repeat(8));
    one("`.repeat(1000000000)`", |_, i| i.a.repeat(1_000_000_000) ^ taken(&i).repeat(8));
    one("a concatenation of", |_, i| cat![i.a.repeat(100_000), i.a.repeat(100_000)].trunc(8) ^ taken(&i).repeat(8));
    one("a product of", |_, i| i.a.zext(700_000).times(i.b.zext(700_000)) ^ taken(&i).repeat(8));
    one("a constant has no bits", |_, i| lit(0, 3) ^ i.a ^ taken(&i).repeat(8));
    one("`300` does not fit", |_, i| i.a + 300 + taken(&i).repeat(8));
    one("`-1` does not fit", |_, i| mux(taken(&i), i.a, -1));
    one("`+` needs equal widths", |_, i| i.a + i.b + taken(&i).repeat(8));
    one("`&` needs equal widths", |_, i| i.b & i.a & taken(&i).repeat(2));
    one("`+` mixes", |_, i| i.b.signed() + i.b + taken(&i).repeat(8));
    one("`+` computes with", |_, i| i.c.code::<Lamp>() + 1 + taken(&i).repeat(8));
    one("a `Lamp` has 1 bit", |_, i| i.a.code::<Lamp>().bits() ^ taken(&i).repeat(8));
    one("`-` makes a negative number", |_, i| -i.a ^ taken(&i).repeat(8));
    one("a record of 12 bits is unpacked", |_, i| {
        let Point { x, y } = Point { x: bits(10), y: bits(2) }.unpack(i.a);
        cat![x, y] ^ taken(&i).repeat(8)
    });
}

#[test]
fn of_lanes() {
    one("lane 4 of a signal of 4 lanes", |_, i| i.a.unpack(4).lane(4) ^ taken(&i).repeat(8));
    one("`.unpack` cannot cut", |_, i| i.a.unpack(3).pack() ^ taken(&i).repeat(8));
    one("`.sum` needs a row", |_, i| i.a.sum() ^ taken(&i).repeat(2));
    one("`+` needs equal shapes", |_, i| (i.a.unpack(4) + i.a.unpack(2).trunc(2)).pack() ^ taken(&i).repeat(8));
    one("the lanes of a stack have different widths", |_, i| stack([i.a, i.b]).pack() ^ taken(&i).repeat(8));
    one("a signal has no lanes", |_, i| i.a.of(0).lane(3) ^ taken(&i).repeat(8));
    one("lane 4 of `.take` would be", |_, i| i.a.unpack(4).take(9, |i| i).pack() ^ taken(&i).repeat(8));
    one("`.to_rows` needs a row", |_, i| i.a.to_rows(3).rows().or_all().pack() ^ taken(&i).repeat(8));
}

#[test]
fn of_what_is_declared() {
    one("register `q` has no bits", |m, i| {
        def!(q = m.reg(0).reset(200));
        q.next(i.a ^ taken(&i).repeat(8));
        *q
    });
    one("wire `w` of 2000000 bits", |m, i| {
        def!(w = m.wire(2_000_000));
        w.drive(i.a ^ taken(&i).repeat(8));
        *w
    });
    one("memory `t` of 0 words", |m, i| {
        def!(t = m.memory(0, 8, ReadUnderWrite::Any).words([1, 2, 3]));
        t.write(i.c, i.b, i.a ^ taken(&i).repeat(8));
        t.read(i.b)
    });
    one("memory `t` of 4 words of 0 bits", |m, i| {
        def!(t = m.memory(4, 0, ReadUnderWrite::Any).fill(3));
        t.write(i.c, i.b, i.a ^ taken(&i).repeat(8));
        t.read_async(i.b)
    });
    one("field `x` of memory `t` has no bits", |m, i| {
        def!(t = m.memory(4, Point { x: bits(0), y: bits(2) }, ReadUnderWrite::Any));
        t.write(i.c, i.b, Point { x: i.a ^ taken(&i).repeat(8), y: i.b });
        t.read_async(i.b).x
    });
    one("a word of memory `t` has 8 bits", |m, i| {
        def!(t = m.memory(4, 8, ReadUnderWrite::Any));
        t.write(i.c, i.b, i.a.zext(9) ^ taken(&i).repeat(9));
        t.read_async(i.b)
    });
    one("the reset value of `q` is not a constant", |m, i| {
        def!(q = m.reg(8).reset(i.b));
        q.next(i.a ^ taken(&i).repeat(8));
        *q
    });
    one("`q` has 4 lanes, but 2 reset values", |m, i| {
        def!(q = m.reg(bits(2).of(4)).reset_each([1, 2]));
        q.next(i.a.unpack(4) ^ taken(&i).repeat(2));
        q.pack()
    });
    one("`next` needs equal widths", |m, i| {
        def!(q = m.reg(8));
        q.next(i.b);
        *q ^ taken(&i).repeat(8)
    });
    one("register `q` of `First` is never driven", |m, i| {
        def!(q = m.reg(8));
        *q ^ taken(&i).repeat(8)
    });
    one("`q` is given a next value twice", |m, i| {
        def!(q = m.reg(8));
        q.next(i.a);
        q.next(taken(&i).repeat(8));
        *q
    });
}

#[test]
fn of_streams_instances_and_clocks() {
    one("stream `words` in `First` is never taken", |_, i| i.a);
    one("stream `words` is taken twice", |_, i| {
        let _ = i.words.take_when(i.c);
        i.a ^ taken(&i).repeat(8)
    });
    one("a stream that is offered in `First` is never taken", |m, i| {
        let (_, sent) = m.offer(i.c, i.a);
        sent.repeat(8) ^ taken(&i).repeat(8)
    });
    one("input `x` of `u_bad` has 8 bits", |m, i| {
        m.instance("u_bad", &Inverter { registered: false }, Link { x: i.b }).out ^ taken(&i).repeat(8)
    });
    one("`crossed` is on clock `clk` but", |m, i| i.a ^ taken(&i).repeat(8) ^ crossed(m));
}

/// A register of the module's own clock, which one of another clock samples.
fn crossed(m: Module) -> Signal {
    def!(crossed = m.reg(8).reset(0));
    crossed.next(crossed + 1);
    def!(taken = m.on(FAST).pipe(*crossed));
    def!(back = m.on(FAST).pipe(taken));
    back.quasi_static("it stands still")
}
