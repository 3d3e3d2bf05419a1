//! The global frame buffer unit: leads the scan, feeds the chain, and keeps what comes out of it (VC1-GFB).
//!
//! ```text
//! start --> [ sequencer ]--> scan, to every unit of the chain
//!              |     |
//!         feed |     | store
//!           .--v-----v--.  old
//!           |           |-------->|first|--[ ]--> left, into the chain
//!           | two banks |  blank >|round|
//!           |           |<----------------------- merged, out of the chain
//!           '-----------'
//!              |     ^
//!    read_word v     | read_address: the bank on display
//! ```
//!
//! Latency: a pixel enters the chain 2 clocks after its address; `read_word` comes 1 clock after `read_address`. A round takes
//! T_m (VC1-TM), see [`GfbSequencer`].
//!
//! One bank is filled while the other is on display; `swap` exchanges them. In the first round after a swap blank pixels
//! enter the chain, so that the bank's old contents are replaced; in later rounds they enter it themselves, so that the bank is
//! cumulative (VC1-CLR3). The chain itself chooses the nearer pixel, so what comes out of it is stored as it is.

use super::sequencer::{GfbSequencer, GfbSequencerIn};
use crate::prelude::*;

block! {
    /// A double-buffered frame buffer with depth: leads the scan, feeds the chain of merging units and keeps what comes out of it.
    pub struct GfbUnit {
        /// The screen: M x N pixels.
        pub screen: Screen,
        /// The merging units of the chain: n.
        pub units: u32,
        /// Clocks of overhead after each scan line: beta.
        pub overhead: u32,
    }
    latency(self) = format!("a round of {} clocks", self.sequencer().merge_clocks());
    source = "VC-1, section 3.3, global frame buffer (VC1-GFB, VC1-TM, VC1-CLR3)";
    in(self) GfbUnitIn {
        /// What the host says.
        host: pub struct Host {
            /// For one clock, when not busy: merge the local frame buffers.
            start: bit(),
            /// For one clock, when not busy: exchange the banks.
            swap: bit(),
            /// A pixel of the bank on display, in raster order.
            read_address: below(self.screen.pixels()),
            /// The word of a blank pixel: the greatest depth above the background's colour.
            background: bits(WORD),
        },
        /// From the right end of the chain.
        merged: bits(WORD),
    }
    out(self) GfbUnitOut {
        /// What the host sees.
        view: pub struct View {
            /// The pixel at the address of the last clock.
            read_word: bits(WORD),
            /// A round is under way.
            busy: bit(),
            /// The next or present round is the first since the banks were swapped.
            first_round: bit(),
            /// The clocks of the round so far, or of the last one, from the first pixel that entered the chain.
            clocks: up_to(self.sequencer().merge_clocks()),
        },
        /// To every unit of the chain.
        scan: ScanControl { restart: bit(), enable: bit() },
        /// To the left end of the chain.
        left: bits(WORD),
    }
}

impl GfbUnit {
    /// What leads its rounds of merging.
    pub fn sequencer(&self) -> GfbSequencer {
        GfbSequencer { screen: self.screen, units: self.units, overhead: self.overhead }
    }

    fn build(&self, m: Module, i: GfbUnitIn) -> GfbUnitOut {
        let Host { start, swap, read_address, background } = i.host;
        let round = m.instance("u_sequencer", &self.sequencer(), GfbSequencerIn { start });
        m.assume((swap | start).implies(!round.busy), "the banks are swapped and a round is started between rounds");

        // The lowest bit of an address tells the banks apart. No read meets a write: what is on display is not filled, and a
        // pixel is fed long before it is stored.
        def!(filled_bank = m.toggle(swap));
        def!(banks = m.memory(2 * self.screen.pixels(), WORD, ReadUnderWrite::Any));
        banks.write(round.stores, cat![round.store, filled_bank], i.merged);
        def!(read_word = banks.read(cat![read_address, !filled_bank]));

        def!(first_round = m.reg(1).reset(1).when(swap, 1).when(round.ends, 0));
        def!(old = banks.read_when(round.scan.enable, cat![round.feed, filled_bank]));
        def!(left = m.pipe_when(round.scan.enable, mux(first_round, background, old)));

        let view = View { read_word, busy: round.busy, first_round: *first_round, clocks: round.clocks };
        GfbUnitOut { view, scan: round.scan, left }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::VecDeque;

    use proptest::prelude::*;
    use tilewright_sim::Simulation;

    use super::*;
    use crate::gfb::SCAN_LATENCY;
    use crate::merger::STAGES;

    const BLANK: u64 = 0xffffff << 24;

    /// A global frame buffer with a chain in software, which merges what enters it with an image.
    struct Bench {
        sim: Simulation<GfbUnitIn, GfbUnitOut>,
        chain: VecDeque<u64>,
        pixels: usize,
        merge_clocks: usize,
    }

    fn unit(width: u32, height: u32, units: u32, overhead: u32) -> GfbUnit {
        GfbUnit { screen: Screen { width, height }, units, overhead }
    }

    impl Bench {
        /// From any values in the banks, and in registers without a reset.
        fn new(gfb: &GfbUnit, seed: u64) -> Bench {
            let mut sim = Simulation::of(gfb).unwrap().seeded(seed);
            sim.reset();
            sim.set(sim.i.host.background, BLANK);
            let GfbUnit { screen, units, .. } = *gfb;
            let chain = VecDeque::from(vec![0; (STAGES * units) as usize]);
            let merge_clocks = gfb.sequencer().merge_clocks() as usize;
            Bench { sim, chain, pixels: screen.pixels() as usize, merge_clocks }
        }

        fn swap(&mut self) {
            self.sim.set(self.sim.i.host.swap, 1);
            self.sim.step();
            self.sim.set(self.sim.i.host.swap, 0);
        }

        /// A round; gives what was seen of the bank on display meanwhile, over and over in raster order.
        fn round(&mut self, image: &[u64]) -> Vec<u64> {
            let mut seen = Vec::new();
            let mut advanced = 0;
            self.sim.set(self.sim.i.host.start, 1);
            while self.sim.get_u64(self.sim.i.host.start) | self.sim.get_u64(self.sim.o.view.busy) == 1 {
                self.sim.set(self.sim.i.host.read_address, (seen.len() % self.pixels) as u64);
                self.sim.set(self.sim.i.merged, self.chain[0]);
                if self.sim.get_u64(self.sim.o.scan.enable) == 1 {
                    let pixel = usize::checked_sub(advanced, SCAN_LATENCY as usize);
                    let sample = pixel.and_then(|pixel| image.get(pixel)).unwrap_or(&u64::MAX);
                    self.chain.push_back(self.sim.get_u64(self.sim.o.left).min(*sample));
                    self.chain.pop_front();
                    advanced += 1;
                }
                self.sim.step();
                self.sim.set(self.sim.i.host.start, 0);
                seen.push(self.sim.get_u64(self.sim.o.view.read_word));
                assert!(seen.len() <= self.merge_clocks + 9, "the round has no end");
            }
            seen
        }

        /// The bank on display.
        fn picture(&mut self) -> Vec<u64> {
            let read = |pixel: usize| {
                self.sim.set(self.sim.i.host.read_address, pixel as u64);
                self.sim.step();
                self.sim.get_u64(self.sim.o.view.read_word)
            };
            (0..self.pixels).map(read).collect()
        }
    }

    #[test]
    fn a_later_round_feeds_the_chain_with_what_the_first_has_stored() {
        let mut bench = Bench::new(&unit(3, 1, 1, 1), 7);
        bench.round(&[5, 6, 7]);
        let wave = bench.sim.record(["scan_restart", "scan_enable", "left", "merged", "u_sequencer.stores"]);
        bench.round(&[9, 1, 9]);
        wave.expect(
            r"
            clk                |~~~\___/~~~\___/~~~\___/~~~\___/~~~\___/~~~\___/~~~\___/~~~\___/~~~\___/~~~\___/~~~\___/
            scan_restart       |~~~~~~~\________________________________________________________________________________
            scan_enable        |_______/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\_______/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
            left               | ffffff000000  | 5             | 6     | 7     | 0             | 5     | 6     | 7     |
            merged             | ffffff000000                                  | 5                     | 1     | 7     |
            u_sequencer.stores |_______________________________________________________________/~~~~~~~~~~~~~~~~~~~~~~~~
            ",
        );
    }

    #[test]
    fn a_swap_or_a_start_during_a_round_is_an_error() {
        for (start, swap) in [(0, 1), (1, 0), (1, 1)] {
            let mut sim = Bench::new(&unit(2, 2, 1, 1), 7).sim;
            sim.set(sim.i.host.start, 1);
            sim.step();
            sim.set(sim.i.host.start, start);
            sim.set(sim.i.host.swap, swap);
            let problem = sim.try_step().unwrap_err().to_string();
            assert!(problem.contains("the banks are swapped and a round is started between rounds"), "{problem}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

        /// Frames of some rounds each. What is on display is the frame before, and stays that during the rounds.
        #[test]
        fn rounds_accumulate_behind_the_picture_on_display(
            (width, height, units, overhead) in (2..9u32, 1..6u32, 1..4u32, 1..4u32),
            frames in prop::collection::vec(prop::collection::vec(prop::collection::vec(0..2 * BLANK, 40), 1..4), 1..4),
            seed in any::<u64>(),
        ) {
            let gfb = unit(width, height, units, overhead);
            let mut bench = Bench::new(&gfb, seed);
            let mut displayed = None;
            for rounds in &frames {
                let mut filled = vec![BLANK; bench.pixels];
                for (number, image) in rounds.iter().enumerate() {
                    let image = &image[..bench.pixels];
                    prop_assert_eq!(bench.sim.get_u64(bench.sim.o.view.first_round) == 1, number == 0);
                    let seen = bench.round(image);
                    prop_assert_eq!(bench.sim.get_u64(bench.sim.o.view.first_round), 0);
                    if let Some(displayed) = &displayed {
                        let same = seen.chunks(bench.pixels).all(|chunk| chunk == &Vec::as_slice(displayed)[..chunk.len()]);
                        prop_assert!(same, "the picture on display changes");
                    }
                    prop_assert_eq!(bench.sim.get(bench.sim.o.view.clocks), gfb.sequencer().merge_clocks());
                    filled.iter_mut().zip(image).for_each(|(old, new)| *old = *new.min(old));
                }
                bench.swap();
                prop_assert_eq!(&bench.picture(), &filled);
                displayed = Some(filled);
            }
        }
    }
}
