//! A picture: a frame, or the unit that drew each pixel.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{Markup, html};
use serde::Serialize;

/// The begin of every PNG file: its signature, then the header chunk's length and name.
const START: &[u8] = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR";

/// The greatest width to which a small picture is enlarged, in CSS pixels.
const ENLARGED: u32 = 320;

/// The greatest width of a picture that is shown pixel by pixel, in CSS pixels: that of the page's text.
const WIDEST: u32 = 760;

/// A PNG picture. It is shown with sharp pixels, at most as wide as the page. A larger one is scaled down, with mixed pixels.
///
/// ```
/// use tilewright_report::Picture;
///
/// let not_png = Picture::new("frame", "The teapot", "a grey teapot on black", b"GIF89a".to_vec());
/// assert_eq!(not_png.size(), None);
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Picture {
    pub(crate) id: String,
    pub(crate) title: String,
    pub(crate) note: String,
    alt: String,
    #[serde(skip)]
    pub(crate) png: Vec<u8>,
}

impl Picture {
    /// A picture. It has a name for addresses and files, a title, a description for readers who do not see it, and the bytes of a PNG file.
    ///
    /// ```
    /// # let png = include_bytes!("../examples/dots.png").to_vec();
    /// use tilewright_report::Picture;
    ///
    /// let picture = Picture::new("dots", "Two dots", "a light dot above a dark one", png);
    /// assert_eq!(picture.size(), Some((8, 8)));
    /// ```
    pub fn new(id: impl Into<String>, title: impl Into<String>, alt: impl Into<String>, png: Vec<u8>) -> Picture {
        Picture { id: id.into(), title: title.into(), note: String::new(), alt: alt.into(), png }
    }

    /// A note below the title, in the caption.
    ///
    /// ```
    /// use tilewright_report::Picture;
    ///
    /// let picture = Picture::new("dots", "Two dots", "two dots", vec![]).note("Eight pixels wide.");
    /// assert_eq!(picture.size(), None);
    /// ```
    pub fn note(self, note: impl Into<String>) -> Picture {
        Picture { note: note.into(), ..self }
    }

    /// Width and height in pixels from the PNG's header; `None` without such a header.
    ///
    /// ```
    /// # let png = include_bytes!("../examples/dots.png").to_vec();
    /// assert_eq!(tilewright_report::Picture::new("dots", "Two dots", "two dots", png).size(), Some((8, 8)));
    /// ```
    pub fn size(&self) -> Option<(u32, u32)> {
        let (width, rest) = self.png.strip_prefix(START)?.split_first_chunk::<4>()?;
        let height = rest.first_chunk::<4>()?;
        Some((u32::from_be_bytes(*width), u32::from_be_bytes(*height)))
    }

    pub(crate) fn html(&self) -> Markup {
        let (width, height) = self.size().unwrap_or((1, 1));
        // A small picture is enlarged, by a whole number so that its pixels stay equal.
        let times = (ENLARGED / width.max(1)).max(1);
        html! {
            img.enlarged[times > 1].reduced[width > WIDEST] src={ "data:image/png;base64," (STANDARD.encode(&self.png)) } alt=(self.alt)
                width=(u64::from(width) * u64::from(times)) height=(u64::from(height) * u64::from(times));
        }
    }
}
