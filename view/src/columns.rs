//! Columns of numbers, as the page unpacks them.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use miniz_oxide::deflate::compress_to_vec_zlib;

/// How hard they are compressed, 0 to 10: more takes longer than it saves on the loopback.
const LEVEL: u8 = 4;

/// Each number less the one before.
pub(crate) fn differences(column: &[u32]) -> Vec<u32> {
    let mut last = 0;
    column.iter().map(|value| value.wrapping_sub(std::mem::replace(&mut last, *value))).collect()
}

/// Columns of 32 bits, compressed. The bytes of one weight are alike, so they stand together.
pub(crate) fn packed_columns(columns: &[Vec<u32>]) -> String {
    let bytes: Vec<u8> = columns
        .iter()
        .flat_map(|column| (0..4).flat_map(|weight| column.iter().map(move |value| value.to_le_bytes()[weight])))
        .collect();
    BASE64_STANDARD.encode(compress_to_vec_zlib(&bytes, LEVEL))
}
