//! The compositor: passes on the lesser of two words, which arrive byte by byte (PFL-NET, facts E4). It processes the
//! pixels of a chip one after another.
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
//! A word is everything known about a pixel, with the depth on top. The most significant byte is sent first. So the
//! lesser word is the nearer pixel. If depths are equal the later bytes decide, so the result does not depend on the
//! sequence of nodes. While all bytes are equal, both words are candidates. The first difference decides, and the rest
//! of the chosen word follows.
//!
//! The bytes of all pixels are interleaved: the first byte of each pixel, then the second of each. So the state of each
//! pixel is stored from one of its bytes to the next.
//!
//! Latency: 1 clock; a byte in every clock.

use crate::prelude::*;

codes! {
    /// The mode of a node: what it does with the words that pass.
    pub enum Mode {
        /// The words pass unchanged.
        Forward,
        /// The node's own words replace them.
        Load,
        /// The node passes on the lesser of both words.
        Composite,
        /// The words pass, and the node also stores them.
        Unload,
    }
}

codes! {
    /// The lesser of two words, by the bytes compared so far.
    pub enum Nearer {
        /// Both words are equal.
        Equal,
        /// The node's own word is the lesser.
        Own,
        /// The passing word is the lesser.
        Upstream,
    }
}

block! {
    /// Passes on the lesser of two words of each pixel, byte by byte.
    pub struct Compositor {
        /// The number of pixels of a chip, which are processed one after another.
        pub pixels: u32,
        /// The width of a byte.
        pub width: u32,
    }
    latency = "1 clock; a byte in every clock";
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NET)";
    in(self) CompositorIn {
        /// The mode of the node: a [`Mode`].
        mode: one_of::<Mode>(),
        /// A byte of the pixel is transferred.
        advances: bit(),
        /// The byte is the first of the pixel's word.
        first: bit(),
        /// The number of the pixel.
        pixel: below(self.pixels),
        /// The pixel's byte from the previous node.
        upstream: bits(self.width),
        /// The pixel's byte in this node.
        own: bits(self.width),
    }
    out(self) CompositorOut {
        /// The pixel's byte for the next node.
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

        def! { takes_own = choose!(i.mode, Mode {
            Forward | Unload => 0,
            Load => 1,
            Composite => nearer.is(Nearer::Own),
        }) }
        CompositorOut { downstream: m.pipe_when(i.advances, "downstream", mux(takes_own, i.own, i.upstream)) }
    }
}

#[cfg(test)]
mod tests;
