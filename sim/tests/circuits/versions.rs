//! Versions of loops for frequent instructions: the results equal those of the reference engine.

use tilewright_hdl::{Module, ReadUnderWrite, Signal, bit, bits, block, case, constants, elaborate, lit, mux, row};
use tilewright_sim::{EngineKind, Passes, Simulation};

use crate::circuits::random::Random;

block! {
    /// Processors under one instruction, whose fields select what all of them do.
    struct Processors { seed: u64 }
    in ProcessorsIn { op: bits(3), source: bits(2), mask: bits(2), flags: bits(4), at: bits(3), x: bits(8) }
    out ProcessorsOut { some: bits(8), any: bit(), total: bits(8), edges: bits(16) }
}

impl Processors {
    fn build(&self, m: Module, i: ProcessorsIn) -> ProcessorsOut {
        let mut random = Random::new(self.seed);
        let lanes = row(random.one(&[100, 256, 300]));
        let width = random.one(&[8, 8, 11, 40]);
        let word = bits(width).of(lanes);
        let memory = m.memory("memory", 8, word, random.one(&[ReadUnderWrite::Old, ReadUnderWrite::Any]));
        let sum = m.reg("sum", word).reset(random.below(200));
        let carry = m.reg("carry", bit().of(lanes)).reset(0);
        let delayed = m.reg("delayed", bits(3)).reset(0);
        let numbers = constants(word, |lane| u64::from(lane * 37 % 251));
        let x = i.x.zext(width);
        // The neighbour's value is read before it changes: that register waits.
        let neighbour = if random.below(2) == 0 { sum.previous(x) } else { numbers };
        let read = memory.read_async(mux(i.flags.bit(3), *delayed, i.at));
        let operand = case(i.source, [(0, x.of(lanes)), (1, *sum), (2, neighbour)], numbers);
        let begins = i.flags.bit(2) & i.op.lt(lit(3, 4));
        let carried = mux(begins, 0, *carry).zext(width);
        let total = operand + read + carried;
        let shown = random.below(2) == 0;
        let result = case(
            i.op,
            [
                (0, total),
                (1, operand & read),
                (2, operand ^ read),
                (3, mux(*carry, operand, read)),
                (4, read - operand),
            ],
            operand,
        );
        carry.when(i.flags.bit(0), mux(i.op.bit(0), result.bit(0), total.msb()));
        let takes: Signal = case(i.mask, [(0, lit(1, 0).of(lanes)), (1, lit(1, 1).of(lanes)), (2, *carry)], !*carry);
        sum.when(takes & i.flags.bit(1), result);
        memory.write(takes & !i.flags.bit(1), i.at, result);
        delayed.next(i.at ^ i.op);
        let edges = m.reg("edges", 16).reset(0);
        edges.next(*edges + 1);
        let of = if shown { result } else { *sum };
        ProcessorsOut {
            some: sum.lane(7).trunc(8) ^ of.lane(9).trunc(8),
            any: of.bit(1).or_all(),
            total: of.trunc(8).xor_all(),
            edges: *edges,
        }
    }
}

/// Runs processors with instructions of which a few are frequent, on generated code beside the reference; returns the
/// number of versions made.
fn run(seed: u64) -> u64 {
    let design = elaborate(&Processors { seed }).unwrap();
    let mut random = Random::new(seed ^ 0x5eed);
    let (longest, versions_after) = (random.one(&[500, 40]), random.one(&[1, 2, 5]));
    let passes =
        Passes { longest, looks_after: 9, held_after: 30, versions_after, versions_from: 1, ..Passes::default() };
    let passes = Passes { guarded: true, ..passes };
    let mut sim = Simulation::with_passes(&design, &passes).unwrap().seeded(seed % 3).on(EngineKind::Both);
    let widths = [("op", 3), ("source", 2), ("mask", 2), ("flags", 4), ("at", 3), ("x", 8)];
    let ports = widths.map(|(name, width)| (sim.port(name).unwrap(), 1 << width));
    let edges = sim.port("edges").unwrap();
    let program: Vec<Vec<u64>> =
        (0..6).map(|_| ports.iter().map(|(_, limit)| random.below(*limit)).collect()).collect();
    for step in 0..60 {
        let mut numbers = program[random.below(6) as usize].clone();
        if random.below(4) == 0 {
            let field = random.below(6) as usize;
            numbers[field] = random.below(ports[field].1);
        }
        ports.iter().zip(numbers).for_each(|((port, _), number)| sim.set(*port, number));
        let done = match random.below(8) {
            0 => sim.try_run(random.below(100)).map(|_| ()),
            1 => sim.try_reset(),
            2 => sim.try_run_until(edges.is(random.below(300)), 70).map(|_| ()),
            _ => sim.try_step(),
        };
        done.unwrap_or_else(|error| panic!("{error}, at step {step} of circuit {seed}"));
    }
    sim.versions()
}

#[test]
fn what_comes_often_gets_a_version() {
    let versions: Vec<u64> = (0..10).map(run).collect();
    assert!(versions.iter().filter(|versions| **versions > 4).count() > 7, "versions are made: {versions:?}");
}

block! {
    /// A row of numbers that are mixed by an instruction in registers. The loop uses one bit of each field: the
    /// choices are small.
    struct Mixer;
    in MixerIn { first: bits(2), second: bits(2), x: bits(8) }
    out MixerOut { last: bits(8) }
}

impl Mixer {
    fn build(&self, m: Module, i: MixerIn) -> MixerOut {
        let [first, second] = [("first_now", i.first), ("second_now", i.second)].map(|(name, field)| {
            let register = m.reg(name, 2).reset(0);
            register.next(field);
            *register
        });
        let sum = m.reg("sum", bits(8).of(row(64))).reset(0);
        let number = mux(first.bit(1), *sum + i.x, *sum ^ i.x);
        let mixed = (1..6).fold(number, |all, round| (all + *sum).rotate_left(round) ^ all);
        sum.next(mux(second.bit(1), !mixed, mixed));
        MixerOut { last: sum.last() }
    }
}

#[test]
fn a_version_is_looked_up_by_what_fields_are_before_they_change() {
    for longest in [10, 500] {
        let passes = Passes { longest, versions_after: 2, versions_from: 1, ..Passes::default() };
        let mut sim = Simulation::with_passes(&elaborate(&Mixer).unwrap(), &passes).unwrap().on(EngineKind::Both);
        let ports = ["first", "second", "x"].map(|name| sim.port(name).unwrap());
        let mut random = Random::new(3);
        for step in 0..200 {
            ports.iter().zip([4, 4, 256]).for_each(|(port, limit)| sim.set(*port, random.below(limit)));
            sim.try_step().unwrap_or_else(|error| panic!("{error}, at step {step}, cut at {longest}"));
        }
        assert_eq!(sim.versions(), 16);
    }
}

#[test]
fn what_comes_seldom_gets_none() {
    let design = elaborate(&Processors { seed: 2 }).unwrap();
    let versions = |passes: Passes, edges: u64| {
        let mut sim = Simulation::with_passes(&design, &passes).unwrap().on(EngineKind::Compiled);
        for (port, number) in [("mask", 1), ("flags", 2)] {
            let port = sim.port(port).unwrap();
            sim.set(port, number);
        }
        sim.run(edges);
        sim.versions()
    };
    let often = Passes { versions_after: 20, versions_from: 1, ..Passes::default() };
    assert_eq!(versions(often.clone(), 10), 0);
    assert!(versions(often.clone(), 1000) > 0);
    assert_eq!(versions(Passes { versions_from: 1_000_000, ..often.clone() }, 1000), 0);
    assert_eq!(versions(Passes { versions_after: u32::MAX, ..often }, 1000), 0);
}
