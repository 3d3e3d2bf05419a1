//! Primitives whose edges take the most possible clocks.
//!
//! Source: facts E0 (guard band), E3. The clocks of an edge are the bits of its values in a region of 128 x 128 pixels. A value of an edge that
//! crosses the region is at most 127 (|a| + |b|) - 1. Here |a| + |b| are the edge's extents in x and y in 1/16 pixel. So 25 bits need 66,053 of
//! these, 24 need 33,027 and 23 need 16,514. The guard band has 65,535 along each axis.

use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::pixel_planes::instruction::Instruction;
use tilewright_rtl::pixel_planes::programs::{Edges, Program};
use tilewright_scenes::{Polygon, ScreenVertex, Size, set_up, set_up_line, set_up_polygon};

use super::super::bin::Bin;
use super::super::config::Config;
use super::Kind;

/// Both ends are in the region, so that all four edges cross it. Edges at the ends are along the axes and 16 units long: 12 bits, or 8 as least
/// half-planes. Long edges are at most as long as the region: 20 bits, or 15.
const VECTOR: [(i32, i32); 2] = [(4524, 16_215), (2868, 14_534)];

/// All edges cross the region, so the triangle is thin. Extents reach 131,070; those of the longest edge are about the sums of the other two. So one edge has
/// 24 bits, and two have 25. As least half-planes all have 15.
const TRIANGLE: [(i32, i32); 3] = [(8865, 7605), (31_341, 31_976), (-31_620, -32_041)];

/// All edges cross the region, so the polygon is thin. Each of its two sides has extents of at most 131,070. So three of its edges have 24 bits, and one has
/// 23. Four and four edges have more bits than five and three.
pub(super) const LARGE: [(i32, i32); 8] = [
    (-31_340, -32_688),
    (-19_951, -21_463),
    (-2845, -4589),
    (14_317, 12_344),
    (32_672, 30_610),
    (14_384, 12_589),
    (-3876, -5461),
    (-22_062, -23_485),
];

/// All edges cross the region, and have 15 bits as least half-planes.
pub(super) const POLYGON: [(i32, i32); 8] = [
    (-32_762, -29_983),
    (-11_854, -10_596),
    (-987, -484),
    (21_228, 20_221),
    (32_372, 30_876),
    (17_800, 17_827),
    (1566, 2861),
    (-16_988, -14_732),
];

/// The instructions of a program for a primitive whose edges take the most possible clocks of its kind, in that form.
///
/// # Errors
/// There are no regions of 128 x 128 pixels.
pub fn worst(program: &Program, kind: Kind, edges: Edges) -> Result<Vec<Instruction<u64>>, ParameterError> {
    let at = |(x, y): (i32, i32)| ScreenVertex { x, y, z: 1 << 20, rgb: [1, 2, 3] };
    let size = Size::new(2048, 2048).expect("the largest screen");
    let (polygon, (left, top)) = match (kind, edges) {
        (Kind::Vectors, _) => (set_up_line(VECTOR.map(at), size), (128, 896)),
        (Kind::Triangles, _) => (set_up(&TRIANGLE.map(at), size).map(Polygon::from), (768, 768)),
        (Kind::Polygons, Edges::Own) => (set_up_polygon(&LARGE.map(at), size).pop(), (768, 768)),
        (Kind::Polygons, _) => (set_up_polygon(&POLYGON.map(at), size).pop(), (1408, 1408)),
    };
    let config = Config { edges, ..Config::new(size) };
    let regions = config.regions()?;
    let bin = Bin::new(regions.of_pixel(left, top), &regions, &config);
    Ok(bin.draw(program, &polygon.expect("it has pixels")))
}
