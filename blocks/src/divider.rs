//! A pipelined divider: a stage for each bit of the quotient.

use tilewright_hdl::{Module, bits, block, bundle, cat, lit, mux};

bundle! {
    /// A division in progress.
    struct Dividing<T> {
        /// The quotient's known digits, and above them the dividend's remaining ones.
        digits: T,
        remainder: T,
        divisor: T,
    }
}

block! {
    /// Divides numbers, with a stage for each bit of the quotient.
    ///
    /// ```text
    /// operands ===>| compare, subtract |[1]===>| .. |[2]===> .. [width]===> results
    /// ```
    ///
    /// Latency: one clock for each bit; one quotient per clock. For a divisor of 0 the quotient is all ones, and the
    /// remainder is the dividend.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Divider, DividerIn, Operands};
    /// # let example = tilewright_sim::traced(|m| {
    /// let (operands, _) = m.offer(lit(1, 1), Operands { dividend: lit(4, 14), divisor: lit(4, 4) });
    /// def!(divider = m.instance(&Divider::new(4), DividerIn { operands }));
    /// let result = divider.results.take_when(1);
    /// m.assert(result.taken.implies(result.quotient.eq(3) & result.remainder.eq(2)), "14 = 3 * 4 + 2");
    /// def!(taken = result.taken);
    /// # });
    /// assert_eq!(example.values("taken"), [0, 0, 0, 0, 1, 1]);
    /// ```
    pub struct Divider {
        width: u32,
    }
    latency(self) = format!("{} clocks", self.width);
    in(self) DividerIn {
        /// The numbers to divide.
        ///
        /// ```
        /// # use tilewright_blocks::Operands;
        /// let third = Operands { dividend: 100, divisor: 3 };
        /// assert_eq!(third.dividend / third.divisor, 33);
        /// ```
        operands: stream(pub struct Operands {
            /// The number that is divided.
            dividend: bits(self.width),
            /// The number by which the dividend is divided.
            divisor: bits(self.width),
        }),
    }
    out(self) DividerOut {
        /// The quotients and remainders.
        ///
        /// ```
        /// # use tilewright_blocks::Quotient;
        /// let third = Quotient { quotient: 33, remainder: 1 };
        /// assert_eq!(third.quotient * 3 + third.remainder, 100);
        /// ```
        results: stream(pub struct Quotient {
            /// The quotient, rounded down to an integer.
            quotient: bits(self.width),
            /// The remainder of the division.
            remainder: bits(self.width),
        }),
    }
}

impl Divider {
    /// A divider of numbers of `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::Divider;
    ///
    /// assert_eq!(Divider::new(16).name(), "divider_width16");
    /// ```
    ///
    /// # Panics
    ///
    /// `width` is below 2.
    #[track_caller]
    pub fn new(width: u32) -> Divider {
        assert!(width > 1, "a divider of {width} bits: it has 2 or more");
        Divider { width }
    }

    fn build(&self, m: Module, i: DividerIn) -> DividerOut {
        let Operands { dividend, divisor } = i.operands.payload;
        let start = Dividing { digits: dividend, remainder: lit(self.width, 0), divisor };
        let divided = m.stream_stages(self.width, i.operands.with(start), |_, part| {
            let rest = cat![part.remainder, part.digits.msb()];
            let divisor = part.divisor.zext(self.width + 1);
            let fits = rest.ge(divisor);
            Dividing {
                digits: cat![part.digits.trunc(self.width - 1), fits],
                remainder: mux(fits, rest - divisor, rest).trunc(self.width),
                ..part
            }
        });
        DividerOut { results: divided.with(Quotient { quotient: divided.digits, remainder: divided.remainder }) }
    }
}
