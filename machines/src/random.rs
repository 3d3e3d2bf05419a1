//! Random numbers that are the same on every machine: SplitMix64 (Steele, Lea and Flood, 2014).

/// A sequence of random numbers; equal states give equal sequences.
pub(crate) struct Random(u64);

impl Random {
    /// Sequence number `index` of a seed.
    pub(crate) fn new(seed: u64, index: u64) -> Random {
        Random(Random(seed).next() ^ Random(!index).next())
    }

    /// The next number of 64 bits.
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number from 0 to 1, excluding 1.
    pub(crate) fn fraction(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number from `least` to `most`.
    pub(crate) fn between(&mut self, least: i32, most: i32) -> i32 {
        let count = (i64::from(most) - i64::from(least) + 1) as u128;
        // The upper bits of a product: all numbers have equal probabilities to within 2^-32.
        (i64::from(least) + ((u128::from(self.next()) * count) >> 64) as i64) as i32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The numbers that the authors' code gives for the state 1234567.
    #[test]
    fn it_is_the_published_sequence() {
        let mut random = Random(1_234_567);
        assert_eq!([random.next(), random.next()], [6_457_827_717_110_365_317, 3_203_168_211_198_807_973]);
    }

    #[test]
    fn numbers_between_reach_both_ends_equally_often() {
        let mut random = Random::new(1, 2);
        let mut times = [0; 4];
        for _ in 0..40_000 {
            times[(random.between(-2, 1) + 2) as usize] += 1;
        }
        assert!(times.iter().all(|times| (9_700..10_300).contains(times)), "{times:?}");
        assert!((0..1000).map(|_| random.fraction()).all(|fraction| (0.0..1.0).contains(&fraction)));
    }
}
