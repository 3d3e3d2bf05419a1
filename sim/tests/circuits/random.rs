//! Random numbers that are the same every time.

/// Random numbers: xorshift.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Random {
        Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    pub fn below(&mut self, limit: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) % limit
    }

    pub fn one<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len() as u64) as usize]
    }
}

/// Runs `<NAME>_MACHINES` machines, from number `<NAME>_SEED` on, by hand; each returns the number of skipped edges.
pub fn campaign(name: &str, run: impl Fn(u64) -> u64) {
    let (seed, machines) = (number(&format!("{name}_SEED")), number(&format!("{name}_MACHINES")));
    let left_out: u64 = (seed..seed + machines).map(run).sum();
    println!("edges that were left out: {left_out}");
    assert!(left_out > 0);
}

/// The number in an environment variable.
fn number(name: &str) -> u64 {
    let text = std::env::var(name).unwrap_or_else(|_| panic!("{name} says no number"));
    text.parse().unwrap_or_else(|_| panic!("{name} is no number: {text}"))
}
