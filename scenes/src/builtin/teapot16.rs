//! Sixteen teapots in a square, each the same as in the scene `teapot`: 16 times 4096 triangles (VC1-SCENE).

use super::shape::{Parts, Shape};
use super::teapot;
use crate::material::Materials;
use crate::mesh::Mesh;
use glam::dvec3;

/// The distance from one teapot to the next, along x and y; a teapot is 6.4 long and 4 wide.
const SPACING: [f64; 2] = [7.4, 6.0];
/// The distance from the middle of a teapot's length to its own origin, the middle of its body.
const OFFSET: f64 = -0.2;
/// Red, green and blue of each row's teapots, from the front.
const COLOURS: [[f64; 3]; 4] = [[0.82, 0.64, 0.42], [0.72, 0.4, 0.3], [0.45, 0.6, 0.5], [0.45, 0.52, 0.68]];

/// 65536 triangles; a texture fills each patch of each teapot.
///
/// ```
/// assert_eq!(tilewright_scenes::builtin::teapot16::mesh().triangles().len(), 65536);
/// ```
pub fn mesh() -> Mesh {
    let teapot = teapot::mesh(8);
    let mut parts = Parts::default();
    for (row, colour) in (0..4).zip(COLOURS) {
        for column in 0..4 {
            let place = |number: i32, spacing: f64| (f64::from(number) - 1.5) * spacing;
            let at = dvec3(place(column, SPACING[0]) + OFFSET, place(row, SPACING[1]), 0.0);
            parts.add(&Shape::of(&teapot).moved(at), colour);
        }
    }
    let one = teapot.materials().expect("the teapot has texture coordinates");
    let materials = Materials { mappings: one.mappings.repeat(16), ..one.clone() };
    parts.mesh().with_materials(materials).expect("a mapping for each triangle")
}

#[cfg(test)]
mod tests {
    use crate::packet::SUBPIXELS;
    use crate::{Scene, golden};

    #[test]
    fn all_sixteen_are_in_sight_and_none_is_cut_by_the_border() {
        let scene = Scene::builtin("teapot16").expect("a built-in scene");
        assert_eq!(scene.mesh.triangles().len(), 65536, "VC1-SCENE: teapot16");
        let projection = scene.project().expect("the teapots are in sight");
        let side = |pixels: u32| 0..=pixels as i32 * SUBPIXELS;
        let (across, down) = (side(scene.size.width()), side(scene.size.height()));
        for vertex in projection.vertices.as_flattened() {
            assert!(across.contains(&vertex.x) && down.contains(&vertex.y), "{vertex:?}");
        }
        assert_eq!((projection.counts.off_screen, projection.counts.behind), (0, 0));

        let frame = golden::render(scene.size, &projection.triangles, scene.background);
        let mut seen = [0; 16];
        for packet in &projection.triangles {
            let b = packet.bounds;
            let pixels = (b.top..=b.bottom).flat_map(|y| (b.left..=b.right).map(move |x| (x, y)));
            let is_seen = |&(x, y): &(u32, u32)| packet.covers(x, y) && packet.word(x, y) == frame.word(x, y);
            seen[packet.polygon as usize / 4096] += pixels.filter(is_seen).count();
        }
        assert!(seen.iter().all(|&pixels| pixels > 2500), "pixels of each: {seen:?}");
    }
}
