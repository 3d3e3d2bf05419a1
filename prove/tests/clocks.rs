//! Designs of several clocks: what is found agrees with the simulator.

use crate::agreement::Numbers;
use crate::harness::{design, proof, words};
use std::collections::BTreeMap;
use tilewright_hdl::*;
use tilewright_prove::Outcome;
use tilewright_sim::{EngineKind, Error, Simulation};

const FAST: Clock = Clock::new("fast", Period::ns(4));
const SLOW: Clock = Clock::new("slow", Period::ns(6));

block! {
    /// A count on each clock; the edges come at 4, 6, 8, 12 (both), 16, 18, 20, 24 (both) ns.
    struct Counts { fast: Clock, slow: Clock }
    in(self) CountsIn { stop: bit().on(self.fast) }
    out CountsOut { all: bits(4) }
}

impl Counts {
    fn build(&self, m: Module, i: CountsIn) -> CountsOut {
        let (fast, slow) = (m.on(self.fast), m.on(self.slow));
        def!(quick = fast.reg(4).reset(0));
        quick.when(!i.stop & quick.ne(9), quick + 1);
        def!(late = slow.reg(4).reset(0));
        late.when(late.ne(9), late + 1);
        fast.assert(quick.le(9), "the fast one counts to 9");
        slow.assert(late.ne(3), "the slow one never has 3");
        fast.assert(quick.ne(4), "the fast one never has 4");
        fast.cover("the fast one has 10", quick.eq(10));
        slow.cover("the slow one has 2", late.eq(2));
        m.ignore(&*late);
        CountsOut { all: *quick }
    }
}

#[test]
fn assertions_count_at_the_edges_of_their_clock() {
    let Some(found) = proof(&design(&Counts { fast: FAST, slow: SLOW }), 12) else { return };
    let expected = [
        ("the fast one counts to 9", "proved over 1"),
        // It has 3 from 18 ns on, and is asked at 24 ns; the other one has 4 from 16 ns on, and is asked at 20 ns.
        ("the slow one never has 3", "happens in 7"),
        ("the fast one never has 4", "happens in 6"),
        ("the fast one has 10", "proved over 1"),
        ("the slow one has 2", "happens in 5"),
    ];
    assert_eq!(words(&found), expected.map(|(message, word)| (message, word.to_owned())));
}

const NAMES: [&str; 4] = ["first", "second", "third", "fourth"];
/// The instants that are searched.
const INSTANTS: u32 = 7;

block! {
    /// Registers on two clocks that look at each other, of which random assertions say something.
    struct Random { seed: u64, fast: Clock, slow: Clock }
    in(self) RandomIn { x: bits(1).on(self.fast) }
    out RandomOut { all: bits(2) }
}

impl Random {
    fn build(&self, m: Module, i: RandomIn) -> RandomOut {
        let mut numbers = Numbers::new(self.seed);
        let (fast, slow) = (m.on(self.fast), m.on(self.slow));
        let registers = [fast.reg("r0", 2).reset(numbers.below(4)), slow.reg("r1", 2).reset(numbers.below(4))];
        // What crosses may have any value: these clocks are exact.
        let seen = |register: &Reg| register.quasi_static("the edges are exact");
        let mut values = vec![seen(&registers[0]), seen(&registers[1]), i.x.quasi_static("it is exact, too").zext(2)];
        for _ in 0..3 {
            let [a, b, c] = [(); 3].map(|()| values[numbers.below(values.len() as u64) as usize]);
            values.push(match numbers.below(4) {
                0 => a + b,
                1 => a ^ b,
                2 => mux(a.lt(b), c, !a),
                _ => mux(a.eq(c), b, a + 1),
            });
        }
        let mut any = || values[values.len() - 1 - numbers.below(4) as usize];
        for register in &registers {
            register.next(any());
        }
        for (index, name) in NAMES.into_iter().enumerate() {
            let clock = if index % 2 == 0 { fast } else { slow };
            clock.assert(any().ne(index as u64) | seen(&registers[index / 2]).eq(3), name);
        }
        RandomOut { all: values.into_iter().fold(lit(2, 0), |all, value| all ^ value) }
    }
}

/// The registers, whether the reset is active, and which clocks have had an edge since.
type State = (Vec<u64>, bool, [bool; 2]);
/// The input and the reset at each instant.
type Stimulus = Vec<(u64, bool)>;

/// The first instant at which each assertion fails, of all runs in which none fails before.
fn simulated(design: &Design) -> [Option<u32>; 4] {
    let base = Simulation::from_design(design).unwrap().on(EngineKind::Interpreter);
    let mut first = [None; 4];
    // A run to each state.
    let mut runs: BTreeMap<State, Stimulus> = BTreeMap::new();
    runs.insert((vec![], false, [true; 2]), vec![]);
    for instant in 0..INSTANTS {
        let mut next = BTreeMap::new();
        for ((_, was_reset, seen), run) in std::mem::take(&mut runs) {
            for (x, reset) in [(0, false), (1, false), (0, true), (1, true)] {
                if was_reset && !reset && seen != [true; 2] {
                    continue;
                }
                let mut run = run.clone();
                run.push((x, reset));
                let mut sim = base.another();
                let cycles = |sim: &Simulation| ["fast", "slow"].map(|clock| sim.cycles(clock).unwrap());
                let (mut before, mut ended) = (cycles(&sim), Ok(()));
                for &(x, reset) in &run {
                    before = cycles(&sim);
                    sim.set(sim.port("x").unwrap(), x);
                    ["fast", "slow"].into_iter().for_each(|clock| sim.set_reset(clock, reset));
                    ended = sim.try_step();
                }
                match ended {
                    Ok(()) => {
                        let after = cycles(&sim);
                        let edge = |clock: usize| after[clock] > before[clock];
                        let seen = [0, 1].map(|clock| !reset || was_reset && seen[clock] || edge(clock));
                        let state = ["r0", "r1"].map(|name| sim.peek(name).unwrap().to_u64().unwrap());
                        next.insert((state.to_vec(), reset, seen), run);
                    }
                    Err(Error::Violated(violations)) => {
                        for violation in violations {
                            let index = NAMES.iter().position(|name| *name == violation.message).unwrap();
                            first[index].get_or_insert(instant);
                        }
                    }
                    Err(error) => panic!("{error}"),
                }
            }
        }
        runs = next;
    }
    first
}

#[test]
fn what_is_found_is_what_all_runs_show() {
    let (mut proved, mut failed) = (0, 0);
    let resets = [Reset::Synchronous, Reset::AsynchronousLow, Reset::SynchronousLow, Reset::Asynchronous];
    for seed in 0..8 {
        let kind = |index: u64| resets[(index % 4) as usize];
        let (fast, slow) = (FAST.reset(kind(seed)), SLOW.reset(kind(seed / 4)));
        let design = elaborate(&Random { seed, fast, slow }).unwrap();
        let Some(found) = proof(&design, INSTANTS) else { return };
        let expected = simulated(&design);
        for statement in &found.statements {
            let index = NAMES.iter().position(|name| *name == statement.message).unwrap();
            match (&statement.outcome, expected[index]) {
                (Outcome::Proved { .. }, None) => proved += 1,
                (Outcome::Fails(run), Some(clock)) if run.clock == clock => failed += 1,
                (Outcome::Holds { .. }, None) => {}
                (outcome, expected) => {
                    panic!("seed {seed}, {}: {expected:?} in all runs, {outcome:?}", statement.message)
                }
            }
        }
    }
    assert!(proved > 2 && failed > 10, "{proved} are proved, {failed} fail");
}
