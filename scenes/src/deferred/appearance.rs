//! The appearance word: the attributes of a pixel's nearest surface for deferred shading, in 21 bytes.
//!
//! Source: PFL-BYTES (4 z, 6 normal, 3 colour, 4 u and v, 2 texture, 2 scale), DES-MIN.

use crate::packet::{DEPTH_BITS, EMPTY_DEPTH};

/// Bytes of an appearance word.
pub const APPEARANCE_BYTES: usize = 21;

/// An appearance word, in the sequence in which its bytes are sent and compared:
///
/// | bytes | contents | format |
/// |---|---|---|
/// | 0 to 2 | depth | 24 bits |
/// | 3 | 0 | 255 only in the empty word |
/// | 4 to 9 | normal: right, down, forward | 16 bits each, two's complement; any length |
/// | 10 to 12 | diffuse red, green, blue | 8 bits each |
/// | 13 to 16 | u/w and v/w | 16 bits each |
/// | 17 | material | index into the shader's table |
/// | 18 | level at the greatest scale | 3 of its 8 bits are fraction |
/// | 19 to 20 | scale: 1/w | 16 bits |
///
/// The more significant byte of a number is sent first. The whole word is compared as one number: depth decides, and if
/// depths are equal the rest does. So the minimum is commutative, associative and idempotent (DES-MIN), and the
/// distribution of triangles over machines cannot change a pixel.
///
/// ```
/// use tilewright_scenes::deferred::{Appearance, Parameters};
///
/// let near = Appearance::from(Parameters { z: 0x00_1234, rgb: [200; 3], ..Parameters::default() });
/// let far = Appearance::from(Parameters { z: 0x00_1235, ..Parameters::default() });
/// assert_eq!(near.bytes()[..4], [0x00, 0x12, 0x34, 0]);
/// assert!(near < far && far < Appearance::EMPTY);
/// assert_eq!(near.parameters().rgb, [200; 3]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Appearance([u8; APPEARANCE_BYTES]);

/// The numbers in an appearance word.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Parameters {
    /// Depth, 24 bits.
    pub z: u32,
    /// The normal: right, down, forward of the eye. Its length is arbitrary.
    pub normal: [i16; 3],
    /// Diffuse red, green and blue.
    pub rgb: [u8; 3],
    /// u/w and v/w, in the same unit as the 1/w in [`Parameters::scale`].
    pub uv: [u16; 2],
    /// Index into [`Shader::materials`](super::Shader::materials).
    pub material: u8,
    /// The level of detail at scale 2^16, in 1/8: the side of the texture on level l has 2^l texels.
    pub level: u8,
    /// 1/w, in a unit of the triangle's own; 0 if there is no texture.
    pub scale: u16,
}

impl Appearance {
    /// The word of a pixel that nothing covers: the identity of the minimum.
    pub const EMPTY: Appearance = Appearance([0xff; APPEARANCE_BYTES]);

    /// The word with these bytes.
    pub fn from_bytes(bytes: [u8; APPEARANCE_BYTES]) -> Appearance {
        Appearance(bytes)
    }

    /// Its bytes, in the sequence of sending.
    pub fn bytes(&self) -> [u8; APPEARANCE_BYTES] {
        self.0
    }

    /// Whether nothing covers the pixel: byte 3 alone decides.
    pub fn is_empty(&self) -> bool {
        self.0[3] != 0
    }

    /// The numbers in it.
    pub fn parameters(&self) -> Parameters {
        let b = &self.0;
        let word = |i: usize| u16::from_be_bytes([b[i], b[i + 1]]);
        Parameters {
            z: u32::from_be_bytes([0, b[0], b[1], b[2]]),
            normal: [4, 6, 8].map(|i| word(i) as i16),
            rgb: [b[10], b[11], b[12]],
            uv: [word(13), word(15)],
            material: b[17],
            level: b[18],
            scale: word(19),
        }
    }
}

impl From<Parameters> for Appearance {
    fn from(p: Parameters) -> Appearance {
        debug_assert!(p.z >> DEPTH_BITS == 0 && p.z != EMPTY_DEPTH, "depth {:#x}", p.z);
        let mut bytes = [0; APPEARANCE_BYTES];
        bytes[..3].copy_from_slice(&p.z.to_be_bytes()[1..]);
        let words = [(4, p.normal[0] as u16), (6, p.normal[1] as u16), (8, p.normal[2] as u16)];
        for (at, word) in words.into_iter().chain([(13, p.uv[0]), (15, p.uv[1]), (19, p.scale)]) {
            bytes[at..at + 2].copy_from_slice(&word.to_be_bytes());
        }
        bytes[10..13].copy_from_slice(&p.rgb);
        (bytes[17], bytes[18]) = (p.material, p.level);
        Appearance(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_of_bytes_is_fixed() {
        let parameters = Parameters {
            z: 0x01_0203,
            normal: [0x0506, -2, i16::MIN],
            rgb: [10, 11, 12],
            uv: [0x0d0e, 0x0f10],
            material: 17,
            level: 18,
            scale: 0x1314,
        };
        let word = Appearance::from(parameters);
        let bytes = [1, 2, 3, 0, 5, 6, 0xff, 0xfe, 0x80, 0, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20];
        assert_eq!(word.bytes(), bytes);
        assert_eq!(Appearance::from_bytes(bytes).parameters(), parameters);
        assert!(!word.is_empty() && Appearance::EMPTY.is_empty());
        // The greatest depth of a pixel that something covers.
        let deep = Appearance::from(Parameters { z: 0xff_fffd, ..parameters });
        assert!(!deep.is_empty() && deep < Appearance::EMPTY);
    }

    #[test]
    fn words_are_compared_as_one_number() {
        let word = |place: usize, byte: u8| {
            let mut bytes = [7; APPEARANCE_BYTES];
            bytes[place] = byte;
            Appearance::from_bytes(bytes)
        };
        for place in 0..APPEARANCE_BYTES {
            // As unsigned bytes, even for the sign of a normal; earlier bytes are more significant than later ones.
            assert!(word(place, 6) < word(place, 7) && word(place, 7) < word(place, 0x80), "byte {place}");
            assert!((place + 1..APPEARANCE_BYTES).all(|later| word(place, 6) < word(later, 0)));
        }
        assert!(Appearance::EMPTY > word(0, 0xff));
    }
}
