//! Colours that tell many things apart.

/// A colour of a hue, in turns of the circle of hues, as bright as `light`: 0 to 255 is its brightest part.
pub fn colour(turn: f64, light: f64) -> [u8; 3] {
    [0.0, 4.0, 2.0].map(|shift: f64| {
        let distance = ((6.0 * turn + shift).rem_euclid(6.0) - 3.0).abs();
        (light * (0.15 + 0.85 * (distance - 1.0).clamp(0.0, 1.0))) as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_goes_from_red_by_green_and_blue_to_red() {
        let third = |k: i32| colour(f64::from(k) / 3.0, 255.0);
        assert_eq!([0, 1, 2, 3].map(third), [[255, 38, 38], [38, 255, 38], [38, 38, 255], [255, 38, 38]]);
        assert_eq!(colour(0.0, 100.0), [100, 15, 15]);
    }
}
