//! Small random designs, proved and simulated exhaustively: what fails, and in which clock, is the same.

use crate::harness::proof;
use std::collections::BTreeSet;
use tilewright_hdl::*;
use tilewright_prove::Outcome;
use tilewright_sim::{EngineKind, Error, Simulation};

/// A generator of numbers (SplitMix64).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Numbers(u64);

impl Numbers {
    pub fn new(seed: u64) -> Numbers {
        Numbers(seed)
    }

    pub fn below(&mut self, limit: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % limit
    }
}

/// The assertions of a design.
const ASSERTIONS: usize = 4;

block! {
    /// Registers of random functions, of which random assertions say something.
    struct Random { seed: u64 }
    in RandomIn { x: bits(2) }
    out RandomOut { all: bits(3) }
}

impl Random {
    fn build(&self, m: Module, i: RandomIn) -> RandomOut {
        let mut numbers = Numbers(self.seed);
        let registers: Vec<Reg> = (0..3)
            .map(|index| {
                let register = m.reg(&format!("r{index}"), 3);
                match numbers.below(4) {
                    0 => register.initial(numbers.below(8)),
                    1 => register.reset(numbers.below(8)).initial(numbers.below(8)),
                    _ => register.reset(numbers.below(8)),
                }
            })
            .collect();
        let mut values: Vec<Signal> = registers.iter().map(|register| **register).collect();
        values.push(i.x.zext(3));
        for _ in 0..5 {
            let [a, b, c] = [(); 3].map(|()| values[numbers.below(values.len() as u64) as usize]);
            values.push(match numbers.below(6) {
                0 => a + b,
                1 => a & b,
                2 => a ^ b,
                3 => mux(a.lt(b), c, a),
                4 => (a * b).trunc(3),
                _ => mux(a.eq(c), b, !a),
            });
        }
        let mut any = || values[values.len() - 1 - numbers.below(5) as usize];
        for register in &registers {
            register.next(any());
        }
        for (index, name) in (0..ASSERTIONS).zip(["first", "second", "third", "fourth"]) {
            let value = any();
            m.assert(value.ne(index as u64) | i.x.eq(3), name);
        }
        RandomOut { all: values.into_iter().fold(lit(3, 0), |all, value| all ^ value) }
    }
}

/// The state and what comes with it: the registers, which the simulation takes as the start of a recording.
fn start(state: [u64; 3]) -> Recording {
    let initial = (0..3).zip(state).map(|(index, value)| recording::Initial {
        path: format!("r{index}"),
        address: 0,
        words: vec![Bits::new(3, value)],
    });
    Recording { steps: Vec::new(), initial: initial.collect() }
}

/// The first clock in which each assertion fails, of all runs in which none fails before; `None` if it never does.
fn simulated(design: &Design) -> [Option<u32>; ASSERTIONS] {
    let base = Simulation::from_design(design).unwrap().on(EngineKind::Interpreter);
    let state_of =
        |sim: &mut Simulation| [0, 1, 2].map(|index| sim.peek(&format!("r{index}")).unwrap().to_u64().unwrap());
    let mut first = [None; ASSERTIONS];
    let mut open = BTreeSet::from([state_of(&mut base.another())]);
    let mut known = open.clone();
    for clock in 0.. {
        let mut next = BTreeSet::new();
        for state in std::mem::take(&mut open) {
            for (x, reset) in (0..4u64).flat_map(|x| [(x, false), (x, true)]) {
                let mut sim = base.another().starting_as(&start(state)).unwrap();
                sim.set(sim.port("x").unwrap(), x);
                sim.set_reset("clk", reset);
                match sim.try_step() {
                    Ok(()) => drop(next.insert(state_of(&mut sim))),
                    Err(Error::Violated(violations)) => {
                        for violation in violations {
                            let names = ["first", "second", "third", "fourth"];
                            let index = names.iter().position(|name| *name == violation.message).unwrap();
                            first[index].get_or_insert(clock);
                        }
                    }
                    Err(error) => panic!("{error}"),
                }
            }
        }
        open = next.into_iter().filter(|state| known.insert(*state)).collect();
        if open.is_empty() {
            return first;
        }
    }
    first
}

#[test]
fn what_is_proved_is_what_all_runs_show() {
    let (mut proved, mut failed) = (0, 0);
    for seed in 0..24 {
        let design = elaborate(&Random { seed }).unwrap();
        let Some(found) = proof(&design, 6) else { return };
        let expected = simulated(&design);
        for statement in &found.statements {
            let names = ["first", "second", "third", "fourth"];
            let index = names.iter().position(|name| *name == statement.message).unwrap();
            match (&statement.outcome, expected[index]) {
                (Outcome::Proved { .. }, None) => proved += 1,
                (Outcome::Fails(run), Some(clock)) if run.clock == clock => failed += 1,
                (Outcome::Holds { clocks }, expected) if expected.is_none_or(|clock| clock >= *clocks) => {}
                (outcome, expected) => {
                    panic!("seed {seed}, {}: {expected:?} in all runs, {outcome:?}", statement.message)
                }
            }
        }
    }
    assert!(proved > 5 && failed > 20, "{proved} are proved, {failed} fail");
}
