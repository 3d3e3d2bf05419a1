//! Polygon set-up in integers: converts three or more screen vertices to packets of 3 to 8 edges.
//!
//! Source: facts E0 and A3 (MPG-RP: convex polygons as edge equations, and linear functions for their attributes). A
//! convex polygon whose vertices lie in one plane is one packet; any other is a fan of triangles.

use crate::packet::*;
use crate::setup::{bounds_of_any_size, edge, pixel_bounds, planes, signed_area2, triangle};
use crate::size::Size;

/// Sets up a polygon for a screen of `size` pixels: as one packet if possible, as none if there is nothing to draw.
///
/// Vertices are as [`set_up`](crate::set_up) takes them, in either direction round the polygon. A vertex may be
/// collinear with its neighbours, or repeat one. A polygon of three gives the same packet as `set_up`. With more:
///
/// - The packet has the planes of depth and colour through the first proper triangle of its fan (0, 1, 2), (0, 2, 3)
///   and so on.
/// - The polygon is cut into that fan in three cases: it is not convex; another vertex is more than one unit off one of
///   these planes; or a plane has a value that no vertex could have.
/// - If it has more than [`MOST_EDGES`] edges, it is cut into packets with that many, which share vertex 0.
///
/// Packets of one polygon share no pixel, unless its fan folds over itself.
///
/// ```
/// use tilewright_scenes::{ScreenVertex, Size, set_up_polygon};
///
/// let size = Size::new(64, 64).unwrap();
/// let at = |x: i32, y: i32, z| ScreenVertex { x: 16 * x, y: 16 * y, z, rgb: [90; 3] };
/// // A square in one plane, and one of which a corner is bent out of it.
/// let flat = set_up_polygon(&[at(0, 0, 100), at(8, 0, 200), at(8, 8, 400), at(0, 8, 300)], size);
/// assert_eq!(flat.iter().map(|packet| packet.edges.len()).collect::<Vec<_>>(), [4]);
/// let bent = set_up_polygon(&[at(0, 0, 100), at(8, 0, 200), at(8, 8, 400), at(0, 8, 302)], size);
/// assert_eq!(bent.iter().map(|packet| packet.edges.len()).collect::<Vec<_>>(), [3, 3]);
/// ```
pub fn set_up_polygon(vertices: &[ScreenVertex], size: Size) -> Vec<Polygon> {
    set_up_parts(vertices, size).into_iter().map(|(_, packet)| packet).collect()
}

/// As [`set_up_polygon`], each packet with the vertices that it was set up from.
pub(crate) fn set_up_parts(vertices: &[ScreenVertex], size: Size) -> Vec<(Vec<ScreenVertex>, Polygon)> {
    packets(vertices, |part| pixel_bounds(part, size))
}

/// As [`set_up_polygon`], but includes a polygon that is too small or too thin to enclose a pixel centre: its bounds
/// are then empty ([`PixelBox::is_empty`]). Nothing of it is drawn, but a machine spends time looking for its pixels.
///
/// Excluded are a polygon without area, and one before the screen's first centre along an axis, or behind its last.
///
/// ```
/// use tilewright_scenes::{ScreenVertex, Size, set_up_polygon, set_up_polygon_of_any_size};
///
/// let size = Size::new(64, 64).unwrap();
/// // Between the centres of columns 2 and 3, which are at 40 and 56 sixteenths.
/// let thin = [(41, 0), (55, 0), (55, 100), (41, 100)].map(|(x, y)| ScreenVertex { x, y, z: 1, rgb: [0; 3] });
/// assert!(set_up_polygon(&thin, size).is_empty());
/// let packets = set_up_polygon_of_any_size(&thin, size);
/// let bounds = packets[0].bounds;
/// assert_eq!((bounds.left, bounds.right, bounds.top, bounds.bottom), (3, 2, 0, 5));
/// ```
pub fn set_up_polygon_of_any_size(vertices: &[ScreenVertex], size: Size) -> Vec<Polygon> {
    packets(vertices, |part| bounds_of_any_size(part, size)).into_iter().map(|(_, packet)| packet).collect()
}

/// The packets of those parts of a polygon that have bounds, each with the vertices of its part.
fn packets(
    vertices: &[ScreenVertex],
    bounds: impl Fn(&[ScreenVertex]) -> Option<PixelBox>,
) -> Vec<(Vec<ScreenVertex>, Polygon)> {
    let round = positive(vertices);
    match flat(&round).filter(|_| vertices.len() > 3 && is_convex(&round)) {
        None => {
            let packet = |part: &[ScreenVertex; 3]| triangle(part, bounds(part)?).map(Polygon::from);
            fan(vertices).filter_map(|part| Some((part.to_vec(), packet(&part)?))).collect()
        }
        Some((corners, proper)) => {
            let planes = planes(corners, proper);
            let packet = |part: &[ScreenVertex]| packet(part, planes, bounds(part)?);
            parts(&round).filter_map(|part| packet(&part).map(|packet| (part, packet))).collect()
        }
    }
}

/// The vertices from the same first one, in the direction that makes the area positive.
fn positive(vertices: &[ScreenVertex]) -> Vec<ScreenVertex> {
    let mut round = vertices.to_vec();
    if fan(vertices).map(|triangle| signed_area2(&triangle)).sum::<i64>() < 0 {
        round[1..].reverse();
    }
    round
}

/// A convex polygon in parts of up to [`MOST_EDGES`] vertices.
fn parts(round: &[ScreenVertex]) -> impl Iterator<Item = Vec<ScreenVertex>> {
    (1..round.len() - 1).step_by(MOST_EDGES - 2).map(|first| {
        let last = (first + MOST_EDGES - 1).min(round.len());
        round[..1].iter().chain(&round[first..last]).copied().collect()
    })
}

/// The packet of a convex polygon in the direction of positive areas; `None` if it has no area.
fn packet(round: &[ScreenVertex], (z, rgb): (Plane, [Plane; 3]), bounds: PixelBox) -> Option<Polygon> {
    let area2 = fan(round).map(|triangle| signed_area2(&triangle)).sum();
    let edges = sides(round).map(|(p, q)| edge(p, q)).collect();
    (area2 > 0).then_some(Polygon { edges, z, rgb, bounds, area2, polygon: 0 })
}

/// The triangles (0, 1, 2), (0, 2, 3) and so on.
fn fan(vertices: &[ScreenVertex]) -> impl Iterator<Item = [ScreenVertex; 3]> {
    vertices.windows(2).skip(1).map(|pair| [vertices[0], pair[0], pair[1]])
}

/// The sides of nonzero length.
fn sides(round: &[ScreenVertex]) -> impl Iterator<Item = (ScreenVertex, ScreenVertex)> {
    let next = round.iter().cycle().skip(1);
    round.iter().zip(next).map(|(&p, &q)| (p, q)).filter(|(p, q)| (p.x, p.y) != (q.x, q.y))
}

/// Whether no vertex is outside a side.
fn is_convex(round: &[ScreenVertex]) -> bool {
    sides(round).all(|(p, q)| round.iter().all(|&v| signed_area2(&[p, q, v]) >= 0))
}

/// The first proper triangle and its doubled area. Its planes must have, at each vertex, values that a vertex may have
/// and that differ from the vertex's own by at most one unit.
fn flat(round: &[ScreenVertex]) -> Option<([ScreenVertex; 3], i64)> {
    let with_area = fan(round).map(|triangle| (triangle, signed_area2(&triangle)));
    let (corners, area2) = with_area.into_iter().find(|(_, area2)| *area2 > 0)?;
    let is_near = |v: &ScreenVertex| {
        let weights = weights(&corners, v);
        // Times the area, so that they are exact; below 2^60.
        let is_near = |of: fn(&ScreenVertex, usize) -> i64, i: usize, least: i64, greatest: i64| {
            let exact: i64 = weights.iter().zip(&corners).map(|(weight, corner)| weight * of(corner, i)).sum();
            (exact - of(v, i) * area2).abs() <= area2 && (least * area2..=greatest * area2).contains(&exact)
        };
        is_near(|v, _| v.z.into(), 0, NEAREST_VERTEX.into(), FARTHEST_VERTEX.into())
            && (0..3).all(|i| is_near(|v, i| v.rgb[i].into(), i, 0, 255))
    };
    round.iter().all(is_near).then_some((corners, area2))
}

/// The weight of each corner in a plane's value at a point, in parts of the doubled area.
fn weights([a, b, c]: &[ScreenVertex; 3], v: &ScreenVertex) -> [i64; 3] {
    [[v, b, c], [a, v, c], [a, b, v]].map(|triangle| signed_area2(&triangle.map(|corner| *corner)))
}
