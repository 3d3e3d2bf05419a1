//! Words on their way from node to node.

/// The bytes of a region's words, in the order of sending: of all pixels of a chip the first byte, then the second, one of each chip at a time.
#[derive(Clone, Debug)]
pub(in crate::pixelflow) struct Words {
    /// Of each sending, the bytes of all chips: the first chip's is the lowest of the first limb.
    limbs: Vec<u64>,
    /// Limbs of a sending.
    size: usize,
}

impl Words {
    /// None, with room for so many sendings; of so many chips.
    pub fn new(chips: u32, sendings: usize) -> Words {
        let size = chips.div_ceil(8) as usize;
        Words { limbs: Vec::with_capacity(size * sendings), size }
    }

    /// How often bytes are sent.
    pub fn len(&self) -> usize {
        self.limbs.len() / self.size
    }

    /// One more.
    pub fn push(&mut self, sent: &[u64]) {
        debug_assert_eq!(sent.len(), self.size);
        self.limbs.extend_from_slice(sent);
    }

    /// What is sent then, if anything is.
    pub fn get(&self, number: usize) -> Option<&[u64]> {
        self.limbs.get(self.size * number..)?.get(..self.size)
    }

    /// The byte of a chip that is sent then.
    ///
    /// # Panics
    /// There is none.
    pub fn byte(&self, number: usize, chip: u32) -> u64 {
        self.limbs[self.size * number + chip as usize / 8] >> (8 * (chip % 8)) & 0xff
    }
}
