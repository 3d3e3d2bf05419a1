//! The network port: the compositors of a node's chips, and the counter of their pixels (PFL-NET, PFL-TCB).
//!
//! ```text
//!                 .-------.
//! sends, first -->|       |--> pixel, whose bytes the node has to show
//!        mode --->| count |--> advances
//!                 |       |--> unloaded: the bytes of upstream are for the node
//!                 '-------'
//!                     | advances, first, pixel
//!                     v
//! upstream ==> [ a compositor for each chip ] ==> downstream
//!                     ^
//! own --------------' a byte of each chip
//! ```
//!
//! The network never waits: a byte goes on in the next clock. A node that loads decides when it sends; all others
//! follow the bytes that arrive. A byte of all pixels takes as many clocks as a chip has pixels: 256, or 1.28 us
//! (PFL-TCB). Each node is one clock behind its predecessor.
//!
//! Latency: 1 clock; a byte of each chip in every clock.

use super::compositor::{Compositor, CompositorIn, Mode};
use crate::prelude::*;

block! {
    /// Connects a node to the network that composes images.
    pub struct NetworkPort {
        /// The number of chips of the node.
        pub chips: u32,
        /// The number of pixels of a chip.
        pub pixels: u32,
        /// The width of a byte.
        pub width: u32,
    }
    latency(self) = format!("1 clock; a byte of all pixels takes {}", self.pixels);
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NET, PFL-TCB)";
    in(self) NetworkPortIn {
        /// The mode of the node, constant during a word: a [`Mode`].
        mode: one_of::<Mode>(),
        /// A node in mode `Load` sends a byte of each chip.
        sends: bit(),
        /// The byte is the first of a word.
        first: bit(),
        /// The bytes from the previous node.
        upstream: Transfer::widths(self),
        /// The node's own bytes of the pixels at `pixel`.
        own: bits(self.width).of(row(self.chips)),
    }
    out(self) NetworkPortOut {
        /// The current pixel of each chip.
        pixel: below(self.pixels),
        /// A byte of the current pixel is transferred.
        advances: bit(),
        /// The bytes from upstream are for this node.
        unloaded: bit(),
        /// The bytes to the next node.
        downstream: Transfer::widths(self),
    }
}

record! {
    /// A byte of each chip on the network.
    pub struct Transfer(port: &NetworkPort) {
        /// A byte of each chip is transferred.
        valid: bit(),
        /// The byte is the first of a word.
        first: bit(),
        /// The bytes, one of each chip.
        bytes: bits(port.width).of(row(port.chips)),
    }
}

impl NetworkPort {
    fn build(&self, m: Module, i: NetworkPortIn) -> NetworkPortOut {
        let NetworkPort { chips, pixels, width } = *self;
        def!(loads = i.mode.is(Mode::Load));
        def!(advances = mux(loads, i.sends, i.upstream.valid));
        def!(is_first = mux(loads, i.first, i.upstream.first));
        def!(pixel = m.reg(below(pixels)).reset(0));
        pixel.when(advances, mux(pixel.eq(pixels - 1), 0, pixel + 1));
        m.assume(!(loads & i.upstream.valid), "no byte arrives while a node loads");

        let each = |signal: Signal| signal.of(row(chips));
        def!(
            compositor = m.array(row(chips), &Compositor { pixels, width }, |_| CompositorIn {
                mode: each(i.mode),
                advances: each(advances),
                first: each(is_first),
                pixel: each(*pixel),
                upstream: i.upstream.bytes,
                own: i.own,
            })
        );
        let valid = m.reg("downstream_valid", bit()).reset(0);
        valid.next(advances);
        let downstream =
            Transfer { valid: *valid, first: m.pipe("downstream_first", is_first), bytes: compositor.downstream };
        NetworkPortOut { pixel: *pixel, advances, unloaded: i.mode.is(Mode::Unload) & i.upstream.valid, downstream }
    }
}

#[cfg(test)]
mod tests;
