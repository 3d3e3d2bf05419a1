//! Textures that appear only once. Machines repeat every texture, so such a texture is put into the middle of a larger
//! one, whose rest has the colours of its edges.

use super::{MOST_LEVEL, Texture};
use glam::DVec2;

/// A square of the plane of texture coordinates that becomes a texture of its own.
#[derive(Debug, PartialEq)]
pub(crate) struct Window {
    /// Its lower left corner; whole texels.
    low: DVec2,
    /// The ratio of its side to the texture's, as a power of two.
    doublings: u32,
}

impl Window {
    /// The window around everything between these, with at least a texel to spare; `None` if the texture would be less
    /// than a texel of it.
    pub(crate) fn round(least: DVec2, most: DVec2, texture: &Texture) -> Option<Window> {
        // Its corner is at a texel's corner, and where possible at a quarter of the texture, so that coarser levels
        // keep their texels.
        let grain = f64::from(1_u32 << texture.level().min(2));
        let needed = (most - least).max_element() + 2.0 / grain;
        let doublings = (0..=MOST_LEVEL).find(|&n| f64::from(1_u32 << n) >= needed)?;
        let side = f64::from(1_u32 << doublings);
        let low = (((least + most - side) / 2.0) * grain).floor() / grain;
        let window = Window { low, doublings };
        (f64::from(1_u32 << window.level(texture)) >= grain).then_some(window)
    }

    /// The finest level of the texture that is in it.
    pub(crate) fn level(&self, texture: &Texture) -> u32 {
        texture.level().min(MOST_LEVEL - self.doublings)
    }

    /// The position of a place in it.
    pub(crate) fn place(&self, uv: DVec2) -> DVec2 {
        (uv - self.low) / f64::from(1_u32 << self.doublings)
    }
}

impl Texture {
    /// The content of a window of a texture that appears only once.
    pub(crate) fn within(&self, window: &Window) -> Texture {
        let level = window.level(self);
        let side = 1_i64 << level;
        let first = window.low * side as f64;
        let texel = |i: i64, j: i64| {
            let [i, j] = [i, j].map(|at| at.clamp(0, side - 1) as u32);
            self.texel(level, i, j)
        };
        let (left, below) = (first.x as i64, first.y as i64);
        let all = 1_i64 << (level + window.doublings);
        let texels =
            (0..all).flat_map(|j| (0..all).map(move |i| (i, j))).map(|(i, j)| texel(left + i, below + j)).collect();
        Texture::of_texels(level + window.doublings, texels)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    fn texture(level: u32) -> Texture {
        let side = 1_u32 << level;
        let texels = (0..side * side).map(|n| [(n * 37) as u8, (n * 91) as u8, (n * 13) as u8]).collect();
        Texture::new(level, texels).expect("as many texels as it takes")
    }

    /// In the middle of each texel the colour is the texel's, and outside the nearest texel's.
    #[test]
    fn a_window_goes_on_with_the_colours_of_edges() {
        for level in [0, 1, 2, 4] {
            let texture = texture(level);
            let side = f64::from(1_u32 << level);
            let (least, most) = (dvec2(-0.75, 0.0), dvec2(1.0, 1.6));
            let window = Window::round(least, most, &texture).expect("it is small");
            let seen = texture.within(&window);
            let count = (4.0 * side) as i32;
            for (i, j) in (-count..2 * count).flat_map(|i| (-count..2 * count).map(move |j| (i, j))) {
                let uv = dvec2(f64::from(i) + 0.5, f64::from(j) + 0.5) / side;
                if uv.cmplt(least).any() || uv.cmpgt(most).any() {
                    continue;
                }
                let place = window.place(uv).to_array().map(|part| (part * 65536.0).round() as u16);
                let nearest = (uv * side).floor().clamp(DVec2::ZERO, DVec2::splat(side - 1.0));
                let expected = texture.texel(level, nearest.x as u32, nearest.y as u32);
                assert_eq!(seen.bilinear(place, seen.level()), expected, "level {level}: {uv}");
            }
        }
    }

    #[test]
    fn a_window_that_is_too_wide_is_none() {
        let round = |most: f64, level: u32| Window::round(DVec2::ZERO, DVec2::splat(most), &texture(level));
        assert_eq!(round(2000.0, 4), None);
        assert_eq!(round(f64::MAX, 4), None);
        let window = round(100.0, 4).expect("of 2^3 texels in 2^10");
        assert_eq!((window.doublings, window.level(&texture(4))), (7, 3));
        assert_eq!(round(500.0, 4), None);
    }
}
