//! Operations with so many operands that their code is made in pieces.

use tilewright_hdl::{Module, Signal, bits, block, case, concat, elaborate, lit, mux, select};
use tilewright_sim::{EngineKind, Passes, Simulation, Target};

use crate::circuits::random::Random;

/// More operands than any step has, and more than the limit for finding pieces of a few values.
const OPERANDS: u32 = 1500;

block! {
    /// One of each.
    struct Many;
    in ManyIn { x: bits(11), y: bits(90) }
    out ManyOut {
        cases: bits(13),
        found: bits(13),
        chosen: bits(70),
        taken: bits(13),
        turned: bits(OPERANDS),
        parts: bits(3 * OPERANDS),
        flags: bits(OPERANDS)
    }
}

impl Many {
    fn build(&self, m: Module, i: ManyIn) -> ManyOut {
        let (numbers, y) = (|| 0..OPERANDS, i.y.trunc(13));
        let value = |k: u32| y ^ u64::from(k * 5 % 8192);
        let flag = |k: u32| i.x.eq(u64::from(k));
        let all = |parts: &dyn Fn(u32) -> Signal| concat(&numbers().map(parts).collect::<Vec<_>>());
        let cases = case(i.x, numbers().map(|k| (k, value(k))), y);
        let table = case(i.x, numbers().map(|k| (k, lit(13, k * 77 % 8192))), lit(13, 5));
        let chosen = select(numbers().map(|k| (flag(k), value(k).zext(70) - u64::from(k))), i.y.trunc(70));
        let taken = m.reg("taken_by", 13).reset(0);
        let first = taken.when(flag(0), 7);
        let _ = (1..OPERANDS).fold(first, |all, k| all.when(flag(k), value(k)));
        let shuffled = m.reg("shuffled", OPERANDS).reset(0);
        shuffled.next(all(&|k| shuffled.bit(k * 7 % OPERANDS)) ^ i.y.zext(OPERANDS));
        let few = |k: u32| if k.is_multiple_of(3) { shuffled.part(k / 2, 3) } else { i.y.part(k % 80, 3) };
        ManyOut {
            cases: m.pipe("cases_before", cases),
            found: m.pipe("found_before", table),
            chosen: m.pipe("chosen_before", chosen),
            taken: *taken,
            turned: *shuffled,
            parts: m.pipe("parts_before", all(&few)),
            flags: m.pipe("flags_before", all(&|k| mux(i.y.bit(k % 90), flag(k), i.x.bit(k % 11)))),
        }
    }
}

#[test]
fn operations_of_many_operands_run_as_on_the_reference_engine() {
    let design = elaborate(&Many).unwrap();
    for passes in [
        Passes::default(),
        Passes { target: Target::Functions, ..Passes::default() },
        Passes { lookups: false, fields: false, longest: 20, ..Passes::default() },
    ] {
        let mut sim = Simulation::with_passes(&design, &passes).unwrap().on(EngineKind::Both);
        let (x, y) = (sim.port("x").unwrap(), sim.port("y").unwrap());
        let mut random = Random::new(3);
        for step in 0..6 {
            sim.set(x, if step == 2 { 0 } else { random.below(2048) });
            sim.set(y, u128::from(random.below(u64::MAX)) << 20 | u128::from(random.below(1 << 20)));
            sim.try_step().unwrap_or_else(|error| panic!("{error} with {passes:?}"));
        }
    }
}
