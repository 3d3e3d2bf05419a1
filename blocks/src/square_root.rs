//! Pipelined square roots: a stage for each bit of the root.

use crate::ports::StreamIn;
use tilewright_hdl::{Module, bits, block, bundle, cat, lit, mux, stream};

bundle! {
    /// A root in progress.
    struct Drawing<T> {
        /// The remaining digits of the square, the next two on top.
        digits: T,
        remainder: T,
        root: T,
    }
}

block! {
    /// Computes square roots, with a stage for each bit of the root.
    ///
    /// ```text
    /// into ===>| compare, subtract |[1]===>| .. |[2]===> .. [width]===> roots
    /// ```
    ///
    /// Latency: one clock for each bit; one root per clock.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{SquareRoot, StreamIn};
    /// # tilewright_sim::example(|m| {
    /// let (into, _) = m.offer(lit(1, 1), lit(16, 1000));
    /// def!(root = m.instance(&SquareRoot::new(8), StreamIn { into }).roots.take_when(1));
    /// m.assert(root.taken.implies(root.root.eq(31) & root.remainder.eq(39)), "31 * 31 + 39 = 1000");
    /// # });
    /// ```
    pub struct SquareRoot {
        width: u32,
    }
    latency(self) = format!("{} clocks", self.width);
    in(self) = StreamIn { into: stream(bits(2 * self.width)) };
    out(self) SquareRootOut {
        /// The roots.
        ///
        /// ```
        /// # use tilewright_blocks::Root;
        /// let of_ten = Root { root: 3, remainder: 1 };
        /// assert_eq!(of_ten.root * of_ten.root + of_ten.remainder, 10);
        /// ```
        roots: stream(pub struct Root {
            /// The largest number whose square is no larger than the input.
            root: bits(self.width),
            /// The input minus the square of the root.
            remainder: bits(self.width + 1),
        }),
    }
}

impl SquareRoot {
    /// Roots of `width` bits, for squares of twice as many.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::SquareRoot;
    ///
    /// assert_eq!(SquareRoot::new(8).name(), "square_root_width8");
    /// ```
    ///
    /// # Panics
    ///
    /// `width` is below 2.
    #[track_caller]
    pub fn new(width: u32) -> SquareRoot {
        assert!(width > 1, "a square root of {width} bits: it has 2 or more");
        SquareRoot { width }
    }

    fn build(&self, m: Module, i: StreamIn) -> SquareRootOut {
        let width = self.width;
        let start = Drawing { digits: i.into.payload, remainder: lit(width + 1, 0), root: lit(width, 0) };
        let drawn = m.stream_stages(width, i.into.with(start), |_, part| {
            let rest = cat![part.remainder.trunc(width), part.digits.part(2 * width - 2, 2)];
            let odd = cat![part.root, lit(2, 1)]; // The difference of two squares.
            let fits = rest.ge(odd);
            Drawing {
                digits: part.digits << 2,
                remainder: mux(fits, rest - odd, rest).trunc(width + 1),
                root: cat![part.root.trunc(width - 1), fits],
            }
        });
        SquareRootOut { roots: drawn.with(Root { root: drawn.root, remainder: drawn.remainder }) }
    }
}
