//! Runs of limbs of the state, to compare it with an earlier copy.

use super::Place;

/// A run of limbs of the state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Span {
    /// In bytes, a multiple of 8.
    pub offset: usize,
    pub limbs: usize,
    /// The significant bits of the last one.
    pub mask: u64,
}

impl Span {
    /// The limbs, each with its significant bits.
    pub fn limbs(self) -> impl Iterator<Item = (usize, u64)> {
        let mask = move |limb| if limb + 1 == self.limbs { self.mask } else { u64::MAX };
        (0..self.limbs).map(move |limb| (self.offset + 8 * limb, mask(limb)))
    }
}

/// The place of a value, in whole limbs.
pub(crate) fn span(place: Place) -> Span {
    let bytes = place.lanes as usize * place.bytes();
    let rest = bytes % 8 * 8;
    let mask = if rest == 0 { u64::MAX } else { (1 << rest) - 1 };
    Span { offset: place.offset, limbs: bytes.div_ceil(8), mask }
}
