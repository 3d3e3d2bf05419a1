//! Line set-up: converts two ends to the packet of a quadrilateral.
//!
//! Source: facts E0, and PP5-HV, whose machine draws vectors as polygons. The minor axis is the one along which the
//! line is shorter. A line from P to Q is the quadrilateral of P and Q, each moved by half a pixel to both sides along
//! the minor axis:
//!
//! ```text
//!      P-______                 P- to P+ is one pixel high, so each column of centres between P and Q
//!      |       ------Q-         has one pixel: the one that the line runs through.
//!      P+______      |
//!              ------Q+
//! ```
//!
//! The fill rule is that of all polygons: the end with the lesser coordinate has its column, the other one has not. So
//! no pixel of a chain of lines in one direction is drawn twice, and a line of length zero has none. Depth and colour
//! change only along the major axis, since both corners of an end have the same. Set-up needs nothing new.

use crate::packet::{Polygon, SUBPIXELS, ScreenVertex};
use crate::polygon::set_up_polygon;
use crate::size::Size;

/// Half the width of a line along its minor axis, in 1/16 pixel.
const HALF_WIDTH: i32 = SUBPIXELS / 2;

/// Sets up a line for a screen of `size` pixels. The packet has four edges. It has one pixel in each column from one
/// end to the other, or in each row if the line is steeper than 45 degrees.
///
/// `None` if there is nothing to draw. The direction does not matter. Ends are as [`set_up`](crate::set_up) takes vertices.
///
/// ```
/// use tilewright_scenes::{ScreenVertex, Size, set_up_line};
///
/// let size = Size::new(8, 8).unwrap();
/// let at = |x: i32, y: i32, z| ScreenVertex { x: 16 * x + 8, y: 16 * y + 8, z, rgb: [255; 3] };
/// let line = set_up_line([at(1, 1, 100), at(5, 3, 180)], size).unwrap();
/// let pixels = (0..8).flat_map(|y| (0..8).map(move |x| (x, y))).filter(|&(x, y)| line.covers(x, y));
/// let pixels: Vec<_> = pixels.map(|(x, y)| (x, y, line.depth(x, y))).collect();
/// assert_eq!(pixels, [(1, 1, 100), (2, 2, 120), (3, 2, 140), (4, 3, 160)]);
/// ```
pub fn set_up_line(ends: [ScreenVertex; 2], size: Size) -> Option<Polygon> {
    // Convex and planar, so it is one packet.
    set_up_polygon(&line_corners(ends), size).pop()
}

/// The corners of a line's quadrilateral, starting at the end with the lesser coordinate; a line at 45 degrees counts
/// as flat. A corner may be half a pixel outside the guard band. Even so, the quadrilateral's edges have 17 bits,
/// because they are as long as the line or as it is wide. Those of its halves have 18 of the packet's 20.
///
/// ```
/// use tilewright_scenes::{ScreenVertex, line_corners};
///
/// let at = |x: i32, y: i32| ScreenVertex { x, y, z: 1, rgb: [0; 3] };
/// let places = |p, q| line_corners([p, q]).map(|corner| (corner.x, corner.y));
/// assert_eq!(places(at(90, 20), at(10, 30)), [(10, 22), (90, 12), (90, 28), (10, 38)]);
/// assert_eq!(places(at(20, 10), at(30, 90)), [(12, 10), (22, 90), (38, 90), (28, 10)]);
/// ```
pub fn line_corners([p, q]: [ScreenVertex; 2]) -> [ScreenVertex; 4] {
    let is_flat = p.x.abs_diff(q.x) >= p.y.abs_diff(q.y);
    let ends = |v: ScreenVertex| if is_flat { (v.x, v.y) } else { (v.y, v.x) };
    let (first, last) = if ends(p) <= ends(q) { (p, q) } else { (q, p) };
    let beside = |v: ScreenVertex, by: i32| match is_flat {
        true => ScreenVertex { y: v.y + by, ..v },
        false => ScreenVertex { x: v.x + by, ..v },
    };
    [beside(first, -HALF_WIDTH), beside(last, -HALF_WIDTH), beside(last, HALF_WIDTH), beside(first, HALF_WIDTH)]
}
