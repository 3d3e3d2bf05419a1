//! A barrel rotator.

use tilewright_hdl::{Module, below, bit, bits, block, mux};

block! {
    /// Rotates a word to the left by any number of places, within one clock.
    ///
    /// ```text
    ///          .-----.   .-----.   .-----.
    ///  word ==>| 0,1 |==>| 0,2 |==>| 0,4 |==[ ]==> rotated
    ///          '-----'   '-----'   '-----'
    /// ```
    ///
    /// Latency 1 clock with `enable`. To rotate to the right by n places, rotate to the left by `width - n`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Rotator, RotatorIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(places = m.reg(3).reset(0));
    /// places.next(places + 3);
    /// let rotation = RotatorIn { enable: lit(1, 1), word: lit(8, 0b1100_0001), places: *places };
    /// def!(rotated = m.instance("u_rotate", &Rotator::new(8), rotation).rotated);
    /// # });
    /// assert_eq!(example.values("rotated"), [0, 0b1100_0001, 0b0000_1110, 0b0111_0000]);
    /// ```
    pub struct Rotator {
        width: u32,
    }
    in(self) RotatorIn {
        /// Loads the result.
        enable: bit(),
        /// The word to rotate.
        word: bits(self.width),
        /// The number of places by which the word is rotated.
        places: below(self.width),
    }
    out(self) RotatorOut {
        /// The rotated word.
        rotated: bits(self.width),
    }
}

impl Rotator {
    /// A rotator of words of `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::Rotator;
    ///
    /// assert_eq!(Rotator::new(32).name(), "rotator_width32");
    /// ```
    ///
    /// # Panics
    ///
    /// `width` is below 2, so there is nothing to rotate.
    #[track_caller]
    pub fn new(width: u32) -> Rotator {
        assert!(width > 1, "a rotator of {width} bits has nothing to rotate: it has 2 or more");
        Rotator { width }
    }

    fn build(&self, m: Module, i: RotatorIn) -> RotatorOut {
        let mut word = i.word;
        for stage in 0..i.places.width() {
            word = mux(i.places.bit(stage), word.rotate_left(1 << stage), word);
        }
        RotatorOut { rotated: m.pipe_when(i.enable, "rotated", word) }
    }
}
