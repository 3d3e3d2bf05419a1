//! A pipelined multiplier.

use tilewright_hdl::{Module, bit, bits, block, bundle, lit};

bundle! {
    /// The sum so far, and the digits still to add.
    struct Partial<T> {
        sum: T,
        left: T,
        /// The remaining digits, the next one lowest.
        digits: T,
    }
}

block! {
    /// Multiplies two numbers, with some digits of the right one in each stage.
    ///
    /// ```text
    ///  left ==>.---.   .---.       .---.
    /// right ==>| + |[1]| + |[2] .. | + |[ ]==> product
    ///          '---'   '---'       '---'
    /// ```
    ///
    /// Latency: one clock for each stage; one product per clock with `enable`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Multiplier, MultiplierIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// let factors = MultiplierIn { enable: lit(1, 1), left: lit(8, 200), right: lit(8, 100) };
    /// def!(product = m.instance("u_times", &Multiplier::new(8, 4), factors).product);
    /// # });
    /// assert_eq!(example.values("product"), [0, 0, 0, 0, 20_000]);
    /// ```
    pub struct Multiplier {
        width: u32,
        stages: u32,
    }
    in(self) MultiplierIn {
        /// All stages of the pipeline advance.
        enable: bit(),
        /// The first factor.
        left: bits(self.width),
        /// The second factor.
        right: bits(self.width),
    }
    out(self) MultiplierOut {
        /// The product.
        product: bits(2 * self.width),
    }
}

impl Multiplier {
    /// A multiplier of factors of `width` bits, in `stages` stages; `stages` must divide `width`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::Multiplier;
    ///
    /// let design = elaborate(&Multiplier::new(16, 4))?;
    /// # assert!(tilewright_gen::verilog(&design)[0].text.contains("4 clocks with `enable`"));
    /// # Ok::<(), Problems>(())
    /// ```
    ///
    /// # Panics
    ///
    /// `stages` does not divide `width`.
    #[track_caller]
    pub fn new(width: u32, stages: u32) -> Multiplier {
        assert!(
            stages > 0 && width >= stages && width.is_multiple_of(stages),
            "a multiplier of {width} bits in {stages} stages: each stage needs the same number of bits, 1 or more"
        );
        Multiplier { width, stages }
    }

    fn build(&self, m: Module, i: MultiplierIn) -> MultiplierOut {
        let digits = self.width / self.stages;
        let add = |stage: u32, part: Partial| {
            let product = part.left.times(part.digits.trunc(digits)).zext(2 * self.width);
            let sum = part.sum + (product << (digits * (stage - 1)));
            Partial { sum, digits: part.digits >> digits, ..part }
        };
        let start = Partial { sum: lit(2 * self.width, 0), left: i.left, digits: i.right };
        let last = m.stages(self.stages - 1, i.enable, start, add);
        MultiplierOut { product: m.pipe_when(i.enable, "product", add(self.stages, last).sum) }
    }
}
