//! Random vectors of one length, at one angle or at random angles.
//!
//! Source: facts D (50-pixel vectors at 45 degrees and at random angles), PP5-HVB. Each vector is a function of the seed and its number, computed
//! with + - * / alone, so that all machines and any number of threads have the same vectors.

use super::regions::Regions;
use crate::random::Random;
use tilewright_rtl::parameter::ParameterError;
use tilewright_scenes::packet::{FARTHEST_VERTEX, NEAREST_VERTEX, SUBPIXELS};
use tilewright_scenes::{Counts, Polygon, Polygons, ScreenVertex, angle, set_up_line};

/// An endless set of random vectors.
///
/// The upper left corner of a vector's box is equally likely at each place in a region, and the margin to the border of the screen is at least a
/// region. So means over these vectors are those over all places of an infinite screen.
///
/// ```
/// use tilewright_machines::pixel_planes::{Regions, Vectors};
///
/// let vectors = Vectors::new(Regions::paper(), 50.0, Some(90.0), 1)?;
/// let [from, to] = vectors.ends(0);
/// assert_eq!((to.x - from.x, to.y - from.y), (0, 50 * 16));
/// # Ok::<(), tilewright_rtl::parameter::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Vectors {
    regions: Regions,
    /// In 1/16 pixel.
    length: f64,
    angle: Option<f64>,
    seed: u64,
}

impl Vectors {
    /// Vectors of `length` pixels, at `angle` degrees from the x axis, or each at a random angle.
    ///
    /// # Errors
    /// They would not fit on the screen, a region from its borders.
    pub fn new(regions: Regions, length: f64, angle: Option<f64>, seed: u64) -> Result<Vectors, ParameterError> {
        let vectors = Vectors { regions, length: length * f64::from(SUBPIXELS), angle, seed };
        // For random angles the longest extents are those along the axes.
        let extents = match angle {
            Some(angle) => vectors.steps(angle).map(i32::abs),
            None => [vectors.length.round() as i32; 2],
        };
        let is_sound = length >= 0.0 && length.is_finite() && angle.is_none_or(f64::is_finite);
        let [width, height] = vectors.sides();
        if is_sound && vectors.choices(extents[0], width) > 0 && vectors.choices(extents[1], height) > 0 {
            return Ok(vectors);
        }
        let (size, side) = (regions.size(), regions.side());
        Err(ParameterError(format!(
            "vectors of {length} pixels on a screen of {size} in regions of {side}x{side}: they have to fit with a region around them, and \
             one more to move in: take shorter ones or a larger screen"
        )))
    }

    /// The begin and the end of vector number `index`. Both have the same depth and colour.
    pub fn ends(&self, index: u64) -> [ScreenVertex; 2] {
        let mut random = Random::new(self.seed, index);
        let angle = self.angle.unwrap_or_else(|| 360.0 * random.fraction());
        let [dx, dy] = self.steps(angle);
        let [width, height] = self.sides();
        let (x, y) = (self.place(dx, width, &mut random), self.place(dy, height, &mut random));
        let range = u64::from(FARTHEST_VERTEX - NEAREST_VERTEX) + 1;
        let z = NEAREST_VERTEX + (random.next() % range) as u32;
        let [r, g, b, ..] = random.next().to_le_bytes();
        [(x, y), (x + dx, y + dy)].map(|(x, y)| ScreenVertex { x, y, z, rgb: [r, g, b] })
    }

    /// The first vectors as a scene that a machine can draw.
    ///
    /// ```
    /// use tilewright_machines::pixel_planes::{Regions, Vectors};
    ///
    /// let scene = Vectors::new(Regions::paper(), 50.0, None, 1)?.polygons(1000);
    /// assert_eq!((scene.polygons.len(), scene.vertices[0].len()), (1000, 2));
    /// # Ok::<(), tilewright_rtl::parameter::ParameterError>(())
    /// ```
    pub fn polygons(&self, count: u64) -> Polygons {
        let size = self.regions.size();
        let packet = |number: u64| {
            let ends = self.ends(number);
            Some((Polygon { polygon: number as u32, ..set_up_line(ends, size)? }, ends.to_vec()))
        };
        let (polygons, vertices): (Vec<_>, Vec<_>) = (0..count).filter_map(packet).unzip();
        let (all, drawn) = (count as u32, polygons.len() as u32);
        let counts = Counts { polygons: all, lines: all, drawn, between_centres: all - drawn, ..Counts::default() };
        Polygons { size, polygons, vertices, spheres: Vec::new(), counts }
    }

    /// From one end to the other, in 1/16 pixel.
    fn steps(&self, angle: f64) -> [i32; 2] {
        let (sine, cosine) = angle::sin_cos(angle);
        [cosine, sine].map(|part| (self.length * part).round() as i32)
    }

    /// The screen's, in 1/16 pixel.
    fn sides(&self) -> [i32; 2] {
        let size = self.regions.size();
        [size.width(), size.height()].map(|side| side as i32 * SUBPIXELS)
    }

    /// The number of regions along an axis in which a box of that extent may have its upper left corner.
    fn choices(&self, extent: i32, side: i32) -> i32 {
        let region = self.regions.side() as i32 * SUBPIXELS;
        side.saturating_sub(2 * region).saturating_sub(extent) / region
    }

    /// The place of the first end along an axis.
    fn place(&self, step: i32, side: i32, random: &mut Random) -> i32 {
        let region = self.regions.side() as i32 * SUBPIXELS;
        let corner = random.between(region, region + self.choices(step.abs(), side) * region - 1);
        corner - step.min(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vectors(length: f64, angle: Option<f64>) -> Vectors {
        Vectors::new(Regions::paper(), length, angle, 5).expect("they fit")
    }

    #[test]
    fn they_have_the_length_and_the_angle() {
        for (length, angle) in [(50.0, 45.0), (3.0, 200.0), (300.0, -80.0), (0.0, 10.0)] {
            let (sine, cosine) = f64::to_radians(angle).sin_cos();
            for index in 0..200 {
                let [p, q] = vectors(length, Some(angle)).ends(index);
                let off = |step: i32, part: f64| (f64::from(step) - 16.0 * length * part).abs();
                assert!(off(q.x - p.x, cosine) <= 0.5 + 1e-9 && off(q.y - p.y, sine) <= 0.5 + 1e-9);
            }
        }
    }

    /// A region around them stays free, and both ends of what is left are reached.
    #[test]
    fn they_are_everywhere_a_region_from_the_border() {
        for angle in [Some(30.0), Some(250.0), None] {
            let vectors = vectors(100.0, angle);
            let all: Vec<ScreenVertex> = (0..40_000).flat_map(|index| vectors.ends(index)).collect();
            for (places, side) in
                [(all.iter().map(|v| v.x).collect::<Vec<_>>(), 1280), (all.iter().map(|v| v.y).collect(), 1024)]
            {
                let (least, greatest) = (places.iter().min().copied(), places.iter().max().copied());
                assert!(least >= Some(2048) && least < Some(2048 + 30), "{least:?}");
                assert!(greatest <= Some(16 * side - 2048) && greatest > Some(16 * side - 2 * 2048), "{greatest:?}");
            }
        }
    }

    #[test]
    fn each_place_in_a_region_is_equally_often() {
        let vectors = vectors(50.0, Some(135.0));
        let mut eighths = [[0; 8]; 2];
        for index in 0..16_000 {
            let [p, q] = vectors.ends(index);
            for (axis, corner) in [p.x.min(q.x), p.y.min(q.y)].into_iter().enumerate() {
                eighths[axis][(corner % 2048 / 256) as usize] += 1;
            }
        }
        assert!(eighths.as_flattened().iter().all(|times| (1850..2150).contains(times)), "{eighths:?}");
    }

    #[test]
    fn any_angle_is_equally_often() {
        let vectors = vectors(200.0, None);
        let mut eighths = [0; 8];
        for index in 0..8000 {
            let [p, q] = vectors.ends(index);
            let turn = f64::from(q.y - p.y).atan2(f64::from(q.x - p.x)) / std::f64::consts::TAU;
            eighths[(8.0 * turn.rem_euclid(1.0)) as usize % 8] += 1;
        }
        assert!(eighths.iter().all(|times| (880..1120).contains(times)), "{eighths:?}");
    }

    #[test]
    fn their_numbers_and_seeds_make_them() {
        let of = |seed| {
            let vectors = Vectors::new(Regions::paper(), 50.0, None, seed).expect("they fit");
            (0..100).map(|index| vectors.ends(index)).collect::<Vec<_>>()
        };
        assert_eq!(of(1), of(1));
        assert!(of(1).iter().zip(of(2)).all(|(one, other)| *one != other));
    }

    #[test]
    fn vectors_that_do_not_fit_are_a_sentence() {
        let refused =
            |length, angle| Vectors::new(Regions::paper(), length, angle, 1).expect_err("too long").to_string();
        assert_eq!(
            refused(641.0, Some(90.0)),
            "vectors of 641 pixels on a screen of 1280x1024 in regions of 128x128: they have to fit with a region around them, and one \
             more to move in: take shorter ones or a larger screen"
        );
        assert!(
            Vectors::new(Regions::paper(), 640.0, Some(90.0), 1).is_ok()
                && Vectors::new(Regions::paper(), 641.0, Some(0.0), 1).is_ok()
        );
        for (length, angle) in
            [(700.0, None), (-1.0, None), (f64::NAN, Some(0.0)), (f64::INFINITY, Some(3.0)), (1.0, Some(f64::NAN))]
        {
            assert!(refused(length, angle).contains("take shorter ones"), "{length}, {angle:?}");
        }
    }
}
