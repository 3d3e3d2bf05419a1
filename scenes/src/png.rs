//! Frames as PNG files: only colours, 8 bits a channel.

use crate::error::SceneError;
use crate::frame::{Frame, blank};
use crate::input::{self, read_bytes};
use crate::output::write_whole;
use crate::size::Size;
use image::codecs::png::{PngDecoder, PngEncoder};
use image::{DynamicImage, ExtendedColorType, ImageDecoder, ImageEncoder};
use std::io::Cursor;
use std::path::Path;

/// The first bytes of every PNG file.
const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

impl Frame {
    /// The frame's colours as the bytes of a PNG file.
    pub fn to_png(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        PngEncoder::new(&mut bytes)
            .write_image(&self.rgb_bytes(), self.size().width(), self.size().height(), ExtendedColorType::Rgb8)
            .expect("a PNG of at most 2048x2048 pixels fits in memory");
        bytes
    }

    /// Writes the frame's colours as a PNG file, whole or not at all.
    ///
    /// # Errors
    /// [`SceneError::Write`], naming the file.
    pub fn write_png(&self, path: impl AsRef<Path>) -> Result<(), SceneError> {
        write_whole(path.as_ref(), &self.to_png())
    }

    /// Reads a PNG file. It has no depths: every pixel gets the greatest one, so compare such a frame with
    /// [`crate::compare_colours`]. Transparency is dropped, 16-bit channels are rounded to 8.
    ///
    /// # Errors
    /// [`SceneError::Read`] if there is no such file, [`SceneError::File`] if it is not a PNG of at most 2048x2048 pixels.
    pub fn read_png(path: impl AsRef<Path>) -> Result<Frame, SceneError> {
        let path = path.as_ref();
        let wrong = |problem: String, remedy: &str| SceneError::File {
            path: path.to_owned(),
            problem,
            remedy: remedy.to_owned(),
        };
        let bytes = read_bytes(path, &input::PICTURE)?;
        let picture =
            decoded(&bytes, |width, height, _| Size::new(width, height).is_ok()).map_err(
                |unreadable| match unreadable {
                    Unreadable::NoPng => wrong("is not a PNG file".to_owned(), "name a PNG file"),
                    Unreadable::Damaged => wrong("is a damaged PNG file".to_owned(), "make it again, or name another"),
                    Unreadable::Size(width, height) => wrong(
                        format!("holds {width}x{height} pixels, and a frame has at most 2048x2048"),
                        "name a smaller picture",
                    ),
                },
            )?;
        let picture = picture.into_rgb8();
        let size = Size::new(picture.width(), picture.height())?;
        let mut frame = Frame::blank(size, [0; 3]);
        for (word, pixel) in frame.words.iter_mut().zip(picture.pixels()) {
            *word = blank(pixel.0);
        }
        Ok(frame)
    }
}

/// Why there is no picture.
pub(crate) enum Unreadable {
    /// It does not begin as PNG files do.
    NoPng,
    /// It begins like one, but the rest is malformed.
    Damaged,
    /// It has an unwanted width or height.
    Size(u32, u32),
}

/// The picture of a PNG file. It is decoded only if its width, its height and its size in bytes are `wanted`.
pub(crate) fn decoded(bytes: &[u8], wanted: impl Fn(u32, u32, u64) -> bool) -> Result<DynamicImage, Unreadable> {
    if !bytes.starts_with(SIGNATURE) {
        return Err(Unreadable::NoPng);
    }
    // The library describes a damaged file in its own jargon.
    let damaged = |_| Unreadable::Damaged;
    let decoder = PngDecoder::new(Cursor::new(bytes)).map_err(damaged)?;
    let (width, height) = decoder.dimensions();
    if !wanted(width, height, decoder.total_bytes()) {
        return Err(Unreadable::Size(width, height));
    }
    DynamicImage::from_decoder(decoder).map_err(damaged)
}
