//! What the examples of this crate share.

use crate::{Answer, Clock, Page, Picture, Site, Unit, Write};

/// A site without data.
pub struct Empty;

impl Site for Empty {
    fn page(&self) -> Page {
        Page::Frame
    }

    fn about(&self) -> String {
        "{}".to_owned()
    }

    fn data(&self, _: &str, _: &str) -> Answer {
        Answer::Unknown
    }
}

/// A picture of two pixels, one of which is written.
pub fn picture() -> Picture {
    Picture {
        machine: "vc1".to_owned(),
        title: "star".to_owned(),
        size: [2, 1],
        background: [0; 3],
        clock: Clock { name: "40 MHz".to_owned(), picoseconds: 25_000 },
        end: 9,
        units: vec![Unit { name: "PE 0".to_owned(), colour: [200, 40, 40] }],
        grids: Vec::new(),
        kinds: Vec::new(),
        lanes: Vec::new(),
        identical: true,
        verdict: "identical to the golden image".to_owned(),
        writes: vec![Write { clock: 7, pixel: 1, unit: 0, depth: 3, colour: [1, 2, 3] }],
    }
}
