//! A run that begins on the interpreter and goes on in machine code is the same run, wherever the code begins.

use crate::circuits::random::Random;
use tilewright_hdl::{Bits, DEFAULT_PERIOD, DefaultClock, Module, ReadUnderWrite, Reset, bit, bits, block};
use tilewright_sim::{EngineKind, Simulation};

block! {
    /// A sum with a reset, a memory at whose address it is, and a wide register without a reset.
    struct Machine;
    in In { add: bits(4), word: bits(16), write: bit() }
    out Out { sum: _, read: _, wide: _ }
}

impl Machine {
    fn build(&self, m: Module, i: In) -> Out {
        let sum = m.reg("sum", 4).reset(3);
        sum.next(sum + i.add);
        let words = m.memory("words", 16, 16, ReadUnderWrite::Old);
        words.write(i.write, *sum, i.word);
        let wide = m.reg("wide", 200);
        wide.next(wide + (i.word.zext(183) * 0x1_0001).zext(200));
        Out { sum: *sum, read: words.read(*sum), wide: *wide }
    }
}

fn machine() -> Simulation<In, Out> {
    let clock = DefaultClock::new(DEFAULT_PERIOD).reset(Reset::Asynchronous);
    Simulation::at(&Machine, clock).unwrap().seeded(5)
}

/// The outputs and a word after each of 40 steps with random inputs and resets.
fn outputs(mut sim: Simulation<In, Out>) -> Vec<(Out<Bits>, Bits)> {
    let mut random = Random::new(9);
    let words = sim.memory("words").unwrap();
    let mut step = |number: u32| {
        sim.drive(In { add: random.below(16), word: random.below(1 << 16), write: random.below(2) });
        sim.set_reset("clk", matches!(number % 16, 5..=7));
        if number % 11 == 3 {
            sim.poke_memory("words", number % 16, 0xabc).unwrap();
        }
        sim.step();
        (sim.read(), sim.word(words, number % 16))
    };
    (0..40).map(&mut step).collect()
}

#[test]
fn a_run_is_the_same_wherever_code_begins() {
    let expected = outputs(machine().on(EngineKind::Reference));
    for edges in 0..40 {
        let found = outputs(machine().code_after(edges));
        assert_eq!(found, expected, "code begins after {edges} edges");
    }
}

#[test]
fn a_run_until_a_condition_goes_on_in_code() {
    let time = |mut sim: Simulation<In, Out>, limit| {
        sim.set(sim.i.add, 1);
        let instants = sim.run_until(sim.o.sum.is(1), limit);
        (instants, sim.time(), sim.get_u64(sim.o.sum))
    };
    let expected = time(machine().on(EngineKind::Reference), 100);
    assert_eq!(expected.0, Some(14));
    for edges in 0..20 {
        assert_eq!(time(machine().code_after(edges), 100), expected, "code begins after {edges} edges");
        let short = time(machine().code_after(edges), 9);
        assert_eq!(short, time(machine().on(EngineKind::Reference), 9), "code begins after {edges} edges");
    }
}
