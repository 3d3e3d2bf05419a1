//! The star: vectors that point away from its middle in all directions, for machines that draw lines (PP5-HVB).

use crate::angle::sin_cos;
use crate::mesh::{Mesh, MeshLine};
use glam::{DVec3, dvec3};

/// Degrees between neighbouring vectors.
const STEP: u32 = 15;
/// The distances from the middle at which a vector begins and ends.
const REACH: [f64; 2] = [0.25, 1.0];

/// A vector for each 15 degrees of longitude and latitude, and one at each pole: 266 lines, coloured by their direction.
///
/// ```
/// assert_eq!(tilewright_scenes::builtin::star::mesh().lines().len(), 266);
/// ```
pub fn mesh() -> Mesh {
    let mut positions = Vec::new();
    let mut lines = Vec::new();
    for direction in directions() {
        let first = positions.len() as u32;
        positions.extend(REACH.map(|distance| direction * distance));
        let colour = direction.to_array().map(|part| 0.65 + 0.35 * part.clamp(-1.0, 1.0));
        lines.push(MeshLine { positions: [first, first + 1], colour });
    }
    Mesh::of_lines(positions, lines).expect("the built-in data is sound")
}

fn directions() -> impl Iterator<Item = DVec3> {
    let ring = |latitude: i32| {
        let (z, radius) = sin_cos(f64::from(latitude));
        (0..360).step_by(STEP as usize).map(move |longitude| {
            let (y, x) = sin_cos(f64::from(longitude));
            dvec3(radius * x, radius * y, z)
        })
    };
    let rings = (-75..=75).step_by(STEP as usize).flat_map(ring);
    [DVec3::NEG_Z].into_iter().chain(rings).chain([DVec3::Z])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_point_in_all_directions() {
        let mesh = mesh();
        assert_eq!(mesh.lines().len(), 2 + 11 * 24);
        for line in mesh.lines() {
            let [from, to] = line.positions.map(|i| mesh.positions()[i as usize]);
            assert!((from.length() - 0.25).abs() < 1e-12 && (to.length() - 1.0).abs() < 1e-12);
            assert!((from.normalize() - to.normalize()).length() < 1e-12);
        }
        // Opposite directions cancel each other.
        let sum: DVec3 = mesh.lines().iter().map(|line| mesh.positions()[line.positions[1] as usize]).sum();
        assert!(sum.length() < 1e-10, "{sum}");
    }
}
