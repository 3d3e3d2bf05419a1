//! Many instants of several clocks at once, without observers: the final state equals that of the reference engine,
//! also if an assertion fails.

use tilewright_hdl::{Clock, Module, Period, bit, bits, block, def, elaborate, row};
use tilewright_sim::{EngineKind, Passes, Simulation};

const QUICK: Clock = Clock::new("quick", Period::ps(1_000));
const FAST: Clock = Clock::new("fast", Period::ps(2_500));
const SLOW: Clock = Clock::new("slow", Period::ps(8_000));

block! {
    /// Lanes that add for some clocks when an input or the slow clock tells them to, and then rest except for a
    /// counter. A fast clock counts by itself; the slow one looks at both.
    pub(super) struct Clocks;
    in In { go: bit().on(FAST), limit: bits(12).on(SLOW), pace: bits(2).on(QUICK) }
    out Out { sum: _, since: _, turns: _, ticks: _, heard: _ }
}

impl Clocks {
    fn build(&self, m: Module, i: In) -> Out {
        let (quick, fast, slow) = (m.on(QUICK), m.on(FAST), m.on(SLOW));
        def!(turns = slow.reg(12).reset(0));
        turns.next(turns + 1);
        def!(tick = slow.reg(bit()).reset(0));
        tick.when(turns.trunc(7).eq(100), !*tick);
        slow.assert(turns.ne(i.limit), "the limit is not come to");

        def!(ticks = quick.reg(16).reset(0));
        ticks.next(ticks + 1 + i.pace.zext(16));
        quick.assert(ticks.ne(0xfff0), "a number that comes late");

        def!(told = fast.synchronize(*tick));
        def!(told_before = fast.pipe(told));
        def!(starts = i.go | (told ^ told_before));
        def!(left = fast.reg(5).reset(0));
        left.when(starts, 20).when(left.ne(0), left - 1);
        def!(since = fast.reg(10).reset(0));
        since.when(starts, 0).when(since.ne(900), since + 1);
        def!(sums = fast.reg(bits(8).of(row(16))).reset(1));
        sums.when(left.ne(0), sums + (sums << 1) + 1);
        fast.assert(since.ne(899) | sums.xor_all().ne(0x77), "what may come");
        fast.cover("it rings", since.eq(300));
        def!(nearly = fast.pipe(left.eq(3)));
        def!(heard = slow.synchronize(nearly));
        Out { sum: sums.xor_all(), since: *since, turns: *turns, ticks: *ticks, heard }
    }
}

/// The values seen after each of these spans in picoseconds, with inputs that change before, and the number of
/// skipped edges.
fn run(kind: EngineKind, passes: &Passes, acts: &[(u64, [u64; 3])]) -> (Vec<String>, u64) {
    let mut sim = Simulation::with_passes(&elaborate(&Clocks).unwrap(), passes).unwrap().on(kind);
    let ports = ["go", "limit", "pace"].map(|name| sim.port(name).unwrap());
    let mut seen = Vec::new();
    sim.set(ports[1], 0xfff);
    sim.reset();
    for &(span, inputs) in acts {
        ports.iter().zip(inputs).for_each(|(&port, input)| sim.set(port, input));
        let end = sim.time() + span;
        let ended = sim.try_run_to(end).map_err(|error| error.to_string());
        let values = ["sum", "since", "turns", "ticks", "heard", "left"].map(|name| sim.peek(name).unwrap());
        let cycles = ["quick", "fast", "slow"].map(|clock| sim.cycles(clock).unwrap());
        let covers: Vec<u64> = sim.covers().iter().map(|cover| cover.count).collect();
        seen.push(format!("{values:?} {cycles:?} {covers:?} {ended:?} at {}", sim.time()));
        if ended.is_err() {
            break;
        }
    }
    (seen, sim.left_out())
}

#[test]
fn many_instants_are_as_one_by_one() {
    let still = [0, 0xfff, 0];
    let far =
        [(10_000, [1, 0xfff, 0]), (3_000_000, still), (7, still), (999, still), (5_000_000, still), (40_000, still)];
    let paces: Vec<_> = (0..30).map(|step| (step * 7_777, [u64::from(step % 11 == 3), 0xfff, step / 9 % 4])).collect();
    let limit = [(2_000_000, [1, 0xfff, 0]), (3_000_000, still), (4_000_000, [0, 800, 0])];
    let late = [(40_000_000, [0, 0xfff, 0]), (60_000_000, still)];
    for (acts, fails) in [(&far[..], false), (&paces, false), (&limit, true), (&late, true)] {
        let (reference, _) = run(EngineKind::Reference, &Passes::default(), acts);
        assert_eq!(reference.last().unwrap().contains("Err"), fails, "{:?}", reference.last());
        for held_after in [50_000, 100] {
            let passes = Passes { idle_from: 0, held_after, guarded: true, ..Passes::default() };
            let (compiled, left_out) = run(EngineKind::Compiled, &passes, acts);
            assert_eq!(compiled, reference, "{acts:?}");
            assert!(left_out > 0 || acts.len() == paces.len(), "some edges are left out in {acts:?}");
        }
    }
}
