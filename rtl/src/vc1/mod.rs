//! The VC-1's frame buffer subsystem: everything of the machine that is hardware here (section 3.3 of the paper).
//!
//! ```text
//!    processor 0        processor 1               processor n-1
//!        |                  |                          |
//!   [ LFB unit ]       [ LFB unit ]               [ LFB unit ]
//!        |                  |                          |
//!        v                  v                          v
//!  .->[merging unit]-->[merging unit]--> .. -->[merging unit]--.
//!  |                                                           |
//!  '-------------------- [ GFB unit ] <------------------------'
//!                             |
//!                           host
//! ```
//!
//! The processors' programs and the host are behind the ports. Each processor draws into its own virtual local frame
//! buffer at its own pace; when all have swapped theirs, the host starts a round of merging, which fills a bank of the global
//! frame buffer, and swaps that to where it can be read.
//!
//! # Protocol
//!
//! | who | does | when |
//! |---|---|---|
//! | processor | swaps its buffers | idle or in overflow, and a whole round has begun and ended since its last swap (VC1-SW3) |
//! | processor | clears its patch table, then resumes | after its swap (VC1-CLR2) |
//! | host | starts a round | no round is under way; [`SWAP_CLOCKS`] after a swap that has to be seen from its first pixel on |
//! | host | swaps the banks | no round is under way, and all that was drawn has been merged (VC1-SW2) |
//! | host | reads the picture | at any time |
//!
//! A processor that swaps during a round loses nothing (VC1-SW4): what the scan has passed already is sent in the next round.

use crate::gfb::{GfbUnit, GfbUnitIn, Host, View};
use crate::lfb::{LfbUnit, LfbUnitIn, LfbUnitOut, Request, ScanCounter, Wanted};
use crate::merger::{ImageMerger, ImageMergerIn, STAGES};
use crate::prelude::*;

/// The scan line overhead of the VC-1, beta, in clocks of the merger (VC1-TM).
pub const OVERHEAD: u32 = 20;

/// The clocks of the merger, at most, until its units know of a swap of local frame buffers.
pub const SWAP_CLOCKS: u64 = 3;

bundle! {
    /// What a processor says to its local frame buffer.
    pub struct ProcessorIn<T> {
        /// A pixel to draw.
        pub request: Stream<Request<T>, T>,
        /// A patch table entry to clear.
        pub clear: Stream<Wanted<T>, T>,
        /// For one clock, when idle or in overflow: exchange the buffers.
        pub swap: T,
        /// For one clock, in overflow: try the held request again.
        pub resume: T,
    }

    /// What a processor sees of its local frame buffer.
    pub struct ProcessorOut<T> {
        /// The request is held: all pages are taken.
        pub overflow: T,
        /// How many pages are taken.
        pub pages_used: T,
        /// Nothing is under way.
        pub idle: T,
    }
}

block! {
    /// The frame buffer subsystem of a VC-1: virtual local frame buffers, pipelined image merger, global frame buffer.
    pub struct Vc1 {
        /// The local frame buffer of each processor.
        pub lfb: LfbUnit,
        /// How many processors there are.
        pub processors: u32,
    }
    ranges(self) {
        /// Each scan counter runs 4 pixels ahead of the succeeding one.
        processors: 1..=self.lfb.patches.screen().pixels() / STAGES,
    }
    latency(self) = format!("a round of merging takes {} clocks", self.gfb().sequencer().merge_clocks());
    source = "VC-1, section 3.3 (VC1-LFB, VC1-PIM, VC1-GFB)";
    in(self) Vc1In {
        /// Of each processor.
        processors: [ProcessorIn = self.processor(); self.processors],
        /// Of the host.
        gfb: Host = self.gfb().inputs().host.on(MERGE),
    }
    out(self) Vc1Out {
        /// To each processor.
        processors: [ProcessorOut] = _,
        /// To the host.
        gfb: View = _,
    }
}

impl Vc1 {
    /// Its global frame buffer unit.
    pub fn gfb(&self) -> GfbUnit {
        GfbUnit { screen: self.lfb.patches.screen(), units: self.processors, overhead: OVERHEAD }
    }

    /// The widths of what a processor says.
    fn processor(&self) -> ProcessorIn<Width> {
        let LfbUnitIn { request, clear, swap, resume, .. } = self.lfb.inputs();
        ProcessorIn { request, clear, swap, resume }
    }

    fn build(&self, m: Module, i: Vc1In) -> Vc1Out {
        let merge = m.on(MERGE);
        let screen = self.lfb.patches.screen();

        def!(merged = merge.wire(WORD));
        let gfb = merge.instance("u_gfb", &self.gfb(), GfbUnitIn { host: i.gfb, merged: *merged });

        let lfb = m.array("u_lfb", self.processors, &self.lfb, |_| {
            let ProcessorIn { request, clear, swap, resume } = stack(i.processors);
            let widths = ScanCounter::position(screen).map(|width| width.of(self.processors));
            let preset = constants(widths, |position| ScanCounter::preset(screen, position));
            LfbUnitIn { request, clear, swap, resume, scan: gfb.scan, preset }
        });

        let chain = ImageMerger { units: self.processors };
        let inputs = ImageMergerIn { left: gfb.left, samples: lfb.word.to_vec(), enable: gfb.scan.enable };
        merged.drive(merge.instance("u_merger", &chain, inputs).merged);

        let processor = |position| {
            let LfbUnitOut { overflow, pages_used, idle, .. } = lfb.map(|unit| unit.lane(position));
            ProcessorOut { overflow, pages_used, idle }
        };
        Vc1Out { processors: (0..self.processors).map(processor).collect(), gfb: gfb.view }
    }
}

#[cfg(test)]
mod tests;
