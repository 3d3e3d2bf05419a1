//! The pixel processor: makes a fragment from a window of one sample (MPG-ARCH, facts E0).
//!
//! ```text
//! leaves ===>[ exact test ]-->[ z || rgb ]--> fragment
//! ```
//!
//! With an aperture, windows of one sample are wider than their pixel. So this unit drops a window if the polygon does
//! not cover its pixel. It first moves the edge functions and the distances to the bounds back to the pixel's centre.
//! Without an aperture they are already exact.
//!
//! Latency: 1 clock; a fragment a clock.

use super::format::{Format, Work};
use super::lanes::numbers;
use crate::prelude::*;

block! {
    /// Makes fragments from windows of one sample.
    pub struct PixelProcessor {
        /// The generator's format.
        pub format: Format,
    }
    latency = "1 clock to the fragment, and a fragment a clock";
    source = "sparse-raster quadtree generator, figure 1 (MPG-ARCH, MPG-LIM)";
    in(self) PixelProcessorIn {
        /// Windows of one sample; each is taken at once.
        leaves: stream(Work::widths(self.format)),
    }
    out(self) PixelProcessorOut {
        /// A pixel of the polygon.
        fragment: Fragment::widths(self.format),
        /// Fragments since the reset, modulo 2^32.
        fragments: bits(32),
    }
}

record! {
    /// A pixel of a polygon.
    pub struct Fragment(format: Format) {
        /// The fragment is valid.
        valid: bit(),
        /// The fragment's column among those of the video processor.
        x: below(format.columns()),
        /// The fragment's line among those of the video processor.
        y: below(format.rows()),
        /// The word of the fragment: depth above colour.
        word: bits(format.word()),
    }
}

impl PixelProcessor {
    fn build(&self, m: Module, i: PixelProcessorIn) -> PixelProcessorOut {
        m.ignore(&i.leaves); // without an aperture, the edges are not used
        let leaf = i.leaves.take_when(1);
        let window = leaf.window;
        let of = self.format.precision();
        let part = |plane: u32, low: u32, width: u32| window.planes.lane(plane).part(low, width);
        let colour = |plane: u32| part(plane, of.colour_from(), of.colour);
        def!(word = cat![part(0, of.depth_from(), of.depth), colour(1), colour(2), colour(3)]);
        def!(covered = self.covers(&leaf));
        let valid = m.reg("fragment_valid", bit()).reset(0);
        valid.next(leaf.taken & covered);
        let fragment = Fragment {
            valid: *valid,
            x: m.pipe_when(leaf.taken, "fragment_x", window.x.trunc(below(self.format.columns()))),
            y: m.pipe_when(leaf.taken, "fragment_y", window.y.trunc(below(self.format.rows()))),
            word: m.pipe_when(leaf.taken, "fragment_word", word),
        };
        def!(fragments = m.reg(32).reset(0));
        fragments.when(valid, fragments + 1);
        m.assume(i.leaves.valid.implies(window.size.eq(0)), "a leaf is a window of one sample");
        PixelProcessorOut { fragment, fragments: *fragments }
    }

    /// Whether the polygon covers the pixel of a leaf.
    fn covers(&self, leaf: &Work) -> Signal {
        let half = self.format.aperture() / 2;
        if half == 0 {
            return lit(1, 1);
        }
        // The spacing of samples no longer matters, only the decrease of an edge function per pixel.
        let (polygon, window, matrix) = (&leaf.polygon, &leaf.window, self.format.matrix());
        let decrease = |decrease: Signal, spacing: u32| {
            let bits = self.format.edge_bits();
            let over_aperture = (decrease.zext(bits) * half).trunc(bits);
            (over_aperture >> spacing.trailing_zeros()).signed()
        };
        let margin = decrease(polygon.step_x, matrix.columns()) + decrease(polygon.step_y, matrix.rows());
        def!(is_edge = numbers(polygon.last_edge.width(), self.format.edges()).le(polygon.last_edge));
        def!(outside = (is_edge & (window.edges - margin).is_negative()).or_all());
        def!(beyond = window.bounds.map(|reach| *reach - half).is_beyond());
        !outside & !beyond
    }
}

#[cfg(test)]
mod tests;
