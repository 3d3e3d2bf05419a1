//! The VC-1's frame buffer subsystem: all of the machine that is a circuit here (section 3.3 of the paper).
//!
//! ```text
//!        .------------------.----- broadcast bus -----.--------- host
//!        |                  |                          |
//!    processor 0        processor 1               processor n-1
//!        |                  |                          |
//!   [ LFB unit ]       [ LFB unit ]               [ LFB unit ]
//!        |                  |                          |
//!        v                  v                          v
//!  .->[merging unit]-->[merging unit]--> .. -->[merging unit]--.
//!  |                                                           |
//!  '-------------------- [ GFB unit ] <------------------------'
//!                             |
//!                     host, display
//! ```
//!
//! The processors' programs and the host are outside the ports. Each processor draws into its own virtual local frame
//! buffer at its own pace, and then asserts `done`. The hardware does the rest: see [`swap`](crate::swap).
//!
//! # Protocol
//!
//! | party | action | when |
//! |---|---|---|
//! | processor | clears its patch table, entry by entry | its state is `Clear`: at the beginning, and after each swap (VC1-CLR2) |
//! | processor | draws | its state is `Draw` |
//! | processor | sends packets over the bus, and takes words from its queue | at any time; the bus stops while the processor's queue is full |
//! | processor | asserts `done` | it has drawn its frame and sent all its packets; it deasserts `done` when its state is `Due` |
//! | processor | waits | its state is `Due` (all have drawn the frame) or `Overflow` (all pages are taken); the hardware retries the waiting request |
//! | host | sends commands over the bus | at any time |
//! | host | pulls the line low | it participates in the synchronization, and is not ready (VC1-SW1) |
//! | host | reads and writes the displayed picture | at any time |
//! | host | sets whether a picture is the average of several frames, and of how many | before the picture's first frame is shown; it needs an accumulation buffer |
//!
//! A processor that swaps in an overflow loses nothing (VC1-SW4). The scan runs freely: the pixels that it has already
//! passed are merged in the next round.
//!
//! With an accumulation buffer a picture may be the average of 2, 4, 8 or 16 frames, its passes (VC1-ACB). With the
//! paper's T_m and 60 refreshes a second, a picture of n passes takes at least 2 n + 1 refreshes: two for each pass,
//! and one for the average.

use crate::bus::{BroadcastBus, BroadcastBusIn, BusWord};
use crate::gfb::{CrtPixel, Display, GfbUnit, GfbUnitIn, Host, View};
use crate::lfb::{LfbUnit, LfbUnitIn, LfbUnitOut, Request, ScanCounter, Wanted};
use crate::merger::{ImageMerger, ImageMergerIn, STAGES};
use crate::prelude::*;
use crate::swap::{GfbSwap, LfbSwap, SwapControl, SwapControlIn};

/// The paper's scan line overhead, beta, in clocks of the merger (VC1-TM).
pub const OVERHEAD: u32 = 20;

/// The merger clocks in addition to T_m for crossings between the clocks and for reading a pixel.
const CROSSINGS: u32 = 4;

record! {
    /// A processor's inputs to its local frame buffer.
    pub struct ProcessorIn(lfb: &LfbUnit) {
        /// A pixel to draw.
        request: stream(Request::widths(lfb.patches.screen())).on(PE),
        /// A patch table entry to clear.
        clear: stream(Wanted { patch: below(lfb.patches.count()) }).on(PE),
        /// A word for the bus.
        sends: stream(BusWord).on(PE),
        /// The processor has drawn its frame.
        done: bit().on(PE),
    }
}

bundle! {
    /// The state of its local frame buffer, as a processor sees it.
    pub struct ProcessorOut<T> {
        /// What the processor may do: a code of [`SwapState`](crate::swap::SwapState).
        pub state: T,
        /// The number of pages taken.
        pub pages_used: T,
        /// No request of the processor is under way.
        pub idle: T,
        /// The word at the front of the processor's queue.
        pub received: Stream<BusWord<T>, T>,
    }
}

block! {
    /// The frame buffer subsystem of a VC-1: virtual local frame buffers, pipelined image merger, global frame buffer,
    /// swap control.
    pub struct Vc1 {
        /// The local frame buffer of each processor.
        pub lfb: LfbUnit,
        /// The number of processors.
        pub processors: u32,
        /// The capacity of each processor's receive queue, in words.
        pub queue: u32,
        /// The processor clocks that a word occupies the bus.
        pub word_clocks: u32,
        /// Clocks of the merger after each scan line: beta, [`OVERHEAD`] in the paper.
        pub overhead: u32,
        /// Whether there is an accumulation buffer; a machine without one does not have its memories.
        pub accumulation: bool,
        /// The display.
        pub display: Display,
    }
    ranges(self) {
        /// Each scan counter runs 4 pixels ahead of the succeeding one, and all lie within the screen.
        processors: 1..=(self.lfb.patches.screen().pixels() - 3) / STAGES,
        overhead: 1..,
    }
    latency(self) = format!("a frame is merged in {} clocks of the merger", self.gfb().sequencer().stored_clocks());
    source = "VC-1, section 3.3 (VC1-LFB, VC1-PIM, VC1-GFB, VC1-SW1 to SW4)";
    in(self) Vc1In {
        /// The inputs from each processor.
        processors: [ProcessorIn::widths(&self.lfb); self.processors],
        /// A word of the host for the bus.
        command: stream(BusWord).on(PE),
        /// The host releases the sync line.
        ready: bit().on(PE),
        /// The inputs from the host.
        host: Host = self.gfb().inputs().host,
    }
    out(self) Vc1Out {
        /// The outputs to each processor.
        processors: [ProcessorOut] = _,
        /// The sync line: all processors have drawn the frame.
        line: bit(),
        /// The outputs to the host.
        view: View = _,
        /// A frame is stored in the global frame buffer, and waits for the blanking.
        is_merged: bit(),
        /// Toggles with each swap of the global frame buffer.
        shown: bit(),
        /// The output to the display.
        pixel: CrtPixel = _,
    }
}

impl Vc1 {
    /// The unit of the global frame buffer.
    pub fn gfb(&self) -> GfbUnit {
        let Vc1 { overhead, accumulation, display, .. } = *self;
        GfbUnit { screen: self.lfb.patches.screen(), units: self.processors, overhead, display, accumulation }
    }

    /// The broadcast bus.
    pub fn bus(&self) -> BroadcastBus {
        BroadcastBus { processors: self.processors, queue: self.queue, word_clocks: self.word_clocks }
    }

    /// The swap control of a local frame buffer.
    pub fn lfb_swap(&self) -> LfbSwap {
        let sequencer = self.gfb().sequencer();
        let [merge_clocks, sent_clocks] = [sequencer.merge_clocks(), self.longest()].map(pe_clocks);
        let sent_clocks = sent_clocks + 4 * u64::from(CROSSINGS);
        // Before an average is shown, the banks also wait for its sum and for a whole refresh with it.
        let refreshes = if self.accumulation { 3 } else { 1 };
        let refreshes = refreshes * self.gfb().read_out().refresh_clocks() * self.display.period.picoseconds();
        let waits = refreshes.div_ceil(PE.period.picoseconds()) + pe_clocks(2 * u64::from(CROSSINGS));
        LfbSwap {
            patches: self.lfb.patches.count(),
            merge_clocks,
            sent_clocks,
            overflow_clocks: 2 * sent_clocks + waits,
        }
    }

    /// The swap control of the global frame buffer.
    pub fn gfb_swap(&self) -> GfbSwap {
        let sequencer = self.gfb().sequencer();
        let merge_clocks = sequencer.merge_clocks();
        let way = self.lfb.patches.screen().pixels() + sequencer.chain() + CROSSINGS;
        GfbSwap { processors: self.processors, merge_clocks, way, late: self.longest() - merge_clocks }
    }

    /// The whole swap control.
    pub fn swap_control(&self) -> SwapControl {
        SwapControl { local: self.lfb_swap(), global: self.gfb_swap() }
    }

    /// The merger clocks after a swap within which the frame is sent and stored: T_m, the crossings, and the overheads
    /// of lines. One overhead may contain the swap, and each line that the last pixels need adds one.
    fn longest(&self) -> u64 {
        let sequencer = self.gfb().sequencer();
        let overheads = 1 + (sequencer.chain() + CROSSINGS).div_ceil(self.lfb.patches.screen().width);
        sequencer.merge_clocks() + u64::from(overheads * self.overhead + CROSSINGS + 1)
    }

    fn build(&self, m: Module, i: Vc1In) -> Vc1Out {
        let (pe, merge) = (m.on(PE), m.on(MERGE));
        let screen = self.lfb.patches.screen();
        let lanes = bit().of(self.processors);

        def!(merged = merge.wire(WORD));
        def!(gfb_swap = merge.wire(bit()));
        let gfb = GfbUnitIn { swap: *gfb_swap, host: i.host, merged: *merged };
        def!(gfb = m.instance(&self.gfb(), gfb));

        def!(swap = pe.wire(lanes));
        def!(resume = pe.wire(lanes));
        let ProcessorIn { request, clear, sends, done } = stack(i.processors);
        let senders = sends.lanes().into_iter().chain([i.command]).collect();
        def!(bus = pe.instance(&self.bus(), BroadcastBusIn { senders }));
        let patch = clear.patch;
        def!(
            lfb = m.array(self.processors, &self.lfb, |_| {
                let widths = Position::widths(screen).of(self.processors);
                let preset = constants(widths, |position| ScanCounter::preset(screen, position));
                LfbUnitIn { request, clear, swap: *swap, resume: *resume, scan: gfb.scan, preset }
            })
        );
        let LfbUnitOut { overflow, idle, draws, clears, sending, word, scanned, .. } = lfb;
        self.state_how_they_scan(merge, scanned, gfb.scan.restart);

        // The swaps.
        def!(finished = idle & bus.empty);
        let control = SwapControlIn {
            done,
            idle: finished,
            overflow,
            draws,
            clears,
            patch,
            bus: bus.idle,
            host: i.ready,
            sending,
            enable: gfb.scan.enable,
            blanking: gfb.blanking,
        };
        let control = m.instance("u_swap", &self.swap_control(), control);
        swap.drive(control.swap);
        resume.drive(control.resume);
        gfb_swap.drive(control.gfb_swap);
        def!(brought = bus.idle & bus.empty.and_all());
        pe.assert(
            control.line.implies(brought & idle.and_all()),
            "the line is high only with the bus and all queues empty and all local frame buffers idle",
        );
        pe.cover("a word on the bus or in a queue keeps the line low", (done & idle).and_all() & i.ready & !brought);

        let chain = ImageMerger { units: self.processors };
        let inputs = ImageMergerIn { left: gfb.left, samples: word.to_vec(), enable: gfb.scan.enable };
        def!(merger = merge.instance(&chain, inputs));
        merged.drive(merger.merged);

        let processor = |position| ProcessorOut {
            state: control.state.lane(position),
            pages_used: lfb.pages_used.lane(position),
            idle: idle.lane(position),
            received: bus.received[position as usize],
        };
        Vc1Out {
            processors: (0..self.processors).map(processor).collect(),
            line: control.line,
            view: gfb.view,
            is_merged: control.merged,
            shown: control.shown,
            pixel: gfb.pixel,
        }
    }

    /// Asserts that each scan counter runs 4 pixels ahead of the succeeding one, modulo a frame (VC1-SCAN). With 4
    /// added for each position, all are at the same pixel. Each counter has a cover for whole frames.
    fn state_how_they_scan(&self, merge: Module, scanned: Position, restart: Signal) {
        let Screen { width, height } = self.lfb.patches.screen();
        let (pixels, number) = (width * height, below(2 * width * height).of(row(self.processors)));
        let lead = constants(number, |place| u64::from(STAGES) * u64::from(place));
        let [x, y] = [scanned.x, scanned.y].map(|it| it.zext(number));
        def!(sum = (y * width).trunc(number) + x + lead);
        def!(led = mux(sum.ge(pixels), sum - pixels, sum));
        def!(is_scanning = merge.reg(bit()).reset(0));
        is_scanning.when(restart, 1);
        merge.assert(
            is_scanning.implies(led.eq(led.lane(0)).and_all()),
            "each scan counter runs 4 pixels ahead of the succeeding one, modulo a frame",
        );
    }
}

/// The least number of processing element clocks that last as long as the given number of merger clocks.
fn pe_clocks(merge_clocks: u64) -> u64 {
    (merge_clocks * MERGE.period.picoseconds()).div_ceil(PE.period.picoseconds())
}

#[cfg(test)]
mod tests;
