//! Where pixels are, and when.

use proptest::prelude::*;
use tilewright_blocks::*;
use tilewright_sim::Simulation;

/// All that is public of a scan.
#[derive(Debug, Clone, Copy)]
struct Parts {
    visible: u64,
    porches: [u64; 3],
    positive: bool,
}

impl Parts {
    fn scan(self) -> Scan {
        Scan::new(self.visible as u32, self.porches.map(|part| part as u32), self.positive)
    }

    fn total(self) -> u64 {
        self.visible + self.porches.iter().sum::<u64>()
    }

    fn level(self, place: u64) -> u64 {
        let start = self.visible + self.porches[0];
        u64::from((start..start + self.porches[1]).contains(&place) == self.positive)
    }
}

/// What is to be seen in a clock, as many after the first pixel.
fn expected(columns: Parts, rows: Parts, clock: u64) -> VideoTimingOut<u64> {
    // A row begins with its sync pulse.
    let pulse = columns.visible + columns.porches[0];
    let x = clock % columns.total();
    let y = (clock + columns.total() - pulse) / columns.total() % rows.total();
    let active = x < columns.visible && y < rows.visible;
    VideoTimingOut { x, y, active: active.into(), hsync: columns.level(x), vsync: rows.level(y) }
}

/// Counts, in a frame of a standard: visible pixels, clocks with a pulse of each kind, and falling edges of each.
#[test]
fn a_frame_of_vga() {
    let mut sim = Simulation::of(&VideoTiming::VGA).unwrap();
    sim.reset();
    sim.set(sim.i.enable, 1);
    let (mut visible, mut low, mut edges, mut before) = (0, [0, 0], [0, 0], [1, 1]);
    for _ in 0..800 * 525 {
        let out = sim.read_u64();
        let pulses = [out.hsync, out.vsync];
        visible += out.active;
        for (kind, pulse) in pulses.into_iter().enumerate() {
            low[kind] += 1 - pulse;
            edges[kind] += u64::from(pulse < before[kind]);
        }
        // Both pulses begin together.
        assert!(pulses[1] >= before[1] || pulses[0] < before[0], "{out:?}");
        before = pulses;
        sim.step();
    }
    assert_eq!((visible, low, edges), (640 * 480, [96 * 525, 2 * 800], [525, 1]));
    assert_eq!(sim.read_u64(), VideoTimingOut { x: 0, y: 0, active: 1, hsync: 1, vsync: 1 });
}

fn parts() -> impl Strategy<Value = Parts> {
    (1u64..9, 0u64..4, 1u64..4, 0u64..4, any::<bool>()).prop_map(|(visible, front, sync, back, positive)| Parts {
        visible,
        porches: [front, sync, back],
        positive,
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn screens_of_all_sizes(columns in parts(), rows in parts(), pauses in any::<u64>(), seed in any::<u64>()) {
        let mut sim = Simulation::of(&VideoTiming { columns: columns.scan(), rows: rows.scan() }).unwrap().seeded(seed);
        sim.reset();
        let mut clock = 0;
        for step in 0..2 * columns.total() * rows.total() + 70 {
            prop_assert_eq!(sim.read_u64(), expected(columns, rows, clock));
            let enable = pauses >> (step % 64) & 1;
            sim.drive(VideoTimingIn { enable });
            sim.step();
            clock += enable;
        }
    }
}

#[test]
#[should_panic(expected = "a scan has something visible and a sync pulse: each is 1 or more")]
fn a_line_without_a_pulse() {
    Scan::new(640, [16, 0, 48], false);
}
