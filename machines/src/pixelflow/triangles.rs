//! Random triangles in boxes of one size, which are the primitives of the paper's counts (PFL-OVERLAP).
//!
//! Each triangle is a function of the seed and its number, so that all machines and any number of threads have the same triangles.

use tilewright_rtl::parameter::ParameterError;
use tilewright_scenes::deferred::{AppearanceVertex, Deferred, Pass, Samples, Shader, set_up_appearance};
use tilewright_scenes::packet::{FARTHEST_VERTEX, NEAREST_VERTEX, SUBPIXELS};
use tilewright_scenes::{Counts, Polygon, Polygons, ScreenVertex, Size, set_up_polygon};

use crate::random::Random;

/// An endless set of random triangles: three of the four corners of a box, anywhere on the screen.
///
/// ```
/// use tilewright_machines::pixelflow::Triangles;
/// use tilewright_scenes::Size;
///
/// let triangles = Triangles::new(Size::new(640, 512)?, 10, 1)?;
/// let corners = triangles.corners(0);
/// let widest = corners.iter().map(|a| corners.iter().map(|b| a.at.x - b.at.x).max().unwrap()).max();
/// assert_eq!(widest, Some(10 * 16));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Triangles {
    size: Size,
    /// The side of a box, in 1/16 pixel.
    side: i32,
    seed: u64,
}

impl Triangles {
    /// 1/w of all corners, and the greatest u/w and v/w.
    const SCALE: u16 = 40_000;

    /// Triangles in boxes of `side` x `side` pixels.
    ///
    /// # Errors
    /// They do not fit on the screen.
    pub fn new(size: Size, side: u32, seed: u64) -> Result<Triangles, ParameterError> {
        if side == 0 || side > size.width().min(size.height()) {
            return Err(ParameterError(format!(
                "triangles of {side} pixels on a screen of {size}: give at least 1, and at most the screen's shorter side"
            )));
        }
        Ok(Triangles { size, side: side as i32 * SUBPIXELS, seed })
    }

    /// The corners of triangle number `index`.
    pub fn corners(&self, index: u64) -> [AppearanceVertex; 3] {
        let mut random = Random::new(self.seed, index);
        let sides = [self.size.width(), self.size.height()];
        let [left, top] = sides.map(|side| random.between(0, side as i32 * SUBPIXELS - self.side));
        let without = random.between(0, 3);
        let depths = i64::from(FARTHEST_VERTEX) - i64::from(NEAREST_VERTEX);
        let corners: Vec<AppearanceVertex> = (0..4)
            .filter(|corner| *corner != without)
            .map(|corner| {
                // Once around the box.
                let (right, below) = (corner == 1 || corner == 2, corner >= 2);
                let [x, y] = [(left, right), (top, below)].map(|(at, far)| at + if far { self.side } else { 0 });
                let z = (i64::from(NEAREST_VERTEX) + (random.fraction() * depths as f64) as i64) as u32;
                let [red, green, blue, ..] = random.next().to_le_bytes();
                let mut below = |most: i32| random.between(0, most);
                AppearanceVertex {
                    at: ScreenVertex { x, y, z, rgb: [red, green, blue] },
                    normal: [below(40_000) - 20_000, below(40_000) - 20_000, -20_000].map(|part| part as i16),
                    uv: [below(Triangles::SCALE.into()), below(Triangles::SCALE.into())].map(|part| part as u16),
                    scale: Triangles::SCALE,
                }
            })
            .collect();
        corners.try_into().expect("three of four")
    }

    /// The first triangles for deferred shading, with one sample a pixel. They use all materials one after another.
    ///
    /// # Panics
    /// The shader has no materials.
    pub fn deferred(&self, count: u64, shader: Shader) -> Deferred {
        let materials = shader.materials.len() as u64;
        let packet = |number: u64| {
            let vertices = self.corners(number);
            let mut packet = set_up_appearance(&vertices, (number % materials) as u8, 0, self.size)?;
            packet.triangle.polygon = number as u32;
            Some((packet, vertices))
        };
        let (packets, vertices): (Vec<_>, Vec<_>) = (0..count).filter_map(packet).unzip();
        let counts = counts(count, packets.len());
        let pass = Pass { size: self.size, packets, vertices };
        Deferred { size: self.size, samples: Samples::One, passes: vec![pass], shader, counts }
    }

    /// The first triangles, with the colours of their corners.
    pub fn polygons(&self, count: u64) -> Polygons {
        let packet = |number: u64| {
            let vertices = self.corners(number).map(|corner| corner.at);
            let polygon = set_up_polygon(&vertices, self.size).pop()?;
            Some((Polygon { polygon: number as u32, ..polygon }, vertices.to_vec()))
        };
        let (polygons, vertices): (Vec<_>, Vec<_>) = (0..count).filter_map(packet).unzip();
        let counts = counts(count, polygons.len());
        Polygons { size: self.size, polygons, vertices, spheres: Vec::new(), counts }
    }
}

fn counts(all: u64, drawn: usize) -> Counts {
    let (polygons, drawn) = (all as u32, drawn as u32);
    Counts { polygons, drawn, between_centres: polygons - drawn, ..Counts::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_scenes::Scene;
    use tilewright_scenes::deferred::project_deferred;

    #[test]
    fn triangles_fill_their_boxes_on_the_screen() -> Result<(), Box<dyn std::error::Error>> {
        let size = Size::new(40, 24)?;
        let triangles = Triangles::new(size, 10, 3)?;
        let mut left_out = [0; 4];
        for number in 0..400 {
            let corners = triangles.corners(number).map(|corner| [corner.at.x, corner.at.y]);
            let range = |axis: usize| {
                let places = corners.map(|corner| corner[axis]);
                (*places.iter().min().unwrap_or(&0), *places.iter().max().unwrap_or(&0))
            };
            for (axis, side) in [40, 24].into_iter().enumerate() {
                let (first, last) = range(axis);
                assert!(first >= 0 && last <= 16 * side && last - first == 160, "{corners:?}");
            }
            let ((left, _), (top, _)) = (range(0), range(1));
            let all = [[left, top], [left + 160, top], [left + 160, top + 160], [left, top + 160]];
            left_out[all.iter().position(|corner| !corners.contains(corner)).ok_or("all four are there")?] += 1;
        }
        assert!(left_out.iter().all(|times| *times > 60), "{left_out:?}");
        assert!(Triangles::new(size, 25, 3).is_err());
        Ok(())
    }

    #[test]
    fn both_forms_are_of_the_same_triangles() -> Result<(), Box<dyn std::error::Error>> {
        let size = Size::new(64, 48)?;
        let shader = project_deferred(&Scene::builtin("textured").ok_or("a scene")?, size, Samples::One)?.shader;
        let triangles = Triangles::new(size, 10, 3)?;
        let (deferred, polygons) = (triangles.deferred(100, shader), triangles.polygons(100));
        assert_eq!((deferred.passes[0].packets.len(), polygons.polygons.len()), (100, 100));
        for (packet, polygon) in deferred.passes[0].packets.iter().zip(&polygons.polygons) {
            assert_eq!((packet.triangle.z, packet.triangle.bounds), (polygon.z, polygon.bounds));
        }
        Ok(())
    }
}
