//! The global frame buffer unit: leads the scan, feeds the chain, keeps what comes out of it, and shows it (VC1-GFB).
//!
//! ```text
//! swap --> [ sequencer ]--> scan, to every unit of the chain
//!              |     |
//!         feed |     | store
//!           .--v-----v--.  old
//!           |           |-------->|first|--[ ]--> left, into the chain
//!           | two banks |  blank >|round|
//!           |           |<----------------------- merged, out of the chain
//!           '-----------'
//!            |  ^    |  ^
//!  read_word v  |    v  | address: the bank on display
//!     read_address  [ CRT read-out ]--> pixel
//! ```
//!
//! Latency: a pixel enters the chain 2 clocks with `enable` after its address; `read_word` comes 1 clock after `read_address`. A frame is
//! stored T_m after the restart (VC1-TM), see [`GfbSequencer::stored_clocks`].
//!
//! One bank is filled while the other is on display. `swap` exchanges them and restarts the scan. In the round after it blank
//! pixels enter the chain, so that the bank's old contents are replaced. In later rounds they enter it themselves, so that the bank is
//! cumulative (VC1-CLR3). The chain itself chooses the nearer pixel, so what comes out of it is stored as it is.
//!
//! A pixel that entered the chain before a swap is not stored after it. Nothing is lost: the frame was stored, and so the
//! pixel is the word that its bank already has, which an assertion holds.
//!
//! The display reads with a clock of its own, of any rate. It learns of a swap through a synchronizer, within the vertical blanking.

use super::crt::{CrtPixel, CrtReadOut, CrtReadOutIn, Display};
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
        /// What shows it.
        pub display: Display,
    }
    ranges(self) {
        /// The chain and the way into it are shorter than the screen: a pixel is stored before it is fed again.
        units: 1..=(self.screen.pixels().saturating_sub(3)) / crate::merger::STAGES,
        overhead: 1..,
    }
    latency(self) = format!("rounds with a period of {} clocks", self.sequencer().period());
    source = "VC-1, section 3.3, global frame buffer (VC1-GFB, VC1-TM, VC1-FREE, VC1-CLR3)";
    in(self) GfbUnitIn {
        /// For one clock: exchange the banks.
        swap: bit().on(MERGE),
        /// What the host says.
        host: pub struct Host {
            /// A pixel of the bank on display, in raster order.
            read_address: below(self.screen.pixels()),
            /// The word of a blank pixel: the greatest depth above the background's colour.
            background: bits(WORD),
        }.on(MERGE),
        /// From the right end of the chain.
        merged: bits(WORD).on(MERGE),
    }
    out(self) GfbUnitOut {
        /// What the host sees.
        view: pub struct View {
            /// The pixel at the address of the last clock.
            read_word: bits(WORD),
            /// Blank pixels enter the chain: the round is the first since the banks were swapped.
            first_round: bit(),
        },
        /// To every unit of the chain.
        scan: ScanControl { restart: bit(), enable: bit() },
        /// To the left end of the chain.
        left: bits(WORD),
        /// The banks may change: the display is in its vertical blanking.
        blanking: bit(),
        /// To the display.
        pixel: CrtPixel { valid: bit(), rgb: bits(24) },
    }
}

impl GfbUnit {
    /// What leads its rounds of merging.
    pub fn sequencer(&self) -> GfbSequencer {
        GfbSequencer { screen: self.screen, units: self.units, overhead: self.overhead }
    }

    /// What shows it.
    pub fn read_out(&self) -> CrtReadOut {
        CrtReadOut { screen: self.screen, blanking: self.display.blanking }
    }

    fn build(&self, m: Module, i: GfbUnitIn) -> GfbUnitOut {
        let (merge, crt) = (m.on(MERGE), m.on(self.display.clock()));
        let Host { read_address, background } = i.host;
        let round = merge.instance("u_sequencer", &self.sequencer(), GfbSequencerIn { restart: i.swap });
        let enable = round.scan.enable;

        // The lowest bit of an address tells the banks apart. No read meets a write: what is on display is not filled, and a
        // pixel is stored long before it is fed again.
        def!(filled_bank = merge.toggle(i.swap));
        def!(banks = m.memory(2 * self.screen.pixels(), WORD, ReadUnderWrite::Any));
        banks.on(MERGE).write(round.stores, cat![round.store, filled_bank], i.merged);
        def!(read_word = banks.on(MERGE).read(cat![read_address, !filled_bank]));

        def!(old = banks.on(MERGE).read_when(enable, cat![round.feed, filled_bank]));
        def!(old_is_blank = merge.pipe_when(enable, round.blank));
        def!(left = merge.pipe_when(enable, mux(old_is_blank, background, old)));

        // What entered the chain comes out of it unchanged, if it entered before the swap.
        let chain = self.sequencer().chain();
        def!(entered = m.memory(chain, WORD, ReadUnderWrite::Any));
        def!(place = merge.reg(below(chain)).reset(0));
        def!(is_full = merge.reg(bit()).reset(0));
        place.when(enable & place.eq(chain - 1), 0).when(enable, place + 1);
        is_full.when(enable & place.eq(chain - 1), 1);
        def!(was_full = merge.reg(bit()).reset(0));
        was_full.when(i.swap, is_full);
        entered.on(MERGE).write(enable, place, left);
        def!(entered_word = entered.read_async(place));
        merge.assert(
            (round.stale & was_full).implies(i.merged.eq(entered_word)),
            "a pixel that entered the chain before a swap is the word that its bank has",
        );

        // The display.
        def!(shown_bank = crt.synchronize_from(true, !filled_bank));
        def!(word = crt.wire(WORD));
        let read_out = crt.instance("u_crt", &self.read_out(), CrtReadOutIn { word: *word });
        word.drive(banks.on(self.display.clock()).read(cat![read_out.address, shown_bank]));
        crt.assert(crt.stable(shown_bank) | read_out.dark, "no refresh shows two frames");
        def!(blanking = merge.synchronize(read_out.window));

        let view = View { read_word, first_round: round.blank };
        GfbUnitOut { view, scan: round.scan, left, blanking, pixel: read_out.pixel }
    }
}

#[cfg(test)]
mod tests;
