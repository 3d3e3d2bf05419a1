//! Stands for the host: has frame after frame merged, and reads them for a checksum.

use tilewright_hdl::{Module, below, bit, bits, block, codes, def, goto, lit, mux, when};
use tilewright_rtl::gfb::Host as GfbHost;
use tilewright_rtl::parameter::Screen;
use tilewright_rtl::vc1::SWAP_CLOCKS;
use tilewright_rtl::word::WORD;

codes! {
    /// What the host does.
    enum Phase {
        /// Waits for the painters.
        Wait,
        /// Has them swap their buffers.
        Swap,
        /// Waits until the merger knows.
        Settle,
        /// Starts a round.
        Start,
        /// Merges a frame, and reads the one before.
        Merge,
        /// Exchanges the banks.
        Show,
    }
}

block! {
    /// The host of a machine with that screen.
    pub struct Host {
        pub screen: Screen,
    }
    in HostIn {
        /// All painters wait for the swap.
        drawn: bit(),
        /// All painters have swapped.
        swapped: bit(),
        /// Of all painters; steady while they wait.
        hash: bits(32),
        /// The pixel at the address of the clock before.
        read_word: bits(WORD),
        /// A round is under way.
        busy: bit(),
    }
    out HostOut {
        /// The painters are to swap their buffers.
        request: bit(),
        /// To the global frame buffer.
        gfb: GfbHost = _,
        /// Of all frames that were read, and of the painters.
        csum: bits(32),
    }
}

impl Host {
    fn build(&self, m: Module, i: HostIn) -> HostOut {
        def!(phase = m.fsm(Phase::Wait));
        def!(settling = m.reg(below(SWAP_CLOCKS)).reset(0));
        def!(settled = settling.eq(SWAP_CLOCKS - 1));
        settling.enable(phase.is(Phase::Settle)).next(mux(settled, 0, settling + 1));

        // There is nothing to read before the first frame is shown.
        def!(shown = m.reg(1).reset(0));
        shown.enable(phase.is(Phase::Show)).next(true);
        def!(address = m.reg(below(self.screen.pixels())).reset(0));
        def!(all_read = m.reg(1).reset(0));
        def!(reads = phase.is(Phase::Merge) & !all_read);
        def!(last = address.eq(self.screen.pixels() - 1));
        address.enable(reads).next(mux(last, 0, address + 1));
        all_read.next(phase.is(Phase::Merge) & (all_read | last));

        phase.next(|state| match state {
            Phase::Wait => when(i.drawn, Phase::Swap),
            Phase::Swap => when(i.swapped, Phase::Settle),
            Phase::Settle => when(settled, Phase::Start),
            Phase::Start => goto(Phase::Merge),
            Phase::Merge => when(all_read & !i.busy, Phase::Show),
            Phase::Show => goto(Phase::Wait),
        });

        def!(reading = m.reg(1).reset(0));
        reading.next(reads & shown);
        def!(csum = m.reg(32).reset(0));
        let pixel = i.read_word.slice(0..32) ^ i.read_word.slice(16..48);
        let more = mux(reading, pixel, i.hash);
        csum.enable(reading | (phase.is(Phase::Swap) & i.swapped)).next(csum.rotate_left(1) + more);
        def!(request = m.reg(1).reset(0));
        request.next(phase.is(Phase::Swap) & !i.swapped);
        HostOut {
            request: *request,
            gfb: GfbHost {
                start: phase.is(Phase::Start),
                swap: phase.is(Phase::Show),
                read_address: *address,
                background: lit(WORD, 0xffff_ff10_2030_u64),
            },
            csum: *csum,
        }
    }
}
