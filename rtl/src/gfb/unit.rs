//! The global frame buffer unit: leads the scan, feeds the chain, and keeps what comes out of it (VC1-GFB).
//!
//! ```text
//!  start --> [ sequencer ]--> scan: restart, enable
//!                 |
//!            feed | address            .---------------------.
//!                 v                    |                     |
//!        .--------------.  old   .-----v-----.               |
//!        |  two banks   |--[ ]-->| first     |--> left   merged
//!        |              |        | round?    |
//!        |              |<---- store address <-- sequencer
//!        |              |        '-----------'
//!        |              |--> read_word, from the bank on display
//!        '--------------'
//! ```
//!
//! A merging round takes T_m = (M + beta) N + 4 n clocks from the first pixel that enters the chain to the last that
//! leaves it (VC1-TM), after [`SCAN_LATENCY`] clocks in which the local frame buffers read their first pixel:
//!
//! ```text
//! Prime 2 | Line M | Overhead beta | Line M | Overhead beta | .. | Overhead beta | Drain 4 n
//!         |<------------------------- N times ------------------>|
//! ```
//!
//! One bank is filled while the other is on display; `swap` exchanges them. In the first round after a swap blank pixels
//! enter the chain, so that the bank's old contents are replaced; in later rounds they enter it themselves, so that the bank is
//! cumulative (VC1-CLR3). The chain itself chooses the nearer pixel, so what comes out of it is stored as it is.

use tilewright_hdl::ir::About;
use tilewright_hdl::{
    Block, Module, ReadUnderWrite, Width, bit, bits, bundle, cat, index_width, mux, net, select, states, when,
};

use crate::merger::STAGES;
use crate::parameter::Screen;
use crate::scan::ScanControl;
use crate::word::WORD;

/// Clocks with `enable` from a scan counter to the word that its local frame buffer sends.
pub const SCAN_LATENCY: u32 = 2;

bundle! {
    /// What the host says to the global frame buffer.
    pub struct Host<T> {
        /// For one clock, when not busy: merge the local frame buffers.
        pub start: T,
        /// For one clock, when not busy: exchange the banks.
        pub swap: T,
        /// A pixel of the bank on display, in raster order.
        pub read_address: T,
        /// The word of a blank pixel: the greatest depth above the background's colour.
        pub background: T,
    }

    /// What the host sees of the global frame buffer.
    pub struct View<T> {
        /// The pixel at the address of the last clock.
        pub read_word: T,
        /// A round is under way.
        pub busy: T,
        /// The next or present round is the first since the banks were swapped.
        pub first_round: T,
        /// The clocks of the round so far, or of the last one, from the first pixel that entered the chain.
        pub clocks: T,
    }

    /// The inputs of [`GfbUnit`].
    pub struct GfbUnitIn<T> {
        /// From the host.
        pub host: Host<T>,
        /// From the right end of the chain.
        pub merged: T,
    }

    /// The outputs of [`GfbUnit`].
    pub struct GfbUnitOut<T> {
        /// To the host.
        pub view: View<T>,
        /// To every unit of the chain.
        pub scan: ScanControl<T>,
        /// To the left end of the chain.
        pub left: T,
    }
}

states! {
    /// The parts of a merging round.
    enum Round { Idle, Prime, Line, Overhead, Drain }
}

/// A double-buffered frame buffer with depth, at the end of a chain of merging units.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GfbUnit {
    /// The screen: M x N pixels.
    pub screen: Screen,
    /// The merging units of the chain: n.
    pub units: u32,
    /// Clocks of overhead after each scan line: beta, at least 1 (VC1-TM).
    pub overhead: u32,
}

impl GfbUnit {
    /// T_m, the clocks of a merging round (VC1-TM).
    pub fn merge_clocks(&self) -> u64 {
        let (width, height) = (u64::from(self.screen.width), u64::from(self.screen.height));
        (width + u64::from(self.overhead)) * height + u64::from(STAGES * self.units)
    }
}

impl Block for GfbUnit {
    type In = GfbUnitIn;
    type Out = GfbUnitOut;

    fn inputs(&self) -> GfbUnitIn<Width> {
        let pixel = bits(index_width(self.screen.pixels().into()));
        let host = Host { start: bit(), swap: bit(), read_address: pixel, background: bits(WORD) };
        GfbUnitIn { host, merged: bits(WORD) }
    }

    fn build(&self, m: Module, i: GfbUnitIn) -> GfbUnitOut {
        let Screen { width, height } = self.screen;
        let pixel = index_width(self.screen.pixels().into());
        let drain = STAGES * self.units;

        // The sequencer.
        let round = m.fsm("round", Round::Idle);
        net!(begin = i.host.start & round.is(Round::Idle));
        net!(enable = round.is(Round::Prime) | round.is(Round::Line) | round.is(Round::Drain));
        let x = m.reg("x", index_width(width.into())).reset(0);
        let y = m.reg("y", index_width(height.into())).reset(0);
        net!(line_end = round.is(Round::Line) & x.eq(width - 1));
        net!(last_line = y.eq(height - 1));
        let longest = drain.max(self.overhead).max(SCAN_LATENCY);
        let left_over = m.reg("clocks_left", index_width(longest.into())).reset(0);
        net!(over = left_over.eq(0));
        net!(overhead_ends = round.is(Round::Overhead) & over);
        round.next(|part| match part {
            Round::Idle => when(begin, Round::Prime),
            Round::Prime => when(over, Round::Line),
            Round::Line => when(line_end, Round::Overhead),
            Round::Overhead => when(over & last_line, Round::Drain).or_when(over, Round::Line),
            Round::Drain => when(over, Round::Idle),
        });
        x.enable(round.is(Round::Line)).next(mux(line_end, 0, x + 1));
        y.enable(overhead_ends).next(mux(last_line, 0, y + 1));
        let part = |clocks: u32| tilewright_hdl::lit(left_over.width(), u64::from(clocks) - 1);
        left_over.next(select(
            [
                (begin, part(SCAN_LATENCY)),
                (line_end, part(self.overhead)),
                (overhead_ends, part(drain)),
                (over, left_over.value()),
            ],
            left_over - 1,
        ));

        // Where the chain is fed from and stored to; a pixel is stored when it has gone through all of it.
        let feed = m.reg("feed", pixel).reset(0);
        feed.enable(begin | enable).next(mux(begin, 0, feed + 1));
        let until_stored = m.reg("until_stored", index_width(u64::from(SCAN_LATENCY + drain) + 1)).reset(0);
        net!(stores = enable & until_stored.eq(0));
        until_stored.enable(begin | (enable & !stores)).next(mux(begin, SCAN_LATENCY + drain, until_stored - 1));
        let store = m.reg("store", pixel).reset(0);
        store.enable(begin | stores).next(mux(begin, 0, store + 1));

        // The banks: the lowest bit of an address tells them apart.
        let filled = m.reg("filled_bank", 1).reset(0);
        filled.enable(i.host.swap).next(!filled);
        let banks = m.memory("banks", 2 * self.screen.pixels(), WORD, ReadUnderWrite::Old);
        banks.write(stores, cat![store, filled], i.merged);
        net!(old = banks.read_when(enable, cat![feed, filled]));
        net!(read_word = banks.read(cat![i.host.read_address, !filled]));

        let first_round = m.reg("first_round", 1).reset(1);
        net!(ends = round.is(Round::Drain) & over);
        first_round.enable(i.host.swap | ends).next(i.host.swap);
        let left = m.pipe_when(enable, "left", mux(first_round, i.host.background, old));

        let clocks = m.reg("clocks", index_width(self.merge_clocks() + 1)).reset(0);
        net!(counts = !(round.is(Round::Idle) | round.is(Round::Prime)));
        clocks.enable(begin | counts).next(mux(begin, 0, clocks + 1));
        m.assert(
            !(i.host.swap | i.host.start) | round.is(Round::Idle),
            "the banks are swapped and a round is started between rounds",
        );

        let busy = !round.is(Round::Idle);
        GfbUnitOut {
            view: View { read_word, busy, first_round: first_round.value(), clocks: clocks.value() },
            scan: ScanControl { restart: begin, enable },
            left,
        }
    }

    fn name(&self) -> String {
        format!("gfb_unit_{}x{}_units{}_overhead{}", self.screen.width, self.screen.height, self.units, self.overhead)
    }

    fn about(&self) -> About {
        About {
            summary: format!(
                "The global frame buffer of {} x {} pixels: leads the scan, feeds the chain of {} merging units and keeps \
                 what comes out of it.",
                self.screen.width, self.screen.height, self.units
            ),
            latency: format!("a round of {} clocks", self.merge_clocks()),
            source: "VC-1, section 3.3, global frame buffer (VC1-GFB, VC1-TM, VC1-CLR3)".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use tilewright_sim::Simulation;

    use super::*;

    const BLANK: u64 = 0xffffff << 24;

    fn host(start: u64, swap: u64) -> GfbUnitIn<u64> {
        GfbUnitIn { host: Host { start, swap, read_address: 0, background: BLANK }, merged: 0 }
    }

    /// A round on a screen of 3 x 2 pixels with an overhead of 2 clocks and one merging unit.
    #[test]
    fn a_round_clock_by_clock() {
        let gfb = GfbUnit { screen: Screen { width: 3, height: 2 }, units: 1, overhead: 2 };
        let mut sim = Simulation::of(&gfb).unwrap();
        sim.reset();
        let wave = sim.record(["scan_restart", "scan_enable", "round", "feed", "stores", "store", "clocks"]);
        sim.drive(host(1, 0));
        sim.step();
        sim.drive(host(0, 0));
        sim.run(17);
        wave.expect(
            r"
            clk          |~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/
            scan_restart |~~~~~~\____________________________________________________________________________________
            scan_enable  |______/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\_____________/~~~~~~~~~~~~~~~~~~~~\______________
            round        | Idle | Prime       | Line               | Overhead    | Line               | Overhead    |
            feed         | 0           | 1    | 2    | 3    | 4    | 5                  | 6    | 7    | 0           |
            stores       |______________________________________________________________/~~~~~~~~~~~~~\______________
            store        | 0                                                                   | 1    | 2           |
            clocks       | 0                         | 1    | 2    | 3    | 4    | 5    | 6    | 7    | 8    | 9    |

            clk          |~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/
            scan_restart |___________________________________
            scan_enable  |~~~~~~~~~~~~~~~~~~~~~~~~~~~\_______
            round        | Drain                     | Idle |
            feed         | 0    | 1    | 2    | 3    | 4    |
            stores       |~~~~~~~~~~~~~~~~~~~~~~~~~~~\_______
            store        | 2    | 3    | 4    | 5    | 6    |
            clocks       | a    | b    | c    | d    | e    |
            ",
        );
        assert_eq!(sim.get(sim.o.view.clocks), gfb.merge_clocks());
    }

    /// What enters the chain: blank pixels in the first round, the bank's contents in the next.
    #[test]
    fn the_first_round_is_blank_and_the_next_feeds_what_was_stored() {
        let gfb = GfbUnit { screen: Screen { width: 4, height: 3 }, units: 2, overhead: 1 };
        let mut sim = Simulation::of(&gfb).unwrap();
        sim.reset();
        let mut fed = |start: u64| {
            let (mut fed, mut chain) = (Vec::new(), std::collections::VecDeque::from([0; 8]));
            let mut inputs = host(1, 0);
            loop {
                inputs.merged = chain[0];
                sim.drive(inputs);
                inputs.host.start = 0;
                let out = sim.read_u64();
                if out.scan.enable == 1 {
                    fed.push(out.left);
                    // The chain of this test makes a pixel nearer by 1 and by its number.
                    chain.push_back(out.left.wrapping_sub(start + fed.len() as u64) % (1 << 48));
                    chain.pop_front();
                }
                sim.step();
                if sim.get_u64(sim.o.view.busy) == 0 {
                    return fed[SCAN_LATENCY as usize..][..12].to_vec();
                }
            }
        };
        assert_eq!(fed(100), vec![BLANK; 12]);
        let stored: Vec<u64> = (0..12).map(|pixel| BLANK - 100 - 3 - pixel).collect();
        assert_eq!(fed(0), stored);
    }
}
