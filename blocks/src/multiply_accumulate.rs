//! Sums of products.

use tilewright_hdl::{Module, ReadUnderWrite, below, bit, bits, block, bundle, def, mux};

bundle! {
    /// The summand of a sum.
    struct Term<T> { valid: T, to: T, restart: T, value: T }

    /// A sum after an addition.
    struct Sum<T> { valid: T, to: T, value: T }
}

block! {
    /// Adds products to several sums in two stages; each clock may select any of the sums.
    ///
    /// ```text
    ///                .---.                .---.
    /// left, right ==>| x |==[1]==========>| + |==[2]=+==> sum
    ///                '---'         .-.    |   |      |
    ///           .--------. held    | |    |   |      |
    ///    to ===>| sums   |========>| |===>'---'      |
    ///           '--------'    .===>'-'               |
    ///             ^           '======================+
    ///             '==================================' newest
    /// ```
    ///
    /// Latency 2 clocks, one product per clock. A sum that is still being written is forwarded from the last stage, so the
    /// next clock may add to it again. `restart` begins a sum; sums are modulo 2^width.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{MultiplyAccumulate, MultiplyAccumulateIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(4).reset(0));
    /// count.next(count + 1);
    /// let product = MultiplyAccumulateIn { // 0, 2, 4 .. times 10, to two sums alternately
    ///     valid: lit(1, 1), to: count.bit(0), restart: count.lt(2), left: count.trunc(3).zext(4) << 1, right: lit(4, 10),
    /// };
    /// def!(sums = m.instance(&MultiplyAccumulate::new(2, 4, 12), product));
    /// def!(sum = mux(sums.done, sums.sum, 0));
    /// # });
    /// assert_eq!(example.values("sum"), [0, 0, 0, 20, 40, 80, 120]); // 0, 20, 0 + 40, 20 + 60, 40 + 80
    /// ```
    pub struct MultiplyAccumulate {
        sums: u32,
        factor: u32,
        width: u32,
    }
    latency = "2 clocks";
    in(self) MultiplyAccumulateIn {
        /// There is a product to add.
        valid: bit(),
        /// The number of the sum that the product is added to.
        to: below(self.sums),
        /// The sum begins with this product.
        restart: bit(),
        /// The first factor.
        left: bits(self.factor),
        /// The second factor.
        right: bits(self.factor),
    }
    out(self) MultiplyAccumulateOut {
        /// A product was added.
        done: bit(),
        /// The number of the sum that the product was added to.
        at: below(self.sums),
        /// The sum with the product added.
        sum: bits(self.width),
    }
}

impl MultiplyAccumulate {
    /// `sums` sums of `width` bits, of products of two factors of `factor` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::MultiplyAccumulate;
    ///
    /// assert_eq!(MultiplyAccumulate::new(64, 8, 24).name(), "multiply_accumulate_sums64_factor8_width24");
    /// ```
    ///
    /// # Panics
    ///
    /// `sums` is below 2, a factor has no bits, or a product does not fit a sum.
    #[track_caller]
    pub fn new(sums: u32, factor: u32, width: u32) -> MultiplyAccumulate {
        assert!(
            sums > 1 && factor > 0 && width / 2 >= factor,
            "{sums} sums of {width} bits of factors of {factor} bits: there are 2 sums or more, each at least twice as wide as a factor"
        );
        MultiplyAccumulate { sums, factor, width }
    }

    fn build(&self, m: Module, i: MultiplyAccumulateIn) -> MultiplyAccumulateOut {
        if !self.sums.is_power_of_two() {
            m.assume(i.to.lt(self.sums), "the number of a sum is in range");
        }
        def!(newest = m.wire(Sum { valid: bit(), to: below(self.sums), value: bits(self.width) }));
        def!(sums = m.memory(self.sums, self.width, ReadUnderWrite::Any));
        def!(held = sums.read(i.to));
        let product = i.left.times(i.right).zext(self.width);
        let start = Term { valid: i.valid, to: i.to, restart: i.restart, value: product };
        let term = m.stages(1, None, start.cleared(|term| term.valid), |_, term| term);

        // The result of the second stage is not in the memory yet when that is read.
        let is_written = newest.valid & newest.to.eq(term.to);
        let before = mux(is_written, newest.value, held);
        let sum = Sum { valid: term.valid, to: term.to, value: mux(term.restart, 0, before) + term.value };
        sums.write(sum.valid, sum.to, sum.value);
        def!(sum = m.stages(1, None, sum.cleared(|sum| sum.valid), |_, sum| sum));
        newest.drive(sum.any_stage());
        MultiplyAccumulateOut { done: newest.valid, at: newest.to, sum: newest.value }
    }
}
