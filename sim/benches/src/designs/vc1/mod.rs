//! The VC-1's frame path at work: its whole hardware, with processors and a host that need no outside input.
//!
//! ```text
//!  [ painter 0 ]   [ painter 1 ]  ..  [ painter n-1 ]        PE clock
//!        |               |                  |
//!  .-----v---------------v------------------v-------.
//!  |                      VC-1                      |
//!  '-----------------------^------------------------'     pixel clock
//!                          |                             merge clock
//!                      [ host ]--> checksum
//! ```
//!
//! Frame after frame, the painters clear their patch tables and draw, while the previous frame is merged, and the
//! host reads the one before that. As in a frame of the teapot, most of the time goes into merging: a frame comes
//! every two refreshes of the display.
//!
//! It tests three clocks, large memories, and identical units inside an irregular machine.

mod host;
mod painter;

use tilewright_hdl::{Module, bit, bits, block, constants, def, lit, one_of, stack};
use tilewright_rtl::bus::{BroadcastBus, BusWord};
use tilewright_rtl::clocks::{MERGE, PE};
use tilewright_rtl::gfb::{Blanking, Display};
use tilewright_rtl::lfb::{LfbUnit, Patches};
use tilewright_rtl::parameter::{ParameterError, Screen};
use tilewright_rtl::swap::SwapState;
use tilewright_rtl::vc1::{OVERHEAD, ProcessorIn, Vc1, Vc1In};

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
        /// The patches that a painter draws for a frame.
        painted: u32,
    }
    source = "VC-1, section 3.3 (VC1-FLOW, VC1-LFB, VC1-PIM, VC1-GFB)";
    out = BenchOut { csum: bits(32) };
}

impl Vc1Frames {
    /// A VC-1 with patches of 4x4 pixels. Each buffer has pages for a quarter of them, 4096 at most, and painters
    /// fill a quarter of those for a frame.
    ///
    /// # Errors
    ///
    /// There is no such VC-1, or a side of the screen is not a multiple of 4.
    pub fn new(screen: Screen, processors: u32) -> Result<Vc1Frames, ParameterError> {
        let patches = Patches::new(screen, 4)?;
        if !(screen.width.is_multiple_of(4) && screen.height.is_multiple_of(4)) {
            let Screen { width, height } = screen;
            return Err(ParameterError(format!("a screen of {width}x{height} pixels: take multiples of 4")));
        }
        let pages = (patches.count() / 4).clamp(2, 4096);
        let lfb = LfbUnit { patches, pages }.checked()?;
        // The paper's T_m is one and a half refreshes.
        let of = |display| Vc1 {
            lfb: lfb.clone(),
            processors,
            queue: BroadcastBus::QUEUE,
            word_clocks: BroadcastBus::WORD_CLOCKS,
            display,
            overhead: OVERHEAD,
            accumulation: false,
        };
        let t_m = of(Display::VGA).gfb().sequencer().merge_clocks() * MERGE.period.picoseconds();
        let display = Display::of_rate(screen, 1.52e12 / t_m as f64, Blanking::AtStart)?;
        let vc1 = Vc1 { display, ..of(Display::VGA) }.checked()?;
        Ok(Vc1Frames { vc1, patches, processors, painted: pages.div_ceil(4) })
    }

    /// The approximate number of instants at which a clock rises, from a frame to the next: two refreshes.
    pub fn frame_cycles(&self) -> u64 {
        let refresh = self.vc1.gfb().read_out().refresh_clocks() * self.vc1.display.period.picoseconds();
        let clocks =
            [PE.period, MERGE.period, self.vc1.display.period].map(|period| 2 * refresh / period.picoseconds());
        clocks.iter().sum()
    }

    fn build(&self, m: Module, (): ()) -> BenchOut {
        let (pe, merge) = (m.on(PE), m.on(MERGE));
        let states = one_of::<SwapState>().of(self.processors);
        def!(state = pe.wire(states));
        let painter = Painter { patches: self.patches, painted: self.painted };
        let painters = pe.array("u_painter", self.processors, &painter, |_| PainterIn {
            seed: constants(bits(32).of(self.processors), seed),
            state: *state,
        });

        let host = Host { screen: self.patches.screen() };
        def!(read_word = merge.wire(48));
        def!(shown = merge.wire(bit()));
        def!(line = pe.wire(bit()));
        def!(drawn = pe.reg(32).reset(0));
        drawn.when(*line, painters.hash.xor_all());
        let hash = drawn.quasi_static("it is of the frame that is shown until the next one is drawn");
        let host = merge.instance("u_host", &host, HostIn { shown: *shown, hash, read_word: *read_word });

        let ProcessorIn { request, clear, sends, done } = painters.vc1;
        let streams = request.lanes().into_iter().zip(clear.lanes()).zip(sends.lanes());
        let processor =
            |(number, ((request, clear), sends))| ProcessorIn { request, clear, sends, done: done.lane(number) };
        let processors = (0..).zip(streams).map(processor).collect();
        let silent = BusWord { word: lit(32, 0), last: lit(1, 0) };
        let (command, _) = pe.offer(lit(1, 0), silent);
        let vc1 = m.instance("u_vc1", &self.vc1, Vc1In { processors, command, ready: lit(1, 1), host: host.gfb });
        for processor in &vc1.processors {
            processor.received.take_when(lit(1, 1));
        }
        read_word.drive(vc1.view.read_word);
        shown.drive(vc1.shown);
        line.drive(vc1.line);
        state.drive(stack(vc1.processors.iter().map(|it| it.state)));
        BenchOut { csum: host.csum }
    }
}
