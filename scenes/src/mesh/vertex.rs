//! Vertices as a front end shares them between polygons.

use super::Mesh;

/// A vertex of a mesh. Polygons share it where they have the same position and the same normal; it is transformed and
/// lit once.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MeshVertex {
    /// An index into the positions.
    pub position: u32,
    /// An index into the normals; none at the end of a line.
    pub normal: Option<u32>,
}

impl Mesh {
    /// The vertices of each triangle, and then of each line; a line's second end comes twice.
    ///
    /// ```
    /// use tilewright_scenes::builtin::terrain;
    ///
    /// // The two halves of a square have two vertices in common.
    /// let polygons = terrain::mesh(4).vertices_of_polygons();
    /// assert_eq!([polygons[0][0], polygons[0][2]], [polygons[1][0], polygons[1][1]]);
    /// ```
    pub fn vertices_of_polygons(&self) -> Vec<[MeshVertex; 3]> {
        let corner = |position, normal| MeshVertex { position, normal };
        let triangles = self.triangles.iter().map(|it| [0, 1, 2].map(|i| corner(it.positions[i], Some(it.normals[i]))));
        let lines = self.lines.iter().map(|it| [0, 1, 1].map(|i| corner(it.positions[i], None)));
        triangles.chain(lines).collect()
    }
}

#[cfg(test)]
mod tests {
    use crate::{Mesh, MeshLine, MeshTriangle};
    use glam::{DVec3, dvec3};
    use std::collections::BTreeSet;

    #[test]
    fn a_corner_with_another_normal_is_another_vertex() {
        let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y, dvec3(1.0, 1.0, 0.0)];
        let triangle = |positions, normals| MeshTriangle { positions, normals, diffuse: [0.5; 3] };
        let halves = vec![triangle([0, 1, 2], [0, 0, 0]), triangle([2, 1, 3], [0, 1, 1])];
        let line = MeshLine { positions: [3, 0], colour: [1.0; 3] };
        let mesh = Mesh::new(positions, vec![DVec3::Z, DVec3::X], halves).unwrap().with_lines(vec![line]).unwrap();
        let polygons = mesh.vertices_of_polygons();
        let distinct = |of: &[[super::MeshVertex; 3]]| of.as_flattened().iter().collect::<BTreeSet<_>>().len();
        assert_eq!((distinct(&polygons[..2]), distinct(&polygons[2..])), (5, 2));
    }
}
