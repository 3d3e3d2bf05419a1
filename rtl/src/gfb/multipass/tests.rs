//! Pictures of several passes clock by clock: by example, and against the rules in plain software.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::*;

type Sim = Simulation<MultipassControlIn, MultipassControlOut>;

fn control() -> Sim {
    let mut sim = Simulation::of(&MultipassControl).unwrap().seeded(7);
    sim.reset();
    sim
}

/// A clock with or without a swap, a sum and a blanking.
fn clock(sim: &mut Sim, [swap, busy, blanking]: [u64; 3]) {
    sim.set(sim.i.swap, swap);
    sim.set(sim.i.busy, busy);
    sim.set(sim.i.blanking, blanking);
    sim.step();
}

#[test]
fn a_picture_of_two_passes_and_the_next_one_clock_by_clock() {
    let mut sim = control();
    let wave = sim.record(["swap", "busy", "blanking", "start", "first", "may_swap", "averages", "stage"]);
    sim.set(sim.i.host.accumulates, 1);
    sim.set(sim.i.host.passes, Passes::Two.code());
    // The first pass, a sum that lasts until a blanking, the last pass, its sum, a blanking, and another one.
    let clocks = [
        [1, 0, 1],
        [0, 1, 1],
        [0, 1, 0],
        [0, 0, 1],
        [1, 0, 1],
        [0, 1, 1],
        [0, 1, 0],
        [0, 0, 0],
        [0, 0, 1],
        [0, 0, 1],
        [0, 0, 0],
        [0, 0, 0],
        [0, 0, 1],
        [1, 0, 1],
        [0, 1, 1],
    ];
    clocks.into_iter().for_each(|it| clock(&mut sim, it));
    wave.expect(
        r"
        clk      |~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/
        swap     |~~~~~~\____________________/~~~~~~\_______________________________________________________/~~~~~~~
        busy     |______/~~~~~~~~~~~~~\_____________/~~~~~~~~~~~~~\_________________________________________________
        blanking |~~~~~~~~~~~~~\______/~~~~~~~~~~~~~~~~~~~~\_____________/~~~~~~~~~~~~~\_____________/~~~~~~~~~~~~~~
        start    |~~~~~~\____________________/~~~~~~\_______________________________________________________/~~~~~~~
        first    |~~~~~~\___________________________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        may_swap |~~~~~~\_____________/~~~~~~~~~~~~~\________________________________________________/~~~~~~~~~~~~~~
        averages |______________________________________________________________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        stage    | Pass                             | LastSum                   | Turn        | Average            |

        clk      |~~~\__/
        swap     |_______
        busy     |~~~~~~~
        blanking |~~~~~~~
        start    |_______
        first    |_______
        may_swap |_______
        averages |_______
        stage    | Pass |
        ",
    );
    let mut covered = |what| sim.covered(what).unwrap();
    assert_eq!(covered("a picture begins while the average of the previous one is shown"), 1);
    assert_eq!(covered("a last sum waits for the blanking"), 1);
    assert_eq!(covered("a blanking passes while a sum is under way"), 3);
    assert_eq!(covered("a frame without accumulation follows an average"), 0);
}

#[test]
fn frames_without_accumulation_follow_an_average() {
    let mut sim = control();
    assert_eq!(sim.get_u64(sim.o.passes), Passes::Two.code());
    sim.set(sim.i.host.accumulates, 1);
    // Two passes, three clocks until the blanking, the average; then two frames.
    [[1, 0, 1], [0, 1, 1], [1, 0, 1], [0, 1, 1]].into_iter().for_each(|it| clock(&mut sim, it));
    [[0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 1], [0, 0, 0]].into_iter().for_each(|it| clock(&mut sim, it));
    sim.set(sim.i.host.accumulates, 0);
    for _ in 0..2 {
        clock(&mut sim, [1, 0, 1]);
        assert_eq!((sim.get_u64(sim.o.averages), sim.get_u64(sim.o.may_swap)), (0, 1));
    }
    assert_eq!(sim.covered("a last sum waits for the blanking").unwrap(), 3);
    assert_eq!(sim.covered("a frame without accumulation follows an average").unwrap(), 1);
}

/// The assertion that stops the simulation in a clock.
fn problem(sim: &mut Sim, inputs: [u64; 3]) -> String {
    sim.set(sim.i.swap, inputs[0]);
    sim.set(sim.i.busy, inputs[1]);
    sim.set(sim.i.blanking, inputs[2]);
    sim.try_step().err().map(|problem| problem.to_string()).unwrap_or_default()
}

#[test]
fn a_swap_at_the_wrong_time_is_an_error() {
    let under_way = "the banks do not change while a sum is under way";
    let too_soon = "the banks do not change before the average has been shown for a whole refresh";
    // The number of passes of the picture, and what is wrong with a swap in a clock after the last pass.
    let after = [([0, 1, 1], under_way), ([0, 0, 0], too_soon), ([0, 0, 1], too_soon), ([0, 0, 1], too_soon)];
    for clocks in 0..=after.len() {
        let mut sim = control();
        sim.set(sim.i.host.accumulates, 1);
        clock(&mut sim, [1, 0, 1]);
        clock(&mut sim, [0, 1, 1]);
        clock(&mut sim, [1, 0, 1]);
        after[..clocks].iter().for_each(|(inputs, _)| clock(&mut sim, *inputs));
        if let Some(([_, busy, blanking], wrong)) = after.get(clocks) {
            let problem = problem(&mut sim, [1, *busy, *blanking]);
            assert!(problem.contains(wrong), "after {clocks} clocks: {problem}");
        } else {
            clock(&mut sim, [0, 0, 0]);
            assert_eq!(problem(&mut sim, [1, 0, 1]), "");
        }
    }
}

/// The control by its rules.
#[derive(Default)]
struct Plain {
    /// The passes of the picture shown so far, and its total number of passes.
    seen: u32,
    passes: u64,
    /// For a complete picture: whether its average is shown, and whether the blanking in which that began has ended.
    averages: bool,
    may_end: bool,
}

impl Plain {
    fn is_complete(&self) -> bool {
        self.seen > 0 && self.seen == 2 << self.passes
    }

    fn may_swap(&self, busy: bool, blanking: bool) -> bool {
        blanking && if self.is_complete() { self.may_end } else { !busy }
    }

    /// An edge; returns whether a sum starts and whether it is the first.
    fn clock(&mut self, swap: bool, (accumulates, passes): (bool, u64), busy: bool, blanking: bool) -> Option<bool> {
        let mut starts = None;
        if swap {
            if self.is_complete() {
                *self = Plain { passes: self.passes, ..Plain::default() };
            }
            if accumulates || self.seen > 0 {
                starts = Some(self.seen == 0);
                self.passes = if self.seen == 0 { passes } else { self.passes };
                self.seen += 1;
            }
        } else if self.is_complete() {
            self.may_end |= self.averages && !blanking;
            self.averages |= !busy && blanking;
        }
        starts
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// Sums and blankings of any length; swaps as early as allowed, or later; a host whose settings change in each
    /// clock.
    #[test]
    fn the_control_follows_its_rules(
        clocks in prop::collection::vec((prop::bool::weighted(0.7), prop::bool::weighted(0.8), 0..4u64), 400),
        sums in prop::collection::vec(1..12u32, 8),
        blankings in prop::collection::vec((1..9usize, 1..6usize), 1..6),
    ) {
        let mut sim = control();
        let mut plain = Plain::default();
        let pattern: Vec<bool> =
            blankings.iter().flat_map(|(dark, light)| [vec![false; *light], vec![true; *dark]].concat()).collect();
        let (mut sum_left, mut started) = (0, 0);
        for (clock, (wants, accumulates, passes)) in clocks.into_iter().enumerate() {
            let (busy, blanking) = (sum_left > 0, pattern[clock % pattern.len()]);
            sim.set(sim.i.swap, 0);
            sim.set(sim.i.busy, busy);
            sim.set(sim.i.blanking, blanking);
            sim.set(sim.i.host.accumulates, accumulates);
            sim.set(sim.i.host.passes, passes);
            prop_assert_eq!(sim.get_u64(sim.o.may_swap) == 1, plain.may_swap(busy, blanking), "clock {}", clock);
            prop_assert_eq!(sim.get_u64(sim.o.averages) == 1, plain.averages, "clock {}", clock);
            if plain.seen > 0 {
                prop_assert_eq!(sim.get_u64(sim.o.passes), plain.passes);
            }
            let swap = wants && plain.may_swap(busy, blanking);
            sim.set(sim.i.swap, swap);
            let (start, first) = (sim.get_u64(sim.o.start), sim.get_u64(sim.o.first));
            let starts = plain.clock(swap, (accumulates, passes), busy, blanking);
            prop_assert_eq!((start == 1).then_some(first == 1), starts, "clock {}", clock);
            sum_left = match starts {
                Some(_) => sums[started % sums.len()],
                None => sum_left.saturating_sub(1),
            };
            started += usize::from(starts.is_some());
            sim.step();
        }
    }
}
