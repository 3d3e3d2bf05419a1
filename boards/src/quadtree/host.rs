//! The host: swaps the banks of the video buffers while nothing is shown, and has them cleared before.

use tilewright_hdl::{Module, below, bit, block, def, up_to};

block! {
    /// Decides at each vertical retrace what is shown next.
    ///
    /// A picture is shown `refreshes` times, and longer if the next one is not drawn yet. It is cleared while it is
    /// shown for the last time. Then the banks are swapped, and the player begins the next step.
    pub struct Host {
        /// How often a picture is shown: 2 or more.
        pub refreshes: u32,
        /// The number of banks whose words are unknown at the start. They are cleared before the first step.
        pub unknown: u32,
    }
    ranges { refreshes: 2..=60, unknown: 0..=2 }
    in HostIn {
        /// High for one clock when a picture has been shown.
        retrace: bit(),
        /// The step is drawn: its packets are sent, and no polygon is under way.
        drawn: bit(),
    }
    out HostOut {
        /// Swaps the banks; in the clock of the retrace.
        swap: bit(),
        /// Begins to read the picture; a clock later.
        start: bit(),
        /// The picture is cleared while it is read.
        clear: bit(),
        /// Begins the next step; a clock later.
        go: bit(),
    }
}

impl Host {
    fn build(&self, m: Module, i: HostIn) -> HostOut {
        def!(unknown = m.reg(up_to(2)).reset(self.unknown));
        def!(begun = m.reg(bit()).reset(0));
        def!(clears = m.reg(bit()).reset(0));
        def!(shown = m.reg(below(self.refreshes)).reset(0));
        def!(begins = i.retrace & unknown.eq(0) & (clears | !begun));
        def!(is_enough = shown.ge(self.refreshes - 2));
        def!(ends = begun & !clears & i.drawn & is_enough);
        unknown.when(i.retrace & unknown.ne(0), unknown - 1);
        begun.when(begins, 1);
        clears.when(i.retrace, unknown.ne(0) | ends);
        shown.when(begins, 0).when(i.retrace & !is_enough, shown + 1);
        HostOut {
            swap: i.retrace & clears,
            start: m.pipe("start", i.retrace),
            clear: *clears,
            go: m.pipe("go", begins),
        }
    }
}
