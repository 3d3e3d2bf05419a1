//! The VC-1 as it fits an FPGA: real local frame buffers and a real merger, processors that only convert triangles,
//! and a frame buffer of colours.
//!
//! ```text
//!               stored scene
//!                    |
//!             [ dispatcher ]
//!        .-----------+-----------.         processing elements, 40 MHz
//!  [ processor ] [ processor ]  ..
//!        |            |
//!   [ LFB unit ]  [ LFB unit ]  ..         merger, 12.5 MHz
//!        v            v
//!  -->[merging]-->[merging]--> ..  --> [ store ] --> colour, at 25 MHz
//!        unit         unit
//! ```
//!
//! # What differs from the paper's machine
//!
//! - A processor takes triangles that are set up, from a ROM. The paper's is an i860 with the whole of geometry.
//! - The scan waits at the end of a round until all local frame buffers have swapped: see [`Round`]. So the frame buffer
//!   stores no depths. A local frame buffer that overflows would need a second round, so the scene has to fit its pages.
//! - Four bits of each colour component are drawn. The merger compares all of the word: 24 bits of depth, above the
//!   cut colour.

mod dispatcher;
pub mod format;
mod processor;
mod round;
mod scene;
mod store;
mod top;

pub use dispatcher::{Dispatcher, DispatcherIn, DispatcherOut};
pub use processor::{COLOUR_BITS, Processor, ProcessorIn, ProcessorOut};
pub use round::{Round, RoundIn, RoundOut};
pub use scene::{BACKGROUND, NoScene, Turning};
pub use store::{Store, StoreIn, StoreOut};
pub use top::Vc1OnUlx3s;

use crate::picture::{Colour, Picture, PictureIn};
use tilewright_hdl::{Layout, Module, Signal, bit, block, cat, constants, def, lit, one_of, row};
use tilewright_rtl::clocks::{MERGE, PE};
use tilewright_rtl::lfb::{LfbUnit, LfbUnitIn, LfbUnitOut, ScanCounter};
use tilewright_rtl::merger::{ImageMerger, ImageMergerIn};
use tilewright_rtl::scan::Position;
use tilewright_rtl::swap::{GfbSwap, LfbSwap, SwapControl, SwapControlIn, SwapState};
use tilewright_scenes::packet::EMPTY_DEPTH;

/// Clocks of the merger beyond a round until the swap control has to know that it is over.
const LATE: u64 = 16;

block! {
    /// A small VC-1 that draws a stored scene, a step in each frame, as a picture.
    pub struct Vc1Picture {
        /// The local frame buffer of each processor.
        pub lfb: LfbUnit,
        /// The number of processors.
        pub processors: u32,
        /// What is drawn.
        pub scene: Turning,
    }
    in = PictureIn;
    out = Colour::widths(8);
}

impl Picture for Vc1Picture {
    fn latency(&self) -> u32 {
        Store::LATENCY
    }
}

impl Vc1Picture {
    /// The merging rounds.
    pub fn round(&self) -> Round {
        Round { screen: self.lfb.patches.screen(), units: self.processors }
    }

    /// The control of all swaps.
    pub fn swap_control(&self) -> SwapControl {
        let round = self.round();
        let [merge_clocks, sent_clocks] = [round.clocks(), round.clocks() + LATE].map(pe_clocks);
        // No buffer overflows.
        let local =
            LfbSwap { patches: self.lfb.patches.count(), merge_clocks, sent_clocks, overflow_clocks: 2 * sent_clocks };
        let way = round.clocks() as u32;
        SwapControl {
            local,
            global: GfbSwap { processors: self.processors, merge_clocks: round.clocks(), way, late: LATE },
        }
    }

    fn build(&self, m: Module, i: PictureIn) -> Colour {
        let (pe, merge) = (m.on(PE), m.on(MERGE));
        let (screen, lanes) = (self.lfb.patches.screen(), bit().of(row(self.processors)));

        // The processors, and what they are given.
        def!(runs = pe.synchronize(i.runs));
        def!(state = pe.wire(one_of::<SwapState>().of(row(self.processors))));
        def!(line = pe.wire(bit()));
        def!(free = pe.wire(lanes));
        def!(may_draw = state.is(SwapState::Draw).and_all());
        let dispatcher = Dispatcher { scene: self.scene.clone(), processors: self.processors };
        let asked = DispatcherIn { begins: may_draw & runs, ends: *line, free: *free };
        def!(dispatcher = pe.instance(&dispatcher, asked));
        let given = ProcessorIn {
            runs,
            state: *state,
            given: dispatcher.given,
            valid: dispatcher.valid,
            words: dispatcher.words.clone(),
        };
        let processor = Processor { patches: self.lfb.patches };
        def!(processor = pe.array(self.processors, &processor, |_| given));
        free.drive(processor.free);

        // Local frame buffers and merger.
        def!(round_swap = merge.wire(bit()));
        def!(sending = merge.wire(lanes));
        def!(round = merge.instance(&self.round(), RoundIn { swap: *round_swap, sending: *sending }));
        def!(swap = pe.wire(lanes));
        def!(resume = pe.wire(lanes));
        let (request, clear) = (processor.request, processor.clear);
        let patch = clear.patch;
        def!(
            lfb = m.array(self.processors, &self.lfb, |_| {
                let widths = Position::widths(screen).of(self.processors);
                let preset = constants(widths, |position| ScanCounter::preset(screen, position));
                LfbUnitIn { request, clear, swap: *swap, resume: *resume, scan: round.scan, preset }
            })
        );
        let LfbUnitOut { overflow, idle, draws, clears, word, .. } = lfb;
        sending.drive(lfb.sending);
        pe.assert(!overflow.or_all(), "the stored scene fits the pages");
        let chain = ImageMerger { units: self.processors };
        let blank = lit(48, u64::from(EMPTY_DEPTH) << 24 | cut(BACKGROUND));
        let inputs = ImageMergerIn { left: blank, samples: word.to_vec(), enable: round.scan.enable };
        def!(merger = merge.instance(&chain, inputs));

        // The frame buffer, and the swaps.
        let store = StoreIn {
            swap: *round_swap,
            stores: round.stores,
            store: round.store,
            colour: stored(merger.merged),
            picture: i,
        };
        def!(store = m.instance(&Store { screen }, store));
        let control = SwapControlIn {
            done: processor.done,
            idle,
            overflow,
            draws,
            clears,
            patch,
            bus: lit(1, 1),
            host: lit(1, 1),
            sending: *sending,
            enable: round.scan.enable,
            blanking: store.blanking,
        };
        let control = m.instance("u_swap", &self.swap_control(), control);
        swap.drive(control.swap);
        resume.drive(control.resume);
        round_swap.drive(control.gfb_swap);
        state.drive(control.state);
        line.drive(control.line);
        store.shown
    }
}

/// The least number of clocks of processing elements that last as long as these clocks of the merger.
fn pe_clocks(merge_clocks: u64) -> u64 {
    (merge_clocks * MERGE.period.picoseconds()).div_ceil(PE.period.picoseconds())
}

/// A colour of 24 bits as it is drawn: the low bits of each component are ones.
fn cut(rgb: [u8; 3]) -> u64 {
    let low = 0xff >> COLOUR_BITS;
    rgb.iter().fold(0, |word, part| word << 8 | u64::from(part | low))
}

/// A colour as it is shown: the high bits of each component, twice.
pub fn as_shown(rgb: [u8; 3]) -> [u8; 3] {
    rgb.map(|part| {
        let high = part >> (8 - COLOUR_BITS);
        high << COLOUR_BITS | high
    })
}

/// The bits of a word's colour that are stored.
fn stored(word: Signal) -> Signal {
    let component = |place: u32| word.part(8 * place + 8 - COLOUR_BITS, COLOUR_BITS);
    cat![component(2), component(1), component(0)]
}
