//! Random numbers that are the same every time, and random ways of machines that they choose.

use tilewright_sim::{Checkpoint, Simulation};

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

/// A state that simulations go back to.
#[derive(Default)]
pub struct Again(Option<Checkpoint>);

impl Again {
    /// In one step of four it keeps the state of one simulation; in another step all go back to it, if they are to.
    pub fn go_on(&mut self, all: &mut [Simulation], step: usize, goes_back: bool) {
        match &self.0 {
            Some(checkpoint) if goes_back => {
                for sim in all {
                    sim.restore(checkpoint).unwrap();
                    // Its inputs alone decide what comes next; an assertion fails on all engines or on none.
                    let _ = sim.try_run(40);
                }
            }
            _ if step % 4 == 1 => {
                let of = step / 4 % all.len();
                self.0 = Some(all[of].checkpoint());
            }
            _ => {}
        }
    }
}
