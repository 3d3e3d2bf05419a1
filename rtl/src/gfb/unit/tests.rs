//! Frames of several rounds, with a chain in software.

use std::collections::VecDeque;

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::*;
use crate::gfb::{Blanking, SCAN_LATENCY};

const BLANK: u64 = 0xffffff << 24;

/// A global frame buffer with a chain in software, which merges what enters it with an image.
struct Bench {
    sim: Simulation<GfbUnitIn, GfbUnitOut>,
    unit: GfbUnit,
    chain: VecDeque<u64>,
    /// What the chain merges with, one in each round from the first on.
    images: Vec<Vec<u64>>,
    first: usize,
    /// Clocks with `enable` since the restart.
    advanced: usize,
    /// What the display got in the refresh under way, and in those before.
    refresh: Vec<u64>,
    refreshes: Vec<Vec<u64>>,
    frame_time: u64,
}

fn unit(width: u32, height: u32, units: u32, overhead: u32) -> GfbUnit {
    let display = Display { period: Period::ps(12_002), blanking: Blanking::AtStart };
    GfbUnit { screen: Screen { width, height }, units, overhead, display }
}

impl Bench {
    /// From any values in the banks, and in registers without a reset.
    fn new(unit: GfbUnit, seed: u64) -> Bench {
        let mut sim = Simulation::of(&unit).unwrap().seeded(seed);
        sim.reset();
        sim.set(sim.i.host.background, BLANK);
        let chain = VecDeque::from(vec![0; unit.sequencer().chain() as usize]);
        let frame_time = unit.read_out().refresh_clocks() * unit.display.period.picoseconds();
        let (images, refresh, refreshes) = (Vec::new(), Vec::new(), Vec::new());
        Bench { sim, unit, chain, images, first: 0, advanced: 0, refresh, refreshes, frame_time }
    }

    fn pixels(&self) -> usize {
        self.unit.screen.pixels() as usize
    }

    /// A clock of the merger, with those of the display in it.
    fn clock(&mut self) {
        self.sim.set(self.sim.i.merged, self.chain[0]);
        let scan = self.sim.o.scan;
        let [restart, enable] = [scan.restart, scan.enable].map(|port| self.sim.get_u64(port) == 1);
        if enable {
            let place = self.advanced.checked_sub(SCAN_LATENCY as usize);
            let (round, pixel) = place.map_or((0, usize::MAX), |place| (place / self.pixels(), place % self.pixels()));
            let image = round.checked_sub(self.first).and_then(|number| self.images.get(number));
            let sample = image.and_then(|image| image.get(pixel)).unwrap_or(&u64::MAX);
            self.chain.push_back(self.sim.get_u64(self.sim.o.left).min(*sample));
            self.chain.pop_front();
            self.advanced += 1;
        }
        if restart {
            self.advanced = 0;
        }
        let end = self.sim.cycles(MERGE).unwrap() + 1;
        while self.sim.cycles(MERGE).unwrap() < end {
            let shown = self.sim.cycles("crt").unwrap();
            self.sim.step();
            if self.sim.cycles("crt").unwrap() > shown && self.sim.get_u64(self.sim.o.pixel.valid) == 1 {
                self.refresh.push(self.sim.get_u64(self.sim.o.pixel.rgb));
                if self.refresh.len() == self.pixels() {
                    self.refreshes.push(std::mem::take(&mut self.refresh));
                }
            }
        }
    }

    /// Merges with the images, one in each round that is still to come, and swaps at the next blanking after them.
    fn frame(&mut self, images: &[Vec<u64>]) {
        self.images = images.to_vec();
        self.first = self.advanced.div_ceil(self.pixels());
        let chain = self.unit.sequencer().chain() as usize;
        let end = SCAN_LATENCY as usize + (self.first + images.len()) * self.pixels() + chain;
        while self.advanced <= end || self.sim.get_u64(self.sim.o.blanking) == 0 {
            self.clock();
        }
        self.images.clear();
        self.sim.set(self.sim.i.swap, 1);
        self.clock();
        self.sim.set(self.sim.i.swap, 0);
    }

    /// The bank on display, through the host's port.
    fn picture(&mut self) -> Vec<u64> {
        let mut picture = Vec::new();
        for pixel in 0..self.pixels() {
            self.sim.set(self.sim.i.host.read_address, pixel as u64);
            self.clock();
            picture.push(self.sim.get_u64(self.sim.o.view.read_word));
        }
        picture
    }
}

#[test]
fn a_later_round_feeds_the_chain_with_what_the_first_has_stored() {
    let mut bench = Bench::new(unit(7, 1, 1, 1), 7);
    bench.images = vec![vec![5, 6, 7, 5, 6, 7, 8], vec![9, 1, 9, 9, 9, 2, 9]];
    let mut left = Vec::new();
    for _ in 0..40 {
        if bench.sim.get_u64(bench.sim.o.scan.enable) == 1 && bench.advanced >= 2 {
            left.push(bench.sim.get_u64(bench.sim.o.left));
        }
        bench.clock();
    }
    assert_eq!(left[..7], [BLANK; 7]);
    assert_eq!(left[7..14], [5, 6, 7, 5, 6, 7, 8]);
    assert_eq!(left[14..21], [5, 1, 7, 5, 6, 2, 8]);
}

#[test]
fn a_pixel_that_is_changed_after_a_swap_is_an_error() {
    let mut bench = Bench::new(unit(7, 2, 2, 1), 7);
    bench.frame(&[vec![9; 14]]);
    // The chain changes a pixel that entered it before the swap, and whose bank is on display now.
    bench.chain.iter_mut().for_each(|word| *word = 3);
    bench.sim.set(bench.sim.i.merged, 3);
    let problem = (0..100).find_map(|_| bench.sim.try_step().err()).unwrap().to_string();
    assert!(
        problem.contains("a pixel that entered the chain before a swap is the word that its bank has"),
        "{problem}"
    );
}

#[test]
fn a_swap_while_pixels_are_read_is_an_error() {
    let mut bench = Bench::new(unit(7, 6, 2, 1), 7);
    while bench.sim.get_u64(bench.sim.o.pixel.valid) == 0 {
        bench.clock();
    }
    bench.sim.set(bench.sim.i.swap, 1);
    let problem = (0..30).find_map(|_| bench.sim.try_step().err()).unwrap().to_string();
    assert!(problem.contains("no refresh shows two frames"), "{problem}");
}

#[test]
fn a_chain_longer_than_a_frame_is_refused_in_a_sentence() {
    assert!(unit(16, 8, 31, 20).checked().is_ok());
    assert_eq!(
        unit(16, 8, 32, 20).checked().unwrap_err().to_string(),
        "`units` of `GfbUnit` is 32: it has to be from 1 to 31. The chain and the way into it are shorter than the screen: \
         a pixel is stored before it is fed again."
    );
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// Frames of some rounds each. The display shows the frame before, whole, in each refresh.
    #[test]
    fn rounds_accumulate_behind_the_picture_on_display(
        (width, height, units, overhead) in (4..9u32, 2..6u32, 1..2u32, 1..4u32),
        frames in prop::collection::vec(prop::collection::vec(prop::collection::vec(0..2 * BLANK, 48), 1..4), 1..4),
        seed in any::<u64>(),
    ) {
        let mut bench = Bench::new(unit(width, height, units, overhead), seed);
        let mut filled = Vec::new();
        for rounds in &frames {
            let images: Vec<Vec<u64>> = rounds.iter().map(|image| image[..bench.pixels()].to_vec()).collect();
            bench.frame(&images);
            // The refresh before the swap was not of this frame.
            let before = bench.refreshes.len();
            let is_same = |refresh: &Vec<u64>| filled.iter().zip(refresh).all(|(word, rgb)| word & 0xffffff == *rgb);
            if !filled.is_empty() {
                prop_assert!(bench.refreshes[1..].iter().all(is_same), "a refresh of the frame before");
            }
            filled = vec![BLANK; bench.pixels()];
            for image in &images {
                filled.iter_mut().zip(image).for_each(|(old, new)| *old = *new.min(old));
            }
            prop_assert_eq!(&bench.picture(), &filled);
            prop_assert!(bench.refreshes.len() >= before);
            bench.refreshes = Vec::from([vec![]]);
        }
        // A refresh later the last frame has been shown as a whole.
        let end = bench.sim.time() + 2 * bench.frame_time;
        while bench.sim.time() < end {
            bench.clock();
        }
        let shown: Vec<u64> = filled.iter().map(|word| word & 0xffffff).collect();
        prop_assert!(bench.refreshes.len() > 1 && bench.refreshes[1..].iter().all(|refresh| *refresh == shown));
    }
}
