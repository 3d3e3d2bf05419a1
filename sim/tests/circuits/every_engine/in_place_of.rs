//! Clocks that run in place of others, in instances and in the description.

use crate::circuits::engine::of;
use tilewright_hdl::*;

/// The clocks that blocks name.
const LEFT: Clock = Clock::new("left", Period::ns(10));
const RIGHT: Clock = Clock::new("right", Period::ns(6));
/// The clock that runs in place of the right one. The default clock runs in place of the left one.
const OUTSIDE: Clock = Clock::new("outside", Period::ns(6));

block! {
    /// Counts its own clocks.
    struct Counter;
    out CounterOut { count: bits(8) }
}

impl Counter {
    fn build(&self, m: Module, _: ()) -> CounterOut {
        def!(count = m.reg(8).reset(0));
        count.next(count + 1);
        CounterOut { count: *count }
    }
}

block! {
    /// Counts on two clocks.
    struct Inner;
    out InnerOut { left: bits(8), right: bits(8) }
}

impl Inner {
    fn build(&self, m: Module, _: ()) -> InnerOut {
        def!(left = m.on(LEFT).instance(&Counter, ()));
        def!(right = m.on(RIGHT).instance(&Counter, ()));
        InnerOut { left: left.count, right: right.count }
    }
}

block! {
    /// Places them on other clocks.
    struct Outer;
    in OuterIn { run: bit().on(OUTSIDE) }
    out OuterOut { left: bits(8), right: bits(8), here: bits(8), word: bits(8), slow: bits(8) }
}

impl Outer {
    fn build(&self, m: Module, i: OuterIn) -> OuterOut {
        let outside = m.on(OUTSIDE);
        let both = m.in_place_of(LEFT, || outside.in_place_of(RIGHT, || m.instance("u_both", &Inner, ())));
        // Only the inner clock that runs in place of the enabled one waits for it.
        let slow = outside
            .enabled(i.run, || m.in_place_of(LEFT, || outside.in_place_of(RIGHT, || m.instance("u_slow", &Inner, ()))));
        let (here, word) = outside.in_place_of(RIGHT, || {
            let here = m.reg("here", bits(8).on(RIGHT)).reset(0);
            here.next(here + 1);
            let words = m.memory("words", 4, 8, ReadUnderWrite::Old).fill(0);
            words.on(RIGHT).write(lit(1, 1), 0, *here);
            (*here, words.on(RIGHT).read(0))
        });
        m.ignore(&slow.left);
        OuterOut { left: both.left, right: both.right, here, word, slow: slow.right }
    }
}

#[test]
fn a_block_runs_on_the_clocks_in_place_of_its_own() {
    let design = elaborate(&Outer).unwrap();
    let clocks: Vec<_> = design.top().clocks.iter().map(|clock| clock.port.as_str()).collect();
    assert_eq!(clocks, ["clk", "outside_clk"]);
    let names: Vec<_> = design.modules().iter().map(|module| module.name.as_str()).collect();
    assert_eq!(names, ["counter", "inner", "counter_enabled", "inner_enabled_right", "outer"]);
    let mut sim = of(&Outer);
    for (time, run, left, right, slow) in [(60_000, 0, 6, 10, 0), (120_000, 1, 12, 20, 10), (180_000, 0, 18, 30, 10)] {
        sim.drive(OuterIn { run });
        sim.run_to(time);
        let seen = sim.read_u64();
        assert_eq!((seen.left, seen.right, seen.slow), (left, right, slow));
        assert_eq!((seen.here, seen.word), (right, right - 2));
        assert_eq!(sim.peek("u_slow.u_left.count").unwrap(), left);
    }
}
