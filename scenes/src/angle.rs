//! Sine, cosine and tangent from + - * / alone, so that a camera is bit-equal on every machine.
//!
//! IEEE 754 fixes the result of + - * / and of the square root, but not of sin, cos or tan. Those come from the
//! system's library and differ between systems in the last bit, which is enough to move a snapped vertex. This module
//! reduces the angle exactly to -45..45 degrees and then uses the Taylor series. The error is below 1e-15.

/// Sine and cosine of an angle in degrees. Multiples of 90 degrees are exact.
pub fn sin_cos(degrees: f64) -> (f64, f64) {
    // Exact: so is the remainder of a division by 360, and so are the subtractions of multiples of 90 from a nearby
    // number.
    let turned = degrees % 360.0;
    let quarters = (turned / 90.0).round();
    let rest = turned - quarters * 90.0;
    let (s, c) = series(rest * (std::f64::consts::PI / 180.0));
    match (quarters as i64).rem_euclid(4) {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}

/// Tangent of an angle in degrees.
pub fn tan(degrees: f64) -> f64 {
    let (s, c) = sin_cos(degrees);
    s / c
}

/// Taylor series of sine and cosine round 0, for |t| up to pi/4: the last terms are below 2^-60.
fn series(t: f64) -> (f64, f64) {
    let square = t * t;
    let (mut sine, mut cosine) = (1.0, 1.0);
    let mut n = 18.0;
    // Horner's scheme, from the smallest term.
    while n >= 2.0 {
        sine = 1.0 - square / (n * (n + 1.0)) * sine;
        cosine = 1.0 - square / ((n - 1.0) * n) * cosine;
        n -= 2.0;
    }
    (t * sine, cosine)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_library_to_the_last_bits() {
        for tenth in -8000..8000 {
            let degrees = f64::from(tenth) / 10.0;
            let (s, c) = sin_cos(degrees);
            assert!((s - degrees.to_radians().sin()).abs() < 4e-15, "{degrees}");
            assert!((c - degrees.to_radians().cos()).abs() < 4e-15, "{degrees}");
        }
        assert!((tan(22.5) - (2f64.sqrt() - 1.0)).abs() < 1e-15);
    }

    #[test]
    fn quarter_turns_are_exact() {
        assert_eq!(
            [0.0, 90.0, 180.0, -90.0, 450.0].map(sin_cos),
            [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0), (1.0, 0.0)]
        );
    }
}
