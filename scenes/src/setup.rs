//! Triangle set-up in integers: converts three screen vertices to a packet.
//!
//! Source: facts E0; DES-EDGE (reduced edge test), DES-Z (depth plane), DES-W (widths). The golden rasterizer and every
//! machine share this set-up; a hardware set-up unit must match it bit for bit. Divisions round down (towards minus
//! infinity).

use crate::packet::*;
use crate::size::Size;

/// Sets up a triangle for a screen of `size` pixels.
///
/// `None` if there is nothing to draw: zero area, or no pixel centre of the screen between the vertices, either along x or
/// along y. A packet may still cover no pixel (a sliver between centres).
///
/// Vertices are in 1/16 pixel and must lie in the guard band (16 bits signed) with depths between [`NEAREST_VERTEX`]
/// and [`FARTHEST_VERTEX`]; [`crate::project`] ensures both.
pub fn set_up(vertices: &[ScreenVertex; 3], size: Size) -> Option<Triangle> {
    triangle(vertices, pixel_bounds(vertices, size)?)
}

/// The packet of a triangle within `bounds`; `None` if it has no area.
pub(crate) fn triangle(vertices: &[ScreenVertex; 3], bounds: PixelBox) -> Option<Triangle> {
    let [v0, mut v1, mut v2] = *vertices;
    let mut area2 = signed_area2(vertices);
    if area2 == 0 {
        return None;
    }
    if area2 < 0 {
        (v1, v2, area2) = (v2, v1, -area2);
    }
    let edges = [edge(v0, v1), edge(v1, v2), edge(v2, v0)];
    let (z, rgb) = planes([v0, v1, v2], area2);
    Some(Triangle { edges, z, rgb, bounds, area2, polygon: 0 })
}

/// Twice the area in 1/256 square pixel; positive if the vertices run clockwise as seen (y points down), 0 if degenerate.
pub fn signed_area2(v: &[ScreenVertex; 3]) -> i64 {
    let d = |p: i32, q: i32| i64::from(p) - i64::from(q);
    d(v[1].x, v[0].x) * d(v[2].y, v[0].y) - d(v[2].x, v[0].x) * d(v[1].y, v[0].y)
}

/// The pixels of the screen whose centres lie between the vertices along both axes, or `None` if there are none.
pub fn pixel_bounds(v: &[ScreenVertex], size: Size) -> Option<PixelBox> {
    bounds_of_any_size(v, size).filter(|bounds| !bounds.is_empty())
}

/// As [`pixel_bounds`], but empty along an axis where the vertices lie between two neighbouring centres of the screen. `None` if they
/// lie before its first centre or behind its last.
pub(crate) fn bounds_of_any_size(v: &[ScreenVertex], size: Size) -> Option<PixelBox> {
    let (left, right) = centres_between(v.iter().map(|v| v.x), size.width())?;
    let (top, bottom) = centres_between(v.iter().map(|v| v.y), size.height())?;
    Some(PixelBox { left, top, right, bottom })
}

/// The first and last pixel of a row of `side` pixels whose centres (16*i + 8) lie between the least and the greatest
/// position. If there is none, the first is the last plus 1.
fn centres_between(positions: impl Iterator<Item = i32> + Clone, side: u32) -> Option<(u32, u32)> {
    let (least, greatest) = (positions.clone().min()?, positions.max()?);
    let half = i64::from(SUBPIXELS / 2);
    let sub = i64::from(SUBPIXELS);
    let first = (i64::from(least) - half + sub - 1).div_euclid(sub).max(0);
    let last = (i64::from(greatest) - half).div_euclid(sub).min(i64::from(side) - 1);
    (first < i64::from(side) && last >= 0).then_some((first as u32, last as u32))
}

/// The reduced edge function from `p` to `q` (DES-EDGE).
pub(crate) fn edge(p: ScreenVertex, q: ScreenVertex) -> Edge {
    let (dx, dy) = (i64::from(q.x) - i64::from(p.x), i64::from(q.y) - i64::from(p.y));
    let (a, b) = (-dy, dx);
    let c = -(a * i64::from(p.x) + b * i64::from(p.y));
    // An edge that is neither a left nor a top one excludes the centres on it: one unit less achieves that.
    let top_left = dy < 0 || (dy == 0 && dx > 0);
    let reduced = (8 * (a + b) + c - i64::from(!top_left)).div_euclid(i64::from(SUBPIXELS));
    // Vertices in the guard band keep |value| < 2^30 (DES-W), so nothing is lost here.
    Edge { a: a as i32, b: b as i32, c: reduced as i32 }
}

/// The planes of depth and of the three channels through a triangle's corners, whose doubled area is positive.
pub(crate) fn planes(corners: [ScreenVertex; 3], area2: i64) -> (Plane, [Plane; 3]) {
    let plane = Anchor { corners, area2 };
    let channel = |i: usize| plane.through(corners.map(|v| i64::from(v.rgb[i])), COLOUR_PLANE_BITS);
    let z = plane.through(corners.map(|v| i64::from(v.z)), DEPTH_PLANE_BITS);
    (z, [channel(0), channel(1), channel(2)])
}

/// The common values of one triangle's planes.
pub(crate) struct Anchor {
    /// In the sequence that makes the area positive.
    pub(crate) corners: [ScreenVertex; 3],
    /// Their doubled area.
    pub(crate) area2: i64,
}

impl Anchor {
    /// The modular plane through one value per corner, of `bits` bits (DES-Z); values are below 2^24 in magnitude.
    pub(crate) fn through(&self, value: [i64; 3], bits: u32) -> Plane {
        let [v0, v1, v2] = self.corners;
        let d = |p: i32, q: i32| i64::from(p) - i64::from(q);
        let (d1, d2) = (value[1] - value[0], value[2] - value[0]);
        // Gradient times area2, per 1/16 pixel. Below 2^42, so that the shifted products below stay under 2^63.
        let nx = d1 * d(v2.y, v0.y) - d2 * d(v1.y, v0.y);
        let ny = d2 * d(v1.x, v0.x) - d1 * d(v2.x, v0.x);
        let gradient = |n: i64| ((n * i64::from(SUBPIXELS)) << FRACTION_BITS).div_euclid(self.area2);
        let (x, y) = (gradient(nx), gradient(ny));
        // The anchor is the centre of v0's pixel: near v0, so that the rounding of the gradients has the least effect.
        let (px, py) = (i64::from(v0.x >> 4), i64::from(v0.y >> 4));
        let to_centre = nx * (16 * px + 8 - i64::from(v0.x)) + ny * (16 * py + 8 - i64::from(v0.y));
        let at_anchor = (value[0] << FRACTION_BITS)
            + (to_centre << FRACTION_BITS).div_euclid(self.area2)
            + (1 << (FRACTION_BITS - 1));
        let mask = (1u64 << bits) - 1;
        // Wrapping on purpose: a sliver's gradients may be huge, and only their residues are kept.
        let origin = at_anchor.wrapping_sub(x.wrapping_mul(px)).wrapping_sub(y.wrapping_mul(py));
        Plane { x: x as u64 & mask, y: y as u64 & mask, origin: origin as u64 & mask }
    }
}
