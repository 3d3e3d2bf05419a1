//! A palette for things that only their colour distinguishes, such as the units of a machine.

/// Lightness of three neighbours in OKLCH. Each contrasts with white and with black.
const LIGHTNESS: [f64; 3] = [0.70, 0.56, 0.63];
/// Chroma of all colours in OKLCH; less if a screen has no such colour.
const CHROMA: f64 = 0.17;
/// The hue of the first colour. Each next hue is a golden section of the circle further, so that any few neighbours are far apart.
const FIRST: f64 = 0.72;
const TURN: f64 = 0.618_033_988_749_895;

/// The red, green and blue of a number's colour. Neighbours differ in hue and in lightness. So do numbers that are 4, 8 or 16 apart, which are neighbours in
/// the columns of a matrix. Each colour is legible on a light and on a dark background.
///
/// ```
/// use tilewright_report::palette;
///
/// assert_eq!(palette::colour(3), palette::colour(3));
/// assert_ne!(palette::colour(3), palette::colour(4));
/// ```
pub fn colour(number: u32) -> [u8; 3] {
    let hue = (FIRST + TURN * f64::from(number)).fract() * std::f64::consts::TAU;
    let lightness = LIGHTNESS[number as usize % LIGHTNESS.len()];
    let fits = |chroma: &f64| linear(lightness, *chroma, hue).iter().all(|part| (0.0..=1.0).contains(part));
    let chroma = (0..=17).map(|step| CHROMA * (1.0 - f64::from(step) / 17.0)).find(fits).unwrap_or(0.0);
    linear(lightness, chroma, hue).map(|part| (255.0 * gamma(part)).round() as u8)
}

/// The colour in CSS, such as `#1461a8`.
pub(crate) fn css(number: u32) -> String {
    let [red, green, blue] = colour(number);
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// Linear red, green and blue of OKLCH.
fn linear(lightness: f64, chroma: f64, hue: f64) -> [f64; 3] {
    let (a, b) = (chroma * hue.cos(), chroma * hue.sin());
    let cone = |of_a: f64, of_b: f64| (lightness + of_a * a + of_b * b).powi(3);
    let [l, m, s] = [
        cone(0.396_337_777_4, 0.215_803_757_3),
        cone(-0.105_561_345_8, -0.063_854_172_8),
        cone(-0.089_484_177_5, -1.291_485_548),
    ];
    [
        4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
        -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
        -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701 * s,
    ]
}

fn gamma(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn luminance(colour: [u8; 3]) -> f64 {
        let linear = colour.map(|it| {
            let it = f64::from(it) / 255.0;
            if it <= 0.040_45 { it / 12.92 } else { ((it + 0.055) / 1.055).powf(2.4) }
        });
        0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
    }

    /// Roughly the visible distance of two colours; one of 0.02 is hardly visible.
    fn distance(one: u32, other: u32) -> f64 {
        let place = |number: u32| {
            let hue = (FIRST + TURN * f64::from(number)) * std::f64::consts::TAU;
            [LIGHTNESS[number as usize % 3], 0.12 * hue.cos(), 0.12 * hue.sin()]
        };
        let [one, other] = [place(one), place(other)];
        (0..3).map(|part| (one[part] - other[part]).powi(2)).sum::<f64>().sqrt()
    }

    #[test]
    fn neighbours_in_a_row_and_in_a_matrix_are_far_apart() {
        for number in 0..256 {
            for step in [1, 2, 3, 4, 8, 16] {
                assert!(distance(number, number + step) > 0.07, "{number} and {step} more");
            }
        }
        for (one, other) in (0..20).flat_map(|one| (0..one).map(move |other| (one, other))) {
            assert!(distance(one, other) > 0.04, "{one} and {other}");
        }
    }

    #[test]
    fn colours_stand_out_on_light_and_on_dark() {
        for number in 0..256 {
            let light = luminance(colour(number)) + 0.05;
            assert!(1.05 / light > 2.4 && light / 0.05 > 3.0, "{number}: {:?}", colour(number));
        }
        let mut all: Vec<_> = (0..256).map(colour).collect();
        all.sort_unstable();
        all.dedup();
        assert!(all.len() > 250, "{}", all.len());
    }
}
