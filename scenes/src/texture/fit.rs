//! Pictures of any size, scaled to the square of a texture.
//!
//! The side is the power of two that is nearest to the longer side of the picture, by ratio, and at most 1024. A texel
//! of the square is the mean of the picture over the area that it covers. Let the sides of a picture of w x h pixels be
//! stretched to w S and h S units. A pixel then is S x S units, and a texel of S x S texels is w x h units. So for each
//! channel a texel is
//!
//! ```text
//! floor((2 sum + w h) / (2 w h)),   sum = sum over all pixels of (units in common) (value of the pixel)
//! ```
//!
//! which is the exact mean, rounded to the nearest, halves upward.

use super::MOST_LEVEL;
use image::RgbImage;

/// The level of a texture with these sides, if it can be used unchanged.
pub(super) fn level(width: u32, height: u32) -> Option<u32> {
    (width == height && width.is_power_of_two() && width.ilog2() <= MOST_LEVEL).then(|| width.ilog2())
}

/// The level of the square that preserves most of such a picture.
fn nearest_level(width: u32, height: u32) -> u32 {
    let side = u64::from(width.max(height).clamp(1, 1 << MOST_LEVEL));
    let above = side.next_power_of_two();
    if 2 * side * side >= above * above { above.ilog2() } else { above.ilog2() - 1 }
}

/// The level and the texels of a picture that is not empty, row by row from below as in a texture.
pub(super) fn fitted(picture: &RgbImage) -> (u32, Vec<[u8; 3]>) {
    let (width, height) = picture.dimensions();
    if let Some(level) = level(width, height) {
        return (level, picture.rows().rev().flatten().map(|pixel| pixel.0).collect());
    }
    let level = nearest_level(width, height);
    let side = 1 << level;
    let area = u64::from(width) * u64::from(height);
    let mut texels = Vec::with_capacity(side * side);
    let mut row = Row { of: None, sums: Vec::new() };
    for j in (0..side).rev() {
        let mut sums = vec![[0_u64; 3]; side];
        for (y, units) in shares(j, side, height) {
            for (sum, part) in sums.iter_mut().zip(row.sums(picture, y, side)) {
                add(sum, *part, units);
            }
        }
        texels.extend(sums.iter().map(|sum| sum.map(|channel| ((2 * channel + area) / (2 * area)) as u8)));
    }
    (level, texels)
}

/// A row of the picture, summed for each column of the square; the last one is kept, as two texels may share it.
struct Row {
    of: Option<u32>,
    sums: Vec<[u64; 3]>,
}

impl Row {
    fn sums(&mut self, picture: &RgbImage, y: u32, side: usize) -> &[[u64; 3]] {
        if self.of != Some(y) {
            self.of = Some(y);
            let sum = |i| {
                let mut sum = [0; 3];
                shares(i, side, picture.width())
                    .for_each(|(x, units)| add(&mut sum, picture.get_pixel(x, y).0.map(u64::from), units));
                sum
            };
            self.sums = (0..side).map(sum).collect();
        }
        &self.sums
    }
}

fn add(sum: &mut [u64; 3], part: [u64; 3], units: u64) {
    for (sum, part) in sum.iter_mut().zip(part) {
        *sum += part * units;
    }
}

/// Along one axis, the pixels that the i-th of `side` texels covers of `pixels`, and the units of each; `pixels` units
/// in all.
fn shares(i: usize, side: usize, pixels: u32) -> impl Iterator<Item = (u32, u64)> {
    let (i, side, pixels) = (i as u64, side as u64, u64::from(pixels));
    let (from, to) = (i * pixels, (i + 1) * pixels);
    (from / side..to.div_ceil(side)).map(move |k| (k as u32, to.min((k + 1) * side) - from.max(k * side)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;
    use proptest::prelude::*;

    #[test]
    fn a_picture_becomes_the_nearest_power_of_two() {
        let sides =
            [(1, 1), (3, 1), (640, 480), (700, 480), (725, 9), (1000, 1000), (4000, 3000), (0, 0), (u32::MAX, 1)];
        assert_eq!(sides.map(|(width, height)| nearest_level(width, height)), [0, 2, 9, 9, 10, 10, 10, 0, 10]);
        assert_eq!([(1, 1), (64, 64), (1024, 1024)].map(|(w, h)| level(w, h)), [Some(0), Some(6), Some(10)]);
        assert_eq!([(0, 0), (64, 32), (48, 48), (2048, 2048)].map(|(w, h)| level(w, h)), [None; 4]);
    }

    fn picture() -> impl Strategy<Value = RgbImage> {
        (1..24_u32, 1..24_u32).prop_flat_map(|(width, height)| {
            proptest::collection::vec(any::<[u8; 3]>(), (width * height) as usize)
                .prop_map(move |pixels| RgbImage::from_fn(width, height, |x, y| Rgb(pixels[(y * width + x) as usize])))
        })
    }

    /// The length that two spans have in common.
    fn common(p: [i128; 2], q: [i128; 2]) -> i128 {
        (p[1].min(q[1]) - p[0].max(q[0])).max(0)
    }

    /// Texel (i, j) from above, as a fraction of whole numbers over every pixel of the picture.
    fn exact(picture: &RgbImage, side: i128, i: i128, j: i128, channel: usize) -> (i128, i128) {
        let [width, height] = [picture.width(), picture.height()].map(i128::from);
        let sum = picture.enumerate_pixels().map(|(x, y, pixel)| {
            let [x, y] = [x, y].map(i128::from);
            common([x * side, (x + 1) * side], [i * width, (i + 1) * width])
                * common([y * side, (y + 1) * side], [j * height, (j + 1) * height])
                * i128::from(pixel.0[channel])
        });
        (sum.sum(), width * height)
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

        /// The nearest whole number to the exact mean is at most half away from it, and above it if there are two.
        #[test]
        fn a_texel_is_the_mean_of_what_it_covers(picture in picture()) {
            let (level, texels) = fitted(&picture);
            let side = 1 << level;
            prop_assert_eq!(texels.len() as i128, side * side);
            for (place, texel) in texels.iter().enumerate() {
                let (i, j) = (place as i128 % side, side - 1 - place as i128 / side);
                for (channel, &value) in texel.iter().enumerate() {
                    let (sum, area) = exact(&picture, side, i, j, channel);
                    let twice_off = 2 * (i128::from(value) * area - sum);
                    prop_assert!(-area < twice_off && twice_off <= area, "{} for {}/{}", value, sum, area);
                }
            }
        }
    }
}
