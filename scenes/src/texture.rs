//! Textures: square pictures with all their smaller versions (mip-maps; Williams, 1983), and how they are filtered.

pub(crate) mod file;
mod filter;
mod fit;
mod generated;
mod picture;
mod window;

pub use generated::GENERATED;
pub(crate) use window::Window;

use crate::error::SceneError;

/// The most levels below a texture's finest: a texture has at most 1024 texels a side.
pub const MOST_LEVEL: u32 = 10;

/// A texture on all of its levels: level l has 2^l x 2^l texels.
///
/// Texel (i, j) is the i-th from the left in the j-th row from below, as v points upward. A texture repeats on all
/// sides.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Texture {
    /// By level, the coarsest first: 1 texel, 4, 16 and so on.
    levels: Vec<Vec<[u8; 3]>>,
}

impl Texture {
    /// A texture of side 2^level from its texels, row by row from below. Each texel of a coarser level is
    /// `floor((a + b + c + d + 2) / 4)` of the four that it covers.
    ///
    /// ```
    /// use tilewright_scenes::Texture;
    ///
    /// let texture = Texture::new(1, vec![[0; 3], [255, 0, 8], [255; 3], [3; 3]])?;
    /// assert_eq!((texture.level(), texture.texel(1, 1, 0), texture.texel(0, 0, 0)), (1, [255, 0, 8], [128, 65, 67]));
    /// # Ok::<(), tilewright_scenes::SceneError>(())
    /// ```
    ///
    /// # Errors
    /// [`SceneError::Invalid`] if the level is above [`MOST_LEVEL`], or there are not 4^level texels.
    pub fn new(level: u32, texels: Vec<[u8; 3]>) -> Result<Texture, SceneError> {
        if level > MOST_LEVEL || texels.len() != 1 << (2 * level) {
            return Err(SceneError::invalid(
                format!("a texture of level {level} has {} texels", texels.len()),
                format!("give 4^level texels, level at most {MOST_LEVEL}"),
            ));
        }
        Ok(Texture::of_texels(level, texels))
    }

    /// As [`Texture::new`], of as many texels as it takes.
    fn of_texels(level: u32, texels: Vec<[u8; 3]>) -> Texture {
        let mut levels = vec![texels];
        for level in (0..level).rev() {
            levels.push(halved(&levels[levels.len() - 1], 1 << level));
        }
        levels.reverse();
        Texture { levels }
    }

    /// The finest level.
    pub fn level(&self) -> u32 {
        self.levels.len() as u32 - 1
    }

    /// Texel (i, j) of a level.
    ///
    /// # Panics
    /// If there is no such level, or i or j is not below 2^level.
    pub fn texel(&self, level: u32, i: u32, j: u32) -> [u8; 3] {
        assert!(i >> level == 0, "column {i} of level {level}");
        self.levels[level as usize][((j as usize) << level) + i as usize]
    }

    /// All texels of a level, row by row from below.
    ///
    /// # Panics
    /// If there is no such level.
    pub fn texels(&self, level: u32) -> &[[u8; 3]] {
        &self.levels[level as usize]
    }
}

/// The texels of the next coarser level, which is `side` texels wide.
fn halved(fine: &[[u8; 3]], side: usize) -> Vec<[u8; 3]> {
    let mean = |i: usize, j: usize| {
        let first = 4 * side * j + 2 * i;
        let four = [first, first + 1, first + 2 * side, first + 2 * side + 1];
        [0, 1, 2].map(|channel| {
            let sum: u16 = four.iter().map(|&texel| u16::from(fine[texel][channel])).sum();
            ((sum + 2) / 4) as u8
        })
    };
    (0..side).flat_map(|j| (0..side).map(move |i| (i, j))).map(|(i, j)| mean(i, j)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_texel_is_the_mean_of_four() {
        let texels: Vec<[u8; 3]> = (0..64_u8).map(|n| [n.wrapping_mul(37), n.wrapping_mul(101), 255 - n]).collect();
        let texture = Texture::new(3, texels).unwrap();
        for level in 0..3 {
            for (i, j) in (0..1 << level).flat_map(|i| (0..1 << level).map(move |j| (i, j))) {
                let fine = |di, dj| texture.texel(level + 1, 2 * i + di, 2 * j + dj);
                let four = [fine(0, 0), fine(1, 0), fine(0, 1), fine(1, 1)];
                for (channel, &mean) in texture.texel(level, i, j).iter().enumerate() {
                    let sum: u32 = four.iter().map(|texel| u32::from(texel[channel])).sum();
                    assert_eq!(u32::from(mean), (sum + 2) / 4);
                }
            }
        }
    }

    #[test]
    fn a_texture_has_as_many_texels_as_its_level_says() {
        let refused = |level, count| Texture::new(level, vec![[0; 3]; count]).unwrap_err().to_string();
        assert_eq!(refused(1, 3), "a texture of level 1 has 3 texels: give 4^level texels, level at most 10");
        assert_eq!(
            refused(11, 1 << 22),
            "a texture of level 11 has 4194304 texels: give 4^level texels, level at most 10"
        );
        assert_eq!(Texture::new(0, vec![[9; 3]]).unwrap().level(), 0);
    }
}
