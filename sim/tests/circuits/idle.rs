//! Clocks that have nothing to do while others run: the results equal those of the reference engine, and edges are
//! skipped.

use tilewright_hdl::{Clock, Module, Period, ReadUnderWrite, Signal, bit, bits, block, cat, elaborate, mux};
use tilewright_sim::{EngineKind, Passes, Simulation, Target};

use crate::circuits::random::{Again, Random, campaign};

const FAST: Clock = Clock::new("fast", Period::ps(2_000));
const SLOW: Clock = Clock::new("slow", Period::ps(3_700));
const LATE: Clock = Clock::new("late", Period::ps(5_300));

block! {
    /// Works for some clocks when it is told to, on its own clock or by another one. It counts the clocks since then,
    /// up to a limit.
    struct Worker { seed: u64 }
    in WorkerIn { go: bit().on(FAST), x: bits(8).on(FAST), tick: bit().on(SLOW), word: bits(8).on(SLOW) }
    out WorkerOut { value: _, works: _, since: _ }
}

impl Worker {
    /// A value computed from others.
    fn value(random: &mut Random, of: &[Signal]) -> Signal {
        let [a, b, c] = [(); 3].map(|()| random.one(of));
        match random.below(4) {
            0 => a + b,
            1 => a ^ b.rotate_left(3),
            2 => mux(a.lt(b), b, c),
            _ => cat![a.slice(0..4), b.slice(4..8)],
        }
    }

    fn build(&self, m: Module, i: WorkerIn) -> WorkerOut {
        let mut random = Random::new(self.seed);
        let (fast, slow) = (m.on(FAST), m.on(SLOW));
        let heard = fast.synchronize("heard", i.tick);
        let starts = i.go | (heard ^ fast.pipe("heard_before", heard));
        let limit = 60 + random.below(440);

        let since = fast.reg("since", 9).reset(0);
        let has_passed = since.ge(limit);
        since.when(starts, 0).when(!has_passed, since + 1);
        let timer = fast.reg("timer", 4).reset(0);
        timer.when(starts, 1 + random.below(15)).when(timer.ne(0), *timer - 1);
        let works = timer.ne(0);

        // Logic that sees more of a counter than whether it has reached its limit.
        let kept = fast.reg("kept", 9).reset(0);
        kept.when(works, *since);
        let rung = fast.reg("rung", 8).reset(0);
        let had_passed = fast.pipe("had_passed", has_passed);
        rung.when(has_passed & !had_passed, rung + 1 + kept.trunc(8));
        let _ = fast.pipe("upper", since.slice(5..9));
        let beats = fast.reg("beats", 6).reset(0);
        beats.when(has_passed & i.x.bit(0), beats + 1);
        let paces = fast.reg("paces", 6).reset(0);
        paces.when(i.tick.quasi_static("both engines sample it alike"), paces + 1);

        let policy = random.one(&[ReadUnderWrite::Old, ReadUnderWrite::Any]);
        let own = m.memory("own", 16, 8, policy);
        let shared = m.memory("shared", 8, 8, policy);
        let turn = slow.reg("turn", 3).reset(0);
        turn.next(turn + 1);
        shared.on(SLOW).write(i.tick, *turn, i.word);
        let taken = match random.below(4) {
            0 => shared.on(FAST).read(since.trunc(3)),
            1 => shared.on(FAST).read_when(has_passed, since.trunc(3)),
            _ => shared.on(FAST).read_when(works, since.trunc(3)),
        };
        let registers: Vec<_> = (0..3).map(|it| fast.reg(&format!("r{it}"), 8).reset(random.below(256))).collect();
        let mut values: Vec<Signal> = registers.iter().map(|register| **register).collect();
        values.extend([i.x, *rung, kept.trunc(8), taken, own.on(FAST).read_async(registers[0].trunc(4))]);
        values.push(own.on(FAST).read_when(works, since.trunc(4)));
        let word = own.on(FAST).read_async(registers[0].trunc(4));
        let _ = fast.pipe("echo", word);
        let heard_last = if random.below(2) == 0 { own.on(FAST).read(since.slice(3..7)) } else { word };
        if random.below(4) == 0 {
            let word = shared.on(FAST).read_async(kept.trunc(3)).quasi_static("both engines sample it alike");
            let _ = fast.pipe("overheard", word);
        }
        for register in &registers {
            let next = Worker::value(&mut random, &values);
            values.push(next);
            register.when(works, next);
        }
        own.on(FAST).write(works & registers[1].bit(0), registers[2].trunc(4), registers[0].trunc(8));
        fast.assert(!(works & i.go & registers[1].eq(random.below(256))), "a number that may come");
        fast.cover("it works", works);
        fast.cover("it has passed", has_passed & random.one(&[works, has_passed]));
        WorkerOut { value: *registers[1] ^ *rung ^ heard_last, works, since: *since }
    }
}

block! {
    /// Workers on one clock, a running clock that wakes them, and one that does hardly anything.
    struct Machine { seed: u64 }
    in MachineIn { go: bit().on(FAST), x: bits(8).on(FAST), quick: bit().on(SLOW) }
    out MachineOut { value: _, works: _, since: _, turns: _, slept: _ }
}

impl Machine {
    fn build(&self, m: Module, i: MachineIn) -> MachineOut {
        let mut random = Random::new(self.seed);
        let (slow, late) = (m.on(SLOW), m.on(LATE));
        // The clock whose state the others read is the first one, or not.
        if self.seed % 2 == 1 {
            late.reg("begun", bit()).reset(0).next(1);
        }
        let turns = slow.reg("turns", 12).reset(0);
        turns.next(turns + 1);
        let tick = slow.reg("tick", bit()).reset(0);
        let is_due = turns.trunc(9).eq(random.below(512));
        tick.when(is_due | (i.quick & turns.trunc(6).eq(3)), !*tick);
        let workers = m.array("u_worker", random.one(&[1, 3, 4, 16]), &Worker { seed: self.seed + 1 }, |_| WorkerIn {
            go: i.go,
            x: i.x,
            tick: *tick,
            word: turns.trunc(8),
        });
        let slept = late.reg("slept", 16).reset(0);
        let told = late.synchronize("told", *tick);
        slept.when(told | late.pipe("told_before", told), slept + 1);
        MachineOut {
            value: workers.value.xor_all(),
            works: workers.works.or_all(),
            since: workers.since.last(),
            turns: *turns,
            slept: *slept,
        }
    }
}

/// Runs a machine on generated code, on evaluated lowered functions, and on the reference engine, side by side with
/// the same random inputs, which seldom change. Returns the number of skipped edges.
fn run(seed: u64) -> u64 {
    let design = elaborate(&Machine { seed }).unwrap();
    let mut random = Random::new(seed ^ 0x1d1e);
    let mut passes = Passes { idle_from: 0, guarded: true, ..Passes::default() };
    passes.held_after = random.one(&[50_000, 40]);
    passes.pack_from = random.one(&[2, u32::MAX]);
    let on = |(kind, target)| {
        let passes = Passes { target, ..passes.clone() };
        Simulation::with_passes(&design, &passes).unwrap().seeded(seed % 3).on(kind)
    };
    let engines = [EngineKind::Reference, EngineKind::Compiled, EngineKind::Compiled, EngineKind::Both];
    let mut all: Vec<_> =
        engines.into_iter().zip([Target::Code, Target::Code, Target::Functions, Target::Code]).map(on).collect();
    let (mut x, mut again) = (0, Again::default());
    for step in 0..40 {
        x = if random.below(3) == 0 { random.below(4) } else { x };
        let (go, quick) = (u64::from(random.below(8) == 0), u64::from(step / 4 % 2 == 1));
        let (way, instants, word) = (random.below(20), random.one(&[1, 7, 40, 300, 1000]), random.below(256));
        again.go_on(&mut all, step, way == 19);
        let seen: Vec<_> = all
            .iter_mut()
            .map(|sim| {
                for (name, number) in [("go", go), ("x", x), ("quick", quick)] {
                    sim.set(sim.port(name).unwrap(), number);
                }
                let ended = match way {
                    0 => sim.try_reset(),
                    1 | 2 => {
                        (0..16).for_each(|address| sim.poke_memory("u_worker[0].own", address, word).unwrap());
                        sim.try_run(instants)
                    }
                    3..8 => (0..instants).try_for_each(|_| {
                        let _ = sim.get(sim.port("works").unwrap());
                        sim.try_step()
                    }),
                    8..14 => sim.try_run(instants),
                    _ => {
                        let end = sim.time() + 1000 * instants;
                        sim.try_run_to(end)
                    }
                };
                sim.set(sim.port("go").unwrap(), 0);
                let ended = ended.and_then(|()| sim.try_run(instants));
                // Only some machines have the last one.
                let registers =
                    ["kept", "upper", "beats", "paces", "echo", "overheard"].map(|name| format!("u_worker[0].{name}"));
                let names =
                    ["value", "works", "since", "turns", "slept"].into_iter().map(str::to_owned).chain(registers);
                let values: Vec<_> = names.map(|name| sim.peek(&name).ok()).collect();
                let words = ["own", "shared"].map(|it| sim.peek_memory(&format!("u_worker[0].{it}"), 3).unwrap());
                let covers: Vec<u64> = sim.covers().iter().map(|cover| cover.count).collect();
                (ended.map_err(|error| error.to_string()), sim.time(), values, words, covers)
            })
            .collect();
        for (other, engine) in seen[1..].iter().zip(["code", "what code is made of", "side by side"]) {
            assert_eq!(*other, seen[0], "step {step} of machine {seed}, {engine}");
        }
        if seen[0].0.is_err() {
            break;
        }
    }
    all[1].left_out()
}

#[test]
fn random_machines_run_as_on_the_reference_engine() {
    let left_out: Vec<u64> = (0..12).map(run).collect();
    let many = left_out.iter().filter(|edges| **edges > 1000).count();
    assert!(many > 6, "edges at which nothing happens are left out: {left_out:?}");
}

/// Run by hand, for a long time: docs/decisions/engine.md has the command.
#[test]
#[ignore = "tries as many machines as IDLE_MACHINES says, from IDLE_SEED on"]
fn random_machines_from_a_seed_run_as_on_the_reference_engine() {
    campaign("IDLE", run);
}
