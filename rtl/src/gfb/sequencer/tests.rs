//! The scan clock by clock, and against a timetable.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::*;

/// Two rounds on a screen of 3 x 2 pixels with an overhead of 2 clocks and one merging unit, and a restart.
#[test]
fn the_scan_clock_by_clock() {
    let sequencer = GfbSequencer { screen: Screen { width: 3, height: 2 }, units: 1, overhead: 2 };
    let mut sim = Simulation::of(&sequencer).unwrap().seeded(7);
    sim.reset();
    let wave =
        sim.record(["scan_restart", "scan_enable", "part", "feed", "blank", "way_left", "stores", "stale", "store"]);
    sim.run(16);
    sim.set(sim.i.restart, 1);
    sim.step();
    sim.set(sim.i.restart, 0);
    sim.run(5);
    wave.expect(
        r"
        clk          |~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/
        scan_restart |~~~~~~~~~~\_____________________________________________________________________________
        scan_enable  |__________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\______________________
        part         | Restart  | Prime               | Line                           | Overhead            |
        feed         | 0                   | 1        | 2        | 3        | 4        | 5                   |
        blank        |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        way_left     | 6                   | 5        | 4        | 3        | 2        | 1                   |
        stores       |________________________________________________________________________________________
        stale        |__________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\______________________
        store        | 0                                                                                     |

        clk          |~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/
        scan_restart |________________________________________________________________________________________
        scan_enable  |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\_____________________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        part         | Line                           | Overhead            | Line                           |
        feed         | 5        | 0        | 1        | 2                              | 3        | 4        |
        blank        |~~~~~~~~~~\_____________________________________________________________________________
        way_left     | 1        | 0                                                                          |
        stores       |__________/~~~~~~~~~~~~~~~~~~~~~\_____________________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        stale        |~~~~~~~~~~\_____________________________________________________________________________
        store        | 0                   | 1        | 2                              | 3        | 4        |

        clk          |~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/
        scan_restart |~~~~~~~~~~\_______________________________________________________
        scan_enable  |__________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        part         | Overhead | Prime               | Line                           |
        feed         | 5        | 0        | 1        | 2        | 3        | 4        |
        blank        |__________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        way_left     | 0        | 6        | 5        | 4        | 3        | 2        |
        stores       |__________________________________________________________________
        stale        |__________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        store        | 5        | 0                                                    |
        ",
    );
}

/// Two measurements after a restart: the clocks from the first pixel that enters to the last one stored, and those
/// between the first pixels of successive rounds.
fn measured(screen: Screen, units: u32, overhead: u32) -> (u64, Vec<u64>) {
    let sequencer = GfbSequencer { screen, units, overhead };
    let mut sim = Simulation::of(&sequencer).unwrap();
    sim.reset();
    let (mut fed, mut stored_at, mut rounds) = (0, None, Vec::new());
    for clock in 0..3 * sequencer.stored_clocks() {
        // A pixel enters the chain 2 clocks with `enable` after it was read.
        if sim.get_u64(sim.o.scan.enable) == 1 {
            if fed >= 2 && (fed - 2) % u64::from(screen.pixels()) == 0 {
                rounds.push(clock);
            }
            fed += 1;
        }
        if sim.get_u64(sim.o.stores) == 1 && sim.get_u64(sim.o.store) == u64::from(screen.pixels() - 1) {
            stored_at.get_or_insert(clock + 1);
        }
        sim.step();
    }
    (stored_at.unwrap() - rounds[0], rounds.windows(2).map(|pair| pair[1] - pair[0]).collect())
}

/// T_m of the VC-1 is 316800 + 64 clocks: 25.35 ms at 80 ns each. A chain of 256 units is longer than a line and stops
/// for an overhead.
#[test]
fn a_frame_takes_t_m_and_rounds_follow_with_their_period() {
    for (units, clocks) in [(16, 316_864), (256, 317_844)] {
        let (stored, rounds) = measured(Screen::VC1, units, 20);
        assert!(stored == clocks && rounds.len() > 1 && rounds.iter().all(|clocks| *clocks == 316_800), "{rounds:?}");
        let sequencer = GfbSequencer { screen: Screen::VC1, units, overhead: 20 };
        assert_eq!((sequencer.stored_clocks(), sequencer.merge_clocks()), (clocks, 316_800 + 4 * u64::from(units)));
    }
    for (width, height, units, overhead) in [(5, 3, 3, 7), (16, 2, 2, 20), (8, 8, 4, 1), (4, 16, 4, 3)] {
        let screen = Screen { width, height };
        let (stored, rounds) = measured(screen, units, overhead);
        assert_eq!(stored, GfbSequencer { screen, units, overhead }.stored_clocks(), "{width} x {height}");
        assert!(rounds.len() > 1 && rounds.iter().all(|clocks| *clocks == u64::from((width + overhead) * height)));
    }
}

#[test]
fn a_chain_of_no_units_and_a_line_without_overhead_are_refused_in_a_sentence() {
    let problem = |units, overhead| {
        elaborate(&GfbSequencer { screen: Screen::VC1, units, overhead }).unwrap_err().0[0].message.clone()
    };
    assert_eq!(problem(0, 20), "`units` of `GfbSequencer` is 0: it has to be at least 1");
    assert_eq!(problem(16, 0), "`overhead` of `GfbSequencer` is 0: it has to be at least 1");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    /// Compared with the number of clocks since the restart (VC1-TM, VC1-FREE), with restarts and resets at any time.
    #[test]
    fn the_scan_follows_the_timetable(
        (width, height, units, overhead) in (1..9u64, 1..6u64, 1..5u64, 1..7u64),
        restarts in prop::collection::vec((prop::bool::weighted(0.02), prop::bool::weighted(0.01)), 1..500),
        seed in any::<u64>(),
    ) {
        let screen = Screen { width: width as u32, height: height as u32 };
        let sequencer = GfbSequencer { screen, units: units as u32, overhead: overhead as u32 };
        let mut sim = Simulation::of(&sequencer).unwrap().seeded(seed);
        sim.reset();
        let pixels = width * height;
        // The clocks since a restart, and the number of them in which the chain advanced. The clock after a reset is a
        // restart.
        let (mut since, mut advanced, mut first, mut later) = (None, 0, 0, 0);
        for (restart, reset) in restarts {
            sim.drive(GfbSequencerIn { restart: restart.into() });
            let o = sim.read_u64();
            let enable = since.is_some_and(|clock: u64| clock < 2 || (clock - 2) % (width + overhead) < width);
            prop_assert_eq!((o.scan.restart == 1, o.scan.enable == 1), (restart || since.is_none(), enable));
            prop_assert_eq!((o.feed, o.blank == 1), (advanced % pixels, advanced < pixels));
            let fresh = advanced >= 2 + 4 * units;
            prop_assert_eq!((o.stores == 1, o.stale == 1), (enable && fresh, enable && !fresh));
            if since.is_none() {
                prop_assert_eq!(o.store, 0);
            }
            if o.stores == 1 {
                prop_assert_eq!(o.store, (advanced - 2 - 4 * units) % pixels);
            }
            let ends = enable && advanced % pixels == pixels - 1;
            first += u64::from(ends && advanced < pixels);
            later += u64::from(ends && advanced >= pixels);
            sim.step();
            (since, advanced) = match since {
                Some(clock) if !restart => (Some(clock + 1), advanced + u64::from(enable)),
                _ => (Some(0), 0),
            };
            if reset {
                sim.reset();
                (since, advanced) = (None, 0);
            }
        }
        prop_assert_eq!(sim.covered("a first round ends").unwrap(), first);
        prop_assert_eq!(sim.covered("a later round ends").unwrap(), later);
    }
}
