//! The merging round of a frame: it begins when all local frame buffers have swapped, and passes once over the screen.
//!
//! ```text
//! swap --> Restart --> Wait --- all send ---> Run --- the last pixel is stored ---> Stop
//! ```
//!
//! The paper's merger scans without a pause. A frame then begins within a round and ends within the next one, so its
//! frame buffer stores depths and feeds them back. A round of its own for each frame needs only the colours.

use tilewright_hdl::{Module, below, bit, block, codes, def, goto, row, up_to, when};
use tilewright_rtl::gfb::SCAN_LATENCY;
use tilewright_rtl::merger::STAGES;
use tilewright_rtl::parameter::Screen;
use tilewright_rtl::scan::ScanControl;

codes! {
    /// The parts of a round.
    enum Part { Restart, Wait, Run, Stop }
}

block! {
    /// Paces the scan of one round, and tells where its pixels are stored.
    pub struct Round {
        /// The screen.
        pub screen: Screen,
        /// The merging units of the chain.
        pub units: u32,
    }
    ranges { units: 1.. }
    latency(self) = format!("a round of {} clocks", self.clocks());
    source = "VC-1, section 3.3, T_m (VC1-TM), without overheads";
    in(self) RoundIn {
        /// High for one clock when the banks of the frame buffer are swapped.
        swap: bit(),
        /// For each local frame buffer: a part of its back buffer has not been sent.
        sending: bit().of(row(self.units)),
    }
    out(self) RoundOut {
        /// The control of the scan, for every unit of the chain.
        scan: ScanControl,
        /// A pixel leaves the chain.
        stores: bit(),
        /// The number of that pixel, in raster order.
        store: below(self.screen.pixels()),
    }
}

impl Round {
    /// The clocks with `enable` from the address of a pixel until it leaves the chain.
    pub fn way(&self) -> u32 {
        SCAN_LATENCY + STAGES * self.units
    }

    /// The clocks of a round.
    pub fn clocks(&self) -> u64 {
        u64::from(self.way()) + u64::from(self.screen.pixels())
    }

    fn build(&self, m: Module, i: RoundIn) -> RoundOut {
        let last = self.screen.pixels() - 1;
        def!(part = m.fsm(Part::Restart));
        def!(runs = part.is(Part::Run));
        def!(restarts = part.is(Part::Restart));
        def!(way_left = m.reg(up_to(self.way())).reset(self.way()));
        def!(stores = runs & way_left.eq(0));
        way_left.when(restarts, self.way()).when(runs & way_left.ne(0), way_left - 1);
        def!(store = m.reg(below(self.screen.pixels())).reset(0));
        def!(ends = stores & store.eq(last));
        store.when(ends, 0).when(stores, store + 1);
        part.next(|part| match part {
            Part::Restart => goto(Part::Wait),
            Part::Wait => when(i.sending.and_all(), Part::Run),
            Part::Run => when(ends, Part::Stop),
            Part::Stop => when(i.swap, Part::Restart),
        });
        m.assert(i.swap.implies(part.is(Part::Stop)), "the banks are swapped when a round is over");
        RoundOut { scan: ScanControl { restart: restarts, enable: runs }, stores, store: *store }
    }
}
