//! The sequencer of the merger: runs the scan without a pause, line by line, and tells which pixels enter and leave the chain (VC1-TM).
//!
//! ```text
//! restart --> Prime --> Line --> Overhead
//!                        ^           |
//!                        '-----------'
//! ```
//!
//! The scan runs freely. A line has M clocks with `enable` and an overhead of beta clocks without. After N lines the
//! next round follows at once (VC1-FREE). So rounds have a period of (M + beta) N clocks. The 4 n clocks of the chain
//! overlap the next round:
//!
//! ```text
//! Prime 2 | Line M | Overhead beta | .. | Line M | Overhead beta | Line M | Overhead beta ..
//!         |<------------------- N lines ------------------------>|
//!         |<------ from the first pixel that enters to the last one stored, T_m ----->|
//! ```
//!
//! A restart returns the scan to the first pixel. It comes after a reset, and when the global frame buffer swaps. In
//! the 2 clocks before that pixel enters the chain, the frame buffers read their pixels ([`SCAN_LATENCY`]). Pixels in the
//! chain at the restart are `stale`: they entered before the swap and are not stored. In the round after a restart
//! blank pixels enter the chain; in later rounds the old contents do (VC1-CLR3).

use crate::merger::STAGES;
use crate::prelude::*;

/// The clocks with `enable` from a scan counter's pixel to the word that its local frame buffer sends.
pub const SCAN_LATENCY: u32 = 2;

// The parts of the scan.
codes! { enum Scan { Restart, Prime, Line, Overhead } }

block! {
    /// Scans the screen continuously, and paces a chain of merging units.
    pub struct GfbSequencer {
        /// The screen: M x N pixels.
        pub screen: Screen,
        /// The merging units of the chain: n.
        pub units: u32,
        /// Clocks of overhead after each scan line: beta.
        pub overhead: u32,
    }
    ranges { units: 1.., overhead: 1.. }
    latency(self) = format!("rounds with a period of {} clocks", self.period());
    source = "VC-1, section 3.3, T_m and the free-running scan (VC1-TM, VC1-FREE, VC1-CLR3)";
    in GfbSequencerIn {
        /// High for one clock to restart the scan at the first pixel.
        restart: bit(),
    }
    out(self) GfbSequencerOut {
        /// The control of the scan, for every unit of the chain.
        scan: ScanControl,
        /// The number of the pixel to read. The pixel enters the chain [`SCAN_LATENCY`] clocks with `enable` later.
        feed: below(self.screen.pixels()),
        /// A blank pixel enters the chain in place of the pixel that is read.
        blank: bit(),
        /// A pixel that entered the chain after the last restart leaves it.
        stores: bit(),
        /// A pixel that entered the chain before the last restart leaves it.
        stale: bit(),
        /// The number of the pixel that is stored, in raster order.
        store: below(self.screen.pixels()),
    }
}

impl GfbSequencer {
    /// The clocks from one round to the next: (M + beta) N.
    pub fn period(&self) -> u64 {
        u64::from(self.screen.width + self.overhead) * u64::from(self.screen.height)
    }

    /// T_m by its formula: (M + beta) N + 4 n clocks (VC1-TM).
    pub fn merge_clocks(&self) -> u64 {
        self.period() + u64::from(self.chain())
    }

    /// The clocks from the first pixel that enters the chain after a restart to the last pixel stored.
    ///
    /// This is T_m unless the chain is longer than a line. Then it is more: the chain stops for an overhead while it
    /// still contains the last pixels.
    pub fn stored_clocks(&self) -> u64 {
        self.merge_clocks() + u64::from((self.chain() - 1) / self.screen.width * self.overhead)
    }

    /// The clocks with `enable` that a pixel takes through the chain: 4 n.
    pub fn chain(&self) -> u32 {
        STAGES * self.units
    }

    fn build(&self, m: Module, i: GfbSequencerIn) -> GfbSequencerOut {
        let Screen { width, height } = self.screen;
        let last = self.screen.pixels() - 1;

        // The parts of the scan. The first restart, right after a reset, sets its counters.
        def!(part = m.fsm(Scan::Restart));
        def!(restarts = i.restart | part.is(Scan::Restart));
        def!(x = m.reg(below(width)));
        def!(y = m.reg(below(height)));
        def!(clocks_left = m.reg(below(self.overhead.max(SCAN_LATENCY))));
        def!(part_ends = clocks_left.eq(0));
        def!(line_ends = part.is(Scan::Line) & x.eq(width - 1));
        part.next(|part| match part {
            Scan::Restart => goto(Scan::Prime),
            Scan::Prime => when(i.restart, Scan::Prime).or_when(part_ends, Scan::Line),
            Scan::Line => when(i.restart, Scan::Prime).or_when(line_ends, Scan::Overhead),
            Scan::Overhead => when(i.restart, Scan::Prime).or_when(part_ends, Scan::Line),
        });
        x.when(restarts | line_ends, 0).when(part.is(Scan::Line), x + 1);
        y.when(restarts | line_ends & y.eq(height - 1), 0).when(line_ends, y + 1);
        clocks_left
            .when(restarts, SCAN_LATENCY - 1)
            .when(line_ends, self.overhead - 1)
            .when(!part_ends, clocks_left - 1);

        // The pixels that enter the chain.
        def!(enable = part.is(Scan::Prime) | part.is(Scan::Line));
        def!(feed = m.reg(below(self.screen.pixels())).reset(0));
        def!(round_ends = enable & feed.eq(last));
        feed.when(restarts | round_ends, 0).when(enable, feed + 1);
        def!(blank = m.reg(bit()).reset(1).when(restarts, 1).when(round_ends, 0));

        // The pixels that have passed the whole chain.
        let way = SCAN_LATENCY + self.chain();
        def!(way_left = m.reg(up_to(way)));
        def!(is_stale = way_left.ne(0));
        way_left.when(restarts, way).when(enable & is_stale, way_left - 1);
        def!(stores = enable & !is_stale);
        def!(store = m.reg(below(self.screen.pixels())).reset(0));
        store.when(restarts | stores & store.eq(last), 0).when(stores, store + 1);

        def!(fed = m.reg(up_to(self.screen.pixels())).reset(0));
        fed.when(restarts, 0).when(enable & fed.le(last), fed + 1);
        m.assert(blank.eq(fed.le(last)), "blank pixels enter in the first round after a restart, and in no other");
        m.cover("a first round ends", round_ends & blank);
        m.cover("a later round ends", round_ends & !blank);
        let (scan, stale) = (ScanControl { restart: restarts, enable }, enable & is_stale);
        GfbSequencerOut { scan, feed: *feed, blank: *blank, stores, stale, store: *store }
    }
}

#[cfg(test)]
mod tests;
