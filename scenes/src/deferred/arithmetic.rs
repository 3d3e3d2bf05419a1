//! The integer rules of shading, one function a step: exact floors, so that every way of computing them gives the same
//! bits.
//!
//! Widths suit processors of 8 bits without a multiplier, which square, divide and take roots digit by digit (facts
//! E4). Cosines and components of unit normals have 12 fraction bits. With 8 bits, a highlight of power 32 would show
//! its steps.

/// Fraction bits of unit normals and of cosines.
pub const UNIT_BITS: u32 = 12;
/// The greatest cosine: 1 minus one unit.
pub const MOST_COSINE: u16 = (1 << UNIT_BITS) - 1;
/// The most squarings of a cosine: highlights have powers up to 2^7.
pub const MOST_SQUARINGS: u8 = 7;

/// A normal scaled to length 1: each component n becomes `sign(n) floor(|n| 2^12 / (s + 1))` with
/// `s = floor(sqrt(x^2 + y^2 + z^2))`.
///
/// The sum has 32 bits, s has 16, and a component is between -4095 and 4095, since |n| <= s. The normal 0 gives 0
/// everywhere. A component's magnitude is at most `1 + 2^12 / s` units of 2^-12 below the exact one, and never above
/// it.
///
/// ```
/// use tilewright_scenes::deferred::unit_normal;
///
/// // 3, 4 and 12 thousand: length 13 thousand.
/// assert_eq!(unit_normal([3000, -4000, 12000]), [945, -1260, 3780]);
/// assert_eq!(unit_normal([0; 3]), [0; 3]);
/// ```
pub fn unit_normal(normal: [i16; 3]) -> [i16; 3] {
    let squares = normal.map(|n| u32::from(n.unsigned_abs()).pow(2));
    let length = squares.iter().sum::<u32>().isqrt();
    normal.map(|n| {
        let magnitude = (u32::from(n.unsigned_abs()) << UNIT_BITS) / (length + 1);
        if n < 0 { -(magnitude as i16) } else { magnitude as i16 }
    })
}

/// The cosine between a unit normal and a direction of 8 fraction bits and a sign: `floor(n . d / 2^8)`, clamped to 0
/// and [`MOST_COSINE`]; 12 fraction bits.
///
/// The sum is below 2^22 in magnitude. A light behind the surface gives 0.
///
/// ```
/// use tilewright_scenes::deferred::cosine;
///
/// assert_eq!(cosine([4095, 0, 0], [128, 0, 221]), 2047);
/// assert_eq!(cosine([4095, 0, 0], [-1, 255, 0]), 0);
/// ```
pub fn cosine(unit: [i16; 3], direction: [i16; 3]) -> u16 {
    let sum: i32 = unit.iter().zip(direction).map(|(&n, d)| i32::from(n) * i32::from(d)).sum();
    (sum >> 8).clamp(0, MOST_COSINE.into()) as u16
}

/// A cosine to the power 2^squarings: `c` becomes `floor(c^2 / 2^12)` that many times.
///
/// At most `2^squarings - 1` units below the exact power, and never above it.
///
/// ```
/// use tilewright_scenes::deferred::power;
///
/// assert_eq!((power(2048, 0), power(2048, 1), power(2048, 3)), (2048, 1024, 16));
/// ```
pub fn power(cosine: u16, squarings: u8) -> u16 {
    (0..squarings).fold(cosine, |c, _| (u32::from(c).pow(2) >> UNIT_BITS) as u16)
}

/// The contribution of a light of this brightness, 255 for 1, at this cosine: `floor(brightness (cosine + 1) / 2^12)`.
///
/// ```
/// use tilewright_scenes::deferred::{MOST_COSINE, brightness_at};
///
/// assert_eq!((brightness_at(200, MOST_COSINE), brightness_at(200, 2047), brightness_at(200, 0)), (200, 100, 0));
/// ```
pub fn brightness_at(brightness: u8, cosine: u16) -> u8 {
    ((u32::from(brightness) * (u32::from(cosine) + 1)) >> UNIT_BITS) as u8
}

/// The product of two numbers in which 255 stands for 1: `floor(a (b + 1) / 2^8)`. It is exactly a if b is 255, and b
/// if a is.
///
/// ```
/// use tilewright_scenes::deferred::product;
///
/// assert_eq!((product(90, 255), product(255, 90), product(90, 0), product(90, 127)), (90, 90, 0, 45));
/// ```
pub fn product(a: u8, b: u8) -> u8 {
    ((u16::from(a) * (u16::from(b) + 1)) >> 8) as u8
}

/// The sum, saturated at 255.
pub fn saturated(sum: u16) -> u8 {
    sum.min(255) as u8
}

/// A texture coordinate: `floor(part 2^16 / scale)`, of which the 16 bits of fraction are kept, as a texture repeats.
///
/// `part` is u/w and `scale` is 1/w, in the same unit. The front end ensures `part < 256 scale`. So a restoring
/// division of 24 steps suffices, whose first remainder is `floor(part / 2^8)`. Division by zero gives ones.
///
/// ```
/// use tilewright_scenes::deferred::coordinate;
///
/// assert_eq!((coordinate(500, 1000), coordinate(3500, 1000)), (0x8000, 0x8000));
/// ```
pub fn coordinate(part: u16, scale: u16) -> u16 {
    (u32::from(part) << 16).checked_div(scale.into()).unwrap_or(u32::MAX) as u16
}

/// The binary logarithm of 1 to 65535, piecewise linear, with 5 fraction bits: `32 p + floor(2^5 (n / 2^p - 1))`, where
/// p is the place of the leading one. It is at most 0.118 below the exact one, and never above it.
///
/// ```
/// use tilewright_scenes::deferred::logarithm;
///
/// assert_eq!([1, 2, 3, 65535].map(logarithm), [0, 32, 48, 511]);
/// ```
pub fn logarithm(number: u16) -> u16 {
    let place = number.max(1).ilog2();
    // The leading one moves to bit 15, and the five bits below it are the fraction.
    let fraction = (u32::from(number) << (15 - place) >> 10) & 31;
    (32 * place + fraction) as u16
}

/// The level of detail in 1/16, at a pixel where 1/w is `scale`: `2 level - (511 - logarithm(scale))`, not below 0.
///
/// `level`, in 1/8, is the level at the greatest scale. From d times the distance, a pixel covers d^2 times as much of
/// the surface along the line of sight, so twice the logarithm of 1/w is subtracted. A logarithm in 1/32 equals twice
/// itself in 1/16.
///
/// ```
/// use tilewright_scenes::deferred::level_at;
///
/// // 64 texels a side at the nearest point, and 16 from twice as far.
/// assert_eq!((level_at(8 * 6, 65535), level_at(8 * 6, 32767)), (16 * 6, 16 * 6 - 32));
/// assert_eq!(level_at(8, 100), 0);
/// ```
pub fn level_at(level: u8, scale: u16) -> u16 {
    (2 * u16::from(level)).saturating_sub(511 - logarithm(scale))
}

/// Interpolates between a and b, with b at weight 256: `floor((a (256 - weight) + b weight) / 2^8)`. It is exactly a if
/// both are equal.
///
/// ```
/// use tilewright_scenes::deferred::between;
///
/// assert_eq!((between(10, 20, 0), between(10, 20, 128), between(20, 10, 255), between(7, 7, 99)), (10, 15, 10, 7));
/// ```
pub fn between(a: u8, b: u8, weight: u8) -> u8 {
    ((u16::from(a) * (256 - u16::from(weight)) + u16::from(b) * u16::from(weight)) >> 8) as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Components at all magnitudes, and the extremes.
    fn component() -> impl Strategy<Value = i16> {
        prop_oneof![4 => any::<i16>(), 1 => -9..9_i16, 1 => Just(i16::MIN), 1 => Just(i16::MAX)]
    }

    fn direction() -> impl Strategy<Value = [i16; 3]> {
        [-255..=255_i16, -255..=255_i16, -255..=255_i16]
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(4000) })]

        #[test]
        fn a_unit_normal_is_just_below_the_exact_one(normal in [component(), component(), component()]) {
            let length = normal.iter().map(|&n| f64::from(n) * f64::from(n)).sum::<f64>().sqrt();
            for (&n, unit) in normal.iter().zip(unit_normal(normal)) {
                prop_assert!(unit.abs() <= 4095 && (unit == 0 || (unit < 0) == (n < 0)));
                if length > 0.0 {
                    let less = f64::from(n).abs() / length * 4096.0 - f64::from(unit.abs());
                    prop_assert!((0.0..=1.0 + 4096.0 / length.floor()).contains(&less), "{} for {:?}", less, normal);
                }
            }
        }

        #[test]
        fn a_cosine_is_the_floor_of_the_sum(unit in [-4095..=4095_i16, -4095..=4095_i16, -4095..=4095_i16], direction in direction()) {
            let exact: f64 = unit.iter().zip(direction).map(|(&n, d)| f64::from(n) * f64::from(d)).sum::<f64>() / 256.0;
            prop_assert_eq!(f64::from(cosine(unit, direction)), exact.floor().clamp(0.0, 4095.0));
        }

        #[test]
        fn a_power_is_at_most_its_number_of_units_below_the_exact_one(c in 0..=MOST_COSINE, squarings in 0..=MOST_SQUARINGS) {
            let exact = (f64::from(c) / 4096.0).powi(1 << squarings) * 4096.0;
            let less = exact - f64::from(power(c, squarings));
            prop_assert!((-1e-9..=f64::from((1 << squarings) - 1) + 1e-9).contains(&less), "{} of {}", less, exact);
        }

        #[test]
        fn a_coordinate_is_the_fraction_of_the_quotient(scale in 1..=u16::MAX, part in any::<u16>()) {
            let exact = (u64::from(part) * 65536) / u64::from(scale);
            prop_assert_eq!(u64::from(coordinate(part, scale)), exact % 65536);
            // As the machine computes it: 24 steps of a restoring division.
            if u32::from(part) < 256 * u32::from(scale) {
                let (mut remainder, mut quotient) = (u32::from(part >> 8), 0_u32);
                for step in (0..24).rev() {
                    let next = if step >= 16 { u32::from(part) >> (step - 16) & 1 } else { 0 };
                    remainder = remainder << 1 | next;
                    quotient = quotient << 1 | u32::from(remainder >= scale.into());
                    remainder -= if remainder >= scale.into() { u32::from(scale) } else { 0 };
                    prop_assert!(remainder < scale.into());
                }
                prop_assert_eq!(quotient as u16, coordinate(part, scale));
            }
        }
    }

    #[test]
    fn the_longest_normals_do_not_overflow() {
        assert_eq!(unit_normal([i16::MIN; 3]), [-2364; 3]);
        assert_eq!(unit_normal([i16::MIN, 0, 0]), [-4095, 0, 0]);
        assert_eq!(unit_normal([1, 0, 0]), [2048, 0, 0]);
        // A direction is up to one unit longer than 256.
        assert_eq!(cosine([4095, 0, 0], [255, 0, 0]), 4079);
        assert_eq!(cosine([4095; 3], [255; 3]), 4095);
        assert_eq!(cosine([-4095; 3], [255; 3]), 0);
    }

    #[test]
    fn products_are_exact_floors() {
        for a in 0..=255_u8 {
            for b in 0..=255_u8 {
                let exact = f64::from(a) * (f64::from(b) + 1.0) / 256.0;
                assert_eq!(f64::from(product(a, b)), exact.floor());
                assert!((f64::from(product(a, b)) - f64::from(a) * f64::from(b) / 255.0).abs() < 1.0);
            }
            assert_eq!([product(a, 255), product(255, a), product(a, 0), product(0, a)], [a, a, 0, 0]);
            for c in 0..=MOST_COSINE {
                assert_eq!(u32::from(brightness_at(a, c)), u32::from(a) * u32::from(c + 1) / 4096);
            }
        }
    }

    #[test]
    fn a_logarithm_is_just_below_the_exact_one() {
        let mut most = 0.0_f64;
        for n in 1..=u16::MAX {
            let less = f64::from(n).log2() - f64::from(logarithm(n)) / 32.0;
            assert!((-1e-9..0.118).contains(&less), "{less} at {n}");
            assert!(n == 1 || logarithm(n) >= logarithm(n - 1));
            most = most.max(less);
        }
        assert!(most > 0.116);
    }

    #[test]
    fn what_is_between_two_is_an_exact_floor() {
        for (a, b) in (0..=255).flat_map(|a| (0..=255).step_by(5).map(move |b| (a, b))) {
            for weight in 0..=255_u8 {
                let exact = f64::from(a) + (f64::from(b) - f64::from(a)) * f64::from(weight) / 256.0;
                assert_eq!(f64::from(between(a, b, weight)), exact.floor());
            }
        }
    }
}
