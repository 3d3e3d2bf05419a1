//! The number of ones in a word: as a function of a signal, and as a block.

use tilewright_hdl::{IntoSignal, Module, Signal, bits, block, up_to};

/// The number of ones in a word, as wide as its greatest value: 4 bits for a byte. Of lanes, the number in each.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_blocks::count_ones;
/// # tilewright_sim::example(|m| {
/// m.assert(count_ones(lit(8, 0b1011_0001)).eq(4), "4 bits");
/// m.assert(count_ones(lit(3, 0b111)).eq(3), "2 bits");
/// # });
/// ```
#[track_caller]
pub fn count_ones(word: impl IntoSignal) -> Signal {
    let word: Signal = word.into().bits();
    let width = word.width();
    if width == 1 {
        return word;
    }
    // A tree, whose adders are as narrow as their sums.
    let [low, high] = [word.slice(0..width / 2), word.slice(width / 2..width)];
    count_ones(low).zext(up_to(width)) + count_ones(high).zext(up_to(width))
}

block! {
    /// Counts the ones in a word.
    ///
    /// ```text
    /// bit 0 ----.---.
    /// bit 1 --->| + |====> ones
    /// bit 2 --->'---'
    /// ```
    ///
    /// Latency 0 clocks. As a function it is [`count_ones`].
    ///
    /// ```
    /// # use tilewright_blocks::*;
    /// # use tilewright_sim::Simulation;
    /// let mut sim = Simulation::of(&CountOnes { width: 6 })?;
    /// sim.drive(CountOnesIn { word: 0b101100 });
    /// assert_eq!(sim.read_u64(), CountOnesOut { ones: 3 });
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct CountOnes {
        /// The bits of a word.
        pub width: u32,
    }
    ranges { width: 1.. }
    in(self) CountOnesIn {
        /// The word whose ones are counted.
        word: bits(self.width),
    }
    out(self) CountOnesOut {
        /// The number of ones.
        ones: up_to(self.width),
    }
}

impl CountOnes {
    fn build(&self, m: Module, i: CountOnesIn) -> CountOnesOut {
        let ones = count_ones(i.word);
        m.assert(ones.bit(0).eq(i.word.parity()), "an odd number of ones has odd parity");
        CountOnesOut { ones }
    }
}
