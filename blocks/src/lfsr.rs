//! A linear feedback shift register.

use tilewright_hdl::{Module, binary, bit, bits, block, cat, def};

/// For each width from 2 on, the taps: the bits, counted from 1, whose parity is shifted in so that all numbers but 0
/// occur.
const TAPS: [&[u32]; 31] = [
    &[2, 1],
    &[3, 2],
    &[4, 3],
    &[5, 3],
    &[6, 5],
    &[7, 6],
    &[8, 6, 5, 4],
    &[9, 5],
    &[10, 7],
    &[11, 9],
    &[12, 6, 4, 1],
    &[13, 4, 3, 1],
    &[14, 5, 3, 1],
    &[15, 14],
    &[16, 15, 13, 4],
    &[17, 14],
    &[18, 11],
    &[19, 6, 2, 1],
    &[20, 17],
    &[21, 19],
    &[22, 21],
    &[23, 18],
    &[24, 23, 22, 17],
    &[25, 22],
    &[26, 6, 2, 1],
    &[27, 5, 2, 1],
    &[28, 25],
    &[29, 27],
    &[30, 6, 4, 1],
    &[31, 28],
    &[32, 22, 2, 1],
];

block! {
    /// Generates a pseudo-random sequence of all numbers of its width but 0, starting at 1.
    ///
    /// ```text
    ///      .--------------- parity <--.
    ///      '-->[ ][ ][ ][ ][ ][ ][ ]--+--> number
    /// ```
    ///
    /// Latency 1 clock; the period is 2^width - 1.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Lfsr, LfsrIn};
    /// # tilewright_sim::example(|m| {
    /// def!(lfsr = m.instance(&Lfsr::new(16), LfsrIn { enable: lit(1, 1) }));
    /// m.assert(lfsr.number.ne(0), "0 would be followed by 0 forever");
    /// # });
    /// ```
    pub struct Lfsr {
        width: u32,
    }
    latency = "1 clock";
    in LfsrIn {
        /// Advances to the next number.
        enable: bit(),
    }
    out(self) LfsrOut {
        /// The number, which is never 0.
        number: bits(self.width),
    }
}

impl Lfsr {
    /// Numbers of `width` bits, from 2 to 32.
    ///
    /// ```
    /// use tilewright_blocks::Lfsr;
    /// assert_eq!(Lfsr::new(3).taps(), [3, 2]);
    /// ```
    ///
    /// # Panics
    ///
    /// `width` is out of range.
    #[track_caller]
    pub fn new(width: u32) -> Lfsr {
        assert!((2..=32).contains(&width), "an LFSR of {width} bits: it has from 2 to 32");
        Lfsr { width }
    }

    /// The taps: the bits whose parity is shifted in, counted from 1.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::Lfsr;
    ///
    /// // The highest bit, which is shifted out, is always one of them.
    /// assert!((2..=32).all(|width| Lfsr::new(width).taps().contains(&width)));
    /// ```
    pub fn taps(&self) -> &'static [u32] {
        TAPS[self.width as usize - 2]
    }

    fn build(&self, m: Module, i: LfsrIn) -> LfsrOut {
        // 0 is followed by 0, so the register must not start there, even if it is never reset.
        def!(number = m.reg(self.width).initial(1).reset(1));
        let taps = self.taps().iter().fold(0, |taps, tap| taps | 1 << (tap - 1));
        number.when(i.enable, cat![number.trunc(self.width - 1), (number & binary(taps)).parity()]);
        LfsrOut { number: *number }
    }
}
