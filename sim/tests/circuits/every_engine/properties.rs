//! Assumptions, covers, past values, and values at power-on.

use tilewright_hdl::*;
use tilewright_sim::{Batch, EngineKind, Error, Simulation};

const ENGINES: [EngineKind; 4] =
    [EngineKind::Reference, EngineKind::Interpreter, EngineKind::Compiled, EngineKind::Both];

block! {
    /// Reads its inputs, plain and in lanes.
    pub struct Looker;
    in LookerIn {
        /// A number.
        x: bits(8),
        /// Flags in lanes.
        flags: bit().of(row(3)),
    }
    out LookerOut {
        /// The number, two clocks later.
        late: bits(8),
    }
}

impl Looker {
    fn build(&self, m: Module, i: LookerIn) -> LookerOut {
        m.assume(i.x.ne(99), "nobody says 99");
        m.assert(i.x.ge(m.past(i.x)) | i.x.eq(0), "it grows, or starts again");
        m.cover("three", i.x.eq(3));
        m.cover("a flag rises", m.rose(i.flags));
        m.cover("it grew by two edges", i.x.gt(m.past(m.past(i.x))));
        m.cover("it stays", m.stable(i.x));
        m.cover("it falls", m.fell(i.x.bit(0)));
        LookerOut { late: m.pipe("late", m.pipe("early", i.x)) }
    }
}

block! {
    /// Two lookers.
    pub struct Lookers;
    in LookersIn {
        /// Numbers.
        x: bits(8).of(row(2)),
        /// Flags.
        flags: bit().of(row(3)),
    }
    out LookersOut {
        /// The sum.
        late: bits(8),
    }
}

impl Lookers {
    fn build(&self, m: Module, i: LookersIn) -> LookersOut {
        let flags = i.flags;
        let all = m.array("u_looker", 2, &Looker, |_| LookerIn { x: i.x, flags: flags.to_rows(2) });
        LookersOut { late: all.late.sum() }
    }
}

/// The covers hit by these numbers, on every engine.
fn covered(x: &[u64], flags: &[u64], seed: u64) -> Vec<u64> {
    let [first, others @ ..] = ENGINES.map(|kind| {
        let mut sim = Simulation::of(&Looker).unwrap().on(kind).seeded(seed);
        for (x, flags) in x.iter().zip(flags.iter().cycle()) {
            sim.set(sim.i.x, *x);
            sim.set(sim.i.flags, *flags);
            sim.step();
        }
        assert_eq!(sim.engine(), kind);
        sim.covers().into_iter().map(|cover| cover.count).collect::<Vec<_>>()
    });
    others.into_iter().for_each(|other| assert_eq!(other, first));
    first
}

#[test]
fn covers_are_counted_in_all_lanes_and_wait_for_the_past() {
    // The seed gives the registers of past values a past that never happened.
    for seed in [0, 1, 2, 3] {
        //                       three, flag, two edges, stays, falls
        assert_eq!(covered(&[3], &[7], seed), [1, 0, 0, 0, 0]);
        assert_eq!(covered(&[3, 3], &[0, 7], seed), [2, 3, 0, 1, 0]);
        assert_eq!(covered(&[3, 3, 4, 4, 3 + 2], &[0, 7, 6, 1, 1], seed), [2, 4, 3, 2, 1]);
    }
}

#[test]
fn what_happens_while_the_reset_is_high_is_not_covered() {
    for kind in ENGINES {
        let mut sim = Simulation::of(&Looker).unwrap().on(kind);
        sim.set(sim.i.x, 3);
        sim.run(2);
        for _ in 0..2 {
            sim.reset();
        }
        assert_eq!(sim.covered("three").unwrap(), 2);
        assert_eq!(sim.covered("it stays").unwrap(), 1);
        sim.run(2);
        assert_eq!(sim.covered("three").unwrap(), 4, "a reset does not forget");
        assert_eq!(sim.covered("it stays").unwrap(), 2, "the first edge after a reset has no past");
        assert_eq!(sim.uncovered(), ["a flag rises", "it grew by two edges", "it falls"]);
    }
}

#[test]
fn an_assertion_waits_for_the_past_at_power_on_and_after_a_reset() {
    for (kind, seed) in ENGINES.into_iter().zip(1..) {
        let mut sim = Simulation::of(&Looker).unwrap().on(kind).seeded(seed);
        sim.set(sim.i.x, 1);
        sim.step();
        sim.set(sim.i.x, 9);
        sim.step();
        sim.reset();
        sim.set(sim.i.x, 5);
        sim.step();
        sim.set(sim.i.x, 4);
        let Err(Error::Violated(violations)) = sim.try_step() else { panic!("4 after 5 does not grow") };
        assert!(violations[0].to_string().starts_with("assertion failed in `looker` in cycle 4"), "{}", violations[0]);
        assert!(!violations[0].is_assumption);
    }
}

#[test]
fn an_assumption_that_fails_blames_the_stimulus() {
    for kind in ENGINES {
        let mut sim = Simulation::of(&Looker).unwrap().on(kind);
        sim.set(sim.i.x, 99);
        let Err(Error::Violated(violations)) = sim.try_step() else { panic!("it is assumed that nobody says 99") };
        let text = violations[0].to_string();
        let expected =
            "the stimulus breaks an assumption of `looker` in cycle 0 of `clk`, at 10000 ps: nobody says 99\n  --> ";
        assert!(text.starts_with(expected) && violations[0].is_assumption, "{text}");
        assert_eq!(sim.time(), 0, "the edge does not happen");
    }
}

#[test]
fn covers_have_paths_and_runs() {
    let mut sim = Simulation::of(&Lookers).unwrap();
    sim.set_lanes(sim.i.x, [3, 4]);
    sim.run(5);
    assert_eq!(sim.covered("u_looker[0].three").unwrap(), 5);
    assert_eq!(sim.covered("u_looker[1].three").unwrap(), 0);
    let error = sim.covered("u_looker[1].tree").unwrap_err().to_string();
    assert_eq!(error, "there is no cover `u_looker[1].tree`: did you mean `u_looker[1].three`?");
    let mut batch = Batch::of(&Looker, 4).unwrap();
    batch.set_each(batch.i.x, |run| run + 1);
    batch.run(3);
    assert_eq!([0, 1, 2, 3].map(|run| batch.covered("three", run).unwrap()), [0, 0, 3, 0]);
}

block! {
    /// Counts down from a value at power-on.
    pub struct PowerOn;
    in PowerOnIn {
        /// Nothing.
        again: bit(),
    }
    out PowerOnOut {
        /// The remaining count.
        left: bits(4),
        /// The same in lanes, each with a larger start.
        lanes: bits(4).of(row(2)),
    }
}

impl PowerOn {
    fn build(&self, m: Module, i: PowerOnIn) -> PowerOnOut {
        let left = m.reg("left", 4).initial(9).reset(2);
        left.when(i.again, 15).otherwise(left - 1);
        let lanes = m.reg("lanes", bits(4).of(row(2))).initial(5);
        lanes.next(lanes + 1);
        PowerOnOut { left: *left, lanes: *lanes }
    }
}

#[test]
fn a_register_begins_with_its_initial_value_whatever_the_seed() {
    for (kind, seed) in ENGINES.into_iter().flat_map(|kind| [(kind, 0), (kind, 7)]) {
        let mut sim = Simulation::of(&PowerOn).unwrap().on(kind).seeded(seed);
        assert_eq!((sim.get_u64(sim.o.left), sim.lanes(sim.o.lanes)), (9, vec![5, 5]));
        sim.step();
        assert_eq!((sim.get_u64(sim.o.left), sim.lanes(sim.o.lanes)), (8, vec![6, 6]));
        sim.reset();
        assert_eq!((sim.get_u64(sim.o.left), sim.lanes(sim.o.lanes)), (2, vec![7, 7]), "a reset gives its own");
    }
}
