//! Simple bodies, from which built-in scenes are assembled.

use crate::angle::sin_cos;
use crate::mesh::{Mesh, MeshTriangle, smooth_normals, unit_or_z};
use glam::{DVec3, dvec3};

/// A body in space; a normal for each position, and triangles counter-clockwise seen from outside.
#[derive(Clone, Default)]
pub(super) struct Shape {
    positions: Vec<DVec3>,
    normals: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

impl Shape {
    /// Two triangles; the corners counter-clockwise seen from outside.
    pub fn rectangle(corners: [DVec3; 4]) -> Shape {
        let normal = unit_or_z((corners[1] - corners[0]).cross(corners[2] - corners[0]));
        Shape { positions: corners.to_vec(), normals: vec![normal; 4], triangles: vec![[0, 1, 2], [0, 2, 3]] }
    }

    /// Twelve triangles between two opposite corners.
    pub fn cuboid(min: DVec3, max: DVec3) -> Shape {
        let corner = |x: bool, y: bool, z: bool| {
            let pick = |of: fn(DVec3) -> f64, upper: bool| if upper { of(max) } else { of(min) };
            dvec3(pick(|v| v.x, x), pick(|v| v.y, y), pick(|v| v.z, z))
        };
        let (o, i) = (false, true);
        let faces = [
            [(o, o, i), (i, o, i), (i, i, i), (o, i, i)],
            [(o, o, o), (o, i, o), (i, i, o), (i, o, o)],
            [(o, o, o), (i, o, o), (i, o, i), (o, o, i)],
            [(i, i, o), (o, i, o), (o, i, i), (i, i, i)],
            [(i, o, o), (i, i, o), (i, i, i), (i, o, i)],
            [(o, i, o), (o, o, o), (o, o, i), (o, i, i)],
        ];
        let mut cuboid = Shape::default();
        faces.iter().for_each(|face| cuboid.join(&Shape::rectangle(face.map(|(x, y, z)| corner(x, y, z)))));
        cuboid
    }

    /// The solid of revolution of a line of (radius, height) round the z axis, cut into `steps` steps. The line begins
    /// and ends on the axis and runs upward on the outside. A line of k points makes `2 * steps * (k - 2)` triangles,
    /// none without area.
    pub fn revolved(profile: &[[f64; 2]], steps: u32) -> Shape {
        let [[_, bottom], rings @ .., [_, top]] = profile else { unreachable!("a profile has two ends") };
        let ring = |&[radius, height]: &[f64; 2]| {
            (0..steps).map(move |step| {
                let (y, x) = sin_cos(360.0 * f64::from(step) / f64::from(steps));
                dvec3(radius * x, radius * y, height)
            })
        };
        let mut positions: Vec<DVec3> = rings.iter().flat_map(ring).collect();
        let mut triangles = bands(rings.len() as u32 - 1, steps);
        let (first, last) = (positions.len() as u32, positions.len() as u32 + 1);
        positions.extend([dvec3(0.0, 0.0, *bottom), dvec3(0.0, 0.0, *top)]);
        let upper = (rings.len() as u32 - 1) * steps;
        for (step, next) in (0..steps).map(|step| (step, (step + 1) % steps)) {
            triangles.push([first, next, step]);
            triangles.push([last, upper + step, upper + next]);
        }
        Shape { normals: smooth_normals(&positions, &triangles), positions, triangles }
    }

    /// A tube with open ends and that radius, round a line in the plane y = 0. The line is given by points and
    /// directions there; the tube has `steps` steps round it.
    pub fn tube(line: &[(DVec3, DVec3)], radius: f64, steps: u32) -> Shape {
        let mut tube = Shape::default();
        for &(middle, direction) in line {
            let across = unit_or_z(direction).cross(DVec3::Y);
            for step in 0..steps {
                let (y, x) = sin_cos(360.0 * f64::from(step) / f64::from(steps));
                let normal = across * x - DVec3::Y * y;
                tube.positions.push(middle + normal * radius);
                tube.normals.push(normal);
            }
        }
        tube.triangles = bands(line.len() as u32 - 1, steps);
        tube
    }

    /// The triangles of a mesh.
    pub fn of(mesh: &Mesh) -> Shape {
        Shape {
            positions: mesh.positions().to_vec(),
            normals: mesh.normals().to_vec(),
            triangles: mesh.triangles().iter().map(|triangle| triangle.positions).collect(),
        }
    }

    /// The shape rotated round the z axis, counter-clockwise seen from above, in degrees.
    pub fn turned(mut self, degrees: f64) -> Shape {
        let (s, c) = sin_cos(degrees);
        let turn = |v: &mut DVec3| *v = dvec3(c * v.x - s * v.y, s * v.x + c * v.y, v.z);
        self.positions.iter_mut().chain(&mut self.normals).for_each(turn);
        self
    }

    /// The shape moved by `by`.
    pub fn moved(mut self, by: DVec3) -> Shape {
        self.positions.iter_mut().for_each(|position| *position += by);
        self
    }

    /// The number of its triangles.
    #[cfg(test)]
    pub fn count(&self) -> usize {
        self.triangles.len()
    }

    fn join(&mut self, other: &Shape) {
        let first = self.positions.len() as u32;
        self.positions.extend(&other.positions);
        self.normals.extend(&other.normals);
        self.triangles.extend(other.triangles.iter().map(|corners| corners.map(|i| first + i)));
    }
}

/// Bands of two triangles a step, between rings of `steps` positions each.
fn bands(count: u32, steps: u32) -> Vec<[u32; 3]> {
    let squares = (0..count).flat_map(|band| (0..steps).map(move |step| (band * steps, step, (step + 1) % steps)));
    let halves = |(ring, step, next)| {
        let (p, q, r, s) = (ring + step, ring + next, ring + steps + next, ring + steps + step);
        [[p, q, r], [p, r, s]]
    };
    squares.flat_map(halves).collect()
}

/// Shapes with their colours, in the sequence of submission.
#[derive(Default)]
pub(super) struct Parts {
    shape: Shape,
    colours: Vec<[f64; 3]>,
}

impl Parts {
    /// Adds a shape in one colour: red, green and blue, 0 to 1.
    pub fn add(&mut self, shape: &Shape, colour: [f64; 3]) {
        self.shape.join(shape);
        self.colours.resize(self.shape.triangles.len(), colour);
    }

    /// All of them as a mesh.
    pub fn mesh(self) -> Mesh {
        let Shape { positions, normals, triangles } = self.shape;
        let triangle = |(corners, diffuse)| MeshTriangle { positions: corners, normals: corners, diffuse };
        let triangles = triangles.into_iter().zip(self.colours).map(triangle).collect();
        Mesh::new(positions, normals, triangles).expect("the built-in data is sound")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six times the volume that the triangles enclose: positive if they are closed and face outward.
    fn volume6(shape: &Shape) -> f64 {
        let of = |corners: &[u32; 3]| {
            let [p, q, r] = corners.map(|i| shape.positions[i as usize]);
            p.cross(q).dot(r)
        };
        shape.triangles.iter().map(of).sum()
    }

    /// Every normal of a triangle's corners is on the side that the triangle faces.
    fn assert_faces_outward(shape: &Shape) {
        for corners in &shape.triangles {
            let [p, q, r] = corners.map(|i| shape.positions[i as usize]);
            let face = (q - p).cross(r - p);
            assert!(face.length() > 1e-9, "a triangle at {p} has no area");
            for normal in corners.map(|i| shape.normals[i as usize]) {
                assert!(normal.dot(face) > 0.0, "a triangle at {p} faces inward");
                assert!((normal.length() - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_cuboid_is_closed_and_faces_outward() {
        let cuboid = Shape::cuboid(dvec3(-1.0, 2.0, -3.0), dvec3(1.0, 5.0, -2.0));
        assert_eq!(cuboid.triangles.len(), 12);
        assert!((volume6(&cuboid) - 6.0 * 6.0).abs() < 1e-12, "2 x 3 x 1");
        assert_faces_outward(&cuboid);
        let turned = cuboid.turned(90.0).moved(DVec3::Z);
        assert_faces_outward(&turned);
        assert_eq!(turned.positions[0], dvec3(-2.0, -1.0, -1.0));
    }

    #[test]
    fn a_revolved_square_is_a_prism() {
        let prism = Shape::revolved(&[[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [0.0, 2.0]], 6);
        assert_eq!(prism.triangles.len(), 2 * 6 * 2);
        let hexagon = 6.0 * 0.75_f64.sqrt() / 2.0;
        assert!((volume6(&prism) - 6.0 * 2.0 * hexagon).abs() < 1e-12);
        assert_faces_outward(&prism);
    }

    #[test]
    fn a_tube_follows_its_line() {
        let line = [0.0, 1.0, 3.0].map(|x| (dvec3(x, 0.0, 1.0), DVec3::X));
        let tube = Shape::tube(&line, 0.5, 8);
        assert_eq!(tube.triangles.len(), 2 * 8 * 2);
        assert_faces_outward(&tube);
        for position in &tube.positions {
            let out = *position - dvec3(position.x, 0.0, 1.0);
            assert!((out.length() - 0.5).abs() < 1e-12);
        }
    }
}
