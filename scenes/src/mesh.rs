//! Triangle meshes: positions, normals and a diffuse colour per triangle.
//!
//! Numbers are f64 (glam's `DVec3`): its operations here are + - * / and square root alone, which IEEE 754 fixes to the last
//! bit, and 53 bits leave the snapping to 1/16 pixel and the 24-bit depth far from rounding noise.

use crate::checksum::Fnv;
use crate::error::SceneError;
use glam::DVec3;

/// A triangle of a mesh, as indices into its positions and normals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshTriangle {
    /// Three indices into the positions. Counter-clockwise seen from the side that the normals point to.
    pub positions: [u32; 3],
    /// Three indices into the normals, one per corner.
    pub normals: [u32; 3],
    /// Diffuse red, green and blue, each 0 to 1.
    pub diffuse: [f64; 3],
}

/// A mesh whose indices and numbers have been checked. Triangles keep their order: it is the order of submission.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    positions: Vec<DVec3>,
    normals: Vec<DVec3>,
    triangles: Vec<MeshTriangle>,
}

/// The corner positions nearest to the origin and farthest from it, axis by axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingBox {
    /// Least x, y and z.
    pub min: DVec3,
    /// Greatest x, y and z.
    pub max: DVec3,
}

impl Mesh {
    /// A mesh from its parts; positions in any unit of length, normals of any length but finite.
    ///
    /// # Errors
    /// [`SceneError::Invalid`] if there is no triangle, an index is out of range, or a number is not finite or a colour is
    /// outside 0 to 1.
    pub fn new(positions: Vec<DVec3>, normals: Vec<DVec3>, triangles: Vec<MeshTriangle>) -> Result<Mesh, SceneError> {
        if triangles.is_empty() {
            return Err(SceneError::invalid("the mesh has no triangle", "give at least one"));
        }
        let vectors = [("position", &positions), ("normal", &normals)];
        for (what, list) in vectors {
            if let Some(i) = list.iter().position(|&v| !representable(v)) {
                return Err(SceneError::invalid(
                    format!("{what} {i} of the mesh is {}", list[i]),
                    "give finite numbers below 1e100",
                ));
            }
        }
        for (i, t) in triangles.iter().enumerate() {
            let in_range = |indices: [u32; 3], count: usize| indices.iter().all(|&index| (index as usize) < count);
            if !in_range(t.positions, positions.len()) || !in_range(t.normals, normals.len()) {
                return Err(SceneError::invalid(
                    format!("triangle {i} of the mesh names a vertex or normal that does not exist"),
                    format!("use indices below {} and {}", positions.len(), normals.len()),
                ));
            }
            if !t.diffuse.iter().all(|c| (0.0..=1.0).contains(c)) {
                return Err(SceneError::invalid(
                    format!("triangle {i} of the mesh has the colour {:?}", t.diffuse),
                    "give three numbers from 0 to 1",
                ));
            }
        }
        Ok(Mesh { positions, normals, triangles })
    }

    /// Vertex positions.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Normals, of any length.
    pub fn normals(&self) -> &[DVec3] {
        &self.normals
    }

    /// Triangles in order of submission; at least one.
    pub fn triangles(&self) -> &[MeshTriangle] {
        &self.triangles
    }

    /// The box round the vertices that triangles use.
    pub fn bounding_box(&self) -> BoundingBox {
        let corners = self.triangles.iter().flat_map(|t| t.positions);
        let empty = BoundingBox { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };
        corners.fold(empty, |bounds, corner| {
            let p = self.positions[corner as usize];
            BoundingBox { min: bounds.min.min(p), max: bounds.max.max(p) }
        })
    }

    /// A 64-bit checksum (FNV-1a) of every number, to pin a mesh in a test.
    pub fn checksum(&self) -> u64 {
        let mut sum = Fnv::new();
        for list in [&self.positions, &self.normals] {
            sum.add(list.len() as u64);
            for v in list {
                v.to_array().iter().for_each(|c| sum.add(c.to_bits()));
            }
        }
        for t in &self.triangles {
            let indices = t.positions.iter().chain(&t.normals);
            indices.for_each(|&index| sum.add(index.into()));
            t.diffuse.iter().for_each(|c| sum.add(c.to_bits()));
        }
        sum.value()
    }
}

/// One normal per position: the sum of the adjacent triangles' normals, weighted by area. A position without a proper triangle
/// gets the z axis.
pub fn smooth_normals(positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; positions.len()];
    for corners in triangles {
        let [p, q, r] = corners.map(|i| positions[i as usize]);
        let twice_area = (q - p).cross(r - p);
        for &i in corners {
            sums[i as usize] += twice_area;
        }
    }
    sums.into_iter().map(unit_or_z).collect()
}

/// Whether every number is finite and below 1e100, so that products of a few of them stay in the range of f64.
pub(crate) fn representable(v: DVec3) -> bool {
    v.to_array().iter().all(|c| c.abs() < 1e100)
}

/// `v` at length 1, or the z axis if it has no direction.
pub(crate) fn unit_or_z(v: DVec3) -> DVec3 {
    // Scaled first, so that squares neither vanish nor overflow.
    let largest = v.abs().max_element();
    if largest > 0.0 && largest.is_finite() {
        let scaled = v / largest;
        scaled / scaled.dot(scaled).sqrt()
    } else {
        DVec3::Z
    }
}
