//! Joins two streams into one.

use crate::ports::StreamOut;
use crate::streams::StreamBlocks;
use tilewright_hdl::{Module, bits, block, cat, stream};

block! {
    /// Joins a word of each of two streams into one word: that of `left` above that of `right`.
    ///
    /// ```text
    /// left ====>|
    ///           |&===> out
    /// right ===>|
    /// ```
    ///
    /// Latency 0. No `valid` waits for `ready`; each input's `ready` is high when both words are taken.
    /// [`StreamBlocks::join`] combines two words, or two records, by a function of your own.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Join, JoinIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(half = m.reg(1).reset(0));
    /// half.next(!half);
    /// let (left, _) = m.offer(lit(1, 1), lit(8, 0xab));
    /// let (right, _) = m.offer(*half, lit(4, 0xc));
    /// def!(join = m.instance(&Join::new(8, 4), JoinIn { left, right }));
    /// let word = join.out.take_when(1);
    /// def!(words = mux(word.taken, *word, 0));
    /// # });
    /// assert_eq!(example.values("words"), [0, 0xabc, 0, 0xabc]); // one waits for the other
    /// ```
    pub struct Join {
        left: u32,
        right: u32,
    }
    in(self) JoinIn {
        /// The upper parts of the words.
        left: stream(bits(self.left)),
        /// The lower parts of the words.
        right: stream(bits(self.right)),
    }
    out(self) = StreamOut { out: stream(bits(self.left + self.right)) };
}

impl Join {
    /// A join of words of `left` and `right` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::Join;
    ///
    /// assert_eq!(Join::new(8, 4).name(), "join_left8_right4");
    /// ```
    ///
    /// # Panics
    ///
    /// A width is 0.
    #[track_caller]
    pub fn new(left: u32, right: u32) -> Join {
        assert!(left > 0 && right > 0, "a join of words of {left} and {right} bits: each has 1 or more");
        Join { left, right }
    }

    fn build(&self, m: Module, i: JoinIn) -> StreamOut {
        m.cover("a word of `left` waits for one of `right`", i.left.valid & !i.right.valid);
        m.cover("a word of `right` waits for one of `left`", i.right.valid & !i.left.valid);
        StreamOut { out: m.join(i.left, i.right, |left, right| cat![left, right]) }
    }
}
