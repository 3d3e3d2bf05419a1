//! Meshes: positions, normals, triangles and lines, each with a colour.
//!
//! Numbers are f64 (glam's `DVec3`). The operations used are + - * / and square root, which IEEE 754 fixes to the last
//! bit. 53 bits keep the snapping to 1/16 pixel and the 24-bit depth far from rounding noise.

mod colours;
mod vertex;

use crate::checksum::Fnv;
use crate::error::SceneError;
use crate::material::Materials;
use glam::DVec3;
use std::sync::Arc;

pub use vertex::MeshVertex;

/// A triangle of a mesh, as indices into its positions and normals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshTriangle {
    /// Three indices into the positions. Counter-clockwise seen from the side that the normals point to.
    pub positions: [u32; 3],
    /// Three indices into the normals, one per corner.
    pub normals: [u32; 3],
    /// Diffuse red, green and blue, each 0 to 1; [`Mesh::with_corner_colours`] overrides it.
    pub diffuse: [f64; 3],
}

/// A line of a mesh, as indices into its positions. It is not lit, because it has no side that could face a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshLine {
    /// Where it begins and ends.
    pub positions: [u32; 2],
    /// Red, green and blue, each 0 to 1.
    pub colour: [f64; 3],
}

/// A mesh whose indices and numbers have been checked. The triangles come first, then the lines, each in the given
/// sequence: this is the sequence of submission.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    positions: Vec<DVec3>,
    normals: Vec<DVec3>,
    triangles: Vec<MeshTriangle>,
    lines: Vec<MeshLine>,
    /// The number of triangles in each face; empty if each triangle is a face of its own.
    faces: Vec<u32>,
    /// The diffuse colours of each triangle's corners; empty if each triangle has one colour.
    colours: Option<Arc<Vec<[[f64; 3]; 3]>>>,
    /// `None` if every triangle has the default material.
    materials: Option<Arc<Materials>>,
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
    /// A mesh from its parts; positions in any unit of length, normals of any finite length.
    ///
    /// # Errors
    /// [`SceneError::Invalid`] if there is no triangle, an index is out of range, or a number is not finite or a colour is
    /// outside 0 to 1.
    pub fn new(positions: Vec<DVec3>, normals: Vec<DVec3>, triangles: Vec<MeshTriangle>) -> Result<Mesh, SceneError> {
        if triangles.is_empty() {
            return Err(SceneError::invalid("the mesh has no triangle", "give at least one"));
        }
        check_vectors("position", &positions)?;
        check_vectors("normal", &normals)?;
        for (i, t) in triangles.iter().enumerate() {
            let in_range = |indices: [u32; 3], count: usize| indices.iter().all(|&index| (index as usize) < count);
            if !in_range(t.positions, positions.len()) || !in_range(t.normals, normals.len()) {
                return Err(SceneError::invalid(
                    format!("triangle {i} of the mesh names a vertex or normal that does not exist"),
                    format!("use indices below {} and {}", positions.len(), normals.len()),
                ));
            }
            check_colour("triangle", i, t.diffuse)?;
        }
        Ok(Mesh { normals, triangles, ..Mesh::empty(positions) })
    }

    /// A mesh of lines alone; positions in any unit of length.
    ///
    /// ```
    /// use glam::{DVec3, dvec3};
    /// use tilewright_scenes::{Mesh, MeshLine};
    ///
    /// let line = MeshLine { positions: [0, 1], colour: [1.0, 0.5, 0.0] };
    /// assert_eq!(Mesh::of_lines(vec![DVec3::ZERO, DVec3::X], vec![line])?.lines(), [line]);
    /// # Ok::<(), tilewright_scenes::SceneError>(())
    /// ```
    ///
    /// # Errors
    /// [`SceneError::Invalid`] if there is no line, or as [`Mesh::with_lines`].
    pub fn of_lines(positions: Vec<DVec3>, lines: Vec<MeshLine>) -> Result<Mesh, SceneError> {
        if lines.is_empty() {
            return Err(SceneError::invalid("the mesh has no line", "give at least one"));
        }
        check_vectors("position", &positions)?;
        Mesh::empty(positions).with_lines(lines)
    }

    /// A mesh without a triangle or a line, for a scene that has only spheres.
    ///
    /// ```
    /// assert!(tilewright_scenes::Mesh::none().positions().is_empty());
    /// ```
    pub fn none() -> Mesh {
        Mesh::empty(Vec::new())
    }

    /// The same mesh with these lines.
    ///
    /// ```
    /// use tilewright_scenes::{MeshLine, builtin::teapot};
    ///
    /// // Lines from one vertex of the teapot to the next.
    /// let line = |i| MeshLine { positions: [i, i + 1], colour: [1.0; 3] };
    /// let mesh = teapot::mesh(2).with_lines((0..20).map(line).collect())?;
    /// assert_eq!((mesh.triangles().len(), mesh.lines().len()), (256, 20));
    /// # Ok::<(), tilewright_scenes::SceneError>(())
    /// ```
    ///
    /// # Errors
    /// [`SceneError::Invalid`] if an index is out of range, or a colour is outside 0 to 1.
    pub fn with_lines(self, lines: Vec<MeshLine>) -> Result<Mesh, SceneError> {
        for (i, line) in lines.iter().enumerate() {
            let count = self.positions.len();
            if line.positions.iter().any(|&index| index as usize >= count) {
                return Err(SceneError::invalid(
                    format!("line {i} of the mesh names a vertex that does not exist"),
                    format!("use indices below {count}"),
                ));
            }
            check_colour("line", i, line.colour)?;
        }
        Ok(Mesh { lines, ..self })
    }

    /// The same mesh with its triangles grouped into faces of these sizes. A face is a fan: its triangles share their
    /// first corner, and each one's second corner is the previous one's third.
    ///
    /// # Errors
    /// [`SceneError::Invalid`] if the sizes do not add up to the number of triangles, or the groups are not fans.
    pub fn with_faces(self, faces: Vec<u32>) -> Result<Mesh, SceneError> {
        let mesh = Mesh { faces, ..self };
        let count = mesh.faces.iter().map(|&count| u64::from(count)).sum::<u64>();
        if count != mesh.triangles.len() as u64 || mesh.faces.contains(&0) {
            return Err(SceneError::invalid(
                format!("the faces of the mesh have {count} triangles, and there are {}", mesh.triangles.len()),
                "give each triangle to one face",
            ));
        }
        let corner = |t: &MeshTriangle, i: usize| (t.positions[i], t.normals[i]);
        let is_fan = |face: &[MeshTriangle]| {
            face.windows(2)
                .all(|pair| [(0, 0), (2, 1)].iter().all(|&(i, j)| corner(&pair[0], i) == corner(&pair[1], j)))
        };
        if let Some(face) = mesh.faces().position(|face| !is_fan(face)) {
            return Err(SceneError::invalid(
                format!("face {face} of the mesh is no fan of triangles"),
                "begin each of its triangles with the same corner, and go on from the last one's end",
            ));
        }
        Ok(mesh)
    }

    /// Its positions, with these lines and no triangle.
    pub(crate) fn with_lines_alone(&self, lines: Vec<MeshLine>) -> Mesh {
        Mesh { lines, ..Mesh::empty(self.positions.clone()) }
    }

    /// These positions alone.
    fn empty(positions: Vec<DVec3>) -> Mesh {
        let (normals, triangles, lines, faces) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Mesh { positions, normals, triangles, lines, faces, colours: None, materials: None }
    }

    /// The same mesh with these materials, which only deferred shading uses.
    ///
    /// # Errors
    /// [`SceneError::Invalid`] if they do not fit the triangles, or a value is out of range.
    pub fn with_materials(self, materials: Materials) -> Result<Mesh, SceneError> {
        materials.check(self.triangles.len())?;
        Ok(Mesh { materials: Some(Arc::new(materials)), ..self })
    }

    /// The materials of its triangles; `None` if all have the default one.
    pub fn materials(&self) -> Option<&Materials> {
        self.materials.as_deref()
    }

    /// Vertex positions.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Normals, of any length.
    pub fn normals(&self) -> &[DVec3] {
        &self.normals
    }

    /// Triangles in the sequence of submission; at least one, unless there are lines, or this is [`Mesh::none`].
    pub fn triangles(&self) -> &[MeshTriangle] {
        &self.triangles
    }

    /// Lines in the sequence of submission, after the triangles.
    pub fn lines(&self) -> &[MeshLine] {
        &self.lines
    }

    /// The triangles of each face, in the sequence of submission.
    pub fn faces(&self) -> impl Iterator<Item = &[MeshTriangle]> {
        let single = if self.faces.is_empty() { self.triangles.len() } else { 0 };
        let counts = self.faces.iter().copied().chain(std::iter::repeat_n(1, single));
        counts.scan(&self.triangles[..], |rest, count| {
            let (face, others) = rest.split_at(count as usize);
            *rest = others;
            Some(face)
        })
    }

    /// The box round the vertices that triangles and lines use.
    pub fn bounding_box(&self) -> BoundingBox {
        let ends = self.lines.iter().flat_map(|line| line.positions);
        let corners = self.triangles.iter().flat_map(|t| t.positions).chain(ends);
        let empty = BoundingBox { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };
        corners.fold(empty, |bounds, corner| {
            let p = self.positions[corner as usize];
            BoundingBox { min: bounds.min.min(p), max: bounds.max.max(p) }
        })
    }

    /// A 64-bit checksum (FNV-1a) of every number except those of materials, to pin a mesh in a test.
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
        let corners = self.colours.iter().flat_map(|colours| colours.as_flattened().as_flattened());
        corners.for_each(|c| sum.add(c.to_bits()));
        for line in &self.lines {
            line.positions.iter().for_each(|&index| sum.add(index.into()));
            line.colour.iter().for_each(|c| sum.add(c.to_bits()));
        }
        sum.value()
    }
}

fn check_vectors(what: &str, vectors: &[DVec3]) -> Result<(), SceneError> {
    match vectors.iter().position(|&v| !representable(v)) {
        None => Ok(()),
        Some(i) => Err(SceneError::invalid(
            format!("{what} {i} of the mesh is {}", vectors[i]),
            "give finite numbers below 1e100",
        )),
    }
}

fn check_colour(what: &str, i: usize, colour: [f64; 3]) -> Result<(), SceneError> {
    match colour.iter().all(|c| (0.0..=1.0).contains(c)) {
        true => Ok(()),
        false => Err(SceneError::invalid(
            format!("{what} {i} of the mesh has the colour {colour:?}"),
            "give three numbers from 0 to 1",
        )),
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

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    const CORNERS: [DVec3; 4] = [DVec3::ZERO, DVec3::X, DVec3::Y, dvec3(-3.0, 5.0, 0.5)];

    fn triangle(positions: [u32; 3]) -> MeshTriangle {
        MeshTriangle { positions, normals: [0; 3], diffuse: [0.0, 0.5, 1.0] }
    }

    #[test]
    fn a_mesh_that_makes_no_sense_is_refused() {
        let sound = triangle([0, 1, 2]);
        let refused = |positions: &[DVec3], normals: &[DVec3], triangles: &[MeshTriangle]| {
            let made = Mesh::new(positions.to_vec(), normals.to_vec(), triangles.to_vec());
            made.expect_err("the mesh is unsound").to_string()
        };
        let normals = [DVec3::Z];
        let far = [DVec3::ZERO, DVec3::X, dvec3(0.0, f64::INFINITY, 0.0)];
        let cases = [
            (refused(&CORNERS, &normals, &[]), "the mesh has no triangle: give at least one"),
            (
                refused(&far, &normals, &[sound]),
                "position 2 of the mesh is [0, inf, 0]: give finite numbers below 1e100",
            ),
            (
                refused(&CORNERS, &[DVec3::NAN], &[sound]),
                "normal 0 of the mesh is [NaN, NaN, NaN]: give finite numbers below 1e100",
            ),
            (
                refused(&CORNERS, &normals, &[sound, triangle([0, 4, 1])]),
                "triangle 1 of the mesh names a vertex or normal that does not exist: use indices below 4 and 1",
            ),
            (
                refused(&CORNERS, &normals, &[MeshTriangle { normals: [0, 0, 1], ..sound }]),
                "triangle 0 of the mesh names a vertex or normal that does not exist: use indices below 4 and 1",
            ),
            (
                refused(&CORNERS, &normals, &[MeshTriangle { diffuse: [0.0, 1.5, 0.0], ..sound }]),
                "triangle 0 of the mesh has the colour [0.0, 1.5, 0.0]: give three numbers from 0 to 1",
            ),
        ];
        for (sentence, expected) in cases {
            assert_eq!(sentence, expected);
        }
        let line = |positions, colour| vec![MeshLine { positions, colour }];
        let refused = |lines| Mesh::of_lines(CORNERS.to_vec(), lines).expect_err("the lines are unsound").to_string();
        assert_eq!(refused(Vec::new()), "the mesh has no line: give at least one");
        assert_eq!(
            refused(line([0, 4], [1.0; 3])),
            "line 0 of the mesh names a vertex that does not exist: use indices below 4"
        );
        assert_eq!(
            refused(line([0, 3], [-1.0; 3])),
            "line 0 of the mesh has the colour [-1.0, -1.0, -1.0]: give three numbers from 0 to 1"
        );
        assert!(Mesh::new(CORNERS.to_vec(), normals.to_vec(), vec![sound]).is_ok());
    }

    #[test]
    fn faces_are_fans_of_all_triangles() {
        let mesh = || {
            Mesh::new(CORNERS.to_vec(), vec![DVec3::Z], [[0, 1, 2], [0, 2, 3], [3, 2, 1]].map(triangle).to_vec())
                .unwrap()
        };
        let counts = |mesh: &Mesh| mesh.faces().map(<[MeshTriangle]>::len).collect::<Vec<_>>();
        assert_eq!(counts(&mesh()), [1, 1, 1]);
        assert_eq!(counts(&mesh().with_faces(vec![2, 1]).unwrap()), [2, 1]);
        let refused = |faces: &[u32]| mesh().with_faces(faces.to_vec()).expect_err("no fans").to_string();
        let uncounted = "the faces of the mesh have 4 triangles, and there are 3: give each triangle to one face";
        assert_eq!(refused(&[2, 2]), uncounted);
        assert_eq!(refused(&[2, 0, 1]), uncounted.replace('4', "3"));
        let no_fan = "face 1 of the mesh is no fan of triangles: begin each of its triangles with the same corner, and go on from \
                      the last one's end";
        assert_eq!(refused(&[1, 2]), no_fan);
    }

    #[test]
    fn the_box_is_round_what_triangles_and_lines_use() {
        let mesh = |triangles: &[[u32; 3]]| {
            Mesh::new(CORNERS.to_vec(), vec![DVec3::Z], triangles.iter().copied().map(triangle).collect())
        };
        let bounds = |triangles: &[[u32; 3]]| mesh(triangles).expect("a sound mesh").bounding_box();
        assert_eq!(bounds(&[[0, 1, 2]]), BoundingBox { min: DVec3::ZERO, max: dvec3(1.0, 1.0, 0.0) });
        let all = BoundingBox { min: dvec3(-3.0, 0.0, 0.0), max: dvec3(1.0, 5.0, 0.5) };
        assert_eq!(bounds(&[[0, 1, 2], [1, 2, 3]]), all);
        let line = MeshLine { positions: [3, 0], colour: [0.5; 3] };
        let lines = mesh(&[[0, 1, 2]]).and_then(|mesh| mesh.with_lines(vec![line])).expect("a sound mesh");
        assert_eq!(lines.bounding_box(), all);
    }

    #[test]
    fn normals_are_weighted_by_area_and_of_length_1() {
        // Twice 6 along x and twice 2.5 along y meet at the first corner.
        let positions =
            [DVec3::ZERO, dvec3(0.0, 3.0, 0.0), dvec3(0.0, 0.0, 4.0), dvec3(5.0, 0.0, 0.0), dvec3(0.0, 0.0, 1.0)];
        for place in [DVec3::ZERO, dvec3(7.0, -2.0, 4.0)] {
            let normals = smooth_normals(&positions.map(|p| p + place), &[[0, 1, 2], [0, 4, 3]]);
            assert!((normals[0] - dvec3(12.0, 5.0, 0.0) / 13.0).length() < 1e-15);
            assert_eq!([normals[1], normals[3]], [DVec3::X, DVec3::Y]);
        }
        // Too small to be squared, and without area.
        let tiny = positions.map(|p| p * 1e-100);
        assert_eq!(smooth_normals(&tiny, &[[0, 1, 2]])[..4], [DVec3::X, DVec3::X, DVec3::X, DVec3::Z]);
    }
}
