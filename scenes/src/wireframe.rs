//! Wireframes: the sides of a mesh's faces as lines, each once.
//!
//! Two faces share a side if its ends are at the same positions. Their indices may differ: parts of a mesh, such as the
//! patches of the teapot, may have vertices of their own. If two faces have different colours, the first one gives the
//! side its colour.

use crate::mesh::{Mesh, MeshLine};
use glam::DVec3;
use std::collections::BTreeSet;

/// The sides of faces, taken one after another.
#[derive(Default)]
pub(crate) struct Sides {
    seen: BTreeSet<[[u64; 3]; 2]>,
    pub(crate) lines: Vec<MeshLine>,
}

impl Sides {
    /// Adds the sides of the face with these corners, by index; a side of length zero is none.
    pub(crate) fn take(&mut self, positions: &[DVec3], corners: &[u32], colour: [f64; 3]) {
        for (&from, &to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let mut ends = [from, to].map(|index| place(positions[index as usize]));
            ends.sort_unstable();
            if ends[0] != ends[1] && self.seen.insert(ends) {
                self.lines.push(MeshLine { positions: [from, to], colour });
            }
        }
    }
}

/// A position as a key: adding zero turns -0 into 0, which is the same place.
pub(crate) fn place(position: DVec3) -> [u64; 3] {
    (position + DVec3::ZERO).to_array().map(f64::to_bits)
}

impl Mesh {
    /// The sides of the faces as lines, each once, and the existing lines; the triangles are removed.
    ///
    /// ```
    /// use tilewright_scenes::builtin::teapot;
    ///
    /// // 512 faces of four sides, which nearly all of them share with others.
    /// let wireframe = teapot::faces(4).wireframe();
    /// assert_eq!((wireframe.triangles().len(), wireframe.lines().len()), (0, 1040));
    /// ```
    pub fn wireframe(&self) -> Mesh {
        let mut sides = Sides::default();
        for face in self.faces() {
            let ends = face.iter().skip(1).map(|triangle| triangle.positions[2]);
            let corners: Vec<u32> = face[0].positions.into_iter().chain(ends).collect();
            sides.take(self.positions(), &corners, face[0].diffuse);
        }
        self.with_lines_alone(sides.lines.into_iter().chain(self.lines().iter().copied()).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshTriangle;
    use glam::dvec3;

    const RED: [f64; 3] = [1.0, 0.0, 0.0];
    const BLUE: [f64; 3] = [0.0, 0.0, 1.0];

    /// A square of two triangles, which is one face, and a triangle with vertices of its own at two of its corners.
    #[test]
    fn a_side_is_drawn_once_and_a_diagonal_not_at_all() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let roof = [[1.0, 1.0], [-0.0, 1.0], [0.5, 2.0]];
        let positions = square.iter().chain(&roof).map(|&[x, y]| dvec3(x, y, 0.0)).collect();
        let triangle = |positions, diffuse| MeshTriangle { positions, normals: [0; 3], diffuse };
        let triangles = vec![triangle([0, 1, 2], RED), triangle([0, 2, 3], RED), triangle([4, 5, 6], BLUE)];
        let mesh = Mesh::new(positions, vec![DVec3::Z], triangles).and_then(|mesh| mesh.with_faces(vec![2, 1]));
        let line = |positions, colour| MeshLine { positions, colour };
        let own = line([0, 6], BLUE);
        let mesh = mesh.and_then(|mesh| mesh.with_lines(vec![own])).expect("a sound mesh");
        let (wireframe, sides) = (mesh.wireframe(), [[0, 1], [1, 2], [2, 3], [3, 0]].map(|side| line(side, RED)));
        assert_eq!(wireframe.lines(), [&sides[..], &[line([5, 6], BLUE), line([6, 4], BLUE), own]].concat());
        assert_eq!(wireframe.triangles(), []);
        assert_eq!(wireframe.positions(), mesh.positions());
    }
}
