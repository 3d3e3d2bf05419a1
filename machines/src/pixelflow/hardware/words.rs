//! Words on their way from node to node.

/// The bytes of a region's words, in the sequence of sending. The first byte of all pixels of a chip comes first, then the second. All chips send
/// at the same time.
#[derive(Clone, Debug)]
pub(in crate::pixelflow) struct Words {
    /// For each sending, the bytes of all chips; the first chip's byte is the lowest of the first limb.
    limbs: Vec<u64>,
    /// Limbs of a sending.
    size: usize,
}

impl Words {
    /// No bytes yet, with capacity for a number of sendings from a number of chips.
    pub fn new(chips: u32, sendings: usize) -> Words {
        let size = chips.div_ceil(8) as usize;
        Words { limbs: Vec::with_capacity(size * sendings), size }
    }

    /// The number of sendings.
    pub fn len(&self) -> usize {
        self.limbs.len() / self.size
    }

    /// Adds a sending.
    pub fn push(&mut self, sent: &[u64]) {
        debug_assert_eq!(sent.len(), self.size);
        self.limbs.extend_from_slice(sent);
    }

    /// The bytes of a sending, if there is one.
    pub fn get(&self, number: usize) -> Option<&[u64]> {
        self.limbs.get(self.size * number..)?.get(..self.size)
    }

    /// The byte of a chip in a sending.
    ///
    /// # Panics
    /// There is none.
    pub fn byte(&self, number: usize, chip: u32) -> u64 {
        self.limbs[self.size * number + chip as usize / 8] >> (8 * (chip % 8)) & 0xff
    }
}
