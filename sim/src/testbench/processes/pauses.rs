//! Random pauses.

/// The pauses of a sender or a receiver before a word, drawn from a seed: the same seed pauses at the same words.
///
/// ```
/// # use tilewright_sim::Pauses;
/// let [mut some, mut none] = [Pauses::percent(50, 7), Pauses::NONE];
/// let drawn: Vec<u32> = (0..6).map(|_| some.next_length()).collect();
/// assert_eq!(drawn, [2, 2, 3, 0, 4, 1]);
/// assert_eq!(none.next_length(), 0);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pauses {
    percent: u64,
    state: u64,
}

impl Pauses {
    /// A word in every clock.
    ///
    /// ```
    /// use tilewright_sim::Pauses;
    ///
    /// let mut pauses = Pauses::NONE;
    /// assert_eq!([(); 3].map(|()| pauses.next_length()), [0, 0, 0]);
    /// ```
    pub const NONE: Pauses = Pauses { percent: 0, state: 1 };

    /// In each clock, a pause with this probability, from 0 to 99 percent.
    ///
    /// ```
    /// use tilewright_sim::Pauses;
    ///
    /// let lengths = |seed| {
    ///     let mut pauses = Pauses::percent(50, seed);
    ///     [(); 8].map(|()| pauses.next_length())
    /// };
    /// assert_eq!(lengths(7), lengths(7));
    /// assert_ne!(lengths(7), lengths(8));
    /// ```
    ///
    /// # Panics
    ///
    /// At 100 percent, no word would ever be transferred.
    #[track_caller]
    pub const fn percent(percent: u64, seed: u64) -> Pauses {
        assert!(percent < 100, "pauses of 100 percent or more let nothing through: from 0 to 99");
        // Spreads small seeds apart, and avoids the fixed point of xorshift.
        Pauses { percent, state: seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1 }
    }

    /// The length of the next pause in clocks.
    ///
    /// ```
    /// use tilewright_sim::Pauses;
    ///
    /// let mut pauses = Pauses::percent(50, 7);
    /// let clocks: u32 = (0..1000).map(|_| pauses.next_length()).sum();
    /// assert!((800..1200).contains(&clocks)); // half of the clocks are pauses
    /// ```
    pub fn next_length(&mut self) -> u32 {
        let mut clocks = 0;
        while self.percent > 0 && self.draw() % 100 < self.percent {
            clocks += 1;
        }
        clocks
    }

    /// The next random number (xorshift).
    fn draw(&mut self) -> u64 {
        self.state ^= self.state << 13;
        self.state ^= self.state >> 7;
        self.state ^= self.state << 17;
        self.state
    }
}
