//! Runs that end when a condition is true.

use crate::circuits::engine::of;
use tilewright_hdl::{Clock, Module, Period, bit, bits, block};
use tilewright_sim::{Error, Simulation, Vcd};

block! {
    /// Counts in steps; an output depends on the count and an input.
    struct Counter;
    in In { step: bits(4), limit: bits(32) }
    out Out { count: _, wide: _, reached: _, flag: _ }
}

impl Counter {
    fn build(&self, m: Module, i: In) -> Out {
        let count = m.reg("count", 32).reset(0);
        count.next(count + i.step.zext(32));
        let wide = m.reg("wide", 70).reset(1);
        wide.next(wide + *wide);
        let flag = m.reg("flag", 1).reset(0);
        flag.next(!flag);
        m.assert(count.ne(700_000), "nobody counts to 700000");
        Out { count: *count, wide: *wide, reached: count.ge(i.limit), flag: *flag }
    }
}

fn counter() -> Simulation<In, Out> {
    let mut sim = of(&Counter);
    sim.drive(In { step: 1, limit: 50 });
    sim
}

#[test]
fn a_run_ends_after_the_instant_that_brings_the_condition() {
    let mut sim = counter();
    assert_eq!(sim.run_until(sim.o.count.is(20), 1000), Some(20));
    assert_eq!((sim.get_u64(sim.o.count), sim.time(), sim.cycles("clk")), (20, 200_000, Ok(20)));
    assert_eq!(sim.run_until(sim.o.reached, 1000), Some(30));
    assert_eq!(sim.run_until(sim.o.count.is_at_least(60), 1000), Some(10));
    assert_eq!(sim.run_until(sim.o.count.is_not(61), 1000), Some(2));
    // The number of an instant, not of a value.
    sim.set(sim.i.step, 3);
    assert_eq!(sim.run_until(sim.o.count.is_at_least(100), 1000), Some(13));
    assert_eq!(sim.get_u64(sim.o.count), 101);
}

#[test]
fn there_is_always_an_instant() {
    let mut sim = counter();
    assert_eq!(sim.run_until(sim.o.count.is_below(5), 9), Some(1));
    assert_eq!(sim.run_until(sim.o.count.is_below(5), 0), None);
    assert_eq!(sim.time(), 10_000);
    assert_eq!([0, 1, 2].map(|_| sim.run_until(sim.o.flag, 9)), [Some(2), Some(2), Some(2)]);
}

#[test]
fn a_run_ends_at_its_limit() {
    let mut sim = counter();
    assert_eq!(sim.run_until(sim.o.count.is(8), 7), None);
    assert_eq!(sim.get_u64(sim.o.count), 7);
    assert_eq!(sim.run_until(sim.o.count.is(8), 1), Some(1));
    assert_eq!(sim.run_until(sim.o.count.is(10), 2), Some(2));
    assert_eq!(sim.run_until(sim.o.count.is(13), 2), None);
}

#[test]
fn inputs_of_the_moment_count() {
    let mut sim = counter();
    sim.run(10);
    sim.set(sim.i.limit, 5);
    assert_eq!(sim.run_until(sim.o.reached, 100), Some(1));
    sim.set(sim.i.limit, 100);
    assert_eq!(sim.run_until(sim.o.reached, 100), Some(89));
    // An input is a port too.
    assert_eq!(sim.run_until(sim.i.limit.is(100), 100), Some(1));
    assert_eq!(sim.run_until(sim.i.limit.is(99), 3), None);
}

#[test]
fn a_port_may_be_wide() {
    let mut sim = counter();
    assert_eq!(sim.run_until(sim.o.wide.is(1 << 40), 1000), Some(40));
    assert_eq!(sim.run_until(sim.o.wide.is(0), 1000), Some(30));
    sim.reset();
    assert_eq!(sim.run_until(sim.o.wide.is_at_least(u64::MAX), 1000), Some(64));
    assert_eq!(sim.run_until(sim.o.wide.is_below(u64::MAX), 1000), Some(6));
}

#[test]
fn an_assertion_comes_first() {
    let mut sim = counter();
    sim.set(sim.i.step, 7);
    let error = sim.try_run_until(sim.o.count.is(700_001), u64::MAX).unwrap_err();
    let Error::Violated(violations) = error else { panic!("{error}") };
    assert_eq!((violations[0].cycle, sim.get_u64(sim.o.count)), (100_000, 700_000));
    assert!(sim.try_run_until(sim.o.count.is(5), 3).is_err());
    sim.reset();
    sim.set(sim.i.step, 1);
    assert_eq!(sim.run_until(sim.o.count.is(5), 9), Some(5));
}

/// Long enough for code with constant inputs.
#[test]
fn inputs_may_change_after_a_long_run() {
    let mut sim = counter();
    sim.set(sim.i.step, 0);
    sim.run(120_000);
    assert_eq!(sim.run_until(sim.o.reached, 60_000), None);
    sim.set(sim.i.step, 2);
    assert_eq!(sim.run_until(sim.o.reached, 60_000), Some(25));
    sim.set(sim.i.limit, 400_000);
    assert_eq!(sim.run_until(sim.o.reached, u64::MAX), Some(199_975));
    assert_eq!(sim.run_until(sim.o.count.is(400_010), u64::MAX), Some(5));
    sim.set(sim.i.step, 1);
    assert_eq!(sim.run_until(sim.o.count.is(400_020), u64::MAX), Some(10));
}

#[test]
fn a_trace_shows_every_instant_of_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let mut texts = Vec::new();
    for until in [true, false] {
        let file = folder.path().join("counter.vcd");
        let mut sim = counter();
        sim.trace(Vcd::to(&file)).unwrap();
        match until {
            true => assert_eq!(sim.run_until(sim.o.count.is(12), 50), Some(12)),
            false => sim.run(12),
        }
        sim.finish().unwrap();
        texts.push(std::fs::read_to_string(&file).unwrap());
    }
    assert_eq!(texts[0], texts[1]);
}

#[test]
#[should_panic(expected = "`count` has 32 bits: compare it with a number, as in `sim.o.count.is(5)`")]
fn a_port_of_several_bits_is_no_condition() {
    let mut sim = counter();
    sim.run_until(sim.o.count, 9);
}

#[test]
#[should_panic(expected = "the condition compares `flag`, which has 1 bit and cannot hold 2")]
fn a_condition_is_one_that_its_port_can_meet() {
    let mut sim = counter();
    sim.run_until(sim.o.flag.is(2), 9);
}

const FAST: Clock = Clock::new("fast", Period::ps(2_000));
const SLOW: Clock = Clock::new("slow", Period::ps(3_000));

block! {
    /// Counters of two clocks.
    struct Ticks;
    in TicksIn { enable: bit().on(FAST) }
    out TicksOut { fast: _, slow: _ }
}

impl Ticks {
    fn build(&self, m: Module, i: TicksIn) -> TicksOut {
        let (fast, slow) = (m.on(FAST).reg("ticks", 8).reset(0), m.on(SLOW).reg("tocks", 8).reset(0));
        fast.enable(i.enable).next(fast + 1);
        slow.next(slow + 1);
        TicksOut { fast: *fast, slow: *slow }
    }
}

#[test]
fn instants_of_all_clocks_count() {
    let mut sim = of(&Ticks);
    sim.set(sim.i.enable, 1);
    // At 2, 3, 4 and 6 ns.
    assert_eq!(sim.run_until(sim.o.slow.is(2), 100), Some(4));
    assert_eq!((sim.time(), sim.get_u64(sim.o.fast)), (6_000, 3));
    assert_eq!(sim.run_until(sim.o.fast.is(4), 100), Some(1));
    assert_eq!(sim.run_until(sim.o.fast.is(200), 10), None);
}
