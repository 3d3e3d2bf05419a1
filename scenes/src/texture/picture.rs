//! Pictures for textures: PNG and JPEG files, recognised by their content and not by their names.
//!
//! JPEG files are decoded in plain integer code on every machine, so the same file has the same pixels everywhere:
//! `zune-jpeg` is built without its vector code. Profiles and gamma of a file are ignored.

use crate::png::{self, Unreadable};
use image::{DynamicImage, RgbImage};
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// A picture as stored, and how its display should differ.
pub(super) struct Picture {
    pub(super) pixels: RgbImage,
    /// Some pixel is not opaque.
    pub(super) is_transparent: bool,
    /// Its EXIF part asks for a rotation or a mirror image.
    pub(super) is_turned: bool,
}

/// Why there is no picture.
pub(super) enum Bad {
    /// It begins like neither kind of file.
    Unknown,
    /// It begins like that kind, but this is wrong with it.
    Damaged(&'static str),
    /// It has this many pixels, which take too much memory.
    Large(u32, u32),
}

/// The most memory that a picture may take during decoding, in bytes.
const MOST_BYTES: u64 = 256 << 20;
/// The first bytes of every JPEG file.
const JPEG: &[u8] = &[0xff, 0xd8, 0xff];
/// The longest side of a JPEG file.
const JPEG_SIDE: usize = u16::MAX as usize;

/// The picture of such a file.
pub(super) fn decoded(bytes: &[u8]) -> Result<Picture, Bad> {
    if bytes.starts_with(JPEG) {
        return jpeg(bytes);
    }
    let image = png::decoded(bytes, |width, height, bytes| width > 0 && height > 0 && bytes <= MOST_BYTES);
    let image = image.map_err(|unreadable| match unreadable {
        Unreadable::NoPng => Bad::Unknown,
        Unreadable::Damaged => Bad::Damaged("PNG"),
        Unreadable::Size(width, height) => Bad::Large(width, height),
    })?;
    Ok(Picture { is_transparent: is_transparent(&image), is_turned: false, pixels: image.into_rgb8() })
}

fn jpeg(bytes: &[u8]) -> Result<Picture, Bad> {
    let options = DecoderOptions::default()
        .set_strict_mode(true)
        .set_max_width(JPEG_SIDE)
        .set_max_height(JPEG_SIDE)
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    // The library describes a damaged file in its own jargon.
    let damaged = |_| Bad::Damaged("JPEG");
    decoder.decode_headers().map_err(damaged)?;
    let (width, height) = decoder.dimensions().ok_or(Bad::Damaged("JPEG"))?;
    let (width, height) = (width as u32, height as u32);
    if 3 * u64::from(width) * u64::from(height) > MOST_BYTES {
        return Err(Bad::Large(width, height));
    }
    let pixels = decoder.decode().map_err(damaged)?;
    let is_turned = decoder.exif().and_then(|exif| orientation(exif)).is_some_and(|orientation| orientation > 1);
    let pixels = RgbImage::from_raw(width, height, pixels).ok_or(Bad::Damaged("JPEG"))?;
    Ok(Picture { pixels, is_transparent: false, is_turned })
}

fn is_transparent(image: &DynamicImage) -> bool {
    match image {
        DynamicImage::ImageLumaA8(pixels) => pixels.pixels().any(|pixel| pixel.0[1] < u8::MAX),
        DynamicImage::ImageRgba8(pixels) => pixels.pixels().any(|pixel| pixel.0[3] < u8::MAX),
        DynamicImage::ImageLumaA16(pixels) => pixels.pixels().any(|pixel| pixel.0[1] < u16::MAX),
        DynamicImage::ImageRgba16(pixels) => pixels.pixels().any(|pixel| pixel.0[3] < u16::MAX),
        _ => false,
    }
}

/// The orientation in an EXIF part, 1 to 8, if it states one: 1 is as stored.
fn orientation(exif: &[u8]) -> Option<u16> {
    let is_little = exif.starts_with(b"II*\0");
    if !is_little && !exif.starts_with(b"MM\0*") {
        return None;
    }
    let number = |at: usize| {
        let bytes: [u8; 2] = exif.get(at..at.checked_add(2)?)?.try_into().ok()?;
        Some(if is_little { u16::from_le_bytes(bytes) } else { u16::from_be_bytes(bytes) })
    };
    // The offset of the first directory, whose entries are of 12 bytes: tag, type, count and value.
    let [low, high] = if is_little { [4, 6] } else { [6, 4] };
    let directory = usize::from(number(low)?) | usize::from(number(high)?) << 16;
    let entries = (0..usize::from(number(directory)?)).map(|i| directory + 2 + 12 * i);
    entries.into_iter().find(|&entry| number(entry) == Some(0x112)).and_then(|entry| number(entry + 8))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_orientation_is_found_in_both_orders_of_bytes() {
        let little = b"II*\0\x08\0\0\0\x02\0\x0f\x01\x02\0\0\0\0\0\0\0\0\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0";
        let big = b"MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x03\0\0";
        assert_eq!([orientation(little), orientation(big)], [Some(6), Some(3)]);
        assert_eq!(orientation(b"II*\0\xff\xff\xff\xff\x02\0"), None);
        assert_eq!(orientation(&little[..20]), None);
        assert_eq!(orientation(b"Exif"), None);
    }
}
