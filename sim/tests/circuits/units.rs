//! Instances that run one by one and are skipped while they have nothing to do: the results equal those of the
//! reference engine.

use tilewright_hdl::{Module, ReadUnderWrite, Signal, bit, bits, block, cat, constants, elaborate, lit, mux, row};
use tilewright_sim::{EngineKind, Passes, Simulation};

use crate::circuits::random::{Again, Random, campaign};

block! {
    /// A lane of a unit.
    struct Lane { seed: u64 }
    in LaneIn { go: bit(), x: bits(8), own: bits(8) }
    out LaneOut { y: _, flag: _ }
}

impl Lane {
    fn build(&self, m: Module, i: LaneIn) -> LaneOut {
        let mut random = Random::new(self.seed);
        let policy = random.one(&[ReadUnderWrite::Old, ReadUnderWrite::Any]);
        let [sum, held] = ["sum", "held"].map(|name| m.reg(name, 8).reset(random.below(256)));
        let flag = m.reg("flag", bit()).reset(0);
        let memory = m.memory("memory", 8, 8, policy);
        let plane = m.memory("plane", 8, bit(), ReadUnderWrite::Old);
        memory.write(i.go, i.x.trunc(3), *sum);
        plane.write(i.go & lit(1, random.below(2)), i.x.trunc(3), *flag);
        let word = memory.read_async(held.trunc(3));
        let read = plane.read_async(i.x.trunc(3));
        sum.when(i.go, mux(*flag, sum + i.own, *sum ^ word));
        held.when(i.go & flag.eq(random.below(2)), i.x + word);
        flag.when(i.go, flag ^ read ^ i.own.bit(0));
        LaneOut { y: *held, flag: *flag }
    }
}

block! {
    /// A unit: it works while it is told to, and for some clocks more.
    struct Unit { seed: u64, lanes: u32 }
    in UnitIn { go: bit(), x: bits(8), left: bits(8) }
    out UnitOut { y: _, busy: _ }
}

impl Unit {
    /// A value computed from others.
    fn value(random: &mut Random, of: &[Signal]) -> Signal {
        let [a, b, c] = [(); 3].map(|()| random.one(of));
        match random.below(5) {
            0 => a + b,
            1 => a ^ b.rotate_left(3),
            2 => mux(a.lt(b), b, c),
            3 => a & !b,
            _ => cat![a.slice(0..4), b.slice(4..8)],
        }
    }

    fn build(&self, m: Module, i: UnitIn) -> UnitOut {
        let mut random = Random::new(self.seed);
        let timer = m.reg("timer", 4).reset(0);
        timer.when(i.go, 1 + random.below(15)).when(timer.ne(0), *timer - 1);
        let works = if random.below(3) == 0 { i.go } else { timer.ne(0) };
        let wide = m.reg("wide", 100).reset(0);
        let registers: Vec<_> = (0..3).map(|number| m.reg(&format!("r{number}"), 8).reset(random.below(256))).collect();
        let words = m.memory("words", 16, 8, random.one(&[ReadUnderWrite::Old, ReadUnderWrite::Any]));
        let lane = Lane { seed: random.below(1 << 40) };
        let lanes = m.array("u_lane", self.lanes, &lane, |_| LaneIn {
            go: works,
            x: *registers[0],
            own: constants(bits(8).of(row(self.lanes)), |lane| u64::from(lane * 37 % 256)),
        });
        let mut values: Vec<Signal> = registers.iter().map(|register| **register).collect();
        values.extend([i.x, i.left, lanes.y.xor_all(), lanes.y.last(), cat![lit(4, 0), *timer]]);
        values.push(words.read_async(registers[1].trunc(4)));
        values.push(words.read_when(works, registers[2].trunc(4)));
        values.push(mux(lanes.flag.xor_all(), *registers[0], i.left));
        values.push(wide.slice(90..98));
        for (register, input) in registers.iter().zip([i.x, i.left, lit(8, 3)]) {
            let (first, second) = (Unit::value(&mut random, &values), Unit::value(&mut random, &values));
            register.when(works, Unit::value(&mut random, &[first, second, values[0]]) ^ input);
        }
        words.write(works & registers[0].bit(0), registers[1].trunc(4), Unit::value(&mut random, &values));
        wide.when(works, cat![wide.slice(0..92), *registers[1]]);
        m.assert((i.go & registers[0].eq(random.below(256)) & registers[1].bit(1)).eq(0), "a number that may come");
        m.cover("it works", works);
        let y = if random.below(2) == 0 { *registers[1] } else { *registers[1] ^ i.x };
        UnitOut { y, busy: works }
    }
}

block! {
    /// A unit in which numbers pass through rows of lanes, or through memories, while no scalar register changes.
    struct Chain { lanes: u32, is_of_memories: bool }
    in ChainIn { go: bit(), x: bits(8) }
    out ChainOut { lanes: _, words: _, copy: _ }
}

impl Chain {
    fn build(&self, m: Module, i: ChainIn) -> ChainOut {
        let [shifts, writes] = [!self.is_of_memories, self.is_of_memories].map(|does| i.go & lit(1, does));
        let row = row(self.lanes);
        let start = i.x + constants(bits(8).of(row), u64::from);
        let end = (0..7).fold(start, |before, number| m.pipe_when(shifts, &format!("row{number}"), before));
        let memory = |number| m.memory(&format!("memory{number}"), 2, 8, ReadUnderWrite::Old);
        let written = (0..7).fold(i.x, |before, number| {
            let memory = memory(number);
            memory.write(writes, lit(1, 1), before);
            memory.read_async(lit(1, 1))
        });
        let [lanes, words] = [("lanes", end.xor_all()), ("words", written)].map(|(name, value)| m.pipe(name, value));
        // A word that a testbench pokes comes out, and so does a reset.
        let poked = m.memory("poked", 4, 8, ReadUnderWrite::Old);
        let copy = m.reg("copy", 8).reset(0);
        copy.next(poked.read_async(lit(2, 3)));
        poked.write(writes & i.x.eq(1), lit(2, 3), i.x);
        ChainOut { lanes, words, copy: *copy }
    }
}

block! {
    /// Units in a row.
    struct Machine { seed: u64 }
    in MachineIn { go: bits(5), x: bits(8) }
    out MachineOut { all: _, busy: _, chained: _ }
}

impl Machine {
    fn build(&self, m: Module, i: MachineIn) -> MachineOut {
        let mut random = Random::new(self.seed);
        let unit = Unit { seed: self.seed + 1, lanes: random.one(&[1, 3, 5, 16, 64, 65, 80]) };
        let ports = m.memory("ports", 4, 8, ReadUnderWrite::Old);
        let kept = m.reg("kept", 8).reset(0);
        let is_linked = random.below(2) == 0;
        let units = m.array("u_unit", 5, &unit, |units| {
            let left = m.pipe("left", units.y).previous(*kept);
            UnitIn {
                go: i.go.unpack(row(5)),
                x: i.x,
                left: if is_linked { left } else { constants(bits(8).of(row(5)), |unit| u64::from(unit * 91 % 256)) },
            }
        });
        kept.when(i.go.bit(0), units.y.last() + ports.read_async(i.x.trunc(2)));
        ports.write(units.busy.lane(2), units.y.lane(1).trunc(2), units.y.lane(3));
        let chain = Chain { lanes: random.one(&[4, 20, 64]), is_of_memories: random.below(2) == 0 };
        let chains = m.array("u_chain", 3, &chain, |_| ChainIn { go: i.go.slice(0..3).unpack(row(3)), x: i.x });
        let chained = cat![chains.lanes.pack(), chains.words.pack(), chains.copy.pack()];
        MachineOut { all: units.y.pack(), busy: units.busy.or_all(), chained }
    }
}

/// Runs a machine on generated code and on the reference engine with the same random inputs, many or few edges at a
/// time, and on both side by side. Returns the number of skipped edges of units.
fn run(seed: u64) -> u64 {
    let design = elaborate(&Machine { seed }).unwrap();
    let mut random = Random::new(seed ^ 0x5eed);
    let mut passes = Passes { apart_from: 1, apart_single: 0, guarded: true, looks_after: 5, ..Passes::default() };
    passes.held_after = random.one(&[50_000, 40]);
    passes.longest = random.one(&[500, 30]);
    let on = |kind| Simulation::with_passes(&design, &passes).unwrap().seeded(seed % 3).on(kind);
    let mut all = [EngineKind::Reference, EngineKind::Compiled, EngineKind::Both].map(on);
    let (mut go, mut again) = (0, Again::default());
    for step in 0..60 {
        go = if random.below(3) == 0 { random.below(32) } else { go * random.below(2) };
        let (x, edges, way) =
            (random.below(if step < 30 { 256 } else { 2 }), random.one(&[1, 1, 1, 3, 20, 150]), random.below(12));
        let (lane, word) = (random.below(5) as u32, random.below(256));
        again.go_on(&mut all, step, way == 11);
        let seen = all.each_mut().map(|sim| {
            let ports = [sim.port("go").unwrap(), sim.port("x").unwrap()];
            sim.set(ports[0], go);
            sim.set(ports[1], x);
            let ended = match way {
                0 => {
                    sim.poke_memory(&format!("u_unit[{lane}].words"), 3, word).unwrap();
                    sim.poke_memory("u_chain[1].poked", 3, word).unwrap();
                    sim.try_run(edges)
                }
                1 => sim.try_reset(),
                2 => {
                    let busy = sim.port("busy").unwrap();
                    sim.try_run_until(busy.is(0), edges).map(|_| ())
                }
                _ if edges == 3 => (0..12).try_for_each(|_| {
                    let _ = sim.peek("u_unit[4].timer").unwrap();
                    sim.try_step()
                }),
                _ => sim.try_run(edges),
            };
            let names = ["all", "busy", "chained", "kept", "u_unit[0].r0", "u_unit[3].wide", "u_unit[2].timer"];
            let values = names.map(|name| sim.peek(name).unwrap());
            let word = sim.peek_memory(&format!("u_unit[{lane}].words"), 3).unwrap();
            (ended.map_err(|error| error.to_string()), sim.time(), values, word)
        });
        assert_eq!(seen[1], seen[0], "step {step} of machine {seed}");
        assert_eq!(seen[2], seen[0], "step {step} of machine {seed}, side by side");
        if seen[0].0.is_err() {
            break;
        }
    }
    all[1].left_out()
}

#[test]
fn random_machines_run_as_on_the_reference_engine() {
    let left_out: Vec<u64> = (0..6).map(run).collect();
    let many = left_out.iter().filter(|edges| **edges > 1000).count();
    assert!(many > 2, "units that have nothing to do are left out: {left_out:?}");
}

/// Run by hand, for a long time: docs/decisions/engine.md has the command.
#[test]
#[ignore = "tries as many machines as UNITS_MACHINES says, from UNITS_SEED on"]
fn random_machines_from_a_seed_run_as_on_the_reference_engine() {
    campaign("UNITS", run);
}
