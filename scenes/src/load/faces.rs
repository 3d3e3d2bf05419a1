//! Cuts a face with any number of corners into triangles.
//!
//! A fan from the first corner serves if it covers the face once: for every convex face, and for some others. Otherwise
//! `earcut` cuts the face; it leaves out corners that are collinear or repeated.

use earcut::Earcut;
use glam::DVec3;

/// A face in triangles.
pub(super) struct Cut {
    /// Corners of the face, by index; the triangles run in the face's direction.
    pub(super) triangles: Vec<[usize; 3]>,
    /// Whether they are a fan from its first corner.
    pub(super) is_fan: bool,
    /// Whether the outline crosses itself, so that the triangles cover it only roughly.
    pub(super) crosses: bool,
}

/// Doubled areas below this fraction of a face's squared width are rounding noise.
const NOISE: f64 = 1e-12;

/// Cuts a face of at least three corners.
pub(super) fn cut(corners: &[DVec3]) -> Cut {
    let fan = (2..corners.len()).map(|i| [0, i - 1, i]);
    let areas: Vec<DVec3> = fan.clone().map(|triangle| doubled_area(triangle.map(|i| corners[i]))).collect();
    // The sum of a fan's areas is that of the outline, wherever the fan begins and whatever it covers.
    let normal: DVec3 = areas.iter().sum();
    let width = corners.iter().map(|&p| p.distance_squared(corners[0])).fold(0.0, f64::max);
    let noise = NOISE * width;
    let direction = normal / normal.length();
    let is_flat = normal.length() <= noise;
    if corners.len() == 3 || !is_flat && areas.iter().all(|area| area.dot(direction) >= -noise) {
        return Cut { triangles: fan.collect(), is_fan: true, crosses: false };
    }
    if is_flat {
        // All corners are collinear, or the halves of a bow tie cancel each other.
        return Cut { triangles: fan.collect(), is_fan: true, crosses: areas.iter().any(|area| area.length() > noise) };
    }
    let mut indices: Vec<usize> = Vec::new();
    Earcut::new().earcut(corners.iter().map(|&p| seen_along(direction, p)), &[], &mut indices);
    let triangles: Vec<[usize; 3]> = indices.as_chunks::<3>().0.to_vec();
    let covered: f64 = triangles.iter().map(|t| doubled_area(t.map(|i| corners[i])).dot(direction).abs()).sum();
    Cut { triangles, is_fan: false, crosses: (covered - normal.length()).abs() > 1e-6 * normal.length() }
}

/// The cross product of two sides: as long as twice the area, along the normal.
fn doubled_area([p, q, r]: [DVec3; 3]) -> DVec3 {
    (q - p).cross(r - p)
}

/// A point without its dominant coordinate along the direction; counter-clockwise round the direction stays
/// counter-clockwise here.
fn seen_along(direction: DVec3, p: DVec3) -> [f64; 2] {
    let size = direction.abs();
    let (axis, [x, y]) = if size.z >= size.x && size.z >= size.y {
        (direction.z, [p.x, p.y])
    } else if size.y >= size.x {
        (direction.y, [p.z, p.x])
    } else {
        (direction.x, [p.y, p.z])
    };
    if axis < 0.0 { [y, x] } else { [x, y] }
}
