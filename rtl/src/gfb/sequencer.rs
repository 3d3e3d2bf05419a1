//! The sequencer of a merging round: leads the scan, line by line, and says which pixels enter and leave the chain (VC1-TM).
//!
//! ```text
//! start --> Idle --> Prime --> Line --> Overhead --> Drain --> Idle
//!                               ^           |
//!                               '-----------'
//!                               N lines
//! ```
//!
//! A round takes T_m = (M + beta) N + 4 n clocks, from the first pixel that enters the chain to the last that leaves it:
//!
//! ```text
//! Prime 2 | Line M | Overhead beta | Line M | Overhead beta | .. | Overhead beta | Drain 4 n
//!         |<-------------------------- N times ------------------------------->|
//! ```
//!
//! In the 2 clocks before, the local frame buffers and the global one read their first pixel ([`SCAN_LATENCY`]). The whole
//! chain holds during the overhead; in the end it runs on until the last pixel has left it.

use crate::merger::STAGES;
use crate::prelude::*;

/// Clocks with `enable` from a scan counter to the word that its local frame buffer sends.
pub const SCAN_LATENCY: u32 = 2;

codes! {
    /// The parts of a merging round.
    enum Round { Idle, Prime, Line, Overhead, Drain }
}

block! {
    /// Leads a merging round over the screen, through a chain of merging units.
    pub struct GfbSequencer {
        /// The screen: M x N pixels.
        pub screen: Screen,
        /// The merging units of the chain: n.
        pub units: u32,
        /// Clocks of overhead after each scan line: beta.
        pub overhead: u32,
    }
    ranges { units: 1.., overhead: 1.. }
    latency(self) = format!("a round of {} clocks", self.merge_clocks());
    source = "VC-1, section 3.3, T_m (VC1-TM)";
    in GfbSequencerIn {
        /// Begins a round, unless one is under way.
        start: bit(),
    }
    out(self) GfbSequencerOut {
        /// To every unit of the chain.
        scan: ScanControl { restart: bit(), enable: bit() },
        /// The pixel to read, which enters the chain [`SCAN_LATENCY`] clocks later.
        feed: below(self.screen.pixels()),
        /// A pixel leaves the chain.
        stores: bit(),
        /// The pixel that leaves the chain.
        store: below(self.screen.pixels()),
        /// A round is under way.
        busy: bit(),
        /// The round ends with this clock.
        ends: bit(),
        /// The clocks of the round so far, or of the last one, from the first pixel that entered the chain.
        clocks: up_to(self.merge_clocks()),
    }
}

impl GfbSequencer {
    /// T_m, the clocks of a merging round (VC1-TM).
    pub fn merge_clocks(&self) -> u64 {
        let [width, height, overhead] = [self.screen.width, self.screen.height, self.overhead].map(u64::from);
        (width + overhead) * height + u64::from(STAGES * self.units)
    }

    fn build(&self, m: Module, i: GfbSequencerIn) -> GfbSequencerOut {
        let Screen { width, height } = self.screen;
        let drain = STAGES * self.units;

        // The parts of the round.
        def!(round = m.fsm(Round::Idle));
        def!(x = m.reg(below(width)).reset(0));
        def!(y = m.reg(below(height)).reset(0));
        let longest = drain.max(self.overhead).max(SCAN_LATENCY);
        def!(clocks_left = m.reg(below(longest)).reset(0));
        def!(part_ends = clocks_left.eq(0));
        def!(last_pixel = x.eq(width - 1));
        def!(last_line = y.eq(height - 1));
        let moves = round.next(|part| match part {
            Round::Idle => when(i.start, Round::Prime),
            Round::Prime => when(part_ends, Round::Line),
            Round::Line => when(last_pixel, Round::Overhead),
            Round::Overhead => when(!part_ends, Round::Overhead).or_when(last_line, Round::Drain).or_else(Round::Line),
            Round::Drain => when(part_ends, Round::Idle),
        });
        def!(begins = moves.leaves(Round::Idle));
        def!(line_ends = moves.leaves(Round::Line));
        def!(overhead_ends = moves.leaves(Round::Overhead));
        def!(scan_ends = moves.enters(Round::Drain));
        def!(ends = moves.leaves(Round::Drain));
        x.when(line_ends, 0).when(round.is(Round::Line), x + 1);
        y.when(scan_ends, 0).when(overhead_ends, y + 1);
        clocks_left
            .when(begins, SCAN_LATENCY - 1)
            .when(line_ends, self.overhead - 1)
            .when(scan_ends, drain - 1)
            .when(!part_ends, clocks_left - 1);

        // The pixels that enter the chain, and those that have gone through all of it.
        def!(enable = round.is(Round::Prime) | round.is(Round::Line) | round.is(Round::Drain));
        def!(feed = m.reg(below(self.screen.pixels())).reset(0));
        feed.when(begins, 0).when(enable, feed + 1);
        let way = SCAN_LATENCY + drain;
        def!(until_stored = m.reg(up_to(way)).reset(0));
        def!(stores = enable & until_stored.eq(0));
        until_stored.when(begins, way).when(stores, 0).when(enable, until_stored - 1);
        def!(store = m.reg(below(self.screen.pixels())).reset(0));
        store.when(begins, 0).when(stores, store + 1);

        def!(clocks = m.reg(up_to(self.merge_clocks())).reset(0));
        def!(counts = round.is(Round::Line) | round.is(Round::Overhead) | round.is(Round::Drain));
        clocks.when(begins, 0).when(counts, clocks + 1);

        let scan = ScanControl { restart: begins, enable };
        let busy = !round.is(Round::Idle);
        GfbSequencerOut { scan, feed: *feed, stores, store: *store, busy, ends, clocks: *clocks }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tilewright_sim::Simulation;

    use super::*;
    use crate::gfb::GfbUnit;

    /// A round on a screen of 3 x 2 pixels with an overhead of 2 clocks and one merging unit.
    #[test]
    fn a_round_clock_by_clock() {
        let sequencer = GfbSequencer { screen: Screen { width: 3, height: 2 }, units: 1, overhead: 2 };
        let mut sim = Simulation::of(&sequencer).unwrap().seeded(7);
        sim.reset();
        let wave = sim.record([
            "scan_restart",
            "scan_enable",
            "round",
            "clocks_left",
            "feed",
            "until_stored",
            "stores",
            "store",
            "ends",
            "clocks",
        ]);
        sim.set(sim.i.start, 1);
        sim.step();
        sim.set(sim.i.start, 0);
        sim.run(17);
        wave.expect(
            r"
            clk          |~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/
            scan_restart |~~~~~~\____________________________________________________________________________________
            scan_enable  |______/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\_____________/~~~~~~~~~~~~~~~~~~~~\______________
            round        | Idle | Prime       | Line               | Overhead    | Line               | Overhead    |
            clocks_left  | 0    | 1    | 0                         | 1    | 0                         | 1    | 0    |
            feed         | 0           | 1    | 2    | 3    | 4    | 5                  | 6    | 7    | 0           |
            until_stored | 0    | 6    | 5    | 4    | 3    | 2    | 1                  | 0                         |
            stores       |______________________________________________________________/~~~~~~~~~~~~~\______________
            store        | 0                                                                   | 1    | 2           |
            ends         |___________________________________________________________________________________________
            clocks       | 0                         | 1    | 2    | 3    | 4    | 5    | 6    | 7    | 8    | 9    |

            clk          |~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/
            scan_restart |___________________________________
            scan_enable  |~~~~~~~~~~~~~~~~~~~~~~~~~~~\_______
            round        | Drain                     | Idle |
            clocks_left  | 3    | 2    | 1    | 0           |
            feed         | 0    | 1    | 2    | 3    | 4    |
            until_stored | 0                                |
            stores       |~~~~~~~~~~~~~~~~~~~~~~~~~~~\_______
            store        | 2    | 3    | 4    | 5    | 6    |
            ends         |____________________/~~~~~~\_______
            clocks       | a    | b    | c    | d    | e    |
            ",
        );
        assert_eq!(sim.get(sim.o.clocks), sequencer.merge_clocks());
    }

    /// The clocks of a round, counted from outside: those after the first [`SCAN_LATENCY`] in which it is busy.
    fn round(screen: Screen, units: u32, overhead: u32) -> u64 {
        let mut sim = Simulation::of(&GfbSequencer { screen, units, overhead }).unwrap();
        sim.reset();
        sim.set(sim.i.start, 1);
        sim.step();
        sim.set(sim.i.start, 0);
        let mut stored = 0;
        let limit = 2 * (screen.pixels() + screen.height * overhead + STAGES * units);
        for clocks in 0..limit.into() {
            if sim.get_u64(sim.o.busy) == 0 {
                assert_eq!(stored, screen.pixels());
                return clocks - u64::from(SCAN_LATENCY);
            }
            stored += u32::from(sim.get_u64(sim.o.stores) == 1);
            sim.step();
        }
        panic!("the round has no end")
    }

    /// T_m of the VC-1 is 316800 + 64 clocks: 25.35 ms of 80 ns each.
    #[test]
    fn a_round_takes_t_m() {
        assert_eq!(round(Screen::VC1, 16, 20), 316_864);
        for (width, height, units, overhead) in [(2, 2, 1, 1), (5, 3, 4, 7), (16, 1, 2, 20), (1, 8, 2, 1)] {
            let t_m = (width + overhead) * height + 4 * units;
            assert_eq!(round(Screen { width, height }, units, overhead), u64::from(t_m), "{width} x {height}");
        }
    }

    #[test]
    fn a_chain_of_no_units_and_a_line_without_overhead_are_refused_in_a_sentence() {
        let problem = |units, overhead| {
            elaborate(&GfbUnit { screen: Screen::VC1, units, overhead }).unwrap_err().0[0].message.clone()
        };
        assert_eq!(problem(0, 20), "`units` of `GfbSequencer` is 0: it has to be at least 1");
        assert_eq!(problem(16, 0), "`overhead` of `GfbSequencer` is 0: it has to be at least 1");
    }

    /// Whether the scan advances, clock by clock of a round: 2 clocks until the first pixel enters the chain, then T_m.
    fn timetable(width: usize, height: usize, units: usize, overhead: usize) -> Vec<bool> {
        let line = [vec![true; width], vec![false; overhead]].concat();
        [vec![true; 2], line.repeat(height), vec![true; 4 * units]].concat()
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

        /// Against a timetable written down in full (VC1-TM), with starts at any time, which are for nothing in a round.
        #[test]
        fn rounds_follow_the_timetable(
            (width, height, units, overhead) in (1..9u32, 1..6u32, 1..5u32, 1..7u32),
            starts in prop::collection::vec(prop::bool::weighted(0.2), 1..400),
            seed in any::<u64>(),
        ) {
            let sequencer = GfbSequencer { screen: Screen { width, height }, units, overhead };
            let mut sim = Simulation::of(&sequencer).unwrap().seeded(seed);
            sim.reset();
            let timetable = timetable(width as usize, height as usize, units as usize, overhead as usize);
            let (pixels, way) = ((width * height) as usize, 2 + 4 * units as usize);
            let (mut clock, mut clocks) = (None, 0);
            for start in starts {
                sim.drive(GfbSequencerIn { start: start.into() });
                let o = sim.read_u64();
                let enable = clock.is_some_and(|clock: usize| timetable[clock]);
                let advanced = clock.map_or(0, |clock| timetable[..clock].iter().filter(|enable| **enable).count());
                prop_assert_eq!((o.scan.restart == 1, o.scan.enable == 1), (start && clock.is_none(), enable));
                prop_assert_eq!(o.busy == 1, clock.is_some());
                prop_assert_eq!(o.ends == 1, clock == Some(timetable.len() - 1));
                prop_assert_eq!(o.clocks, clock.map_or(clocks, |clock| clock.saturating_sub(2)) as u64);
                if enable && advanced < pixels {
                    prop_assert_eq!(o.feed, advanced as u64);
                }
                prop_assert_eq!(o.stores == 1, enable && advanced >= way);
                if enable && advanced >= way {
                    prop_assert_eq!(o.store, (advanced - way) as u64);
                }
                sim.step();
                clock = match clock {
                    None => start.then_some(0),
                    Some(clock) => Some(clock + 1).filter(|clock| *clock < timetable.len()),
                };
                if o.ends == 1 {
                    clocks = ((width + overhead) * height + 4 * units) as usize;
                }
            }
        }
    }
}
