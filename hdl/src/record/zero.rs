//! Records of zeros.

use crate::stream::Stream;

/// The type of a test's numbers: of what may be a `Control::ZERO`, this makes it a `Control<u64>`.
#[doc(hidden)]
pub trait Numbers {
    type Are;
}

impl Numbers for () {
    type Are = u64;
}

/// A number, or a record of numbers, that is 0 in every bit.
#[doc(hidden)]
pub trait Zero {
    const ZERO: Self;
}

impl Zero for u64 {
    const ZERO: u64 = 0;
}

impl<V: Zero, const N: usize> Zero for [V; N] {
    const ZERO: [V; N] = [V::ZERO; N];
}

impl<P: Zero, T: Zero> Zero for Stream<P, T> {
    const ZERO: Stream<P, T> = Stream { valid: T::ZERO, ready: T::ZERO, payload: P::ZERO };
}
