//! The region allocator: gives each region to the first renderer that is free (PP5-ARCH, facts E3).
//!
//! ```text
//!            .-------.    .-----------------------.
//! regions ==>| next  |--->| lowest of those free  |---> given, a bit per renderer
//!            '-------'    '-----------------------'
//!                                    ^
//! free, a bit per renderer ----------'
//! ```
//!
//! The host lists the regions by decreasing load, so that small ones fill the gaps at the end of a frame. A free
//! renderer gets the next region at once, so renderers are served in the sequence in which they become free. If several
//! become free in one clock, the lowest is served first, and the others follow, one per clock.
//!
//! Latency: none; a region a clock.

use tilewright_blocks::first;

use super::REGION_BITS;
use crate::prelude::*;

block! {
    /// Gives the next region to the first renderer that is free.
    pub struct RegionAllocator {
        /// The number of renderers.
        pub renderers: u32,
    }
    latency = "a region a clock";
    source = "Pixel-planes 5, section I.3.2.1 (PP5-ARCH)";
    in(self) RegionAllocatorIn {
        /// The numbers of the regions, the one with the most primitives first.
        regions: stream(bits(REGION_BITS)),
        /// The renderers that are free.
        free: bit().of(row(self.renderers)),
    }
    out(self) RegionAllocatorOut {
        /// The renderer that gets the region in this clock, if any.
        given: bit().of(row(self.renderers)),
        /// The number of the region that is given.
        region: bits(REGION_BITS),
    }
}

impl RegionAllocator {
    fn build(&self, m: Module, i: RegionAllocatorIn) -> RegionAllocatorOut {
        let region = i.regions.take_when(i.free.or_all());
        let chosen = first(i.free.pack()).unpack(row(self.renderers));
        let given = chosen & region.taken;
        m.assert(given.or_all().eq(region.taken), "a region that is taken goes to a renderer");
        RegionAllocatorOut { given, region: *region }
    }
}

#[cfg(test)]
mod tests;
