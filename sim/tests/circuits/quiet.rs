//! Loops that are split, and skipped if nothing would change: the results equal those of the reference engine.

use tilewright_hdl::{
    Module, ReadUnderWrite, Signal, bit, bits, block, case, constants, elaborate, lit, mux, row, select,
};
use tilewright_sim::{EngineKind, Pass, Passes, Simulation};

use crate::circuits::random::Random;
use crate::text_after;

block! {
    /// Rows of registers and of memories, changed by an operation that all lanes share.
    struct Rows { seed: u64 }
    in RowsIn { op: bits(3), go: bits(3), x: bits(8) }
    out RowsOut { some: bits(8), flags: bit() }
}

impl Rows {
    fn build(&self, m: Module, i: RowsIn) -> RowsOut {
        let mut random = Random::new(self.seed);
        let lanes = random.one(&[300, 512, 1024]);
        let numbers = constants(bits(8).of(row(lanes)), |lane| u64::from(lane * 37 % 256));
        let registers: Vec<_> = (0..4)
            .map(|number| m.reg(&format!("r{number}"), bits(8).of(row(lanes))).reset(random.below(256)))
            .collect();
        let flag = m.reg("flag", bit().of(row(lanes))).reset(0);
        let policy = random.one(&[ReadUnderWrite::Old, ReadUnderWrite::Any]);
        let memory = m.memory("memory", 4, bits(8).of(row(lanes)), policy).true_dual_port();
        let word = memory.read_async(i.x.trunc(2));
        let mut values: Vec<Signal> = registers.iter().map(|register| **register).collect();
        values.push(numbers);
        values.push(if random.below(2) == 0 { word } else { registers[0].previous(i.x) });
        for register in &registers {
            let next = Rows::next(&mut random, i, **register, *flag, &values);
            if random.below(2) == 0 {
                register.next(next);
            } else {
                register.when(i.go.bit(random.below(3) as u32), next);
            }
        }
        flag.when(i.go.bit(0), values[random.below(4) as usize].bit(2));
        for port in 0..2 {
            let enable = i.go.bit(port) & values[random.below(4) as usize].bit(1);
            memory.write(enable, i.x.part(2, 2), random.one(&values));
        }
        RowsOut { some: registers[1].lane(7) ^ registers[3].lane(9), flags: flag.lane(1) }
    }

    /// A value computed from others.
    fn value(random: &mut Random, of: &[Signal]) -> Signal {
        let [a, b, c] = [(); 3].map(|()| random.one(of));
        match random.below(4) {
            0 => a + b,
            1 => a ^ b.rotate_left(3),
            2 => mux(a.lt(b), b, c),
            _ => (a & !b) + c,
        }
    }

    /// The next value of a register: often the old one.
    fn next(random: &mut Random, i: RowsIn, stays: Signal, flag: Signal, values: &[Signal]) -> Signal {
        let [first, second] = [(); 2].map(|()| random.one(values));
        let value = Rows::value(random, values);
        let bit = random.below(3) as u32;
        match random.below(5) {
            0 => case(i.op, [(2, first), (3, second), (5, value)], stays),
            1 => case(i.op, [(0, stays), (1, stays), (4, mux(flag, stays, first))], value),
            2 => mux(i.go.bit(bit), value, stays),
            3 => select([(i.go.bit(bit), first), (i.op.eq(lit(3, 6)), stays), (flag, second)], stays),
            _ => select([(i.op.lt(lit(3, 4)) & !i.go.bit(bit), stays), (i.op.bit(1), value)], mux(flag, stays, first)),
        }
    }
}

/// Runs such a circuit on both engines, side by side; returns the largest number of loops into which its loop was
/// split.
fn run(seed: u64) -> usize {
    let design = elaborate(&Rows { seed }).unwrap();
    let mut random = Random::new(seed ^ 0x5eed);
    let (longest, versions_after) = (random.one(&[500, 30]), random.one(&[1, 3, 32]));
    let passes = Passes { longest, looks_after: 5, versions_after, versions_from: 100, ..Passes::default() };
    let mut sim = Simulation::with_passes(&design, &passes).unwrap().seeded(seed % 3).on(EngineKind::Both);
    let ports = ["op", "go", "x"].map(|name| sim.port(name).unwrap());
    for step in 0..60 {
        let go = random.below(8) * random.below(2);
        for (port, number) in ports.into_iter().zip([random.below(8), go, random.below(256)]) {
            sim.set(port, number);
        }
        let edges = random.one(&[1, 1, 2, 9]);
        sim.try_run(edges).unwrap_or_else(|error| panic!("{error}, at step {step} of circuit {seed}"));
    }
    let branched = text_after(&design, Pass::Branch, &passes);
    let parts = branched.lines().filter_map(|line| line.split_once(": in ")?.1.strip_suffix(" loops")?.parse().ok());
    parts.max().unwrap_or(0)
}

#[test]
fn loops_in_which_nothing_would_change_are_left_out() {
    let parts: Vec<usize> = (0..60).map(run).collect();
    assert!(parts.iter().filter(|parts| **parts > 1).count() > 20, "loops are parted: {parts:?}");
}

block! {
    /// Two writes to the same words, and a sum of a register's occasional next value.
    struct Apart;
    in ApartIn { writes: bits(2), at: bits(2), adds: bit(), x: bits(8) }
    out ApartOut { word: bits(8), total: bits(8) }
}

impl Apart {
    fn build(&self, m: Module, i: ApartIn) -> ApartOut {
        let lanes = row(512);
        let numbers = constants(bits(8).of(lanes), |lane| u64::from(lane % 251));
        let memory = m.memory("memory", 4, bits(8).of(lanes), ReadUnderWrite::Any).true_dual_port();
        let kept = m.reg("kept", bits(8).of(lanes)).reset(1);
        let sum = *kept + numbers;
        memory.write(i.writes.bit(0).of(lanes), i.at, sum);
        memory.write(i.writes.bit(1).of(lanes), i.at, numbers ^ i.x);
        kept.when(i.adds, sum);
        let total = m.pipe("total_before", (sum ^ i.x).sum().trunc(8));
        ApartOut { word: memory.read_async(i.at).lane(100), total }
    }
}

/// The later write wins, and the sum is correct in each clock, although parts of the loop are skipped.
#[test]
fn parts_keep_their_order_and_what_others_take_of_them() {
    let design = elaborate(&Apart).unwrap();
    let branched = text_after(&design, Pass::Branch, &Passes::default());
    assert!(branched.contains(": in 2 loops"), "the loop is parted:\n{branched}");
    let (mut random, mut sim) = (Random::new(3), Simulation::of(&Apart).unwrap().on(EngineKind::Both));
    for _ in 0..100 {
        for (port, limit) in [(sim.i.writes, 4), (sim.i.at, 4), (sim.i.adds, 2), (sim.i.x, 256)] {
            sim.set(port, random.below(limit));
        }
        sim.try_step().unwrap_or_else(|error| panic!("{error}"));
        sim.get(sim.o.word);
    }
}

block! {
    /// A chain of registers of eight numbers, each with a flag that says whether it is full.
    struct Chain { seed: u64 }
    in ChainIn { valid: bit(), ready: bit(), x: bits(16) }
    out ChainOut { y: bits(16), full: bit() }
}

impl Chain {
    fn build(&self, m: Module, i: ChainIn) -> ChainOut {
        let mut random = Random::new(self.seed);
        let links = 3 + random.below(4) as usize;
        let fulls: Vec<_> = (0..links).map(|link| m.reg(&format!("full{link}"), bit()).reset(0)).collect();
        let words: Vec<_> = (0..links).map(|link| m.reg(&format!("word{link}"), bits(16).of(row(8)))).collect();
        for link in 0..links {
            let (comes, value) = match link.checked_sub(1) {
                None => (i.valid, i.x.of(row(8)) + constants(bits(16).of(row(8)), |lane| u64::from(lane) * 777)),
                Some(before) => (*fulls[before], *words[before] + random.below(999)),
            };
            let leaves = fulls.get(link + 1).map_or(i.ready, |next| !**next);
            let takes = comes & !*fulls[link];
            fulls[link].next(mux(takes, 1, *fulls[link] & !leaves));
            match random.below(3) {
                0 => drop(words[link].when(takes, value)),
                1 => words[link].next(mux(takes, value, mux(leaves & i.valid, *words[link] ^ 5, *words[link]))),
                _ => words[link].next(select([(takes, value)], *words[link])),
            }
        }
        ChainOut { y: words[links - 1].xor_all(), full: *fulls[links - 1] }
    }
}

block! {
    /// Some such chains, each with flags of its own.
    struct Chains { seed: u64 }
    in ChainsIn { valid: bits(16), ready: bits(16), x: bits(16) }
    out ChainsOut { y: bits(16), full: bit() }
}

impl Chains {
    fn build(&self, m: Module, i: ChainsIn) -> ChainsOut {
        let lanes = row(16);
        let chains = m.array("u_chain", lanes, &Chain { seed: self.seed }, |_| ChainIn {
            valid: i.valid.unpack(lanes),
            ready: i.ready.unpack(lanes),
            x: i.x.of(lanes),
        });
        ChainsOut { y: chains.y.xor_all(), full: chains.full.or_all() }
    }
}

/// Most of the words of a chain wait, and which of them move is another flag in each lane.
#[test]
fn loops_rest_while_no_lane_has_a_flag() {
    let mut rest = 0;
    for seed in 0..24 {
        let design = elaborate(&Chains { seed }).unwrap();
        let mut random = Random::new(seed);
        let passes = Passes { looks_after: random.one(&[3, u64::MAX]), ..Passes::default() };
        let branched = text_after(&design, Pass::Branch, &passes);
        rest += usize::from(branched.contains("= or of 16 lanes of") && branched.contains("1: nothing"));
        let mut sim = Simulation::with_passes(&design, &passes).unwrap().seeded(seed).on(EngineKind::Both);
        let ports = ["valid", "ready", "x"].map(|name| sim.port(name).unwrap());
        let y = sim.port("y").unwrap();
        for step in 0..80 {
            let busy = if step % 20 < 9 { 0 } else { 1 << 16 };
            let numbers =
                [random.below(busy + 1) & random.below(busy + 1), random.below(busy + 1), random.below(1 << 16)];
            ports.into_iter().zip(numbers).for_each(|(port, number)| sim.set(port, number & 0xffff));
            sim.try_run(random.one(&[1, 1, 3])).unwrap_or_else(|error| panic!("{error}, at step {step} of {seed}"));
            sim.get(y);
        }
    }
    assert!(rest > 16, "loops rest in {rest} circuits");
}
