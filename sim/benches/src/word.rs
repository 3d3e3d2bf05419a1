//! Operations on words that several designs share.

use tilewright_hdl::{Signal, mux};

/// The next state of a 32-bit xorshift generator (Marsaglia's shifts 13, 17, 5). It visits every state but 0.
pub fn xorshift(state: Signal) -> Signal {
    let mixed = state ^ (state << 13);
    let mixed = mixed ^ (mixed >> 17);
    mixed ^ (mixed << 5)
}

/// A seed for the generator of each lane: odd multiples of the golden ratio have no pattern in their bits.
pub fn seed(lane: u32) -> u64 {
    u64::from(0x9e37_79b1_u32.wrapping_mul(lane + 1))
}

/// A random number below `count`: one that is too large is reduced by `less`.
pub fn below(random: Signal, count: u32, less: u32) -> Signal {
    if u64::from(count) == 1 << random.width() { random } else { mux(random.ge(count), random - less, random) }
}
