//! Textures from PNG and JPEG files of any size.

use super::fit::{fitted, level};
use super::picture::{Bad, Picture, decoded};
use super::{MOST_LEVEL, Texture};
use crate::error::SceneError;
use crate::input::{self, read_bytes};
use crate::quote::shown;
use std::path::Path;
use std::sync::Arc;

/// What is wrong with a texture's file, and the remedy; the caller adds the place.
pub(crate) type Wrong = (String, String);

/// A texture, and how it differs from its file, a sentence each; the caller adds the place.
#[derive(Debug)]
pub(crate) struct Found {
    pub(crate) texture: Arc<Texture>,
    pub(crate) notes: Vec<String>,
}

/// Reads a texture. Transparency is dropped, 16-bit channels are rounded to 8. A picture that is not a square of a
/// power of two up to 1024 is scaled to one, as [the page of that](super::fit) says.
///
/// # Errors
/// The file cannot be read, is not a complete PNG or JPEG file, or takes more than 256 MiB.
pub(crate) fn read(path: &Path) -> Result<Found, Wrong> {
    let name = shown(path);
    if !path.exists() {
        return Err((
            format!("there is no texture {name}"),
            "correct the path, which is relative to this file's folder".to_owned(),
        ));
    }
    made(&name, &read_bytes(path, &input::TEXTURE).map_err(|error| split(&error))?)
}

/// A texture from the bytes of such a file; messages use that name.
///
/// # Errors
/// As [`read`].
pub(crate) fn made(name: &str, bytes: &[u8]) -> Result<Found, Wrong> {
    let wrong = |problem: String, remedy: &str| Err((format!("the texture {name} {problem}"), remedy.to_owned()));
    let picture = match decoded(bytes) {
        Ok(picture) => picture,
        Err(Bad::Unknown) => return wrong("is neither a PNG nor a JPEG file".to_owned(), "convert it to one of them"),
        Err(Bad::Damaged(kind)) => return wrong(format!("is a damaged {kind} file"), "make it again"),
        Err(Bad::Large(width, height)) => {
            let problem = format!("has {width}x{height} pixels, which take more than 256 MiB");
            return wrong(problem, "scale it to 1024x1024, the most that is drawn");
        }
    };
    let (side, texels) = fitted(&picture.pixels);
    let texture = Arc::new(Texture::new(side, texels).map_err(|error| split(&error))?);
    Ok(Found { texture, notes: notes(name, &picture, side) })
}

/// The detail that a texture on that level loses, compared with the picture.
fn notes(name: &str, picture: &Picture, side: u32) -> Vec<String> {
    let (width, height) = picture.pixels.dimensions();
    let mut notes = Vec::new();
    if level(width, height).is_none() {
        notes.push(format!(
            "the texture {name} has {width}x{height} pixels, so it is scaled to {0}x{0}: a texture is a square of a power of two, up to {1}",
            1 << side,
            1 << MOST_LEVEL
        ));
    }
    if picture.is_transparent {
        notes.push(format!("the texture {name} is transparent in places, and drawn as opaque: make it opaque"));
    }
    if picture.is_turned {
        notes.push(format!(
            "the texture {name} asks to be shown turned (EXIF), and is drawn as it is stored: turn its pixels"
        ));
    }
    notes
}

/// A sentence in its two parts.
fn split(error: &SceneError) -> Wrong {
    let sentence = error.to_string();
    let (problem, remedy) = sentence.rsplit_once(": ").unwrap_or((&sentence, ""));
    (problem.to_owned(), remedy.to_owned())
}
