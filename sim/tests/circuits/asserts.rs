//! Values of many lanes that both assertions and an edge need are the same as on the reference engine, and so is the
//! cycle in which an assertion fails.

use tilewright_hdl::{Block, Module, Width, bits, block, bundle, def, elaborate, mux, stack};
use tilewright_sim::{EngineKind, Passes, Simulation, Target};

use crate::circuits::random::Random;

const WORKERS: u64 = 9;

bundle! {
    pub struct RowIn<T> { pub workers: Vec<WorkerIn<T>> }
    pub struct RowOut<T> { pub count: T, pub least: T, pub sums: T }
}

block! {
    /// Adds up its input.
    struct Worker;
    in WorkerIn { line: bits(8), flag: bits(1) }
    out WorkerOut { sum: _, flagged: _ }
}

impl Worker {
    fn build(&self, m: Module, i: WorkerIn) -> WorkerOut {
        def!(sum = m.reg(8).reset(0));
        sum.when(i.flag, sum + i.line);
        m.assert(!(sum.eq(0xe5) & i.flag), "a sum that may come");
        m.assert(i.line.ne(9), "nine is not given");
        WorkerOut { sum: *sum, flagged: i.flag & sum.bit(0) }
    }
}

/// Several workers; the number of clocks in which none is flagged, and the lowest line.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Row;

impl Block for Row {
    type In = RowIn;
    type Out = RowOut;

    fn inputs(&self) -> RowIn<Width> {
        RowIn { workers: vec![Worker.inputs(); WORKERS as usize] }
    }

    fn build(&self, m: Module, i: RowIn) -> RowOut {
        let least = i.workers.iter().map(|it| it.line).reduce(|a, b| mux(a.lt(b), a, b)).unwrap();
        let given = stack(i.workers);
        let workers = m.array("u_worker", WORKERS as u32, &Worker, |_| given);
        def!(quiet = !workers.flagged.or_all());
        def!(count = m.reg(8).reset(0));
        count.when(quiet, count + 1);
        def!(lowest = m.reg(8).reset(0));
        lowest.when(given.flag.or_all(), least);
        m.assert(quiet | lowest.ne(100), "the least line is not a hundred");
        RowOut { count: *count, least: *lowest, sums: workers.sum.xor_all() }
    }
}

/// The values seen in each clock, until an assertion fails.
fn seen(seed: u64, kind: EngineKind, passes: &Passes) -> Vec<String> {
    let mut sim = Simulation::with_passes(&elaborate(&Row).unwrap(), passes).unwrap().on(kind);
    let mut random = Random::new(seed);
    let mut seen = Vec::new();
    sim.reset();
    for _ in 0..400 {
        for worker in 0..WORKERS {
            if random.below(4) == 0 {
                let seldom = if random.below(60) == 0 { 9 } else { 8 };
                let line = random.one(&[2, 4, 16, 77, 100, 130, seldom]);
                sim.set(sim.port(&format!("workers_{worker}_line")).unwrap(), line);
                sim.set(sim.port(&format!("workers_{worker}_flag")).unwrap(), random.below(2));
            }
        }
        let clocks = random.one(&[1, 1, 1, 5, 90]);
        let ended = sim.try_run(clocks);
        let values = ["count", "least", "sums", "u_worker[3].sum"].map(|name| sim.peek(name).unwrap());
        seen.push(format!("{values:?} {:?} at {}", ended.as_ref().map_err(ToString::to_string), sim.time()));
        if ended.is_err() {
            break;
        }
    }
    seen
}

#[test]
fn what_assertions_have_computed_is_what_an_edge_needs() {
    let mut fails = 0;
    for seed in 0..12 {
        let reference = seen(seed, EngineKind::Reference, &Passes::default());
        fails += usize::from(reference.last().unwrap().contains("Err"));
        let usual = Passes { held_after: 40, guarded: true, ..Passes::default() };
        let others = [
            Passes { longest: 6, ..usual.clone() },
            Passes { pack_from: u32::MAX, ..usual.clone() },
            Passes { target: Target::Functions, ..usual.clone() },
            usual,
        ];
        for passes in others {
            assert_eq!(seen(seed, EngineKind::Compiled, &passes), reference, "{seed} with {passes:?}");
        }
    }
    assert!(fails > 3, "assertions fail in {fails} runs");
}
