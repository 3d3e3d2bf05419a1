//! Random rectangles of one area and one form: the polygons of the paper's examples.
//!
//! Source: facts D and MPG-L (5:1, at random place and angle). Each rectangle is a function of the seed and its number, computed with + - * /
//! and square roots alone, so that all machines and any number of threads have the same rectangles.

use crate::random::Random;
use tilewright_rtl::parameter::ParameterError;
use tilewright_scenes::packet::{FARTHEST_VERTEX, NEAREST_VERTEX, SUBPIXELS};
use tilewright_scenes::{Polygon, ScreenVertex, Size, angle, set_up_polygon_of_any_size};

/// The least distance of a rectangle from the border of the screen, in pixels.
const MARGIN: i32 = 2;

/// An endless set of random rectangles that lie on the screen.
///
/// ```
/// use tilewright_machines::quadtree::Rectangles;
/// use tilewright_scenes::Size;
///
/// let size = Size::new(1024, 1024)?;
/// let rectangles = Rectangles::new(size, 100.0, 5.0, 1)?;
/// let first = rectangles.polygon(0);
/// assert_eq!(first.edges.len(), 4);
/// assert_eq!(first, Rectangles::new(size, 100.0, 5.0, 1)?.polygon(0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Rectangles {
    screen: Size,
    /// In 1/16 pixel.
    long: f64,
    /// In 1/16 pixel.
    short: f64,
    seed: u64,
}

impl Rectangles {
    /// Rectangles of `area` pixels with sides of `ratio` to 1.
    ///
    /// # Errors
    /// They would not fit on the screen at every angle, or their shorter side would be less than 1/8 pixel. Then snapping to 1/16 pixel would
    /// change their form.
    pub fn new(screen: Size, area: f64, ratio: f64, seed: u64) -> Result<Rectangles, ParameterError> {
        let subpixels = f64::from(SUBPIXELS);
        let short = (area / ratio).sqrt() * subpixels;
        let long = short * ratio;
        // The longest diagonal, and the increase by snapping two sides.
        let needed = (long * long + short * short).sqrt() + 2.0;
        let given = f64::from((screen.width().min(screen.height()) as i32 - 2 * MARGIN) * SUBPIXELS);
        if short.min(long) >= 2.0 && needed <= given {
            return Ok(Rectangles { screen, long, short, seed });
        }
        Err(ParameterError(format!(
            "rectangles of {area} pixels and {ratio}:1 on a screen of {screen}: they have to fit at every angle, {MARGIN} pixels from \
             the border, with sides of at least 1/8 pixel"
        )))
    }

    /// Rectangle number `index`: one packet of four edges, flat in depth and colour.
    ///
    /// Its sides are snapped to 1/16 pixel, so it is a parallelogram, nearly a rectangle. The mean of the areas is right.
    pub fn polygon(&self, index: u64) -> Polygon {
        let mut random = Random::new(self.seed, index);
        let corners = self.corners(&mut random);
        let range = u64::from(FARTHEST_VERTEX - NEAREST_VERTEX) + 1;
        let z = NEAREST_VERTEX + (random.next() % range) as u32;
        let [r, g, b, ..] = random.next().to_le_bytes();
        let vertices = corners.map(|(x, y)| ScreenVertex { x, y, z, rgb: [r, g, b] });
        // With an area, on the screen, convex and in one plane.
        set_up_polygon_of_any_size(&vertices, self.screen).remove(0)
    }

    /// The corners in 1/16 pixel.
    fn corners(&self, random: &mut Random) -> [(i32, i32); 4] {
        // A rectangle is symmetric under half a rotation.
        let (sine, cosine) = angle::sin_cos(180.0 * random.fraction());
        let snapped = |x: f64, y: f64| (x.round() as i32, y.round() as i32);
        let along = snapped(self.long * cosine, self.long * sine);
        let across = snapped(-self.short * sine, self.short * cosine);
        let mut place = |first: i32, second: i32, side: u32| {
            let (least, greatest) = (first.min(0) + second.min(0), first.max(0) + second.max(0));
            random.between(MARGIN * SUBPIXELS - least, (side as i32 - MARGIN) * SUBPIXELS - greatest)
        };
        let x = place(along.0, across.0, self.screen.width());
        let y = place(along.1, across.1, self.screen.height());
        [(0, 0), along, (along.0 + across.0, along.1 + across.1), across].map(|(dx, dy)| (x + dx, y + dy))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangles(area: f64, seed: u64) -> Rectangles {
        Rectangles::new(Size::new(1024, 1024).expect("in range"), area, 5.0, seed).expect("they fit")
    }

    fn corners(rectangles: &Rectangles, index: u64) -> [(i32, i32); 4] {
        rectangles.corners(&mut Random::new(rectangles.seed, index))
    }

    #[test]
    fn they_lie_on_the_screen_with_four_edges() {
        for area in [0.1, 1.0, 30.0, 1e3, 1e5] {
            let rectangles = rectangles(area, 3);
            for index in 0..500 {
                assert_eq!(rectangles.polygon(index).edges.len(), 4);
                let inside = 2 * 16..=1022 * 16;
                assert!(corners(&rectangles, index).iter().all(|(x, y)| inside.contains(x) && inside.contains(y)));
            }
        }
    }

    /// Thin rectangles reach both margins.
    #[test]
    fn they_are_everywhere_on_the_screen() {
        let rectangles = rectangles(1.0, 4);
        let all: Vec<(i32, i32)> = (0..20_000).flat_map(|index| corners(&rectangles, index)).collect();
        for place in [all.iter().map(|c| c.0).collect::<Vec<_>>(), all.iter().map(|c| c.1).collect()] {
            assert!(place.iter().min() <= Some(&40) && place.iter().max() >= Some(&(1024 * 16 - 40)));
            let mean = place.iter().map(|&p| i64::from(p)).sum::<i64>() / place.len() as i64;
            assert!((mean - 8192).abs() < 100, "{mean}");
        }
    }

    /// The means of area, sides and angle are right; single values differ by snapping.
    #[test]
    fn they_have_the_area_the_form_and_all_angles() {
        for area in [1.0, 10.0, 1e3] {
            let rectangles = rectangles(area, 5);
            let count = 4000;
            let mean = (0..count).map(|index| rectangles.polygon(index).area()).sum::<f64>() / count as f64;
            assert!((mean / area - 1.0).abs() < 0.004, "{mean} of {area}");
            let short = (area / 5.0).sqrt() * 16.0;
            let mut eighths = [0; 8];
            for index in 0..count {
                let [a, b, _, d] = corners(&rectangles, index).map(|(x, y)| (f64::from(x), f64::from(y)));
                let length = |(x, y): (f64, f64)| ((x - a.0).powi(2) + (y - a.1).powi(2)).sqrt();
                assert!((length(b) - 5.0 * short).abs() < 0.71 && (length(d) - short).abs() < 0.71);
                let turn = (b.1 - a.1).atan2(b.0 - a.0).rem_euclid(std::f64::consts::PI) / std::f64::consts::PI;
                eighths[(8.0 * turn) as usize % 8] += 1;
            }
            assert!(eighths.iter().all(|times| (410..590).contains(times)), "{eighths:?}");
        }
    }

    #[test]
    fn their_numbers_and_seeds_make_them() {
        let of = |seed| (0..100).map(|index| rectangles(50.0, seed).polygon(index)).collect::<Vec<_>>();
        assert_eq!(of(1), of(1));
        let (one, other) = (of(1), of(2));
        assert!(one.iter().zip(&other).all(|(one, other)| one.edges != other.edges));
        assert!((1..100).all(|index| one[index].edges != one[index - 1].edges));
    }

    /// The rectangles are the same on every machine.
    #[test]
    fn they_are_pinned() {
        let first_three = |index| <[_; 3]>::try_from(&corners(&rectangles(1000.0, 1), index)[..3]).expect("three");
        assert_eq!(first_three(0), [(14747, 13019), (14727, 14150), (14501, 14146)]);
        assert_eq!(first_three(1), [(8870, 13506), (9998, 13589), (9981, 13815)]);
        assert_eq!(first_three(1 << 40), [(963, 1022), (2033, 1390), (1959, 1604)]);
    }

    #[test]
    fn what_cannot_be_is_a_sentence() {
        let sentence = |width, height, area, ratio| {
            let screen = Size::new(width, height).expect("in range");
            Rectangles::new(screen, area, ratio, 0).expect_err("impossible").to_string()
        };
        assert_eq!(
            sentence(640, 480, 1e5, 5.0),
            "rectangles of 100000 pixels and 5:1 on a screen of 640x480: they have to fit at every angle, 2 pixels from the border, \
             with sides of at least 1/8 pixel"
        );
        for (area, ratio) in [(0.07, 5.0), (0.0, 5.0), (-3.0, 5.0), (f64::NAN, 1.0), (9.0, f64::INFINITY), (1.0, 0.0)] {
            assert!(sentence(64, 64, area, ratio).starts_with("rectangles of"));
        }
        assert!(sentence(1, 1, 0.1, 1.0).starts_with("rectangles of"));
    }
}
