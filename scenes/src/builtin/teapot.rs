//! The teapot: 32 bicubic Bezier patches (Newell, 1975), tessellated in exact integers.
//!
//! Facts D: 8 x 8 x 2 triangles per patch make the VC-1 paper's 4096 polygons (VC1-SCENE). 64 of them, round the poles
//! of lid and bottom, have no area; they are kept because they count. With n = 32 the same code gives 65536.
//!
//! A point at (i/n, j/n) is a whole number of 1 / (10^5 n^6): control points have five decimals, and a cubic's weights at i/n are
//! whole numbers of 1/n^3. Normals are cross products of the exact derivatives. Only the last division to f64 rounds, and IEEE 754
//! fixes how.

use crate::material::{Mapping, Material, Materials};
use crate::mesh::{Mesh, MeshTriangle, unit_or_z};
use glam::{DVec3, dvec2, dvec3};

/// An exact point or vector, in the caller's unit.
type Exact = [i64; 3];

/// A position of a patch: the point and its normal.
struct Corner {
    position: DVec3,
    normal: DVec3,
}

/// The teapot with every patch cut into n x n x 2 triangles, z up, standing on z = 0; n from 1 to 64. A texture fills each patch.
pub fn mesh(n: u32) -> Mesh {
    let n = n.clamp(1, 64);
    let mut positions = Vec::new();
    let mut normals = Vec::new();
    let mut coordinates = Vec::new();
    let mut triangles = Vec::new();
    for patch in patches() {
        let first = positions.len() as u32;
        for i in 0..=n {
            for j in 0..=n {
                let corner = corner(&patch, i, j, n);
                positions.push(corner.position);
                normals.push(corner.normal);
                coordinates.push(dvec2(j.into(), i.into()) / f64::from(n));
            }
        }
        let index = |i: u32, j: u32| first + i * (n + 1) + j;
        for i in 0..n {
            for j in 0..n {
                let (p, q) = (index(i, j), index(i + 1, j));
                let (r, s) = (index(i + 1, j + 1), index(i, j + 1));
                for corners in [[p, s, r], [p, r, q]] {
                    triangles.push(MeshTriangle { positions: corners, normals: corners, diffuse: [0.82, 0.64, 0.42] });
                }
            }
        }
    }
    let mapping = |t: &MeshTriangle| Mapping { material: 0, coordinates: t.positions };
    let mappings = triangles.iter().map(mapping).collect();
    let materials = Materials { textures: Vec::new(), materials: vec![Material::default()], coordinates, mappings };
    let mesh = Mesh::new(positions, normals, triangles).and_then(|mesh| mesh.with_materials(materials));
    mesh.expect("the built-in data is sound")
}

/// The teapot of [`mesh`], with n x n faces of two triangles in each patch.
///
/// ```
/// assert_eq!(tilewright_scenes::builtin::teapot::faces(4).faces().count(), 32 * 16);
/// ```
pub fn faces(n: u32) -> Mesh {
    let mesh = mesh(n);
    let count = mesh.triangles().len() / 2;
    mesh.with_faces(vec![2; count]).expect("the halves of a square have a corner in common")
}

/// The control points of every patch, in units of 10^-5.
fn patches() -> Vec<[[Exact; 4]; 4]> {
    let mut points: Vec<Exact> = Vec::new();
    let mut patches = Vec::new();
    for line in include_str!("../../data/teapot.txt").lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("point") => {
                let mut axis = || decimal(words.next().expect("a point has three numbers"));
                points.push([axis(), axis(), axis()]);
            }
            Some("patch") => {
                let mut indices = words.skip(1).map(|word| word.parse::<usize>());
                let mut next = || points[indices.next().expect("16 indices").expect("a number")];
                patches.push([(); 4].map(|()| [(); 4].map(|()| next())));
            }
            _ => {}
        }
    }
    patches
}

/// A decimal number with at most five places, in units of 10^-5.
fn decimal(text: &str) -> i64 {
    let (sign, digits) = text.strip_prefix('-').map_or((1, text), |rest| (-1, rest));
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    assert!(part.len() <= 5, "{text} has more than five places");
    let number: i64 = format!("{whole}{part:0<5}").parse().expect("a decimal number");
    sign * number
}

fn corner(patch: &[[Exact; 4]; 4], i: u32, j: u32, n: u32) -> Corner {
    let (u, v) = (weights(i, n), weights(j, n));
    let (du, dv) = (slopes(i, n), slopes(j, n));
    let point = blend(patch, &u, &v);
    // At a pole a whole row of control points coincides and one derivative vanishes. Next to it that derivative grows
    // along the mixed one, so this direction is the limit (l'Hopital). The sign depends on the side of the pole.
    let mixed = |side: u32| blend(patch, &du, &dv).map(|c| if side == 0 { c } else { -c });
    let nonzero = |derivative: Exact, side: u32| match derivative {
        [0, 0, 0] => mixed(side),
        other => other,
    };
    let along_u = nonzero(blend(patch, &du, &v), j);
    let along_v = nonzero(blend(patch, &u, &dv), i);
    // Below 2^53, so exact.
    let unit = (100_000 * u64::from(n).pow(6)) as f64;
    Corner { position: DVec3::from_array(point.map(|c| c as f64)) / unit, normal: normal(along_u, along_v) }
}

/// The four cubic weights at i/n, in units of 1/n^3.
fn weights(i: u32, n: u32) -> [i64; 4] {
    let (t, s) = (i64::from(i), i64::from(n - i));
    [s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t]
}

/// Their derivatives by i/n, up to a positive factor.
fn slopes(i: u32, n: u32) -> [i64; 4] {
    let (t, s) = (i64::from(i), i64::from(n - i));
    [-s * s, s * s - 2 * s * t, 2 * s * t - t * t, t * t]
}

/// The sum of the control points, weighted by row and by column.
fn blend(patch: &[[Exact; 4]; 4], row: &[i64; 4], column: &[i64; 4]) -> Exact {
    [0, 1, 2].map(|axis| {
        let sum = |points: &[Exact; 4]| -> i64 { points.iter().zip(column).map(|(p, w)| p[axis] * w).sum() };
        patch.iter().zip(row).map(|(points, w)| sum(points) * w).sum()
    })
}

/// The unit normal along the exact cross product of v and u, which points out of the pot.
fn normal(u: Exact, v: Exact) -> DVec3 {
    let product = |p: usize, q: usize| i128::from(v[p]) * i128::from(u[q]) - i128::from(v[q]) * i128::from(u[p]);
    // The conversion from i128 rounds to nearest on every machine.
    unit_or_z(dvec3(product(1, 2) as f64, product(2, 0) as f64, product(0, 1) as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area2(mesh: &Mesh, triangle: &MeshTriangle) -> f64 {
        let [p, q, r] = triangle.positions.map(|i| mesh.positions()[i as usize]);
        (q - p).cross(r - p).length()
    }

    #[test]
    fn has_the_papers_polygon_counts() {
        assert_eq!(mesh(8).triangles().len(), 4096, "VC1-SCENE: teapot");
        assert_eq!(mesh(32).triangles().len(), 65536, "VC1-SCENE: teapot16 as one fine teapot");
    }

    #[test]
    fn keeps_64_degenerate_triangles_at_the_poles() {
        let mesh = mesh(8);
        let flat = |t: &&MeshTriangle| area2(&mesh, t) == 0.0;
        assert_eq!(mesh.triangles().iter().filter(flat).count(), 64);
    }

    #[test]
    fn decimals_are_read_exactly() {
        assert_eq!(["2.53125", "-0.784", "3", "0.15"].map(decimal), [253_125, -78_400, 300_000, 15_000]);
    }

    #[test]
    fn neighbouring_patches_meet_exactly() {
        // Each point of the rim's lower edge belongs to rim and body: no position is there only once.
        let mesh = mesh(8);
        let rim_and_body = &mesh.positions()[..12 * 81];
        let edge = |p: &&DVec3| p.z == 2.4 && p.x * p.x + p.y * p.y > 2.2;
        let ring: Vec<_> = rim_and_body.iter().filter(edge).collect();
        assert_eq!(ring.len(), 2 * 4 * 9);
        for p in &ring {
            let same = ring.iter().filter(|q| q == &p).count();
            assert!(same >= 2, "{p} is alone");
        }
    }

    #[test]
    fn normals_point_out_of_the_body_and_agree_with_the_winding() {
        let mesh = mesh(8);
        for t in &mesh.triangles()[4 * 128..12 * 128] {
            let [p, q, r] = t.positions.map(|i| mesh.positions()[i as usize]);
            let face = (q - p).cross(r - p);
            let out = dvec3(p.x + q.x + r.x, p.y + q.y + r.y, 0.0);
            assert!(face.dot(out) > 0.0, "a body triangle at {p} faces inward");
            for n in t.normals {
                assert!(mesh.normals()[n as usize].dot(face) > 0.0, "normal at {p}");
            }
        }
    }

    #[test]
    fn poles_have_a_normal_along_the_axis() {
        let mesh = mesh(8);
        let mut poles = 0;
        for (p, n) in mesh.positions().iter().zip(mesh.normals()) {
            assert!((n.length() - 1.0).abs() < 1e-12);
            if p.x == 0.0 && p.y == 0.0 && (p.z == 3.15 || p.z == 0.0) {
                poles += 1;
                let up = if p.z == 0.0 { -1.0 } else { 1.0 };
                assert!((n.z - up).abs() < 1e-12, "normal {n} at the pole {p}");
            }
        }
        assert_eq!(poles, 8 * 9);
    }
}
