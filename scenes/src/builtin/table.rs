//! The table of the VC-1 paper: a teapot and four cups on a slab, which covers as much of the screen as everything else
//! together (VC1-SCENE).
//!
//! The paper gives the count of polygons and a small picture. Our choice of bodies matches the count (facts D). A slab
//! has 12 triangles, its legs 48, two mats 4, and the teapot 4096. Four cups, each with saucer and handle, have 1516
//! each.

use super::shape::{Parts, Shape};
use super::teapot;
use crate::mesh::Mesh;
use glam::{DVec3, dvec3};

/// Half the slab, in the unit of the teapot, whose body has a diameter of 4. The slab's upper side is the plane z = 0.
const SLAB: DVec3 = dvec3(9.0, 6.0, 0.4);
/// Half a leg's width, and the distance from the slab's middle to a leg's.
const LEG: f64 = 0.45;
const LEGS: [f64; 2] = [8.2, 5.2];
const FLOOR: f64 = -6.2;
/// The distance from the middle to a mat's, half a mat, and its height above the slab.
const MAT: f64 = 6.1;
const MAT_HALF: [f64; 2] = [2.1, 4.4];
const MAT_LIES: f64 = 0.02;
/// Steps round a cup and a saucer.
const STEPS: u32 = 24;

/// A saucer from below to above, as radius and height: 2 x 24 x 8 triangles.
const SAUCER: [[f64; 2]; 10] = [
    [0.0, 0.0],
    [0.78, 0.0],
    [0.96, 0.07],
    [1.24, 0.14],
    [1.5, 0.26],
    [1.5, 0.3],
    [1.22, 0.2],
    [0.92, 0.12],
    [0.62, 0.09],
    [0.0, 0.09],
];
/// The height at which the cup stands on it.
const CUP_STANDS: f64 = 0.09;
/// A cup from below, up its outside and down its inside: 2 x 24 x 19 triangles.
const CUP: [[f64; 2]; 21] = [
    [0.0, 0.05],
    [0.44, 0.05],
    [0.46, 0.0],
    [0.54, 0.0],
    [0.55, 0.07],
    [0.67, 0.13],
    [0.78, 0.24],
    [0.86, 0.42],
    [0.91, 0.64],
    [0.94, 0.86],
    [0.97, 1.07],
    [0.98, 1.14],
    [0.95, 1.17],
    [0.91, 1.13],
    [0.86, 0.92],
    [0.83, 0.68],
    [0.77, 0.44],
    [0.68, 0.27],
    [0.53, 0.17],
    [0.3, 0.13],
    [0.0, 0.12],
];
/// A cup's handle leaves its wall above and comes back below: a cubic Bezier line, in x and z.
const HANDLE: [[f64; 2]; 4] = [[0.905, 0.92], [1.6, 1.08], [1.5, 0.05], [0.798, 0.37]];
const HANDLE_RADIUS: f64 = 0.065;
/// Cuts of a handle along its line and round it: 2 x 11 x 10 triangles.
const HANDLE_CUTS: [u32; 2] = [11, 10];

const WOOD: [f64; 3] = [0.55, 0.33, 0.18];
const LEG_WOOD: [f64; 3] = [0.47, 0.28, 0.15];
const CLOTH: [f64; 3] = [0.3, 0.42, 0.5];
const CLAY: [f64; 3] = [0.82, 0.64, 0.42];
const PORCELAIN: [f64; 3] = [0.93, 0.91, 0.86];

/// 10224 triangles.
///
/// ```
/// assert_eq!(tilewright_scenes::builtin::table::mesh().triangles().len(), 10224);
/// ```
pub fn mesh() -> Mesh {
    let mut parts = Parts::default();
    parts.add(&Shape::cuboid(dvec3(-SLAB.x, -SLAB.y, -SLAB.z), dvec3(SLAB.x, SLAB.y, 0.0)), WOOD);
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    for (x, y) in corners {
        let middle = dvec3(x * LEGS[0], y * LEGS[1], 0.0);
        let leg = Shape::cuboid(dvec3(-LEG, -LEG, FLOOR), dvec3(LEG, LEG, -SLAB.z));
        parts.add(&leg.moved(middle), LEG_WOOD);
    }
    for side in [-1.0, 1.0] {
        let mat = corners.map(|(x, y)| dvec3(side * MAT + x * MAT_HALF[0], y * MAT_HALF[1], MAT_LIES));
        parts.add(&Shape::rectangle(mat), CLOTH);
    }
    parts.add(&Shape::of(&teapot::mesh(8)).turned(-20.0).moved(dvec3(-0.1, 1.2, 0.0)), CLAY);
    // Each handle points to its guest, and a little towards the eye.
    for (x, y, turn) in [(-1.0, -2.2, -150.0), (1.0, -2.2, -40.0), (-1.0, 2.2, -155.0), (1.0, 2.2, -30.0)] {
        cup_set(&mut parts, dvec3(x * MAT, y, MAT_LIES), turn);
    }
    parts.mesh()
}

/// A saucer at this place, and a cup on it. The cup's handle points along the x axis rotated by the angle in degrees.
fn cup_set(parts: &mut Parts, place: DVec3, turn: f64) {
    let stands = place + dvec3(0.0, 0.0, CUP_STANDS);
    parts.add(&Shape::revolved(&CUP, STEPS).moved(stands), PORCELAIN);
    parts.add(&Shape::revolved(&SAUCER, STEPS).moved(place), PORCELAIN);
    parts.add(&handle().turned(turn).moved(stands), PORCELAIN);
}

fn handle() -> Shape {
    let [along, round] = HANDLE_CUTS;
    let points = HANDLE.map(|[x, z]| dvec3(x, 0.0, z));
    let at = |cut: u32| {
        let t = f64::from(cut) / f64::from(along);
        let between = |from: DVec3, to: DVec3| from + (to - from) * t;
        let [a, b, c] = [0, 1, 2].map(|i| between(points[i], points[i + 1]));
        let (p, q) = (between(a, b), between(b, c));
        (between(p, q), q - p)
    };
    Shape::tube(&(0..=along).map(at).collect::<Vec<_>>(), HANDLE_RADIUS, round)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshTriangle;

    /// Triangles and the kinds of bodies in the sequence of submission: slab, legs, mats, teapot, and for each set cup,
    /// saucer and handle.
    const COUNTS: [(usize, usize); 5] = [(1, 12), (4, 12), (2, 2), (1, 4096), (4, 1516)];
    const SET: [usize; 3] = [912, 384, 220];

    fn positions<'a>(mesh: &'a Mesh, triangles: &'a [MeshTriangle]) -> impl Iterator<Item = DVec3> + 'a {
        triangles.iter().flat_map(|triangle| triangle.positions.map(|i| mesh.positions()[i as usize]))
    }

    fn lowest(mesh: &Mesh, triangles: &[MeshTriangle]) -> f64 {
        positions(mesh, triangles).map(|p| p.z).fold(f64::INFINITY, f64::min)
    }

    fn highest(mesh: &Mesh, triangles: &[MeshTriangle]) -> f64 {
        positions(mesh, triangles).map(|p| p.z).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The bodies of each kind.
    fn bodies(mesh: &Mesh) -> Vec<Vec<&[MeshTriangle]>> {
        let mut rest = mesh.triangles();
        let mut take = |count: usize| {
            let (body, others) = rest.split_at(count);
            rest = others;
            body
        };
        let kinds = COUNTS.map(|(bodies, count)| (0..bodies).map(|_| take(count)).collect());
        assert!(rest.is_empty());
        kinds.to_vec()
    }

    #[test]
    fn has_the_papers_polygon_count() {
        assert_eq!(mesh().triangles().len(), 10224, "VC1-SCENE: table");
        assert_eq!(Shape::revolved(&CUP, STEPS).count(), SET[0]);
        assert_eq!(Shape::revolved(&SAUCER, STEPS).count(), SET[1]);
        assert_eq!(handle().count(), SET[2]);
    }

    #[test]
    fn everything_stands_on_what_is_below_it() {
        let mesh = mesh();
        let bodies = bodies(&mesh);
        let [slab, legs, mats, teapot, sets] = &bodies[..] else { panic!("five kinds") };
        assert_eq!((lowest(&mesh, slab[0]), highest(&mesh, slab[0])), (-0.4, 0.0));
        assert!(legs.iter().all(|leg| highest(&mesh, leg) == -0.4));
        assert!(mats.iter().all(|mat| lowest(&mesh, mat) == MAT_LIES && highest(&mesh, mat) == MAT_LIES));
        assert_eq!(lowest(&mesh, teapot[0]), 0.0);
        for (number, set) in sets.iter().enumerate() {
            let (cup, rest) = set.split_at(SET[0]);
            let (saucer, handle) = rest.split_at(SET[1]);
            assert_eq!(lowest(&mesh, saucer), MAT_LIES);
            assert_eq!(lowest(&mesh, cup), MAT_LIES + CUP_STANDS);
            assert!(lowest(&mesh, handle) > highest(&mesh, saucer));
            let mat = mats[number % 2];
            let on_the_mat = |p: DVec3| {
                let at: Vec<DVec3> = positions(&mesh, mat).collect();
                let within =
                    |of: fn(DVec3) -> f64| at.iter().any(|&m| of(m) <= of(p)) && at.iter().any(|&m| of(m) >= of(p));
                within(|v| v.x) && within(|v| v.y)
            };
            assert!(positions(&mesh, saucer).all(on_the_mat), "saucer {number}");
        }
        // The cup's foot is on the level middle of the saucer.
        let [foot, level] = [&CUP[2..4], &SAUCER[8..]];
        assert!(foot.iter().all(|&[radius, height]| height == 0.0 && radius < level[0][0]));
        assert!(level.iter().all(|&[_, height]| height == CUP_STANDS));
    }

    /// Whether a point of that radius and height is inside a cup's wall.
    fn in_the_wall(radius: f64, height: f64) -> bool {
        let sides = CUP.windows(2).filter(|side| (side[0][1] > height) != (side[1][1] > height));
        let beyond = sides.filter(|side| {
            let [[r0, z0], [r1, z1]] = [side[0], side[1]];
            r0 + (r1 - r0) * (height - z0) / (z1 - z0) > radius
        });
        beyond.count() % 2 == 1
    }

    #[test]
    fn a_handles_ends_are_inside_the_cups_wall() {
        let [along, round] = HANDLE_CUTS.map(|cuts| cuts as usize);
        let mesh = mesh();
        let handle = &mesh.triangles()[mesh.triangles().len() - SET[2]..];
        let set = dvec3(MAT, 2.2, MAT_LIES + CUP_STANDS);
        let ends = handle[..2 * round].iter().chain(&handle[2 * round * (along - 1)..]);
        let (mut inside, mut outside) = (0, 0);
        for p in ends.flat_map(|triangle| triangle.positions).map(|i| mesh.positions()[i as usize] - set) {
            let radius = p.x.hypot(p.y);
            // The wall has 24 flat sides, so it is a little nearer than its corners.
            let flat = (std::f64::consts::PI / f64::from(STEPS)).cos();
            match in_the_wall(radius, p.z) && in_the_wall(radius / flat, p.z) {
                true => inside += 1,
                false => outside += 1,
            }
        }
        // Of the six corners of the two triangles of a step, three are on the ring at the end.
        assert_eq!((inside, outside), (6 * round, 6 * round));
    }
}
