//! Textures from PNG files.

use super::{MOST_LEVEL, Texture};
use crate::error::SceneError;
use crate::input::{self, read_bytes};
use crate::png::{Unreadable, decoded};
use crate::quote::shown;
use std::path::Path;

/// What is wrong with a texture's file, and what to do; who names the file knows at what place.
pub(crate) type Wrong = (String, String);

/// Reads a texture. Transparency is dropped, 16-bit channels are rounded to 8.
///
/// # Errors
/// The file cannot be read, is no PNG file, or its picture is no square whose side is a power of two up to 1024.
pub(crate) fn read(path: &Path) -> Result<Texture, Wrong> {
    let wrong = |problem: String, remedy: &str| (problem, remedy.to_owned());
    let name = shown(path);
    if !path.exists() {
        return Err(wrong(
            format!("there is no texture {name}"),
            "correct the path, which is relative to this file's folder",
        ));
    }
    let bytes = read_bytes(path, &input::TEXTURE).map_err(|error| split(&error))?;
    let picture =
        decoded(&bytes, |width, height| level(width, height).is_some()).map_err(|unreadable| match unreadable {
            Unreadable::NoPng => wrong(format!("the texture {name} is not a PNG file"), "convert it to PNG"),
            Unreadable::Damaged => wrong(format!("the texture {name} is a damaged PNG file"), "make it again"),
            Unreadable::Size(width, height) => (
                format!("the texture {name} has {width}x{height} pixels"),
                format!(
                    "scale it to {0}x{0}: a texture is a square of a power of two, up to 1024",
                    fitting(width, height)
                ),
            ),
        })?;
    let side = picture.width();
    // A picture begins with its uppermost row, and a texture with its lowest.
    let texels = picture.rows().rev().flatten().map(|pixel| pixel.0).collect();
    let made = level(side, side).map(|level| Texture::new(level, texels));
    made.ok_or_else(|| wrong(format!("the texture {name} is empty"), "make it again"))?.map_err(|error| split(&error))
}

/// The level of a texture of these sides, if it can be one.
fn level(width: u32, height: u32) -> Option<u32> {
    (width == height && width.is_power_of_two() && width.ilog2() <= MOST_LEVEL).then(|| width.ilog2())
}

/// The side of a texture that keeps most of such a picture.
fn fitting(width: u32, height: u32) -> u32 {
    let most = 1 << MOST_LEVEL;
    // Above the power of two that is nearest, going by ratio.
    let side = width.max(height).clamp(1, most);
    let above = side.next_power_of_two();
    if u64::from(side) * u64::from(side) * 2 >= u64::from(above) * u64::from(above) { above } else { above / 2 }
}

/// A sentence in its two parts.
fn split(error: &SceneError) -> Wrong {
    let sentence = error.to_string();
    let (problem, remedy) = sentence.rsplit_once(": ").unwrap_or((&sentence, ""));
    (problem.to_owned(), remedy.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_to_be_scaled_to_the_nearest_power_of_two() {
        let sides = [(1, 1), (3, 1), (640, 480), (700, 480), (725, 9), (1000, 1000), (4000, 3000), (0, 0)];
        assert_eq!(sides.map(|(width, height)| fitting(width, height)), [1, 4, 512, 512, 1024, 1024, 1024, 1]);
        assert_eq!([(1, 1), (64, 64), (1024, 1024)].map(|(w, h)| level(w, h)), [Some(0), Some(6), Some(10)]);
        assert_eq!([(0, 0), (64, 32), (48, 48), (2048, 2048)].map(|(w, h)| level(w, h)), [None; 4]);
    }
}
