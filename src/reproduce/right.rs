//! Whether a frame of the hardware is the golden image.

use crate::golden;
use crate::shell::Failure;
use tilewright_report::{Origin, Rule, Statement};
use tilewright_scenes::golden::render_watched;
use tilewright_scenes::{Frame, Polygons, compare};

/// The number of pixels that differ from the golden image.
pub fn differing(frame: &Frame, scene: &Polygons, background: [u8; 3]) -> Result<u64, Failure> {
    let golden = golden::draw(|watch| render_watched(scene.size, &scene.polygons, background, watch))?;
    Ok(compare(frame, &golden).differing)
}

/// That number as a sentence.
pub fn in_words(differing: u64) -> String {
    match differing {
        0 => "Identical to the golden image, in depth and colour.".to_owned(),
        _ => format!("NOT the golden image: {differing} pixels differ."),
    }
}

/// The check that all frames are right: the pixels that differ, by frame.
pub fn statement(fact: &str, differing: impl IntoIterator<Item = (String, u64)>) -> Statement {
    let found = differing.into_iter().map(|(frame, pixels)| (frame, pixels as f64));
    Statement::new(fact, "Each frame of the hardware is the golden image, in depth and colour.", Rule::Zero)
        .unit("pixels that differ")
        .found(Origin::rtl([]), found)
}
