//! Linear colours, encoded for screens.

/// The sRGB encoding (IEC 61966-2-1) of a linear channel, clamped to 0 to 1. It uses only + - * / and square roots, so
/// that it is bit-equal on every machine.
pub(super) fn encoded(linear: f64) -> f64 {
    let linear = linear.clamp(0.0, 1.0);
    if linear <= 0.003_130_8 {
        return 12.92 * linear;
    }
    // The power 1/2.4 is the power 1/4 times the power 1/6.
    let power = linear.sqrt().sqrt() * cube_root(linear).sqrt();
    // As in the standard, except that 1 stays 1.
    1.0 - 1.055 * (1.0 - power)
}

/// Newton's method, from above, for numbers from 0.003 to 1.
fn cube_root(number: f64) -> f64 {
    (0..16).fold(1.0, |root, _| (2.0 * root + number / (root * root)) / 3.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_encoding_is_that_of_the_standard() {
        for i in 0..=10_000 {
            let linear = f64::from(i) / 10_000.0;
            let exact = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
            assert!((encoded(linear) - exact).abs() < 1e-14, "{linear}");
        }
        assert_eq!([encoded(-1.0), encoded(0.0), encoded(1.0), encoded(7.0)], [0.0, 0.0, 1.0, 1.0]);
    }
}
