//! Trilinear filtering in integers: the four nearest texels on each of two levels, interpolated.

use super::Texture;
use crate::deferred::between;

impl Texture {
    /// The texture's colour at (u, v), with 16 bits of fraction each, on a level in 1/16. Beyond the finest level it is
    /// that of the finest.
    ///
    /// The levels are `floor(level / 16)` and the next finer one. [`between`] interpolates their [`Texture::bilinear`]
    /// colours with the weight 16 `(level mod 16)`.
    ///
    /// ```
    /// use tilewright_scenes::Texture;
    ///
    /// let texture = Texture::new(1, vec![[0; 3], [255; 3], [255; 3], [0; 3]])?;
    /// // In the middle of the lower left texel, on both levels, and halfway between them.
    /// let at = |level| texture.trilinear([0x4000; 2], level)[0];
    /// assert_eq!([at(16), at(0), at(8), at(160)], [0, 128, 64, 0]);
    /// # Ok::<(), tilewright_scenes::SceneError>(())
    /// ```
    pub fn trilinear(&self, uv: [u16; 2], level: u16) -> [u8; 3] {
        let coarse = u32::from(level >> 4);
        if coarse >= self.level() {
            return self.bilinear(uv, self.level());
        }
        let weight = (level & 15) as u8 * 16;
        mixed(self.bilinear(uv, coarse), self.bilinear(uv, coarse + 1), weight)
    }

    /// The texture's colour at (u, v) on one level: interpolated first along both rows, then between them, by
    /// [`between`].
    ///
    /// The place in texels is `floor(u 2^level / 2^8) - 2^7`, in 1/2^8 and modulo 2^(level + 8), since a texel's colour is that of
    /// its middle. Its whole part is the texel to the left, and its fraction the weight of the one to the right.
    ///
    /// # Panics
    /// If there is no such level.
    pub fn bilinear(&self, uv: [u16; 2], level: u32) -> [u8; 3] {
        let last = (1_u32 << level) - 1;
        let place = uv.map(|part| ((u32::from(part) << level) >> 8).wrapping_sub(1 << 7));
        let [[i, right], [j, above]] = place.map(|place| [place >> 8 & last, ((place >> 8) + 1) & last]);
        let [along, up] = place.map(|place| place as u8);
        let row = |j| mixed(self.texel(level, i, j), self.texel(level, right, j), along);
        mixed(row(j), row(above), up)
    }
}

fn mixed(a: [u8; 3], b: [u8; 3], weight: u8) -> [u8; 3] {
    [0, 1, 2].map(|channel| between(a[channel], b[channel], weight))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn texture() -> impl Strategy<Value = Texture> {
        (0..5_u32).prop_flat_map(|level| {
            proptest::collection::vec(any::<[u8; 3]>(), 1 << (2 * level))
                .prop_map(move |texels| Texture::new(level, texels).unwrap())
        })
    }

    /// The colour of a level at (u, v), in floats: a tent over the middles of the texels.
    fn exact(texture: &Texture, [u, v]: [u16; 2], level: u32, channel: usize) -> f64 {
        let side = f64::from(1_u32 << level);
        let place = |part: u16| f64::from(part) / 65536.0 * side - 0.5;
        let (x, y) = (place(u), place(v));
        let texel = |i: f64, j: f64| {
            let [i, j] = [i, j].map(|at| at.rem_euclid(side) as u32);
            f64::from(texture.texel(level, i, j)[channel])
        };
        let (i, j) = (x.floor(), y.floor());
        let row = |j: f64| texel(i, j) * (i + 1.0 - x) + texel(i + 1.0, j) * (x - i);
        row(j) * (j + 1.0 - y) + row(j + 1.0) * (y - j)
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(1000) })]

        /// Each of three roundings subtracts less than a unit. Cutting a place to 1/256 subtracts less than one for
        /// each axis and level.
        #[test]
        fn filtering_is_exact_to_its_roundings(texture in texture(), uv in any::<[u16; 2]>(), level in 0..96_u16) {
            let got = texture.trilinear(uv, level);
            for (channel, &got) in got.iter().enumerate() {
                let level = f64::from(level).min(16.0 * f64::from(texture.level())) / 16.0;
                let coarse = exact(&texture, uv, level.floor() as u32, channel);
                let fine = exact(&texture, uv, level.ceil() as u32, channel);
                let exact = coarse + (fine - coarse) * (level - level.floor());
                prop_assert!((-5.0..2.0).contains(&(f64::from(got) - exact)), "{} for {}", got, exact);
            }
        }

        /// If all texels have one colour, so has the result; otherwise it stays between the least and the greatest.
        #[test]
        fn filtering_adds_no_colour(texture in texture(), uv in any::<[u16; 2]>(), level in 0..96_u16) {
            let got = texture.trilinear(uv, level);
            for channel in 0..3 {
                let all = texture.texels(texture.level()).iter().map(|texel| texel[channel]);
                prop_assert!(all.clone().min() <= Some(got[channel]) && Some(got[channel]) <= all.max());
            }
        }
    }

    #[test]
    fn the_middle_of_a_texel_has_its_colour_and_neighbours_go_round() {
        let texels: Vec<[u8; 3]> = (0..16).map(|n| [16 * n, 255 - n, n]).collect();
        let texture = Texture::new(2, texels).unwrap();
        for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
            let middle = [i, j].map(|at| (at << 14 | 1 << 13) as u16);
            assert_eq!(texture.trilinear(middle, 32), texture.texel(2, i, j));
        }
        // Between the last column and the first.
        let left = texture.bilinear([0, 1 << 13], 2);
        assert_eq!(left, mixed(texture.texel(2, 3, 0), texture.texel(2, 0, 0), 128));
    }
}
