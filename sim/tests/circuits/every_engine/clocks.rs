//! Several clocks: the sequence of edges, crossings, and memories between two clocks, compared with a plain model.

use crate::circuits::engine::of;
use crate::circuits::store::{FAST, SLOW, Store, StoreIn, StoreOut};
use proptest::prelude::*;
use tilewright_hdl::{Module, ReadUnderWrite, Signal, bits, block, lit};

block! {
    /// A count on each of two clocks; each is sampled by the other.
    struct Pair;
    out PairOut { fast: _, slow: _, fast_seen: _, slow_seen: _ }
}

impl Pair {
    fn build(&self, m: Module, _: ()) -> PairOut {
        let count = |name: &str, clock| {
            let count = m.on(clock).reg(name, 8).reset(0);
            count.next(count + 1);
            *count
        };
        let seen = |name: &str, clock, of: Signal| m.on(clock).pipe(name, of.quasi_static("the test samples it"));
        let (fast, slow) = (count("fast_count", FAST), count("slow_count", SLOW));
        PairOut { fast, slow, fast_seen: seen("fast_seen", SLOW, fast), slow_seen: seen("slow_seen", FAST, slow) }
    }
}

#[test]
fn clocks_that_rise_together_sample_together() {
    let mut sim = of(&Pair);
    let mut seen = Vec::new();
    while sim.time() < 6_000 {
        sim.step();
        let out = sim.read_u64();
        seen.push((sim.time(), out.fast, out.slow, out.fast_seen, out.slow_seen));
    }
    assert_eq!(seen, [(2_000, 1, 0, 0, 0), (3_000, 1, 1, 1, 0), (4_000, 2, 1, 1, 1), (6_000, 3, 2, 2, 1)]);
    sim.step_clock("slow", 2);
    assert_eq!((sim.time(), sim.cycles("fast"), sim.cycles("slow_clk")), (12_000, Ok(6), Ok(4)));
    sim.run_to(14_999);
    assert_eq!(sim.time(), 14_000);
}

block! {
    /// A count on the clock that its width names, and one on the module's clock.
    struct ByWidth;
    out CountsOut { slow: _, fast: _ }
}

impl ByWidth {
    fn build(&self, m: Module, _: ()) -> CountsOut {
        let m = m.on(FAST);
        let (slow, fast) = (m.reg("slow_count", bits(8).on(SLOW)).reset(0), m.reg("fast_count", bits(8)).reset(0));
        slow.next(slow + 1);
        fast.next(fast + 1);
        CountsOut { slow: *slow, fast: *fast }
    }
}

#[test]
fn a_register_runs_on_the_clock_that_its_width_names() {
    let mut sim = of(&ByWidth);
    sim.run_to(12_000);
    assert_eq!(sim.read_u64(), CountsOut { slow: 4, fast: 6 });
}

#[test]
fn a_wave_of_two_clocks_shows_both() {
    let mut sim = of(&Pair);
    let wave = sim.record([sim.o.fast, sim.o.slow]);
    sim.run(6);
    wave.expect(
        r"
        fast_clk |___/~~~\___/~\_/~\_/~~~\
        slow_clk |_______/~~~~~\_/~\_____/
        fast     | 0 | 1     | 2 | 3 | 4 |
        slow     | 0     | 1     | 2     |",
    );
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    /// Inputs often stay the same, so that edges without changes occur too.
    #[test]
    fn a_memory_between_two_clocks_follows_its_policy(
        any_policy: bool,
        stimulus in prop::collection::vec((1..6usize, 0..2u64, 0..4u64, 0..3u64, 0..2u64, 0..4u64), 1..40),
    ) {
        let policy = if any_policy { ReadUnderWrite::Any } else { ReadUnderWrite::Old };
        let mut sim = of(&Store { policy });
        let (mut words, mut word, mut time) = ([0u64; 4], 0, 0u64);
        for (repeat, write, to, data, read, from) in stimulus {
            sim.drive(StoreIn { write, to, data, read, from });
            for _ in 0..repeat {
                sim.step();
                time += 1_000;
                while time % 2_000 != 0 && time % 3_000 != 0 {
                    time += 1_000;
                }
                let (fast, slow) = (time % 2_000 == 0, time % 3_000 == 0);
                if slow && read == 1 {
                    let collides = any_policy && fast && write == 1 && to == from;
                    word = if collides { !words[from as usize] & 255 } else { words[from as usize] };
                }
                if fast && write == 1 {
                    words[to as usize] = data;
                }
                prop_assert_eq!(sim.time(), time);
                prop_assert_eq!(sim.read_u64(), StoreOut { word, at_once: words[from as usize] });
            }
        }
    }
}

#[test]
fn an_edge_evaluates_nothing_that_depends_on_another_clock_alone() {
    use tilewright_sim::program::{Readers, Triggers};
    let sim = of(&Pair);
    let clocks = &sim.program().clocks;
    for (index, clock) in clocks.iter().enumerate() {
        let other = 1 - index;
        let own: Vec<_> =
            sim.program().schedule.segments.iter().filter(|it| it.readers.meet(Readers::edge(index))).collect();
        assert!(!own.is_empty());
        assert!(own.iter().all(|segment| !segment.triggers.meet(Triggers::state(other))), "{}", clock.name);
        assert!(clock.triggers.meet(Triggers::state(other)), "it samples the other count");
    }
}

block! {
    /// A word that two clocks write repeatedly.
    struct Contested;
    out ContestedOut { word: _ }
}

impl Contested {
    fn build(&self, m: Module, (): ()) -> ContestedOut {
        let words = m.on(FAST).memory("words", 4, 8, ReadUnderWrite::Old).true_dual_port();
        words.write(lit(1, 1), 0, 5);
        words.on(SLOW).write(lit(1, 1), 0, 7);
        ContestedOut { word: m.on(FAST).pipe("constant", lit(8, 1)) }
    }
}

#[test]
fn a_write_that_changed_nothing_is_repeated_after_that_of_another_clock() {
    let mut sim = of(&Contested);
    let mut seen = Vec::new();
    while sim.time() < 10_000 {
        sim.step();
        seen.push((sim.time(), sim.peek_memory("words", 0).unwrap().to_u64().unwrap()));
    }
    // At 6 ns both write, the slow clock last.
    assert_eq!(seen, [(2_000, 5), (3_000, 7), (4_000, 5), (6_000, 7), (8_000, 5), (9_000, 7), (10_000, 5)]);
}
