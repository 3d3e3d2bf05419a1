//! The bits that may be 1, lane by lane.

use super::super::value::{Bytes, Type};
use super::fact::ones;

/// The bits of a vector, or of a number, that may be 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(in crate::engine) struct Possible([u64; 4]);

impl Possible {
    pub(super) const ALL: Possible = Possible([u64::MAX; 4]);

    /// Those of a number.
    pub(super) fn of(number: u64) -> Possible {
        Possible([number, 0, 0, 0])
    }

    /// Those of a constant.
    pub(super) fn of_bytes(bytes: &Bytes) -> Possible {
        Possible(std::array::from_fn(|i| u64::from_le_bytes(std::array::from_fn(|byte| bytes[8 * i + byte]))))
    }

    /// Those of a number that has no more.
    pub(super) fn number(self) -> u64 {
        self.0[0]
    }

    fn both(self, other: Possible, of: impl Fn(u64, u64) -> u64) -> Possible {
        Possible(std::array::from_fn(|i| of(self.0[i], other.0[i])))
    }

    pub(super) fn and(self, other: Possible) -> Possible {
        self.both(other, |x, y| x & y)
    }

    pub(super) fn or(self, other: Possible) -> Possible {
        self.both(other, |x, y| x | y)
    }

    /// The same, with those of a lane replaced.
    pub(super) fn with_lane(mut self, ty: Type, i: u32, bits: u64) -> Possible {
        let (low, all) = (i * ty.element(), ones(ty.element()));
        let limb = &mut self.0[low as usize / 64];
        *limb = *limb & !(all << (low % 64)) | (bits & all) << (low % 64);
        self
    }
}

/// Bits of each lane of a vector, where `of` gives those of a lane by number.
pub(super) fn lanes(ty: Type, of: impl Fn(u32) -> u64) -> Possible {
    (0..ty.lanes()).fold(Possible::default(), |all, i| all.with_lane(ty, i, of(i)))
}

/// Bits of a lane.
pub(super) fn lane(ty: Type, bits: Possible, i: u32) -> u64 {
    let low = i * ty.element();
    bits.0[low as usize / 64] >> (low % 64) & ones(ty.element())
}
