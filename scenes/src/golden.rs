//! The golden rasterizer: a plain double loop over the integer contract, against which every machine is compared.
//!
//! Source: facts E0. It shares only the packet's type with the machines. Products are computed directly in i64, without
//! increments and without a tree, for each pixel of a polygon's box. So it can be checked by reading.

mod deferred;
mod passes;
mod samples;
mod spheres;

pub use deferred::{render_deferred, render_deferred_watched, visible};
pub use passes::{average, pass_shifts};
pub use samples::{average_eight, render_samples, render_samples_watched};
pub use spheres::{Rule, fragments_of, render_polygons, render_polygons_watched};

use crate::frame::{Frame, depth_of, rgb_of, word};
use crate::packet::*;
use crate::project::Polygons;
use crate::size::Size;
use std::ops::ControlFlow;

impl<E: AsRef<[Edge]>> Packet<E> {
    /// Whether the polygon covers pixel (x, y): all its reduced edge functions are at least 0 (DES-EDGE).
    pub fn covers(&self, x: u32, y: u32) -> bool {
        let value = |e: &Edge| i64::from(e.a) * i64::from(x) + i64::from(e.b) * i64::from(y) + i64::from(e.c);
        self.edges.as_ref().iter().all(|edge| value(edge) >= 0)
    }

    /// Depth at pixel (x, y), 24 bits; meaningful where the polygon covers the pixel (DES-Z).
    pub fn depth(&self, x: u32, y: u32) -> u32 {
        plane_at(&self.z, x, y, DEPTH_PLANE_BITS) as u32
    }

    /// Red, green and blue at pixel (x, y); meaningful where the polygon covers the pixel.
    pub fn rgb(&self, x: u32, y: u32) -> [u8; 3] {
        self.rgb.map(|plane| plane_at(&plane, x, y, COLOUR_PLANE_BITS) as u8)
    }

    /// The visibility word at pixel (x, y): `z << 24 | r << 16 | g << 8 | b`.
    pub fn word(&self, x: u32, y: u32) -> u64 {
        word(self.depth(x, y), self.rgb(x, y))
    }
}

/// The whole part of a plane of `bits` bits at pixel (x, y).
fn plane_at(plane: &Plane, x: u32, y: u32, bits: u32) -> u64 {
    // Fields have at most 40 bits and positions 11, so this is exact.
    let sum = plane.x * u64::from(x) + plane.y * u64::from(y) + plane.origin;
    (sum & ((1 << bits) - 1)) >> FRACTION_BITS
}

/// Renders triangles, or other polygons, over a background: each pixel keeps the least word (DES-MIN), so their
/// sequence does not matter.
pub fn render<E: AsRef<[Edge]>>(size: Size, packets: &[Packet<E>], background: [u8; 3]) -> Frame {
    let mut frame = Frame::blank(size, background);
    packets.iter().for_each(|packet| draw(&mut frame, packet, least));
    frame
}

/// As [`render`], but calls `watch` before every packet with the fraction done, from 0 to 1. `watch` may stop the
/// rendering; then there is no frame.
pub fn render_watched<E: AsRef<[Edge]>>(
    size: Size,
    packets: &[Packet<E>],
    background: [u8; 3],
    watch: impl FnMut(f64) -> ControlFlow<()>,
) -> Option<Frame> {
    draw_watched(Frame::blank(size, background), packets, [0, packets.len()], least, watch)
}

/// Renders packets with the strict rule: depth alone decides, and of equal depths the first submitted is kept (facts
/// E0).
pub fn render_strict<E: AsRef<[Edge]>>(size: Size, packets: &[Packet<E>], background: [u8; 3]) -> Frame {
    let mut frame = Frame::blank(size, background);
    packets.iter().for_each(|packet| draw(&mut frame, packet, nearest));
    frame
}

/// As [`render_strict`], watched as in [`render_watched`].
pub fn render_strict_watched<E: AsRef<[Edge]>>(
    size: Size,
    packets: &[Packet<E>],
    background: [u8; 3],
    watch: impl FnMut(f64) -> ControlFlow<()>,
) -> Option<Frame> {
    draw_watched(Frame::blank(size, background), packets, [0, packets.len()], nearest, watch)
}

/// A primitive that covers pixels.
pub(crate) trait Primitive {
    /// It covers no pixel outside this box.
    fn bounds(&self) -> PixelBox;
    /// Whether it covers that pixel.
    fn covers(&self, x: u32, y: u32) -> bool;
    /// The word there.
    fn word(&self, x: u32, y: u32) -> u64;
}

impl<E: AsRef<[Edge]>> Primitive for Packet<E> {
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

/// The smaller of a pixel's word and a fragment.
fn least(kept: u64, fragment: u64) -> u64 {
    kept.min(fragment)
}

/// The word that a pixel keeps by the strict rule, given its word and a later fragment.
fn nearest(kept: u64, fragment: u64) -> u64 {
    if depth_of(fragment) < depth_of(kept) { fragment } else { kept }
}

/// Draws primitives; `before` were drawn earlier, and `count` is the total.
fn draw_watched(
    mut frame: Frame,
    primitives: &[impl Primitive],
    [before, count]: [usize; 2],
    keep: impl Fn(u64, u64) -> u64 + Copy,
    mut watch: impl FnMut(f64) -> ControlFlow<()>,
) -> Option<Frame> {
    for (done, primitive) in (before..).zip(primitives) {
        if watch(done as f64 / count as f64).is_break() {
            return None;
        }
        draw(&mut frame, primitive, keep);
    }
    Some(frame)
}

fn draw(frame: &mut Frame, packet: &impl Primitive, keep: impl Fn(u64, u64) -> u64) {
    each_fragment(frame.size(), packet, |pixel, fragment| {
        let kept = &mut frame.words[pixel];
        *kept = keep(*kept, fragment);
    });
}

/// How often exact depth ties decide a frame (facts E0 asks for the count of each scene).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Ties {
    /// Pixels whose least depth is reached by two or more polygons.
    pub pixels: u64,
    /// The pixels among them where the tied polygons differ in colour, so that a rule is needed: least word, or first
    /// submitted.
    pub decided_by_colour: u64,
    /// Pixels that some polygon covers.
    pub covered: u64,
}

/// Counts the exact depth ties of a frame.
pub fn ties<E: AsRef<[Edge]>>(size: Size, packets: &[Packet<E>]) -> Ties {
    #[derive(Clone, Copy)]
    struct Front {
        depth: u32,
        rgb: [u8; 3],
        tied: bool,
        coloured: bool,
    }
    let mut front: Vec<Option<Front>> = vec![None; size.pixels()];
    let mut see = |pixel: usize, fragment: u64| {
        let (depth, rgb) = (depth_of(fragment), rgb_of(fragment));
        match &mut front[pixel] {
            Some(kept) if kept.depth < depth => {}
            Some(kept) if kept.depth == depth => {
                kept.tied = true;
                kept.coloured |= kept.rgb != rgb;
            }
            nearer => {
                *nearer = Some(Front { depth, rgb, tied: false, coloured: false });
            }
        }
    };
    packets.iter().for_each(|packet| each_fragment(size, packet, &mut see));
    let mut ties = Ties::default();
    for kept in front.into_iter().flatten() {
        ties.covered += 1;
        ties.pixels += u64::from(kept.tied);
        ties.decided_by_colour += u64::from(kept.coloured);
    }
    ties
}

/// The pixels that polygons cover, counted once for each polygon: what a machine without hidden-surface removal draws.
///
/// ```
/// use tilewright_scenes::{ScreenVertex, Size, golden, set_up};
///
/// let (size, at) = (Size::new(8, 8)?, |x: i32, y: i32| ScreenVertex { x: 16 * x, y: 16 * y, z: 1, rgb: [0; 3] });
/// let half = set_up(&[at(0, 0), at(4, 0), at(0, 4)], size).expect("it covers pixels");
/// // Centres on the long side belong to the triangle below it.
/// assert_eq!(golden::fragments(size, &[half.clone(), half]), 2 * (3 + 2 + 1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn fragments<E: AsRef<[Edge]>>(size: Size, packets: &[Packet<E>]) -> u64 {
    let mut count = 0;
    packets.iter().for_each(|packet| each_fragment(size, packet, |_, _| count += 1));
    count
}

/// Calls `visit` with each pixel of a box that a polygon or a sphere covers, by its number in raster order, and with
/// its word there. Spheres are numbered after the polygons.
///
/// ```
/// use tilewright_scenes::{PixelBox, Scene, Size, golden, project_polygons};
///
/// let polygons = project_polygons(&Scene::builtin("star").expect("a built-in scene"), Size::new(16, 12)?)?;
/// let (mut count, all) = (0, PixelBox { left: 0, top: 0, right: 15, bottom: 11 });
/// (0..polygons.polygons.len()).for_each(|number| golden::visit_fragments(&polygons, number, &all, |_, _| count += 1));
/// assert_eq!(count, golden::fragments_of(&polygons));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Panics
/// If `number` is out of range.
pub fn visit_fragments(polygons: &Polygons, number: usize, within: &PixelBox, mut visit: impl FnMut(u32, u64)) {
    let Polygons { size, polygons, spheres, .. } = polygons;
    match polygons.get(number) {
        Some(polygon) => each_within(*size, within, polygon, &mut visit),
        None => each_within(*size, within, &spheres[number - polygons.len()], &mut visit),
    }
}

fn each_within(size: Size, within: &PixelBox, primitive: &impl Primitive, mut visit: impl FnMut(u32, u64)) {
    let bounds = primitive.bounds();
    for y in bounds.top.max(within.top)..=bounds.bottom.min(within.bottom) {
        for x in bounds.left.max(within.left)..=bounds.right.min(within.right) {
            if primitive.covers(x, y) {
                visit(y * size.width() + x, primitive.word(x, y));
            }
        }
    }
}

/// Calls `visit(pixel index, word)` for every pixel that the primitive covers.
fn each_fragment(size: Size, packet: &impl Primitive, mut visit: impl FnMut(usize, u64)) {
    let bounds = packet.bounds();
    // A packet set up for a larger screen is cut to this one.
    for y in bounds.top..=bounds.bottom.min(size.height() - 1) {
        for x in bounds.left..=bounds.right.min(size.width() - 1) {
            if packet.covers(x, y) {
                visit(y as usize * size.width() as usize + x as usize, packet.word(x, y));
            }
        }
    }
}
