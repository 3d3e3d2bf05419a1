//! Procedural textures, in integers: no picture has to be shipped, and they tile without a seam.

use super::Texture;

/// The names of the generated textures, for scene files.
pub const GENERATED: [&str; 3] = ["checker", "planks", "marble"];

/// The level of the generated textures: 256 x 256 texels.
const LEVEL: u32 = 8;
const SIDE: u32 = 1 << LEVEL;

impl Texture {
    /// A generated texture by its name, one of [`GENERATED`], or `None`.
    ///
    /// ```
    /// use tilewright_scenes::{GENERATED, Texture};
    ///
    /// assert!(GENERATED.iter().all(|name| Texture::generated(name).is_some_and(|texture| texture.level() == 8)));
    /// assert!(Texture::generated("granite").is_none());
    /// ```
    pub fn generated(name: &str) -> Option<Texture> {
        let texel = match name {
            "checker" => checker,
            "planks" => planks,
            "marble" => marble,
            _ => return None,
        };
        let texels = (0..SIDE).flat_map(|j| (0..SIDE).map(move |i| texel(i, j))).collect();
        Some(Texture::new(LEVEL, texels).expect("as many texels as the level has"))
    }
}

/// Two squares by two, light and dark, with a grain.
fn checker(i: u32, j: u32) -> [u8; 3] {
    let is_light = (i < SIDE / 2) == (j < SIDE / 2);
    let base = if is_light { [232, 226, 212] } else { [70, 78, 92] };
    let grain = noise(i, j, [32, 32], 1) / 16;
    shade(base, 248 + grain)
}

/// Four planks, one above the other, each with its own tint, its grain along u, and a joint to the next.
fn planks(i: u32, j: u32) -> [u8; 3] {
    const PLANK: u32 = SIDE / 4;
    let plank = j / PLANK;
    let from_joint = (j % PLANK).min(PLANK - 1 - j % PLANK);
    // The u at which a plank ends; those of neighbours are far apart.
    let from_end = i.wrapping_add(SIDE - 104 * plank % SIDE) % SIDE;
    if from_joint == 0 || from_end < 2 {
        return [58, 36, 22];
    }
    let fine = noise(i, j, [4, 128], 10 + plank);
    let coarse = noise(i, j, [2, 32], 20 + plank);
    let tint = hash(plank, 7, 3) % 36;
    shade([176, 118, 68], 190 + tint + fine / 8 + coarse / 8)
}

/// White stone with dark veins, along the zeros of a wave that noise distorts.
fn marble(i: u32, j: u32) -> [u8; 3] {
    let bend: u32 = (0..4).map(|octave| noise(i, j, [4 << octave; 2], 30 + octave) >> octave).sum();
    // Two waves to a side, so that it tiles without a seam; 512 to a wave.
    let phase = (4 * i + 4 * j + 2 * bend) % 512;
    let from_vein = phase.abs_diff(256);
    let depth = 64_u32.saturating_sub(from_vein);
    let cloud = noise(i, j, [8, 8], 40) / 12;
    shade([236, 232, 226], 235 + cloud - depth * 2)
}

/// A colour at a brightness in 1/256.
fn shade(base: [u32; 3], brightness: u32) -> [u8; 3] {
    base.map(|channel| (channel * brightness / 256).min(255) as u8)
}

/// Smooth noise, 0 to 255, of this many cells along u and along v; it tiles without a seam.
fn noise(i: u32, j: u32, cells: [u32; 2], seed: u32) -> u32 {
    // The position in cells, with 8 bits of fraction.
    let [x, y] = [i * cells[0], j * cells[1]].map(|place| (place << 8) / SIDE);
    let corner = |dx, dy| hash(((x >> 8) + dx) % cells[0], ((y >> 8) + dy) % cells[1], seed) & 255;
    let [along, up] = [x, y].map(|place| smooth(place & 255));
    let row = |dy| corner(0, dy) * (256 - along) + corner(1, dy) * along;
    (row(0) * (256 - up) + row(1) * up) >> 16
}

/// `3 t^2 - 2 t^3`, 8 bits of fraction.
fn smooth(t: u32) -> u32 {
    (t * t * (768 - 2 * t)) >> 16
}

/// A mix of three numbers' bits.
fn hash(x: u32, y: u32, seed: u32) -> u32 {
    let start = x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77) ^ seed.wrapping_mul(0xc2b2_ae3d);
    [15, 13, 16].iter().fold(start, |bits, &shift| (bits ^ (bits >> shift)).wrapping_mul(0x2c1b_3c6d)) >> 8
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Neighbours across the border differ no more than others do.
    #[test]
    fn a_generated_texture_goes_on_without_a_seam() {
        let step = |p: [u8; 3], q: [u8; 3]| p.iter().zip(q).map(|(&p, q)| u32::from(p.abs_diff(q))).sum::<u32>();
        let marble = Texture::generated("marble").unwrap();
        let texel = |i: u32, j: u32| marble.texel(LEVEL, i % SIDE, j % SIDE);
        let across = |i: u32| (0..SIDE).map(|j| step(texel(i, j), texel(i + 1, j))).fold(0, u32::max);
        let up = |j: u32| (0..SIDE).map(|i| step(texel(i, j), texel(i, j + 1))).fold(0, u32::max);
        let last = SIDE - 1;
        assert!(across(last) <= (0..last).map(across).fold(0, u32::max), "{} across the border", across(last));
        assert!(up(last) <= (0..last).map(up).fold(0, u32::max), "{} across the border", up(last));
    }

    #[test]
    fn a_checker_has_two_squares_by_two() {
        let checker = Texture::generated("checker").unwrap();
        let dark = |i, j| checker.texel(LEVEL, i, j)[0] < 128;
        assert_eq!([dark(10, 10), dark(200, 10), dark(10, 200), dark(200, 200)], [false, true, true, false]);
        assert_eq!(checker.texels(LEVEL).iter().filter(|texel| texel[0] < 128).count(), 1 << 15);
    }
}
