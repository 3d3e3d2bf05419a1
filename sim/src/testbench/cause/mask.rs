//! Which bits of a value count: sets of bits, as values of the same width.

use tilewright_circuit::Bits;

use tilewright_circuit::limbs;

/// No bits.
pub(super) fn none(width: u32) -> Bits {
    Bits::zero(width)
}

/// All bits.
pub(super) fn all(width: u32) -> Bits {
    Bits::ones(width)
}

/// Bit `index`.
pub(super) fn one(width: u32, index: u32) -> Bits {
    between(width, index, index + 1)
}

/// Bits `from .. to`.
pub(super) fn between(width: u32, from: u32, to: u32) -> Bits {
    let mut limbs = none(width).limbs().to_vec();
    limbs::set(&mut limbs, from, to);
    Bits::from_limbs(width, &limbs)
}

pub(super) fn and(a: &Bits, b: &Bits) -> Bits {
    combined(a, b, |a, b| a & b)
}

pub(super) fn or(a: &Bits, b: &Bits) -> Bits {
    combined(a, b, |a, b| a | b)
}

pub(super) fn xor(a: &Bits, b: &Bits) -> Bits {
    combined(a, b, |a, b| a ^ b)
}

fn combined(a: &Bits, b: &Bits, combine: fn(u64, u64) -> u64) -> Bits {
    let limbs: Vec<u64> = a.limbs().iter().zip(b.limbs()).map(|(a, b)| combine(*a, *b)).collect();
    Bits::from_limbs(a.width(), &limbs)
}

/// The index of the lowest 1, if there is one.
pub(super) fn lowest(of: &Bits) -> Option<u32> {
    (0..).zip(of.limbs()).find(|(_, limb)| **limb != 0).map(|(index, limb)| 64 * index + limb.trailing_zeros())
}

/// The index of the highest 1, if there is one.
pub(super) fn highest(of: &Bits) -> Option<u32> {
    let index = of.limbs().iter().rposition(|limb| *limb != 0)?;
    Some(64 * index as u32 + 63 - of.limbs()[index].leading_zeros())
}

/// The set with only its lowest bit.
pub(super) fn first(of: &Bits) -> Bits {
    lowest(of).map_or_else(|| none(of.width()), |index| one(of.width(), index))
}

/// The bits from 0 to the highest of the set, in a value of another width.
pub(super) fn up_to_highest(of: &Bits, width: u32) -> Bits {
    between(width, 0, highest(of).map_or(0, |highest| highest + 1).min(width))
}

/// A value of `width` bits with the lowest bits of another one from bit `at` on, as far as there is room.
pub(super) fn placed(of: &Bits, width: u32, at: u32) -> Bits {
    let mut limbs = none(width).limbs().to_vec();
    if at < width {
        limbs::copy(&mut limbs, at, of.limbs(), 0, of.width().min(width - at));
    }
    Bits::from_limbs(width, &limbs)
}

/// The only run of bits in the set: its lowest and its highest.
pub(super) fn run(of: &Bits) -> Option<(u32, u32)> {
    let (low, high) = (lowest(of)?, highest(of)?);
    (between(of.width(), low, high + 1).limbs() == of.limbs()).then_some((low, high))
}
