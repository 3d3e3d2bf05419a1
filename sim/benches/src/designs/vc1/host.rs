//! Stands for the host: has frame after frame merged, and reads them for a checksum.

use tilewright_hdl::{Block, Module, Width, below, bit, bits, bundle, codes, goto, lit, mux, net, when};
use tilewright_rtl::gfb;
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

bundle! {
    /// The inputs of [`Host`].
    pub struct HostIn<T> {
        /// All painters wait for the swap.
        pub drawn: T,
        /// All painters have swapped.
        pub swapped: T,
        /// Of all painters; steady while they wait.
        pub hash: T,
        /// The pixel at the address of the clock before.
        pub read_word: T,
        /// A round is under way.
        pub busy: T,
    }

    /// The outputs of [`Host`].
    pub struct HostOut<T> {
        /// The painters are to swap their buffers.
        pub request: T,
        /// To the global frame buffer.
        pub gfb: gfb::Host<T>,
        /// Of all frames that were read, and of the painters.
        pub csum: T,
    }
}

/// The host of a machine with that screen.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Host {
    pub screen: Screen,
}

impl Block for Host {
    type In = HostIn;
    type Out = HostOut;

    fn inputs(&self) -> HostIn<Width> {
        HostIn { drawn: bit(), swapped: bit(), hash: bits(32), read_word: bits(WORD), busy: bit() }
    }

    fn build(&self, m: Module, i: HostIn) -> HostOut {
        let phase = m.fsm("phase", Phase::Wait);
        let settling = m.reg("settling", below(SWAP_CLOCKS)).reset(0);
        net!(settled = settling.eq(SWAP_CLOCKS - 1));
        settling.enable(phase.is(Phase::Settle)).next(mux(settled, 0, settling + 1));

        // There is nothing to read before the first frame is shown.
        let shown = m.reg("shown", 1).reset(0);
        shown.enable(phase.is(Phase::Show)).next(true);
        let address = m.reg("address", below(self.screen.pixels())).reset(0);
        let all_read = m.reg("all_read", 1).reset(0);
        net!(reads = phase.is(Phase::Merge) & !all_read);
        net!(last = address.eq(self.screen.pixels() - 1));
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

        let reading = m.reg("reading", 1).reset(0);
        reading.next(reads & shown);
        let csum = m.reg("csum", 32).reset(0);
        let pixel = i.read_word.slice(0..32) ^ i.read_word.slice(16..48);
        let more = mux(reading, pixel, i.hash);
        csum.enable(reading | (phase.is(Phase::Swap) & i.swapped)).next(csum.rotate_left(1) + more);
        let request = m.reg("request", 1).reset(0);
        request.next(phase.is(Phase::Swap) & !i.swapped);
        HostOut {
            request: request.value(),
            gfb: gfb::Host {
                start: phase.is(Phase::Start),
                swap: phase.is(Phase::Show),
                read_address: address.value(),
                background: lit(WORD, 0xffff_ff10_2030),
            },
            csum: csum.value(),
        }
    }

    fn name(&self) -> String {
        "vc1_host".to_owned()
    }
}
