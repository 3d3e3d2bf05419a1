//! The least of many numbers.

use tilewright_hdl::{Module, Signal, below, bit, bits, block, bundle, constants, mux, row, tree};

bundle! {
    /// A number, and its index.
    struct Candidate<T> { word: T, index: T }

    /// Whether a stage has valid numbers.
    struct Held<T> { valid: T }
}

/// The numbers, each with its index.
#[track_caller]
fn candidates(words: Signal) -> Candidate {
    let lanes = words.count();
    Candidate { word: words, index: constants(below(lanes).of(row(lanes)), u64::from) }
}

/// Of equal numbers the left one, whose index is lower.
fn lesser(left: Candidate, right: Candidate) -> Candidate {
    mux(right.word.lt(left.word), right, left)
}

#[track_caller]
fn check(words: u32, width: u32) {
    assert!(words > 1 && width > 0, "a minimum of {words} words of {width} bits: it has 2 words of 1 bit or more");
}

block! {
    /// Finds the least of several numbers and its index; of equal ones the first.
    ///
    /// ```text
    /// words[0] ==>|<|
    /// words[1] ==>| |==>|<|
    /// words[2] ==>|<|   | |==> word, index
    /// words[3] ==>| |==>| |
    /// ```
    ///
    /// Latency 0 clocks, through as many comparisons as an index has bits.
    ///
    /// ```
    /// # use tilewright_blocks::*;
    /// # use tilewright_sim::Simulation;
    /// let mut sim = Simulation::of(&Minimum::new(4, 4))?;
    /// sim.drive(MinimumIn { words: 0x5937 }); // 7, 3, 9 and 5
    /// assert_eq!(sim.read_u64(), MinimumOut { word: 3, index: 1 });
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct Minimum {
        words: u32,
        width: u32,
    }
    in(self) MinimumIn {
        /// The numbers, a lane for each.
        words: bits(self.width).of(row(self.words)),
    }
    out(self) MinimumOut {
        /// The least of the numbers.
        word: bits(self.width),
        /// The lane of the least number.
        index: below(self.words),
    }
}

impl Minimum {
    /// The least of `words` words of `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::Minimum;
    ///
    /// assert_eq!(Minimum::new(4, 8).name(), "minimum_words4_width8");
    /// ```
    ///
    /// # Panics
    ///
    /// `words` is below 2, or `width` is 0.
    #[track_caller]
    pub fn new(words: u32, width: u32) -> Minimum {
        check(words, width);
        Minimum { words, width }
    }

    fn build(&self, m: Module, i: MinimumIn) -> MinimumOut {
        let least = tree(candidates(i.words), lesser);
        m.assert(!i.words.lt(least.word).or_all(), "no word is less than the least");
        MinimumOut { word: least.word, index: least.index }
    }
}

block! {
    /// Finds the least of several numbers and its index, with a register behind each comparison; of equal ones the
    /// first.
    ///
    /// ```text
    /// words[0] ==>|<|
    /// words[1] ==>| |=[1]=>|<|
    /// words[2] ==>|<|      | |=[2]=> word, index
    /// words[3] ==>| |=[1]=>| |
    ///    valid ----------[1]-----[2]-> found
    /// ```
    ///
    /// Latency: as many clocks as an index has bits; one minimum per clock. A reset clears `found` in all stages, and
    /// nothing else.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{PipelinedMinimum, PipelinedMinimumIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(4).reset(3));
    /// count.next(count + 1);
    /// let words = stack([lit(4, 9), *count, lit(4, 4), lit(4, 7)]);
    /// def!(least = m.instance(&PipelinedMinimum::new(4, 4), PipelinedMinimumIn { valid: lit(1, 1), words }));
    /// def!(found = least.found);
    /// def!(index = mux(least.found, least.index, 0));
    /// # });
    /// assert_eq!(example.values("found"), [0, 0, 1, 1, 1]);
    /// assert_eq!(example.values("index"), [0, 0, 1, 1, 2]); // 3, the first 4, and then the other one
    /// ```
    pub struct PipelinedMinimum {
        words: u32,
        width: u32,
    }
    in(self) PipelinedMinimumIn {
        /// The words are valid numbers.
        valid: bit(),
        /// The numbers, a lane for each.
        words: bits(self.width).of(row(self.words)),
    }
    out(self) PipelinedMinimumOut {
        /// The word and its index are the result of valid numbers.
        found: bit(),
        /// The least of the numbers.
        word: bits(self.width),
        /// The lane of the least number.
        index: below(self.words),
    }
}

impl PipelinedMinimum {
    /// The least of `words` words of `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::PipelinedMinimum;
    ///
    /// let design = elaborate(&PipelinedMinimum::new(5, 8))?;
    /// assert_eq!(design.latencies()[0].as_ref().unwrap().to_string(), "3 clocks");
    /// # Ok::<(), Problems>(())
    /// ```
    ///
    /// # Panics
    ///
    /// `words` is below 2, or `width` is 0.
    #[track_caller]
    pub fn new(words: u32, width: u32) -> PipelinedMinimum {
        check(words, width);
        PipelinedMinimum { words, width }
    }

    fn build(&self, m: Module, i: PipelinedMinimumIn) -> PipelinedMinimumOut {
        let stages = below(self.words).bits();
        let held = m.stages(stages, None, Held { valid: i.valid }.cleared(|held| held.valid), |_, held| held);
        let least = m.tree_of_stages("least", candidates(i.words), lesser);
        PipelinedMinimumOut { found: held.valid, word: least.word, index: least.index }
    }
}
