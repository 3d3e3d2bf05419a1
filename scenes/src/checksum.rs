//! FNV-1a, 64 bits: a checksum that pins meshes and frames in tests. It does not protect against tampering.
//!
//! Source: Fowler, Noll and Vo's published constants. Numbers are fed least significant byte first, on every machine.

pub(crate) struct Fnv(u64);

impl Fnv {
    pub(crate) fn new() -> Fnv {
        Fnv(0xcbf2_9ce4_8422_2325)
    }

    pub(crate) fn add(&mut self, number: u64) {
        for byte in number.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    pub(crate) fn value(&self) -> u64 {
        self.0
    }
}
