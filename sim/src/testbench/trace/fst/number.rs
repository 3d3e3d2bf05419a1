//! Numbers of variable length, and compressed bytes.

use flate2::Compression;
use flate2::write::{GzEncoder, ZlibEncoder};
use std::io::Write;

/// Seven bits in each byte, the lowest first; all bytes but the last have the eighth bit.
#[inline]
pub fn unsigned(to: &mut Vec<u8>, mut value: u64) {
    while value > 0x7f {
        to.push(value as u8 | 0x80);
        value >>= 7;
    }
    to.push(value as u8);
}

/// The same for a signed number: bit 6 of the last byte is the sign.
pub fn signed(to: &mut Vec<u8>, mut value: i64) {
    while !(-64..64).contains(&value) {
        to.push(value as u8 | 0x80);
        value >>= 7;
    }
    to.push(value as u8 & 0x7f);
}

/// Eight bytes, the highest first.
pub fn long(to: &mut Vec<u8>, value: u64) {
    to.extend_from_slice(&value.to_be_bytes());
}

/// The bytes as zlib writes them, or themselves where that is not shorter: a reader tells by the length.
pub fn shorter(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::new(4));
    let packed = encoder.write_all(bytes).and_then(|()| encoder.finish()).expect(IN_MEMORY);
    if packed.len() < bytes.len() { packed } else { bytes.to_vec() }
}

/// The bytes as gzip writes them, without a time.
pub fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::new(4));
    encoder.write_all(bytes).and_then(|()| encoder.finish()).expect(IN_MEMORY)
}

const IN_MEMORY: &str = "writing to memory does not fail";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_as_many_bytes_as_they_need() {
        let bytes = |put: &dyn Fn(&mut Vec<u8>)| {
            let mut bytes = Vec::new();
            put(&mut bytes);
            bytes
        };
        for (value, expected) in [(0, &[0][..]), (127, &[0x7f]), (128, &[0x80, 1]), (300, &[0xac, 2])] {
            assert_eq!(bytes(&|to| unsigned(to, value)), expected, "{value}");
        }
        assert_eq!(bytes(&|to| unsigned(to, u64::MAX)).len(), 10);
        // 19 and -5 are from GTKWave's own files.
        for (value, expected) in
            [(19, &[0x13][..]), (-5, &[0x7b]), (63, &[0x3f]), (64, &[0xc0, 0]), (-65, &[0xbf, 0x7f])]
        {
            assert_eq!(bytes(&|to| signed(to, value)), expected, "{value}");
        }
    }
}
