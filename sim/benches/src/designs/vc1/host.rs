//! Represents the host: reads each frame that is shown, for a checksum.

use tilewright_hdl::{Module, below, bit, bits, block, def, lit, mux};
use tilewright_rtl::gfb::{Access, Host as GfbHost};
use tilewright_rtl::parameter::Screen;
use tilewright_rtl::word::WORD;

block! {
    /// The host of a machine with this screen.
    pub struct Host {
        pub screen: Screen,
    }
    in HostIn {
        /// Toggles with each frame that is shown.
        shown: bit(),
        /// The hash of all painters, for the frame that is shown; stable while it is read.
        hash: bits(32),
        /// The pixel that the host has requested, 1 clock later.
        read_word: bits(WORD),
    }
    out HostOut {
        /// To the global frame buffer.
        gfb: GfbHost = _,
        /// A checksum of all frames that were read, and of the painters.
        csum: bits(32),
    }
}

impl Host {
    fn build(&self, m: Module, i: HostIn) -> HostOut {
        def!(was_shown = m.reg(bit()).reset(0));
        was_shown.next(i.shown);
        def!(begins = was_shown.ne(i.shown));
        def!(address = m.reg(below(self.screen.pixels())).reset(0));
        def!(reads = m.reg(bit()).reset(0));
        def!(last = address.eq(self.screen.pixels() - 1));
        reads.when(begins, 1).when(last, 0);
        address.when(begins, 0).when(reads & !last, address + 1);

        def!(reading = m.reg(bit()).reset(0));
        reading.next(reads);
        def!(csum = m.reg(32).reset(0));
        let pixel = i.read_word.slice(0..32) ^ i.read_word.slice(16..48);
        csum.enable(reading | begins).next(csum.rotate_left(1) + mux(reading, pixel, i.hash));
        let access = Access { address: *address, writes: lit(1, 0), word: lit(WORD, 0) };
        let (accesses, _) = m.offer(*reads, access);
        HostOut {
            gfb: GfbHost { accesses, background: lit(WORD, 0xffff_ff10_2030_u64), multipass: Vec::new() },
            csum: *csum,
        }
    }
}
