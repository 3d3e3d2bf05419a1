//! Golden frames of polygons and spheres: for a sphere, too, each pixel of its box is tested, with all products
//! computed directly.

use super::{Primitive, draw_watched, each_fragment, fragments, least, nearest};
use crate::frame::{Frame, word};
use crate::packet::*;
use crate::project::Polygons;
use crate::sphere::{Quadratic, SpherePacket};
use std::ops::ControlFlow;

/// Which of a pixel's fragments is visible.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// The one with the least word (DES-MIN), as in [`render`](super::render).
    Least,
    /// The one with the least depth, of equal ones the first, as in [`render_strict`](super::render_strict).
    Strict,
}

impl SpherePacket {
    /// Whether the sphere covers pixel (x, y).
    pub fn covers(&self, x: u32, y: u32) -> bool {
        // On all screens this is far below 2^63.
        self.inside.at(x.into(), y.into()) >= 0
    }

    /// Depth at pixel (x, y), 24 bits; meaningful where the sphere covers the pixel.
    pub fn depth(&self, x: u32, y: u32) -> u32 {
        whole(&self.z, x, y, DEPTH_PLANE_BITS) as u32
    }

    /// Red, green and blue at pixel (x, y); meaningful where the sphere covers the pixel.
    pub fn rgb(&self, x: u32, y: u32) -> [u8; 3] {
        self.rgb.map(|channel| whole(&channel, x, y, COLOUR_PLANE_BITS) as u8)
    }

    /// The visibility word at pixel (x, y): `z << 24 | r << 16 | g << 8 | b`.
    pub fn word(&self, x: u32, y: u32) -> u64 {
        word(self.depth(x, y), self.rgb(x, y))
    }
}

/// The whole part of a quadratic modulo 2^`bits` at pixel (x, y).
fn whole(quadratic: &Quadratic, x: u32, y: u32, bits: u32) -> u64 {
    (quadratic.at(x.into(), y.into()) as u64 & ((1 << bits) - 1)) >> FRACTION_BITS
}

impl Primitive for SpherePacket {
    fn bounds(&self) -> PixelBox {
        self.bounds
    }

    fn covers(&self, x: u32, y: u32) -> bool {
        self.covers(x, y)
    }

    fn word(&self, x: u32, y: u32) -> u64 {
        self.word(x, y)
    }
}

/// Renders polygons, and then spheres, over a background.
pub fn render_polygons(polygons: &Polygons, rule: Rule, background: [u8; 3]) -> Frame {
    render_polygons_watched(polygons, rule, background, |_| ControlFlow::Continue(())).expect("nothing breaks it off")
}

/// As [`render_polygons`], watched as in [`render_watched`](super::render_watched).
pub fn render_polygons_watched(
    polygons: &Polygons,
    rule: Rule,
    background: [u8; 3],
    mut watch: impl FnMut(f64) -> ControlFlow<()>,
) -> Option<Frame> {
    let Polygons { size, polygons, spheres, .. } = polygons;
    let keep = match rule {
        Rule::Least => least,
        Rule::Strict => nearest,
    };
    let count = polygons.len() + spheres.len();
    let frame = draw_watched(Frame::blank(*size, background), polygons, [0, count], keep, &mut watch)?;
    draw_watched(frame, spheres, [polygons.len(), count], keep, watch)
}

/// The pixels that polygons and spheres cover, counted once for each, as [`fragments`] counts them.
pub fn fragments_of(polygons: &Polygons) -> u64 {
    let Polygons { size, polygons, spheres, .. } = polygons;
    let mut count = fragments(*size, polygons);
    spheres.iter().for_each(|sphere| each_fragment(*size, sphere, |_, _| count += 1));
    count
}
