//! The VC-1's frame path at work: its whole hardware, with processors and a host that need nobody outside.
//!
//! ```text
//!  [ painter 0 ]   [ painter 1 ]  ..  [ painter n-1 ]        PE clock
//!        |               |                  |
//!  .-----v---------------v------------------v-------.
//!  |                      VC-1                      |
//!  '-----------------------^------------------------'
//!                          |                             merge clock
//!                      [ host ]--> checksum
//! ```
//!
//! Frame after frame, the painters clear their patch tables and draw, while the host has the frame before merged and reads the one
//! before that; then all swap. As in a frame of the teapot, most of the time goes into merging.
//!
//! What it asks of a simulator: two clocks, large memories, and units that are alike inside of a machine that is not.

mod host;
mod painter;

use tilewright_hdl::{Module, Signal, bits, block, constants, def, stack};
use tilewright_rtl::clocks::{MERGE, PE};
use tilewright_rtl::lfb::{LfbUnit, Patches};
use tilewright_rtl::parameter::{ParameterError, Screen};
use tilewright_rtl::vc1::{ProcessorIn, Vc1, Vc1In};

use super::BenchOut;
use crate::word::seed;
use host::{Host, HostIn};
use painter::{Painter, PainterIn};

block! {
    /// Frame after frame on a VC-1 whose processors draw at random.
    pub struct Vc1Frames {
        vc1: Vc1,
        patches: Patches,
        processors: u32,
        /// Patches that a painter draws for a frame.
        painted: u32,
    }
    source = "VC-1, section 3.3 (VC1-FLOW, VC1-LFB, VC1-PIM, VC1-GFB)";
    out = BenchOut { csum: bits(32) };
}

impl Vc1Frames {
    /// A VC-1 with patches of 4x4 pixels, pages for a quarter of them, 4096 at most, in each buffer, and painters that fill a quarter
    /// of those for a frame.
    ///
    /// # Errors
    ///
    /// There is no such VC-1, or a side of the screen is no multiple of 4.
    pub fn new(screen: Screen, processors: u32) -> Result<Vc1Frames, ParameterError> {
        let patches = Patches::new(screen, 4)?;
        if !(screen.width.is_multiple_of(4) && screen.height.is_multiple_of(4)) {
            let Screen { width, height } = screen;
            return Err(ParameterError(format!("a screen of {width}x{height} pixels: take multiples of 4")));
        }
        let pages = (patches.count() / 4).clamp(2, 4096);
        let lfb = LfbUnit { patches, pages }.checked()?;
        let vc1 = Vc1 { lfb, processors }.checked()?;
        Ok(Vc1Frames { vc1, patches, processors, painted: pages.div_ceil(4) })
    }

    /// How many cycles there are from a frame to the next, where drawing takes less time than merging: T_m (VC1-TM) and the
    /// swaps, in clocks of the merger, with 4 instants for each at which one or both of its clocks rise.
    pub fn frame_cycles(&self) -> u64 {
        const SWAPS: u64 = 14;
        4 * (self.vc1.gfb().sequencer().merge_clocks() + SWAPS)
    }

    fn build(&self, m: Module, (): ()) -> BenchOut {
        let (pe, merge) = (m.on(PE), m.on(MERGE));
        let idle: Vec<_> = (0..self.processors).map(|number| m.wire(&format!("idle{number}"), 1)).collect();
        def!(request = merge.wire(1));
        def!(swap = pe.synchronize(*request));

        let painter = Painter { patches: self.patches, painted: self.painted };
        let painters = pe.array("u_painter", self.processors, &painter, |_| PainterIn {
            seed: constants(bits(32).of(self.processors), seed),
            idle: stack(idle.iter().map(|wire| Signal::from(*wire))),
            swap,
        });

        let host = Host { screen: self.patches.screen() };
        let [read_word, busy] = [("read_word", 48), ("busy", 1)].map(|(name, width)| merge.wire(name, width));
        def!(drawn = merge.synchronize(pe.pipe("all_drawn", painters.drawn.and_all())));
        def!(swapped = merge.synchronize(pe.pipe("all_swapped", painters.swapped.and_all())));
        let hash = painters.hash.xor_all().quasi_static("the painters wait when the host looks at it");
        let host = merge.instance("u_host", &host, HostIn { drawn, swapped, hash, read_word: *read_word, busy: *busy });
        request.drive(host.request);

        let ProcessorIn { request, clear, swap, resume } = painters.vc1;
        let streams = request.lanes().into_iter().zip(clear.lanes());
        let processor = |(number, (request, clear))| {
            let [swap, resume] = [swap, resume].map(|field| field.lane(number));
            ProcessorIn { request, clear, swap, resume }
        };
        let processors = (0..).zip(streams).map(processor).collect();
        let vc1 = m.instance("u_vc1", &self.vc1, Vc1In { processors, gfb: host.gfb });
        read_word.drive(vc1.gfb.read_word);
        busy.drive(vc1.gfb.busy);
        for (idle, processor) in idle.iter().zip(&vc1.processors) {
            idle.drive(processor.idle);
        }
        BenchOut { csum: host.csum }
    }
}
