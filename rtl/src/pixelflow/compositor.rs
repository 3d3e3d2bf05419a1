//! The compositor: of two words that come byte by byte, the lesser, for each pixel of a chip in turn (PFL-NET, facts E4).
//!
//! ```text
//!                                  .---------.
//! pixel ------------------------->| states  |<--.
//!                                  '----|----'   | nearer
//!                                equal, v own, | upstream
//! upstream -----+-----------------> compare -----'
//!               |    .--------------->  |
//! own --------|----+                  v
//!               '----|---------------->mux--[ ]--> downstream
//!                    '---------------->
//! ```
//!
//! A word is the whole of what is known of a pixel, with its depth first, most significant byte first. So the lesser word is the nearer
//! pixel, and equal depths are decided by what follows, alike in every order of nodes. As long as all bytes were equal, both are; the first that
//! differs decides, and the rest of the word follows it.
//!
//! The bytes of all pixels come in turn: the first byte of each, then the second of each. So between two bytes of a pixel its state is kept.
//!
//! Latency 1 clock, a byte a clock.

use crate::prelude::*;

codes! {
    /// What a node does with the words that pass.
    pub enum Mode {
        /// They go on.
        Forward,
        /// Its own go instead.
        Load,
        /// The lesser ones of both go on.
        Composite,
        /// They go on, and the node keeps them.
        Unload,
    }
}

codes! {
    /// Which of two words is the lesser, so far.
    pub enum Nearer {
        /// They are equal.
        Equal,
        /// The node's own.
        Own,
        /// The one that comes.
        Upstream,
    }
}

block! {
    /// Sends on the lesser of two words of each pixel, byte by byte.
    pub struct Compositor {
        /// Pixels that take turns.
        pub pixels: u32,
        /// Bits of a byte.
        pub width: u32,
    }
    latency = "1 clock, a byte a clock";
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NET)";
    in(self) CompositorIn {
        /// What the node does: a [`Mode`].
        mode: one_of::<Mode>(),
        /// A byte of the pixel goes.
        advances: bit(),
        /// The byte is the first of the pixel's word.
        first: bit(),
        /// The number of the pixel.
        pixel: below(self.pixels),
        /// The pixel's byte from the node before.
        upstream: bits(self.width),
        /// The pixel's byte in this node.
        own: bits(self.width),
    }
    out(self) CompositorOut {
        /// The pixel's byte for the node behind.
        downstream: bits(self.width),
    }
}

impl Compositor {
    fn build(&self, m: Module, i: CompositorIn) -> CompositorOut {
        def!(states = m.memory(self.pixels, one_of::<Nearer>(), ReadUnderWrite::Any));
        def!(state = mux(i.first, Nearer::Equal, states.read_async(i.pixel)));
        let differ = [(i.own.lt(i.upstream), Nearer::Own), (i.upstream.lt(i.own), Nearer::Upstream)];
        def!(nearer = mux(state.is(Nearer::Equal), select(differ, Nearer::Equal), state));
        states.write(i.advances, i.pixel, nearer);

        def!(
            takes_own = i.mode.choose(|mode| match mode {
                Mode::Forward | Mode::Unload => lit(1, 0),
                Mode::Load => lit(1, 1),
                Mode::Composite => nearer.is(Nearer::Own),
            })
        );
        CompositorOut { downstream: m.pipe_when(i.advances, "downstream", mux(takes_own, i.own, i.upstream)) }
    }
}

#[cfg(test)]
mod tests;
