//! A pipelined shifter.

use tilewright_hdl::{Module, Signal, below, bit, bits, block, bundle, choose, codes, mux, one_of};

codes! {
    /// The direction of a [`Shifter`].
    ///
    /// ```
    /// use tilewright_blocks::Shifting;
    /// use tilewright_hdl::Codes;
    ///
    /// assert_eq!(Shifting::ALL.len(), 3);
    /// ```
    pub enum Shifting {
        /// To the left; zeros are shifted in.
        Left,
        /// To the right; zeros are shifted in.
        Right,
        /// To the right; copies of the sign are shifted in.
        Arithmetic,
    }
}

bundle! {
    /// A word in progress, and the remaining shift.
    struct Shifted<T> { word: T, places: T, kind: T }
}

block! {
    /// Shifts a word by any number of places, with a stage for each bit of that number.
    ///
    /// ```text
    ///          .-----.   .-----.   .-----.
    ///  word ==>| 0,1 |[1]| 0,2 |[2]| 0,4 |[ ]==> shifted
    ///          '-----'   '-----'   '-----'
    /// ```
    ///
    /// Latency: one clock for each stage; one word per clock with `enable`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Shifter, ShifterIn, Shifting};
    /// # let example = tilewright_sim::traced(|m| {
    /// let kind = lit(2, Shifting::Arithmetic.code()).code::<Shifting>();
    /// let shift = ShifterIn { enable: lit(1, 1), word: lit(8, 0b1001_0000), places: lit(3, 3), kind };
    /// def!(shifted = m.instance("u_shift", &Shifter::new(8), shift).shifted);
    /// # });
    /// assert_eq!(example.values("shifted"), [0, 0, 0, 0b1111_0010]);
    /// ```
    pub struct Shifter {
        width: u32,
    }
    in(self) ShifterIn {
        /// All stages of the pipeline advance.
        enable: bit(),
        /// The word to shift.
        word: bits(self.width),
        /// The number of places by which the word is shifted.
        places: below(self.width),
        /// The direction of the shift.
        kind: one_of::<Shifting>(),
    }
    out(self) ShifterOut {
        /// The shifted word.
        shifted: bits(self.width),
    }
}

impl Shifter {
    /// A shifter of words of `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::Shifter;
    ///
    /// assert_eq!(Shifter::new(32).name(), "shifter_width32");
    /// ```
    ///
    /// # Panics
    ///
    /// `width` is below 2, so there is nothing to shift.
    #[track_caller]
    pub fn new(width: u32) -> Shifter {
        assert!(width > 1, "a shifter of {width} bits has nothing to shift: it has 2 or more");
        Shifter { width }
    }

    fn build(&self, m: Module, i: ShifterIn) -> ShifterOut {
        m.assume(i.enable.implies(i.kind.is_code()), "a word that enters has a valid direction");
        let shift = |stage: u32, part: Shifted| {
            let places = 1 << (stage - 1);
            let word: Signal = choose!(part.kind, Shifting {
                Left => part.word << places,
                Right => part.word >> places,
                Arithmetic => (part.word.signed() >> places).bits(),
            });
            Shifted { word: mux(part.places.bit(stage - 1), word, part.word), ..part }
        };
        let stages = i.places.width();
        let last = m.stages(stages - 1, i.enable, Shifted { word: i.word, places: i.places, kind: i.kind }, shift);
        ShifterOut { shifted: m.pipe_when(i.enable, "shifted", shift(stages, last).word) }
    }
}
