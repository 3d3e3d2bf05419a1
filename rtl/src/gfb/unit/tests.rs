//! Frames of several rounds, with a software chain and concurrent host accesses.

mod accumulation;

use std::collections::VecDeque;

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::*;
use crate::gfb::{Blanking, SCAN_LATENCY};

const BLANK: u64 = 0xffffff << 24;

/// The host's action in each clock: nothing, or an access to a pixel, which is a write if there is a word.
type Accesses = Vec<Option<(usize, Option<u64>)>>;

/// A host that accesses the unit while frames are made, and the expected contents of the bank on display.
struct HostModel {
    /// The accesses are repeated without end.
    accesses: Accesses,
    next: usize,
    /// Nothing is known about a pixel before it is written or the first frame is on display.
    bank: Vec<Option<u64>>,
    /// The word that it read last, which stays until it reads another one.
    last: Option<u64>,
}

/// A global frame buffer with a software chain, which merges the pixels that enter it with an image.
struct Bench {
    sim: Simulation<GfbUnitIn, GfbUnitOut>,
    unit: GfbUnit,
    chain: VecDeque<u64>,
    /// The images to merge, one in each round from the first on.
    images: Vec<Vec<u64>>,
    first: usize,
    /// Clocks with `enable` since the restart.
    advanced: usize,
    /// What the display got in the current refresh, and in earlier ones.
    refresh: Vec<u64>,
    refreshes: Vec<Vec<u64>>,
    frame_time: u64,
}

fn unit(width: u32, height: u32, units: u32, overhead: u32) -> GfbUnit {
    let display = Display { period: Period::ps(12_002), blanking: Blanking::AtStart };
    GfbUnit { screen: Screen { width, height }, units, overhead, display, accumulation: false }
}

impl Bench {
    /// Starts with arbitrary values in the banks and in registers without a reset.
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

    /// Runs clocks of the merger until the end condition; in each, the host acts as its model says.
    fn with_host(&mut self, model: &mut HostModel, mut ends: impl FnMut(&mut Bench) -> bool) {
        while !ends(self) {
            let access = model.accesses[model.next % model.accesses.len()];
            model.next += 1;
            match access {
                Some((pixel, word)) => self.host_access(model, pixel % self.pixels(), word),
                None => {
                    self.clock();
                    assert_eq!(self.sim.get_u64(self.sim.o.view.read_valid), 0);
                }
            }
            let word = self.sim.get_u64(self.sim.o.view.read_word);
            assert!(model.last.is_none_or(|last| word == last), "the word that was read last is {word:x}");
        }
    }

    /// A clock in which the host writes this word, or reads.
    fn host_access(&mut self, model: &mut HostModel, pixel: usize, word: Option<u64>) {
        let read = self.access(pixel, word);
        assert_eq!(read.is_some(), word.is_none());
        match word {
            Some(_) => model.bank[pixel] = word,
            None => {
                assert!(model.bank[pixel].is_none_or(|word| read == Some(word)), "pixel {pixel}");
                model.last = read;
            }
        }
    }

    /// A clock of the merger, with the display's clocks in it.
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

    /// Merges the images, one in each remaining round, and swaps at the next blanking after them.
    fn frame(&mut self, images: &[Vec<u64>]) {
        self.merge(images);
        self.sim.set(self.sim.i.swap, 1);
        self.clock();
        self.sim.set(self.sim.i.swap, 0);
    }

    /// Like [`Bench::frame`], up to the swap.
    fn merge(&mut self, images: &[Vec<u64>]) {
        let end = self.begin(images);
        while !self.may_swap(end) {
            self.clock();
        }
        self.images.clear();
    }

    /// Starts merging the images; returns how far the scan is when all is stored.
    fn begin(&mut self, images: &[Vec<u64>]) -> usize {
        self.images = images.to_vec();
        self.first = self.advanced.div_ceil(self.pixels());
        let chain = self.unit.sequencer().chain() as usize;
        SCAN_LATENCY as usize + (self.first + images.len()) * self.pixels() + chain
    }

    fn may_swap(&mut self, end: usize) -> bool {
        self.advanced > end && self.sim.get_u64(self.sim.o.blanking) == 1
    }

    /// One host access, a write if there is a word; returns the word read, if `read_valid` is high.
    fn access(&mut self, address: usize, word: Option<u64>) -> Option<u64> {
        let accesses = self.sim.i.host.accesses;
        assert_eq!(self.sim.get_u64(accesses.ready), 1, "an access is taken in every clock");
        self.sim.set(accesses.valid, 1);
        self.sim.set(accesses.address, address as u64);
        self.sim.set(accesses.writes, word.is_some());
        self.sim.set(accesses.word, word.unwrap_or(0));
        self.clock();
        // The word is valid while the next access may be at the port.
        let view = self.sim.o.view;
        let read = (self.sim.get_u64(view.read_valid) == 1).then(|| self.sim.get_u64(view.read_word));
        self.sim.set(accesses.valid, 0);
        read
    }

    /// The next refresh that begins from now on.
    fn next_refresh(&mut self) -> Vec<u64> {
        let next = self.refreshes.len() + 1 + usize::from(!self.refresh.is_empty());
        while self.refreshes.len() < next {
            self.clock();
        }
        self.refreshes[next - 1].clone()
    }

    /// The bank on display, read through the host's port.
    fn picture(&mut self) -> Vec<u64> {
        let mut picture = Vec::new();
        for pixel in 0..self.pixels() {
            picture.push(self.access(pixel, None).unwrap());
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

/// A bit that crosses from one clock to another arrives two clocks of the destination later. A reset sets it on both
/// sides; the value of the source arrives some edges later.
fn know_of_each_other(phase: u32) {
    let mut bench = Bench::new(unit(7, 2, 1, 1), 7);
    let peek = |bench: &mut Bench, name| bench.sim.peek(name).unwrap().to_u64().unwrap();
    // A chain that changes nothing, with pixels that are 0; then a reset while both bits differ from their reset
    // values.
    bench.sim.set(bench.sim.i.host.background, 0);
    bench.frame(&[vec![0; 14]]);
    while ["window", "window_meta", "shown_bank"].map(|name| peek(&mut bench, name)) != [1, 1, 0] {
        bench.clock();
    }
    bench.sim.set(bench.sim.i.merged, 0);
    (0..phase).for_each(|_| bench.sim.step());
    bench.sim.reset();
    bench.advanced = 0;
    let (mut windows, mut banks) = ([0, 0], [1, 1]);
    assert_eq!(peek(&mut bench, "filled_bank"), 0);
    let mut swaps = 0;
    while swaps < 3 {
        let [merge, crt] = [MERGE.name, "crt"].map(|clock| bench.sim.cycles(clock).unwrap());
        let blanking = bench.sim.get_u64(bench.sim.o.blanking);
        assert_eq!((blanking, peek(&mut bench, "shown_bank")), (windows[0], banks[0]));
        let swap = bench.advanced > 40 && blanking == 1;
        bench.sim.set(bench.sim.i.swap, swap);
        let (window, bank) = (peek(&mut bench, "u_crt.window"), 1 - peek(&mut bench, "filled_bank"));
        bench.sim.step();
        if bench.sim.cycles(MERGE).unwrap() > merge {
            windows = [windows[1], window];
            swaps += u32::from(swap);
            bench.advanced = if swap { 0 } else { bench.advanced + 1 };
        }
        if bench.sim.cycles("crt").unwrap() > crt {
            banks = [banks[1], bank];
        }
    }
}

#[test]
fn the_display_and_the_swap_know_of_each_other_two_clocks_later() {
    (0..9).for_each(know_of_each_other);
}

#[test]
fn the_display_turns_to_the_other_bank_with_each_swap() {
    let mut bench = Bench::new(unit(7, 2, 1, 1), 7);
    for swaps in 1..4 {
        bench.frame(&[vec![swaps; 14]]);
        (0..3).for_each(|_| bench.clock());
        assert_eq!(bench.sim.covered("the display changes to the other bank").unwrap(), swaps);
    }
}

#[test]
fn a_reset_leaves_no_answer_and_begins_a_first_round() {
    let mut bench = Bench::new(unit(7, 2, 1, 1), 7);
    bench.sim.set(bench.sim.i.host.accesses.valid, 1);
    bench.sim.reset();
    let view = bench.sim.o.view;
    assert_eq!((bench.sim.get_u64(view.read_valid), bench.sim.get_u64(view.first_round)), (0, 1));
    while bench.advanced < 2 * bench.pixels() {
        assert_eq!(bench.sim.get_u64(view.first_round) == 1, bench.advanced < bench.pixels());
        bench.clock();
    }
}

#[test]
fn the_host_writes_and_reads_in_every_clock() {
    let mut bench = Bench::new(unit(7, 2, 1, 1), 7);
    bench.frame(&[(10..24).collect()]);
    assert_eq!(bench.access(3, None), Some(13));
    assert_eq!(bench.access(4, Some(99)), None);
    assert_eq!(bench.access(4, None), Some(99));
    assert_eq!(bench.access(5, None), Some(15));
    bench.access(6, Some(98));
    bench.clock();
    assert_eq!(bench.sim.get_u64(bench.sim.o.view.read_valid), 0);
    // The word stays until the next read, even across a swap.
    bench.frame(&[vec![50; 14]]);
    // The chain reads that bank meanwhile.
    for _ in 0..40 {
        bench.clock();
        assert_eq!(bench.sim.get_u64(bench.sim.o.view.read_word), 15);
    }
    assert_eq!(bench.sim.covered("the host reads in the clock after a write").unwrap(), 1);
}

#[test]
fn the_display_shows_what_the_host_writes_until_the_next_frame() {
    let mut bench = Bench::new(unit(7, 2, 1, 1), 7);
    bench.frame(&[(10..24).collect()]);
    bench.access(4, Some(99));
    bench.access(13, Some(98));
    let mut written: Vec<u64> = (10..24).collect();
    (written[4], written[13]) = (99, 98);
    assert_eq!(bench.next_refresh(), written);
    bench.frame(&[vec![50; 14]]);
    assert_eq!(bench.next_refresh(), [50; 14]);
    // The write is not visible when the bank is on display again, either.
    bench.frame(&[vec![60; 14]]);
    assert_eq!((bench.next_refresh(), bench.picture()), (vec![60; 14], vec![60; 14]));
}

#[test]
fn an_access_in_the_clock_of_a_swap_goes_to_the_frame_before() {
    for writes in [false, true] {
        let mut bench = Bench::new(unit(7, 2, 1, 1), 7);
        bench.frame(&[(10..24).collect()]);
        bench.merge(&[(30..44).collect()]);
        bench.sim.set(bench.sim.i.swap, 1);
        let read = bench.access(5, writes.then_some(99));
        bench.sim.set(bench.sim.i.swap, 0);
        assert_eq!(read, (!writes).then_some(15));
        assert_eq!(bench.access(5, None), Some(35));
        assert_eq!(bench.picture(), (30..44).collect::<Vec<u64>>());
        bench.access(5, Some(98));
        let written = bench.sim.covered("the host writes in the clock of a swap").unwrap();
        assert_eq!(written, u64::from(writes));
    }
}

#[test]
fn a_pixel_that_is_changed_after_a_swap_is_an_error() {
    let mut bench = Bench::new(unit(7, 2, 2, 1), 7);
    bench.frame(&[vec![9; 14]]);
    // The chain changes a pixel that entered it before the swap, and whose bank is now on display.
    bench.chain.iter_mut().for_each(|word| *word = 3);
    bench.sim.set(bench.sim.i.merged, 3);
    let problem = (0..100).find_map(|_| bench.sim.try_step().err()).unwrap().to_string();
    assert!(problem.contains("a pixel that entered the chain before a swap equals the word in its bank"), "{problem}");
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
        "`units` of `GfbUnit` is 32: it has to be from 1 to 31. The chain and the path into it are shorter than the screen, \
         so that a pixel is stored before it is fed again."
    );
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// Frames of some rounds each. In each refresh the display shows the previous frame, whole.
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
            // The refresh before the swap did not show this frame.
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
        // One refresh later the last frame has been shown whole.
        let end = bench.sim.time() + 2 * bench.frame_time;
        while bench.sim.time() < end {
            bench.clock();
        }
        let shown: Vec<u64> = filled.iter().map(|word| word & 0xffffff).collect();
        prop_assert!(bench.refreshes.len() > 1 && bench.refreshes[1..].iter().all(|refresh| *refresh == shown));
    }

    /// A host that reads and writes at all times, including the clock of a swap (VC1-HOSTP). Its writes are on display,
    /// and its words are not in the frames.
    #[test]
    fn the_host_has_a_port_of_the_picture_on_display(
        (width, height, units, overhead) in (4..9u32, 2..6u32, 1..2u32, 1..4u32),
        frames in prop::collection::vec(prop::collection::vec(0..2 * BLANK, 48), 1..4),
        accesses in prop::collection::vec(prop::option::weighted(0.8, (0..6usize, prop::option::of(0..1u64 << 48))), 1..200),
        spread in 1..11usize,
        seed in any::<u64>(),
        accumulates in any::<bool>(),
    ) {
        let unit = unit(width, height, units, overhead);
        // It adds nothing up, but has a port for that.
        let unit = if accumulates { accumulation::accumulating(unit) } else { unit };
        let mut bench = Bench::new(unit, seed);
        let accesses = accesses.into_iter().map(|it| it.map(|(pixel, word)| (spread * pixel, word))).collect();
        let mut model = HostModel { accesses, next: 0, bank: vec![None; bench.pixels()], last: None };
        for image in &frames {
            let image = image[..bench.pixels()].to_vec();
            let end = bench.begin(std::slice::from_ref(&image));
            bench.with_host(&mut model, |bench| bench.may_swap(end));
            bench.images.clear();
            bench.sim.set(bench.sim.i.swap, 1);
            let mut swaps = 0..=1;
            bench.with_host(&mut model, |_| swaps.next() == Some(1));
            bench.sim.set(bench.sim.i.swap, 0);
            model.bank = image.iter().map(|word| Some(*word.min(&BLANK))).collect();
            let end = bench.refreshes.len() + 2;
            bench.with_host(&mut model, |bench| bench.refreshes.len() == end);
            let colours: Vec<u64> = model.bank.iter().map(|word| word.unwrap() & 0xffffff).collect();
            prop_assert_eq!(bench.next_refresh(), colours);
        }
    }
}
