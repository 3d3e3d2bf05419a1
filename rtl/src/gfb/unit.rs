//! The global frame buffer unit: paces the scan, feeds the chain, stores the chain's output, and displays it (VC1-GFB).
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
//!            |  ^   |  |
//!  read_word v  |   |  '--> [ accumulation ]-- average -->|shows  |
//!        accesses   |             ^                       |average|--> [ CRT read-out ]--> pixel
//!                   '-------------|---------------------->|       |           |
//!     bank on display             '-- start -- [ multipass control ]<---------' blanking
//! ```
//!
//! Latency: a pixel enters the chain 2 clocks with `enable` after its address. A frame is stored T_m after the restart (VC1-TM), see
//! [`GfbSequencer::stored_clocks`].
//!
//! One bank is filled while the other is on display. `swap` exchanges them and restarts the scan. In the round after a
//! swap blank pixels enter the chain, so the bank's old contents are replaced. In later rounds the old contents
//! themselves enter, so the bank is cumulative (VC1-CLR3). The chain chooses the nearer pixel, so the unit stores the
//! chain's output unchanged.
//!
//! A pixel that entered the chain before a swap is not stored after it. Nothing is lost: the frame was already stored,
//! so the bank already has that pixel's word. An assertion checks this.
//!
//! The display reads with its own clock, at any rate. It learns of a swap through a synchronizer, within the vertical
//! blanking.
//!
//! # The host's port
//!
//! A bank has the three ports of a triple-port DRAM, for the chain, the display and the host. So the host never waits:
//! the unit takes an access in every clock. The word of a read is valid 1 clock after the access, while `read_valid` is
//! high. A read returns the effect of all writes in earlier clocks.
//!
//! An access goes to the bank on display (VC1-HOSTP). In the clock of a swap this is still the old bank. A read then
//! returns a word of the old frame, and a write is never shown.
//!
//! Subsequent refreshes show a write. If the display reads a pixel in the clock of its write, that refresh may show
//! anything. The write does not reach the next frame, because the bank is filled afresh after the next swap.
//!
//! # Pictures of several passes
//!
//! With an accumulation buffer the unit shows the average of several frames, the passes of a picture (VC1-ACB). MUACC
//! adds the bank on display to the sums, a pixel in each clock, while the next pass is merged into the other bank. It
//! reads through the port of that bank that the chain does not use. Until the last sum is complete the display shows
//! the passes. From the next blanking on it shows the average for at least one refresh. [`MultipassControl`] keeps
//! `blanking` low while the banks may not change.
//!
//! MUACC reads pixel `k` in clock k + 1 after the swap. A host write into a pass is added if it comes before that.
//! While the average is shown, the host reads and writes the last pass, which is not on display.

use super::accumulation::{Accumulation, AccumulationIn};
use super::crt::{CrtPixel, CrtReadOut, CrtReadOutIn, CrtReadOutOut, Display};
use super::multipass::{Multipass, MultipassControl, MultipassControlIn, MultipassControlOut};
use super::sequencer::{GfbSequencer, GfbSequencerIn, GfbSequencerOut};
use crate::prelude::*;

record! {
    /// The host's inputs to the global frame buffer.
    pub struct Host(screen: Screen, accumulation: bool) {
        /// Reads and writes of the bank on display, one in every clock.
        accesses: stream(Access::widths(screen)),
        /// The word of a blank pixel: the greatest depth above the background's colour.
        background: bits(WORD),
        /// The settings for pictures of several passes, if there is an accumulation buffer.
        multipass: [Multipass; accumulation],
    }

    /// An access of the host to the bank on display.
    pub struct Access(screen: Screen) {
        /// The number of the pixel that the host accesses, in raster order.
        address: below(screen.pixels()),
        /// High if the host writes the pixel, low if it reads the pixel.
        writes: bit(),
        /// The word that the host writes: depth above colour.
        word: bits(WORD),
    }

    /// The accumulation buffer's requests.
    struct Adding(screen: Screen) {
        /// A sum is under way.
        busy: bit(),
        /// The number of the pixel of the bank on display that the sum needs.
        address: below(screen.pixels()),
    }
}

block! {
    /// A double-buffered frame buffer with depth: paces the scan, feeds the chain of merging units and stores its
    /// output.
    pub struct GfbUnit {
        /// The screen: M x N pixels.
        pub screen: Screen,
        /// The merging units of the chain: n.
        pub units: u32,
        /// Clocks of overhead after each scan line: beta.
        pub overhead: u32,
        /// Whether there is an accumulation buffer.
        pub accumulation: bool,
        /// The display.
        pub display: Display,
    }
    ranges(self) {
        /// The chain and the path into it are shorter than the screen, so that a pixel is stored before it is fed again.
        units: 1..=(self.screen.pixels().saturating_sub(3)) / crate::merger::STAGES,
        overhead: 1..,
    }
    latency(self) = format!("rounds with a period of {} clocks", self.sequencer().period());
    source = "VC-1, section 3.3, global frame buffer (VC1-GFB, VC1-TM, VC1-FREE, VC1-CLR3)";
    in(self) GfbUnitIn {
        /// High for one clock to swap the banks.
        swap: bit().on(MERGE),
        /// The inputs from the host.
        host: Host::widths(self.screen, self.accumulation).on(MERGE),
        /// The pixel from the right end of the chain.
        merged: bits(WORD).on(MERGE),
    }
    out(self) GfbUnitOut {
        /// The outputs to the host.
        view: pub struct View {
            /// The access of the previous clock was a read.
            read_valid: bit(),
            /// The word of the pixel that was read last.
            read_word: bits(WORD),
            /// Blank pixels enter the chain: the round is the first since the banks were swapped.
            first_round: bit(),
        },
        /// The control of the scan, for every unit of the chain.
        scan: ScanControl,
        /// The pixel to the left end of the chain.
        left: bits(WORD),
        /// The banks may change: the display is in its vertical blanking.
        blanking: bit(),
        /// The pixel to the display.
        pixel: CrtPixel { valid: bit(), rgb: bits(24) },
    }
}

impl GfbUnit {
    /// The sequencer of its merging rounds.
    pub fn sequencer(&self) -> GfbSequencer {
        GfbSequencer { screen: self.screen, units: self.units, overhead: self.overhead }
    }

    /// The read-out to the display.
    pub fn read_out(&self) -> CrtReadOut {
        CrtReadOut { screen: self.screen, blanking: self.display.blanking }
    }

    /// The accumulation buffer, which exists only if `accumulation` is true.
    pub fn sums(&self) -> Accumulation {
        Accumulation { screen: self.screen, crt: self.display.clock() }
    }

    fn build(&self, m: Module, i: GfbUnitIn) -> GfbUnitOut {
        let (merge, crt) = (m.on(MERGE), m.on(self.display.clock()));
        let Host { accesses, background, multipass } = i.host;
        let access = accesses.take_when(1);
        def!(sequencer = merge.instance(&self.sequencer(), GfbSequencerIn { restart: i.swap }));
        let enable = sequencer.scan.enable;

        // Two banks. The chain uses its port of the bank being filled; the host uses its port of the bank on display. A
        // pixel is stored long before it is fed again. Only a sum can coincide with a write, that of the host.
        let policy = if self.accumulation { ReadUnderWrite::Old } else { ReadUnderWrite::Any };
        def!(filled_bank = merge.toggle(i.swap));
        def!(is_filled = constants(bit().of(row(2)), |bank| bank).eq(filled_bank));
        def!(banks = m.memory(self.screen.pixels(), bits(WORD).of(row(2)), policy));
        def!(writes = access.taken & access.writes);
        def!(reads = access.taken & !access.writes);
        banks.on(MERGE).write(
            mux(is_filled, sequencer.stores, writes),
            mux(is_filled, sequencer.store, access.address),
            mux(is_filled, i.merged, access.word),
        );

        // The chain reads the bank being filled, and the host the one on display. So they share a port of each bank. A sum
        // reads the bank on display through the chain's port, and the host then needs one of its own.
        let adds = self.accumulation.then(|| merge.wire("adds", Adding::widths(self.screen)));
        let (other_reads, other_address) = match &adds {
            Some(adds) => (adds.busy, adds.address),
            None => (reads, access.address),
        };
        let (reads_old, old_address) =
            (mux(is_filled, enable, other_reads), mux(is_filled, sequencer.feed, other_address));
        def!(old = banks.on(MERGE).read_when(reads_old, old_address));

        // A word arrives from the bank that was read, even after a swap, and stays until the next one.
        def!(read_bank = merge.pipe_when(reads, !filled_bank));
        def!(read_valid = merge.reg(bit()).reset(0));
        read_valid.next(reads);
        let read_word = match &adds {
            Some(_) => {
                def!(read_words = banks.on(MERGE).read_when(reads & !is_filled, access.address));
                read_words.pick(read_bank)
            }
            None => {
                let arriving = old.pick(read_bank);
                def!(arrived = merge.pipe_when(*read_valid, arriving));
                mux(read_valid, arriving, arrived)
            }
        };
        merge.cover("the host reads in the clock after a write", reads & merge.past(writes));
        merge.cover("the host writes in the clock of a swap", writes & i.swap);
        merge.assert(
            merge.past(i.swap).implies(sequencer.blank),
            "blank pixels enter the chain in the first round after a swap",
        );

        def!(fed_bank = merge.pipe_when(enable, filled_bank));
        def!(old_is_blank = merge.pipe_when(enable, sequencer.blank));
        def!(left = merge.pipe_when(enable, mux(old_is_blank, background, old.pick(fed_bank))));

        self.state_what_is_stale(m, (&sequencer, i.swap), left, i.merged);

        // The display.
        def!(shown_bank = crt.synchronize_from(true, !filled_bank));
        def!(word = crt.wire(WORD));
        let read_out = crt.instance("u_crt", &self.read_out(), CrtReadOutIn { word: *word });
        crt.assert(crt.stable(shown_bank) | read_out.dark, "no refresh shows two frames");
        crt.cover("the display changes to the other bank", shown_bank.ne(crt.past(shown_bank)));
        let shown = banks.on(self.display.clock()).read(read_out.address).pick(shown_bank);
        def!(window = merge.synchronize(read_out.window));
        let (word_shown, blanking) = match (adds, multipass.first()) {
            (Some(adds), Some(host)) => {
                let control = MultipassControlIn { swap: i.swap, host: *host, busy: adds.busy, blanking: window };
                let average = self.average(m, control, old.pick(!filled_bank), &read_out);
                adds.drive(average.adds);
                (mux(average.shows, average.colour.zext(WORD), shown), average.may_swap)
            }
            _ => (shown, window),
        };
        word.drive(word_shown);

        let view = View { read_valid: *read_valid, read_word, first_round: sequencer.blank };
        GfbUnitOut { view, scan: sequencer.scan, left, blanking, pixel: read_out.pixel }
    }

    /// Asserts that a pixel that entered the chain before the swap leaves it unchanged.
    fn state_what_is_stale(&self, m: Module, (round, swap): (&GfbSequencerOut, Signal), left: Signal, merged: Signal) {
        let (merge, chain) = (m.on(MERGE), self.sequencer().chain());
        def!(entered = m.memory(chain, WORD, ReadUnderWrite::Any));
        def!(place = merge.reg(below(chain)).reset(0));
        def!(is_full = merge.reg(bit()).reset(0));
        def!(is_last = round.scan.enable & place.eq(chain - 1));
        place.when(is_last, 0).when(round.scan.enable, place + 1);
        is_full.when(is_last, 1);
        def!(was_full = merge.reg(bit()).reset(0));
        was_full.when(swap, is_full);
        entered.on(MERGE).write(round.scan.enable, place, left);
        def!(entered_word = entered.read_async(place));
        merge.assert(
            (round.stale & was_full).implies(merged.eq(entered_word)),
            "a pixel that entered the chain before a swap equals the word in its bank",
        );
    }

    /// The accumulation buffer and its control.
    fn average(&self, m: Module, control: MultipassControlIn, added: Signal, read_out: &CrtReadOutOut) -> Average {
        let crt = m.on(self.display.clock());
        def!(multipass = m.on(MERGE).instance(&MultipassControl, control));
        let MultipassControlOut { start, first, passes, averages, may_swap } = multipass;
        let sums = AccumulationIn { start, first, word: added, passes, read_address: read_out.address };
        def!(accumulation = m.instance(&self.sums(), sums));
        def!(shows_average = crt.synchronize(averages));
        crt.assert(crt.stable(shows_average) | read_out.dark, "no refresh shows both an average and a pass");
        let adds = Adding { busy: accumulation.busy, address: accumulation.address };
        Average { adds, shows: shows_average, colour: accumulation.colour, may_swap }
    }
}

/// The outputs of the accumulation buffer.
struct Average {
    adds: Adding,
    /// The display shows `colour`.
    shows: Signal,
    colour: Signal,
    /// The banks may change.
    may_swap: Signal,
}

#[cfg(test)]
mod tests;
