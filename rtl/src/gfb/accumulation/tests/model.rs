//! Random pictures, passes and pauses, clock by clock on both clocks, against sums in plain software.

use std::cell::RefCell;

use proptest::prelude::*;
use tilewright_sim::monitor;

use super::*;

/// The buffer by its rules.
struct Plain {
    /// Nothing is known about a pixel before a first pass has reached it.
    sums: Vec<Option<[u64; 3]>>,
    first: bool,
    reads: Option<usize>,
    stores: Option<usize>,
}

impl Plain {
    /// One edge of the merger.
    fn clock(&mut self, start: bool, first: bool, word: u64) {
        if let Some(pixel) = self.stores {
            let so_far = if self.first { Some([0; 3]) } else { self.sums[pixel] };
            let components = [16, 8, 0].map(|shift| word >> shift & 0xff);
            self.sums[pixel] = so_far.map(|sums| std::array::from_fn(|place| sums[place] + components[place]));
        }
        self.stores = self.reads;
        self.reads = match self.reads {
            Some(pixel) => Some(pixel + 1).filter(|pixel| *pixel < self.sums.len()),
            None => start.then_some(0),
        };
        if start {
            self.first = first;
        }
    }

    fn busy(&self) -> bool {
        self.reads.is_some() || self.stores.is_some()
    }

    /// The average at a pixel, as far as it is known.
    fn colour(&self, pixel: usize, passes: u64) -> Option<u64> {
        let average = |sum: u64| ((sum + passes / 2) / passes) & 0xff;
        self.sums[pixel].map(|sums| sums.into_iter().fold(0, |colour, sum| colour << 8 | average(sum)))
    }
}

#[derive(Debug, Clone)]
struct Case {
    screen: Screen,
    passes: Passes,
    /// Whole frames: the pause before each pass, and its words.
    frames: Vec<Vec<(u64, Vec<u64>)>>,
    /// What the display reads, over and over.
    addresses: Vec<usize>,
}

fn word() -> impl Strategy<Value = u64> {
    let component = || prop_oneof![Just(0), Just(255), 0..256u64];
    (0..1u64 << 24, component(), component(), component())
        .prop_map(|(depth, red, green, blue)| depth << 24 | red << 16 | green << 8 | blue)
}

fn case() -> impl Strategy<Value = Case> {
    let passes = prop::sample::select(Passes::ALL);
    (1..6u32, 1..5u32, passes).prop_flat_map(|(width, height, passes)| {
        let pixels = (width * height) as usize;
        let pass = (0..4u64, prop::collection::vec(word(), pixels));
        let count = passes.count() as usize;
        let frames = prop::collection::vec(prop::collection::vec(pass, 1..=count), 1..3);
        let addresses = prop::collection::vec(0..pixels, 1..60);
        (frames, addresses).prop_map(move |(frames, addresses)| Case {
            screen: Screen { width, height },
            passes,
            frames,
            addresses,
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// Checks both clocks at every clock: the address of the pass, `busy`, and what the display sees.
    #[test]
    fn the_average_is_that_of_the_sums(case in case(), seed in any::<u64>()) {
        let Case { screen, passes, frames, addresses } = case;
        let mut sim = Simulation::of(&Accumulation { screen, crt: CRT }).unwrap().seeded(seed);
        sim.reset();
        let pixels = screen.pixels() as usize;
        let plain = RefCell::new(Plain { sums: vec![None; pixels], first: false, reads: None, stores: None });
        sim.set(sim.i.passes, passes.code());
        let (i, o) = (sim.i, sim.o);
        let t = sim.testbench();
        let (merge, crt) = (t.on(MERGE), t.on(CRT));

        // One clock of the merger; the global frame buffer returns the requested word one clock later.
        let clock = async |start: bool, first: bool, picture: &[u64]| {
            merge.set(i.start, start);
            merge.set(i.first, first);
            merge.step().await;
            let mut plain = plain.borrow_mut();
            assert_eq!(merge.get_u64(o.busy) == 1, plain.busy());
            assert_eq!(merge.get_u64(o.address) as usize, plain.reads.unwrap_or(0));
            plain.clock(start, first, merge.get_u64(i.word));
            merge.set(i.word, picture[merge.get_u64(o.address) as usize]);
        };
        let host = async {
            merge.step().await;
            for passes in &frames {
                for (number, (pause, picture)) in passes.iter().enumerate() {
                    for _ in 0..*pause {
                        clock(false, false, picture).await;
                    }
                    clock(true, number == 0, picture).await;
                    // The clocks that a pass should take.
                    for _ in 0..pixels + 1 {
                        clock(false, true, picture).await;
                    }
                    assert!(!plain.borrow().busy());
                }
            }
            // Until the display has seen all of it.
            for _ in 0..2 * pixels {
                clock(false, false, &frames[0][0].1).await;
            }
        };
        let display = async {
            let mut expected = None;
            for address in addresses.iter().copied().chain(0..pixels).cycle() {
                crt.set(i.read_address, address as u64);
                crt.step().await;
                if let Some(expected) = expected {
                    assert_eq!(crt.get_u64(o.colour), expected);
                }
                expected = plain.borrow().colour(address, passes.count().into());
            }
        };
        t.run((host, monitor(display)));
    }
}
