//! The terrains: ter1k and ter250, one landscape of 80 km x 80 km sampled every 1000 m and every 250 m (facts D).
//!
//! Grids of 80 x 80 and 320 x 320 heights make 2*79^2 = 12482 and 2*319^2 = 203522 triangles, the VC-1 paper's counts
//! (VC1-SCENE). Every fourth height of the fine grid is a height of the coarse one. The data is generated: five octaves
//! of hashed value noise, all in integers, clamped at sea level.

use crate::mesh::{Mesh, MeshTriangle};
use glam::{DVec3, dvec3};

/// Heights along a side of the fine grid.
const SIDE: u32 = 320;
/// The spacing of the fine grid's heights, in km.
const SPACING: f64 = 0.25;
/// The middle of the map along x and along y, in km.
pub const MIDDLE: f64 = (SIDE - 1) as f64 * SPACING / 2.0;
/// The vertical exaggeration (facts D).
const EXAGGERATION: f64 = 3.0;
/// Edge of a noise cell, in fine samples, and the noise's amplitude in decimetres.
const OCTAVES: [(i128, i128); 5] = [(80, 14000), (40, 7000), (20, 3500), (10, 1750), (5, 875)];
/// Subtracted from the noise, in decimetres: everything below is sea.
const SEA: i128 = 9000;

/// The terrain at every `step`-th height of the fine grid: 1 for ter250, 4 for ter1k. Kilometres, z up, from (0, 0).
pub fn mesh(step: u32) -> Mesh {
    let step = step.clamp(1, SIDE / 2);
    let side = SIDE.div_ceil(step);
    let spacing = f64::from(step) * SPACING;
    // One height beyond each border, for the normals there.
    let height = |x: i64, y: i64| decimetres(x * i64::from(step), y * i64::from(step)) as f64 * EXAGGERATION / 10_000.0;
    let mut positions = Vec::new();
    let mut normals = Vec::new();
    for y in 0..i64::from(side) {
        for x in 0..i64::from(side) {
            positions.push(dvec3(x as f64 * spacing, y as f64 * spacing, height(x, y)));
            let slope = |ahead: f64, behind: f64| (behind - ahead) / (2.0 * spacing);
            normals.push(DVec3::new(
                slope(height(x + 1, y), height(x - 1, y)),
                slope(height(x, y + 1), height(x, y - 1)),
                1.0,
            ));
        }
    }
    let mut triangles = Vec::new();
    for y in 0..side - 1 {
        for x in 0..side - 1 {
            let first = y * side + x;
            let quad = [first, first + 1, first + side + 1, first + side];
            for corners in [[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]] {
                let sum: f64 = corners.iter().map(|&i| positions[i as usize].z).sum();
                triangles.push(MeshTriangle {
                    positions: corners,
                    normals: corners,
                    diffuse: tint(sum / (3.0 * EXAGGERATION)),
                });
            }
        }
    }
    Mesh::new(positions, normals, triangles).expect("the built-in terrain is sound")
}

/// The height at a fine sample in decimetres, not below sea level.
fn decimetres(x: i64, y: i64) -> i128 {
    let sum: i128 =
        (0..).zip(OCTAVES).map(|(octave, (cell, amplitude))| noise(x.into(), y.into(), octave, cell, amplitude)).sum();
    (sum - SEA).max(0)
}

/// Value noise: hashed heights at the corners of cells, blended with the cubic 3t^2 - 2t^3, rounded down to a decimetre.
fn noise(x: i128, y: i128, octave: u32, cell: i128, amplitude: i128) -> i128 {
    let (column, row) = (x.div_euclid(cell), y.div_euclid(cell));
    // The cubic in units of 1/cell^3.
    let cubic = |t: i128| t * t * (3 * cell - 2 * t);
    let (u, v) = (cubic(x.rem_euclid(cell)), cubic(y.rem_euclid(cell)));
    let one = cell * cell * cell;
    let corner = |i: i128, j: i128| i128::from(hash(octave, column + i, row + j) >> 16);
    let upper = corner(0, 0) * (one - u) + corner(1, 0) * u;
    let lower = corner(0, 1) * (one - u) + corner(1, 1) * u;
    (upper * (one - v) + lower * v) * amplitude / (one * one * 65536)
}

/// 32 mixed bits of a lattice point: multiply and fold, so that neighbours are uncorrelated.
fn hash(octave: u32, column: i128, row: i128) -> u32 {
    let mut h = octave.wrapping_mul(0x9e37_79b1)
        ^ (column as u32).wrapping_mul(0x85eb_ca6b)
        ^ (row as u32).wrapping_mul(0xc2b2_ae35);
    for _ in 0..2 {
        h ^= h >> 15;
        h = h.wrapping_mul(0x2c1b_3c6d);
        h ^= h >> 13;
    }
    h
}

/// The colour of the land at a height in km: sea, meadow, wood, rock, snow.
fn tint(km: f64) -> [f64; 3] {
    match km {
        km if km <= 0.0 => [0.16, 0.34, 0.58],
        km if km < 0.25 => [0.52, 0.66, 0.34],
        km if km < 0.65 => [0.30, 0.50, 0.26],
        km if km < 1.10 => [0.56, 0.48, 0.38],
        _ => [0.92, 0.93, 0.95],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn has_the_papers_polygon_counts() {
        assert_eq!(mesh(4).triangles().len(), 12482, "VC1-SCENE: ter1k");
        assert_eq!(mesh(1).triangles().len(), 203_522, "VC1-SCENE: ter250");
    }

    #[test]
    fn the_coarse_grid_is_every_fourth_height_of_the_fine_one() {
        let (coarse, fine) = (mesh(4), mesh(1));
        for (i, p) in coarse.positions().iter().enumerate() {
            let (x, y) = (i % 80 * 4, i / 80 * 4);
            assert_eq!(*p, fine.positions()[y * 320 + x]);
        }
    }

    #[test]
    fn there_is_sea_and_there_are_mountains() {
        let mesh = mesh(4);
        let sea = mesh.positions().iter().filter(|p| p.z == 0.0).count();
        assert!((300..3200).contains(&sea), "{sea} of 6400 heights are sea");
        let top = mesh.bounding_box().max.z / EXAGGERATION;
        assert!((0.9..1.9).contains(&top), "the highest point is at {top} km");
    }
}
