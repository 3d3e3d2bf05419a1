//! The local frame buffer unit against a plain software model, clock by clock.

mod swaps;

use std::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;
use tilewright_hdl::elaborate;
use tilewright_sim::{Port, Simulation};

use super::*;
use crate::parameter::Screen;

const EMPTY: u64 = (1 << WORD) - 1;

/// A virtual local frame buffer in software: a map from pixel to word, and the patches that have a page.
#[derive(Default)]
struct Model {
    pixels: BTreeMap<(u64, u64), u64>,
    resident: BTreeSet<u64>,
}

impl Model {
    fn draw(&mut self, patch: u64, pixel: (u64, u64), word: u64) {
        self.resident.insert(patch);
        let kept = self.pixels.entry(pixel).or_insert(EMPTY);
        *kept = word.min(*kept);
    }
}

/// A unit with its processor, a scan that runs round after round, and the model.
struct Bench {
    sim: Simulation<LfbUnitIn, LfbUnitOut>,
    unit: LfbUnit,
    /// The front buffer.
    model: Model,
    /// The pixels that the back buffer has to send, and those it has sent.
    expected: BTreeMap<(u64, u64), u64>,
    sent: BTreeMap<(u64, u64), u64>,
    /// The unit's place in the chain.
    position: u32,
    /// The number of pixels that the scan has advanced since its restart.
    advanced: u64,
    /// The number of pixels sent since the last swap.
    since_swap: u64,
    /// Clocks in which the scan advanced with nothing left to send.
    again: u64,
    overflows: u64,
    /// The clock in which the first stage ends its last look-up, and the first clock in which it can read the table
    /// again.
    found: u64,
    table_free: u64,
}

impl Bench {
    fn new(screen: Screen, edge: u32, pages: u32, position: u32) -> Bench {
        let unit = LfbUnit { patches: Patches::new(screen, edge).unwrap(), pages };
        // Registers without a reset start with arbitrary values.
        let mut sim = Simulation::of(&unit).unwrap().seeded(7);
        sim.reset();
        let (x, y) = (sim.i.preset.x, sim.i.preset.y);
        let preset = ScanCounter::preset(screen, position);
        sim.set(x, preset.x);
        sim.set(y, preset.y);
        sim.set(sim.i.scan.restart, 1);
        assert_eq!(sim.get_u64(sim.o.sending), 0, "nothing is to be sent after a reset");
        sim.step_clock(MERGE, 1);
        sim.set(sim.i.scan.restart, 0);
        sim.set(sim.i.scan.enable, 1);
        Bench {
            sim,
            unit,
            model: Model::default(),
            expected: BTreeMap::new(),
            sent: BTreeMap::new(),
            position,
            advanced: 0,
            since_swap: u64::from(screen.pixels()),
            again: 0,
            overflows: 0,
            found: 0,
            table_free: 0,
        }
    }

    fn frame(&self) -> u64 {
        self.unit.patches.screen().pixels().into()
    }

    fn now(&self) -> u64 {
        self.sim.cycles(PE).unwrap()
    }

    /// Lets a clock of the processor pass, and takes the merger's words meanwhile.
    fn clock(&mut self) {
        let now = self.now();
        let (i, o) = (&self.sim.i, &self.sim.o);
        let (request, clear, says) = (i.request, i.clear, [o.draws, o.clears]);
        let goes = [[request.valid, request.ready], [clear.valid, clear.ready]];
        let goes = goes.map(|both| both.iter().all(|port| self.sim.get_u64(*port) == 1));
        assert_eq!(says.map(|port| self.sim.get_u64(port) == 1), goes, "`draws` and `clears` report what is accepted");
        while self.now() == now {
            let word = self.sim.get_u64(self.sim.o.word);
            let merged = self.sim.cycles(MERGE).unwrap();
            self.sim.step();
            if self.sim.cycles(MERGE).unwrap() > merged {
                self.merge(word);
            }
        }
    }

    /// An edge of the merge clock has passed, at which the merging unit saw `word`.
    fn merge(&mut self, word: u64) {
        let scan = self.sim.i.scan;
        if self.sim.get_u64(scan.enable) == 1 {
            self.advanced += 1;
            self.again += u64::from(self.sim.get_u64(self.sim.o.sending) == 0);
            // The word of a pixel comes 2 clocks after the counter shows the pixel: 3 edges have passed.
            let first = 3 + 4 * u64::from(self.position);
            match self.advanced.checked_sub(first) {
                Some(number) => self.merge_pixel(number % self.frame(), word),
                None => assert_eq!(word, EMPTY, "nothing is sent before the first whole frame"),
            }
        }
        if self.sim.get_u64(scan.restart) == 1 {
            self.advanced = 0;
        }
        // The chain pauses now and then, as it does after each line.
        let merged = self.sim.cycles(MERGE).unwrap();
        self.sim.set(scan.restart, 0);
        self.sim.set(scan.enable, merged % 11 > 1);
        // The merger learns of a swap some clocks later.
        let is_sent = self.since_swap <= 4 || self.since_swap >= self.frame();
        assert!(is_sent || self.sim.get_u64(self.sim.o.sending) == 1, "`sending` is low too early");
    }

    fn merge_pixel(&mut self, number: u64, word: u64) {
        self.since_swap += 1;
        let width = u64::from(self.unit.patches.screen().width);
        let pixel = (number % width, number / width);
        if word != EMPTY {
            assert_eq!(self.sent.insert(pixel, word), None, "pixel {pixel:?} is sent twice");
        }
    }

    /// Draws as soon as the access is accepted; returns the clock of the acceptance. After an overflow, continues with
    /// the next buffer.
    fn draw(&mut self, (x, y): (u64, u64), word: u64) -> u64 {
        self.sim.set(self.sim.i.request.valid, 1);
        self.sim.set(self.sim.i.request.x, x);
        self.sim.set(self.sim.i.request.y, y);
        self.sim.set(self.sim.i.request.word, word);
        let due = self.now().max(self.found);
        self.wait_until(self.sim.i.request.ready);
        let accepted = self.now();
        assert_eq!(accepted, due, "a request is accepted when the one before has its page");
        self.clock();
        self.sim.set(self.sim.i.request.valid, 0);

        let patch = self.unit.patches.place(x as u32, y as u32).patch;
        if self.model.resident.len() == self.unit.pages as usize && !self.model.resident.contains(&patch) {
            self.clock();
            self.clock();
            assert_eq!(self.sim.get_u64(self.sim.o.overflow), 1, "the third clock shows the overflow");
            self.overflows += 1;
            self.swap();
            self.sim.set(self.sim.i.resume, 1);
            self.clock();
            self.sim.set(self.sim.i.resume, 0);
        }
        // Read, examine, and for a miss allocate: the next clock is the last.
        let miss = u64::from(!self.model.resident.contains(&patch));
        self.found = self.now().max(self.table_free) + 2 + miss;
        self.model.draw(patch, (x, y), word);
        accepted
    }

    /// Lets clocks pass until an output is high. This takes at most 9: a clear and both stages, or a swap.
    fn wait_until(&mut self, port: Port) {
        let start = self.now();
        while self.sim.get(port) != 1 {
            assert!(self.now() < start + 9, "the unit does not go on");
            self.clock();
        }
    }

    /// Swaps when the back buffer has been sent, and clears the patch table.
    fn swap(&mut self) {
        if self.sim.get(self.sim.o.overflow) != 1 {
            self.wait_until(self.sim.o.idle);
        }
        assert_eq!(self.sim.get_u64(self.sim.o.pages_used), self.model.resident.len() as u64);
        self.finish_scan();
        self.sim.set(self.sim.i.swap, 1);
        self.clock();
        self.sim.set(self.sim.i.swap, 0);
        self.expected = std::mem::take(&mut self.model).pixels;
        self.since_swap = 0;
        for patch in 0..self.unit.patches.count() {
            self.clear(patch);
        }
    }

    /// Clears an entry of the patch table as soon as the request is accepted; returns the clock of the acceptance.
    fn clear(&mut self, patch: u32) -> u64 {
        self.sim.set(self.sim.i.clear.valid, 1);
        self.sim.set(self.sim.i.clear.patch, patch);
        self.wait_until(self.sim.i.clear.ready);
        let accepted = self.now();
        self.clock();
        self.sim.set(self.sim.i.clear.valid, 0);
        self.table_free = accepted + 3;
        accepted
    }

    /// Waits until the scan has reached this position in a frame.
    fn wait_for_scan(&mut self, advanced: u64) {
        while self.advanced % self.frame() != advanced {
            self.clock();
        }
    }

    /// Waits until every pixel of the back buffer has been sent, and checks it against what was drawn. The merger
    /// follows a swap after 2 clocks, and a word comes 2 clocks after its pixel is counted.
    fn finish_scan(&mut self) {
        while self.sim.get_u64(self.sim.o.sending) == 1 || self.since_swap < self.frame() {
            assert!(self.since_swap <= self.frame() + 5, "`sending` is high too long");
            self.clock();
        }
        assert_eq!(std::mem::take(&mut self.sent), std::mem::take(&mut self.expected));
    }

    /// The number of words in each buffer that are not empty.
    fn words_held(&self) -> [usize; 2] {
        let words = self.unit.pages * self.unit.patches.pixels();
        [0, 1].map(|buffer| {
            let word = |i| self.sim.peek_memory("u_image_memory.words", 2 * i + buffer).unwrap();
            (0..words).filter(|i| word(*i).to_u64() != Some(EMPTY)).count()
        })
    }
}

/// The clocks from each acceptance to the next.
fn intervals(accepted: &[u64]) -> Vec<u64> {
    accepted.windows(2).map(|pair| pair[1] - pair[0]).collect()
}

const SMALL: Screen = Screen { width: 24, height: 20 };

#[test]
fn hits_are_accepted_every_3_clocks_and_misses_every_4() {
    let mut bench = Bench::new(SMALL, 4, 30, 0);
    let misses: Vec<u64> = (0..6).map(|i| bench.draw((4 * i, 0), 9)).collect();
    assert_eq!(intervals(&misses), [4; 5]);
    bench.wait_until(bench.sim.o.idle);
    let hits: Vec<u64> = (0..24).map(|x| bench.draw((x, 1), 9)).collect();
    assert_eq!(intervals(&hits), [3; 23]);
    bench.wait_until(bench.sim.o.idle);
    let mixed = [(0, 2), (0, 4), (0, 3), (4, 4), (8, 4), (5, 4)].map(|pixel| bench.draw(pixel, 9));
    assert_eq!(intervals(&mixed), [3, 4, 3, 4, 4]);
}

#[test]
fn a_clear_takes_3_clocks() {
    let mut bench = Bench::new(SMALL, 4, 30, 0);
    let accepted: Vec<u64> = (0..5).map(|patch| bench.clear(patch)).collect();
    assert_eq!(intervals(&accepted), [3; 4]);
}

#[test]
fn an_overflow_holds_the_request_until_the_buffers_are_swapped() {
    let mut bench = Bench::new(SMALL, 8, 2, 0);
    for (pixel, word) in [((0, 0), 3), ((8, 0), 4), ((1, 1), 5), ((16, 0), 6), ((17, 1), 7)] {
        bench.draw(pixel, word);
    }
    assert_eq!(bench.overflows, 1);
    assert_eq!(bench.expected, BTreeMap::from([((0, 0), 3), ((8, 0), 4), ((1, 1), 5)]));
    bench.swap();
    assert_eq!(bench.expected, BTreeMap::from([((16, 0), 6), ((17, 1), 7)]));
    bench.finish_scan();
}

#[test]
fn after_a_whole_scan_the_back_buffer_is_empty() {
    let mut bench = Bench::new(SMALL, 4, 30, 0);
    for y in 0..20 {
        for x in 0..24 {
            bench.draw((x, y), 100 * y + x);
        }
    }
    bench.swap();
    bench.draw((3, 3), 1);
    bench.wait_until(bench.sim.o.idle);
    assert!(bench.words_held()[0] > 300, "{:?}: the scan is not far yet", bench.words_held());
    bench.finish_scan();
    assert_eq!(bench.words_held(), [0, 1]);
    (0..2000).for_each(|_| bench.clock());
    assert!(bench.again > bench.frame(), "whole frames are scanned again");
    assert_eq!(bench.sim.covered("a pixel is scanned again after it was sent").unwrap(), bench.again);
}

#[test]
fn of_the_words_drawn_on_a_pixel_the_smallest_is_sent() {
    let mut bench = Bench::new(SMALL, 16, 4, 3);
    for word in [8, 5, 7, 5, 6] {
        bench.draw((23, 19), word);
    }
    bench.swap();
    assert_eq!(bench.expected, BTreeMap::from([((23, 19), 5)]));
    bench.finish_scan();
}

#[test]
#[should_panic(expected = "the buffers are swapped only when idle or in overflow")]
fn swapping_while_a_request_is_under_way_is_an_error() {
    let mut bench = Bench::new(SMALL, 4, 30, 0);
    bench.draw((0, 0), 1);
    bench.sim.set(bench.sim.i.swap, 1);
    bench.clock();
}

/// A request takes a look-up, and 3 clocks in the image memory.
#[test]
fn a_request_is_under_way_until_its_word_is_written() {
    let mut bench = Bench::new(SMALL, 4, 30, 0);
    for (pixel, look_up) in [((0, 0), 4), ((1, 0), 3)] {
        let accepted = bench.draw(pixel, 9);
        for clock in 1..look_up + 4 {
            assert_eq!(bench.sim.get_u64(bench.sim.o.idle), 0, "clock {clock}");
            bench.clock();
        }
        assert_eq!((bench.sim.get_u64(bench.sim.o.idle), bench.now()), (1, accepted + look_up + 4));
    }
}

#[test]
fn every_size_elaborates() {
    for edge in [4, 8, 16] {
        for pages in [2, 75, 600, 1200] {
            elaborate(&LfbUnit { patches: Patches::new(Screen::VC1, edge).unwrap(), pages }).unwrap();
        }
    }
}

#[test]
fn a_page_for_each_patch_is_the_most() {
    let unit = |pages| LfbUnit { patches: Patches::new(Screen { width: 16, height: 8 }, 4).unwrap(), pages }.checked();
    assert!(unit(2).is_ok() && unit(8).is_ok() && unit(1).is_err());
    assert_eq!(
        unit(9).unwrap_err().to_string(),
        "`pages` of `LfbUnit` is 9: it has to be from 2 to 8. A patch of the screen has one page at most."
    );
}

/// The processor's next action.
#[derive(Debug, Clone)]
enum Step {
    Draw { x: u64, y: u64, word: u64 },
    Wait(u8),
    Swap,
}

fn step(screen: Screen) -> impl Strategy<Value = Step> {
    let draw = (0..u64::from(screen.width), 0..u64::from(screen.height), 0..4u64, 0..4u64);
    prop_oneof![
        30 => draw.prop_map(|(x, y, z, rgb)| Step::Draw { x, y, word: z << 24 | rgb }),
        3 => (1..12u8).prop_map(Step::Wait),
        1 => Just(Step::Swap),
    ]
}

fn run() -> impl Strategy<Value = (Screen, Vec<Step>)> {
    (17..40u32, 17..30u32).prop_flat_map(|(width, height)| {
        let screen = Screen { width, height };
        (Just(screen), prop::collection::vec(step(screen), 0..80))
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn what_is_sent_is_what_was_drawn(
        (screen, steps) in run(),
        edge in prop::sample::select(vec![4, 8, 16]),
        pages in 2..12u32,
        position in 0..4u32,
    ) {
        let pages = pages.min(Patches::new(screen, edge).unwrap().count());
        let mut bench = Bench::new(screen, edge, pages, position);
        for step in steps {
            match step {
                Step::Draw { x, y, word } => {
                    bench.draw((x, y), word);
                }
                Step::Wait(clocks) => (0..clocks).for_each(|_| bench.clock()),
                Step::Swap => bench.swap(),
            }
        }
        bench.swap();
        bench.finish_scan();
        prop_assert_eq!(bench.words_held(), [0, 0]);
    }
}
