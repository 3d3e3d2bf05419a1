//! Enabled parts: they run as if their clock rose only where the enable is high.

use crate::circuits::engine::of;
use tilewright_hdl::*;

block! {
    /// Two numbers of a row, added up.
    struct Adder;
    in AdderIn { x: bits(8) }
    out AdderOut { sum: bits(8) }
}

impl Adder {
    fn build(&self, m: Module, i: AdderIn) -> AdderOut {
        def!(sum = m.reg(8).reset(1));
        sum.next(sum + i.x);
        m.cover("odd", sum.bit(0));
        AdderOut { sum: *sum }
    }
}

block! {
    /// Everything that has a state, of its own and in instances.
    struct Inner;
    in InnerIn { x: bits(8), take: bit() }
    out InnerOut { all: bits(8), lanes: bits(8).of(row(3)), word: bits(8), stays: bit() }
}

impl Inner {
    fn build(&self, m: Module, i: InnerIn) -> InnerOut {
        def!(count = m.reg(8).reset(3));
        count.when(i.take, count + i.x);
        def!(late = m.pipe_when(i.take, i.x));
        let piped = m.stages(2, i.take, InnerIn { x: i.x, take: i.take }, |_, stage| stage);
        def!(words = m.memory(4, 8, ReadUnderWrite::Old).fill(7));
        words.write(i.take, count.slice(0..2), i.x);
        def!(word = words.read(i.x.slice(0..2)));
        def!(adder = m.instance(&Adder, AdderIn { x: late }));
        def!(lanes = m.array(3, &Adder, |all| AdderIn { x: all.sum.previous(i.x) }));
        def!(quiet = m.reg(4).reset(0));
        m.enabled(count.bit(0), || quiet.next(quiet + 1));
        def!(part = m.enabled(count.bit(0), || m.pipe("part_x", i.x)));
        m.assert(m.past(i.take).implies(count.eq(m.past(*count) + m.past(i.x))), "a step adds its number");
        m.cover("it took", m.past(i.take));
        let all = count ^ piped.x ^ adder.sum ^ part ^ quiet.zext(8) ^ piped.take.zext(8);
        InnerOut { all, lanes: lanes.sum, word, stays: m.stable(*count) }
    }
}

block! {
    /// The same within an enabled part.
    struct Outer;
    in OuterIn { enable: bit(), x: bits(8), take: bit() }
    out OuterOut { all: bits(8), lanes: bits(8).of(row(3)), word: bits(8), stays: bit() }
}

impl Outer {
    fn build(&self, m: Module, i: OuterIn) -> OuterOut {
        let inner = m.enabled(i.enable, || m.instance("u_inner", &Inner, InnerIn { x: i.x, take: i.take }));
        OuterOut { all: inner.all, lanes: inner.lanes, word: inner.word, stays: inner.stays }
    }
}

/// Pseudo-random numbers.
fn numbers() -> impl FnMut() -> u64 {
    let mut state = 1_u64;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        state >> 33
    }
}

#[test]
fn an_enabled_block_runs_in_the_edges_that_are_enabled() {
    let (mut outer, mut inner) = (of(&Outer), of(&Inner));
    // What has no reset takes its first value.
    outer.drive(OuterIn { enable: 1, x: 0, take: 0 });
    outer.reset();
    inner.reset();
    let mut next = numbers();
    let mut enabled = 0;
    for _ in 0..200 {
        let (x, take, enable) = (next() % 256, next() % 2, u64::from(next().is_multiple_of(3)));
        outer.drive(OuterIn { enable, x, take });
        inner.drive(InnerIn { x, take });
        let (seen, expected) = (outer.read_u64(), inner.read_u64());
        assert_eq!((seen.all, seen.lanes, seen.stays), (expected.all, expected.lanes, expected.stays));
        assert_eq!(seen.word, expected.word);
        outer.step();
        if enable == 1 {
            inner.step();
            enabled += 1;
        }
    }
    assert!((40..100).contains(&enabled), "{enabled}");
    let counts = |covers: Vec<tilewright_sim::Covered>| covers.into_iter().map(|cover| cover.count).collect::<Vec<_>>();
    assert_eq!(counts(outer.covers()), counts(inner.covers()));
    assert_eq!(inner.covers().len(), 5);
}

#[test]
fn a_reset_does_not_wait_for_the_enable() {
    let mut outer = of(&Outer);
    outer.reset();
    outer.drive(OuterIn { enable: 1, x: 5, take: 1 });
    outer.step();
    assert_eq!(outer.peek("u_inner.count").unwrap(), 8);
    outer.drive(OuterIn { enable: 0, x: 5, take: 1 });
    outer.step();
    assert_eq!(outer.peek("u_inner.count").unwrap(), 8);
    outer.reset();
    assert_eq!(outer.peek("u_inner.count").unwrap(), 3);
    assert_eq!(outer.peek("u_inner.u_adder.sum").unwrap(), 1);
}
