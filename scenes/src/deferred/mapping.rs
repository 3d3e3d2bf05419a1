//! Texture coordinates of a triangle as planes: u/w, v/w and 1/w, each linear on the screen, and the level of detail.
//!
//! A common factor of the three cancels when u/w is divided by 1/w. So each triangle has a unit of its own that makes
//! best use of 16 bits. Source: Heckbert and Moreton, 1991 (rational linear interpolation); PFL-BYTES.

use super::packet::AppearanceVertex;
use crate::packet::SUBPIXELS;
use crate::setup::signed_area2;
use glam::DVec2;

/// The most repeats of a texture over a triangle, counted from the whole number below its least coordinate. So the
/// quotient has 7 bits before the point. A texture with more repeats is stretched.
pub const MOST_REPEATS: f64 = 128.0;

/// The least scale of a vertex. At a vertex, u/w is then at most 128 times the scale. At every pixel it is below 256
/// times the scale, including rounding.
const LEAST_SCALE: f64 = 8.0;

/// The greatest scale, u/w and v/w of a vertex.
const MOST: f64 = 65535.0;

/// u/w, v/w and 1/w at three corners with these texture coordinates and these distances w along the line of sight, all
/// positive.
///
/// Coordinates are first moved by whole repeats, so that the least of each is from 0 to 1. Let r be the greater of 1
/// and the greatest coordinate. The nearest corner has the scale `floor(65535 / r)`. The others have less in proportion
/// to 1/w, also rounded down and at least 8. u/w is u times the scale, rounded to the nearest whole number.
pub(crate) fn mapped(coordinates: [DVec2; 3], distances: [f64; 3]) -> ([[u16; 2]; 3], [u16; 3]) {
    let [a, b, c] = coordinates;
    let least = a.min(b).min(c).floor();
    let moved = coordinates.map(|uv| uv - least);
    let most = moved.iter().fold(1.0, |most: f64, uv| most.max(uv.x).max(uv.y));
    let repeats = most.min(MOST_REPEATS);
    let stretched = moved.map(|uv| uv * (repeats / most));
    let nearest = distances.iter().copied().fold(f64::INFINITY, f64::min);
    let scale = distances.map(|w| (MOST / repeats * (nearest / w)).floor().max(LEAST_SCALE));
    let part = |i: usize| (stretched[i] * scale[i]).to_array().map(|part| (part + 0.5).floor() as u16);
    ([0, 1, 2].map(part), scale.map(|scale| scale as u16))
}

/// The level of detail at scale 2^16, in 1/8, of a triangle with an area.
///
/// Where the scale is q and u/w is U, moving a pixel to the right changes u by `(U_x q - U q_x) / q^2`. The numerator
/// is constant along a row, so its greatest value is at a vertex. N is the greatest length of these numerators for (u,
/// v), along x or y, at a vertex. A pixel is at most `N / q^2` textures long, so the level `2 log2(q) - log2(N)` has
/// one texel a pixel. At q = 2^16 that is `32 - log2(N)`. The result is its ceiling in 1/8, clamped to 0 and 255/8.
pub(crate) fn level(vertices: &[AppearanceVertex; 3]) -> u8 {
    let [v0, v1, v2] = vertices;
    let to = |v: &AppearanceVertex| [f64::from(v.at.x - v0.at.x), f64::from(v.at.y - v0.at.y)];
    let ([x1, y1], [x2, y2]) = (to(v1), to(v2));
    let per_pixel = f64::from(SUBPIXELS) / signed_area2(&vertices.map(|v| v.at)) as f64;
    // Along x and along y.
    let slopes = |value: &dyn Fn(&AppearanceVertex) -> u16| {
        let (d1, d2) = (f64::from(value(v1)) - f64::from(value(v0)), f64::from(value(v2)) - f64::from(value(v0)));
        [(d1 * y2 - d2 * y1) * per_pixel, (d2 * x1 - d1 * x2) * per_pixel]
    };
    let (of_u, of_v, of_scale) = (slopes(&|v| v.uv[0]), slopes(&|v| v.uv[1]), slopes(&|v| v.scale));
    let squares = vertices.iter().flat_map(|v| {
        let scale = f64::from(v.scale);
        [0, 1].map(|axis| {
            let change = |slope: f64, part: u16| slope * scale - f64::from(part) * of_scale[axis];
            let (u, v) = (change(of_u[axis], v.uv[0]), change(of_v[axis], v.uv[1]));
            u * u + v * v
        })
    });
    let greatest = squares.fold(0.0, f64::max);
    if greatest < 1.0 {
        return u8::MAX;
    }
    // Of the square, so half of it.
    (256 - eighths(greatest) / 2).clamp(0, 255) as u8
}

/// `floor(8 log2(n))` of a number from 1 on, by multiplication alone, which IEEE 754 fixes to the last bit.
fn eighths(number: f64) -> i32 {
    let exponent = |n: f64| (n.to_bits() >> 52) as i32 - 1023;
    let whole = exponent(number);
    let mantissa = f64::from_bits((number.to_bits() & ((1 << 52) - 1)) | (1023 << 52));
    let squared = (0..3).fold(mantissa, |m, _| m * m);
    8 * whole + exponent(squared)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deferred::coordinate;
    use crate::packet::ScreenVertex;
    use glam::dvec2;
    use proptest::prelude::*;

    fn place() -> impl Strategy<Value = f64> {
        prop_oneof![3 => -3.0..3.0, 1 => -40.0..40.0, 1 => -1e4..1e4]
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

        /// At the vertices the quotient equals the coordinate, apart from whole repeats and rounding. It is in the
        /// range of the division, with a margin for the rounding of planes.
        #[test]
        fn the_quotient_is_the_coordinate(
            corners in [(place(), place()), (place(), place()), (place(), place())],
            nearest in 1e-3..1e3_f64,
            farther in [1.0..4096.0_f64, 1.0..4096.0_f64],
        ) {
            let corners = corners.map(|(u, v)| dvec2(u, v));
            let distances = [nearest * farther[0], nearest, nearest * farther[1]];
            let (uv, scale) = mapped(corners, distances);
            let [a, b, c] = corners;
            let least = a.min(b).min(c).floor();
            let most = corners.iter().map(|&uv| (uv - least).max_element()).fold(1.0, f64::max);
            for i in 0..3 {
                let exact = (corners[i] - least).to_array();
                for (part, exact) in uv[i].into_iter().zip(exact) {
                    prop_assert!(scale[i] >= 8 && u32::from(part) + 2 < 256 * (u32::from(scale[i]) - 1));
                    if most <= MOST_REPEATS {
                        let error = f64::from(part) / f64::from(scale[i]) - exact;
                        prop_assert!(error.abs() * f64::from(scale[i]) <= 0.5 + 1e-6, "{}", error);
                    }
                }
            }
        }

        /// Where 1/w is linear, the level is that of the pixel's length in textures, found from a small step on the
        /// screen.
        #[test]
        fn a_level_is_the_logarithm_of_a_pixels_length(
            (x1, y1, x2, y2) in (200..2000_i32, -300..300_i32, -300..300_i32, 200..2000_i32),
            uv in [(0.0..1.0, 0.0..1.0), (0.0..1.0, 0.0..1.0), (0.0..1.0, 0.0..1.0_f64)],
            farther in [1.0..8.0_f64, 1.0..8.0_f64],
        ) {
            let (uv, scale) = mapped(uv.map(|(u, v)| dvec2(u, v)), [1.0, farther[0], farther[1]]);
            let vertices: [AppearanceVertex; 3] = std::array::from_fn(|i| {
                let (x, y) = [(0, 0), (x1, y1), (x2, y2)][i];
                let at = ScreenVertex { x, y, z: 1, rgb: [0; 3] };
                AppearanceVertex { at, normal: [0; 3], uv: uv[i], scale: scale[i] }
            });
            // u and v at a position on the screen, in pixels, from the exact planes.
            let area = f64::from(x1 * y2 - x2 * y1);
            let at = |x: f64, y: f64| {
                let (x, y) = (16.0 * x, 16.0 * y);
                let (b, c) = ((x * f64::from(y2) - f64::from(x2) * y) / area, (f64::from(x1) * y - x * f64::from(y1)) / area);
                let plane = |of: &dyn Fn(&AppearanceVertex) -> u16| {
                    let [p, q, r] = [0, 1, 2].map(|i| f64::from(of(&vertices[i])));
                    p + (q - p) * b + (r - p) * c
                };
                let scale = plane(&|v| v.scale);
                [plane(&|v| v.uv[0]) / scale, plane(&|v| v.uv[1]) / scale]
            };
            let length = |v: &AppearanceVertex| {
                let (x, y, step) = (f64::from(v.at.x) / 16.0, f64::from(v.at.y) / 16.0, 1e-4);
                let along = |dx: f64, dy: f64| {
                    let (p, q) = (at(x - dx, y - dy), at(x + dx, y + dy));
                    ((p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2)).sqrt() / (2.0 * step)
                };
                f64::max(along(step, 0.0), along(0.0, step)) * f64::from(v.scale).powi(2)
            };
            let exact = 32.0 - vertices.iter().map(length).fold(0.0, f64::max).log2();
            let found = f64::from(level(&vertices)) / 8.0;
            prop_assert!(exact > 31.8 || (-0.01..0.14).contains(&(found - exact)), "{} for {}", found, exact);
        }
    }

    #[test]
    fn a_texture_that_repeats_too_often_is_stretched() {
        let (uv, scale) = mapped([dvec2(-3.5, 0.0), dvec2(252.5, 0.5), dvec2(0.0, 1e9)], [1.0; 3]);
        assert_eq!(scale, [511; 3]);
        assert_eq!((uv[2], uv[0]), ([0, 65408], [0, 0]));
        assert_eq!(uv[2][1], 128 * 511);
        assert_eq!(coordinate(uv[2][1], scale[2]), 0);
    }

    #[test]
    fn logarithms_are_floors() {
        for n in 1..5000 {
            let n = f64::from(n) * 1.37;
            assert_eq!(eighths(n), (8.0 * n.log2()).floor() as i32, "{n}");
        }
        assert_eq!([1.0, 2.0, 1024.0, 3.0].map(eighths), [0, 8, 80, 12]);
    }
}
