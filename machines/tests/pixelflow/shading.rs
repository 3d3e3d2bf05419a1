//! What a pixel's colour is, of any appearance word.

use std::sync::Arc;

use proptest::prelude::*;
use tilewright_machines::pixelflow::constants;
use tilewright_rtl::pixelflow::emulator::Pixel;
use tilewright_rtl::pixelflow::fields::{Field, appearance, bank, texture};
use tilewright_rtl::pixelflow::instruction::{Instruction, Sync};
use tilewright_rtl::pixelflow::programs::{NO_TEXTURE, Shading, ShadingOnce};
use tilewright_scenes::Texture;
use tilewright_scenes::deferred::{Appearance, Parameters, Shader, ShaderLight, ShaderMaterial};

/// Where a pixel's appearance word is.
pub const WORD: u64 = bank(1);
/// Where the least word of samples is kept.
const LEAST: u64 = 160;
const COLOUR: u64 = bank(0) + 5;

fn read(pixel: &Pixel, field: Field) -> u32 {
    (0..field.bytes).rev().fold(0, |number, byte| number << 8 | u32::from(pixel.memory[field.byte(byte) as usize]))
}

/// What the texture unit does: the four nearest texels on a level, and those on the next finer one, if there is.
fn look_up(pixel: &mut Pixel, textures: &[Arc<Texture>]) {
    let number = read(pixel, texture::TEXTURE);
    if i64::from(number) == NO_TEXTURE {
        return;
    }
    let found = &textures[number as usize];
    let [u, v] = texture::UV.map(|field| read(pixel, field));
    let level = read(pixel, texture::LEVEL);
    for finer in 0..2 {
        let level = (level + finer).min(found.level());
        let last = (1 << level) - 1;
        let place = [u, v].map(|part| ((part << level >> 8).wrapping_sub(128) >> 8) & last);
        for (x, y) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let texel = found.texel(level, (place[0] + x) & last, (place[1] + y) & last);
            for (channel, value) in texel.into_iter().enumerate() {
                let at = texture::texel(finer.into(), [x.into(), y.into()], channel as u64);
                pixel.memory[at.address as usize] = value;
            }
        }
    }
}

/// A pixel where all is left from before.
fn littered() -> Pixel {
    let mut pixel = Pixel::new();
    pixel.memory = std::array::from_fn(|at| (at * 37 + 11) as u8);
    (pixel.flag, pixel.enable, pixel.carry, pixel.accumulator) = (true, 0x55, true, 99);
    pixel
}

/// A word comes from the network.
fn put(pixel: &mut Pixel, word: Appearance) {
    for (j, byte) in word.bytes().into_iter().enumerate() {
        pixel.memory[(WORD + appearance::BYTES) as usize - 1 - j] = byte;
    }
}

/// The colour that the programs give to a word.
fn shaded(shader: &Shader, word: Appearance) -> [u8; 3] {
    let mut pixel = littered();
    put(&mut pixel, word);
    run(&mut pixel, shader)
}

/// The colour that they give to eight samples, shaded once.
fn shaded_once(shader: &Shader, words: &[Appearance; 8]) -> [u8; 3] {
    let constants = constants(shader);
    let once = ShadingOnce { shading: Shading { shader: &constants, word: LEAST, colour: COLOUR } };
    let mut pixel = littered();
    for (number, word) in words.iter().enumerate() {
        put(&mut pixel, *word);
        pixel.run(&once.take(number as u64, WORD), 0, 0);
    }
    pixel.run(&once.combine(), 0, 0);
    parts(&mut pixel, shader, [once.before_texture(), once.under_texture(), once.after_texture()])
}

/// The colour that the programs give to a pixel with a word.
pub fn run(pixel: &mut Pixel, shader: &Shader) -> [u8; 3] {
    let constants = constants(shader);
    let programs = Shading { shader: &constants, word: WORD, colour: COLOUR };
    parts(pixel, shader, [programs.before_texture(), programs.under_texture(), programs.after_texture()])
}

/// The colour, after the parts before, beside and behind the texture unit.
fn parts(pixel: &mut Pixel, shader: &Shader, [before, under, after]: [Vec<Instruction<u64>>; 3]) -> [u8; 3] {
    pixel.run(&before, 0, 0);
    if before.iter().any(|instruction| instruction.sync == Sync::StartTexture as u64) {
        look_up(pixel, &shader.textures);
    }
    pixel.run(&under, 0, 0);
    pixel.run(&after, 0, 0);
    [2, 1, 0].map(|at| pixel.memory[(COLOUR + at) as usize])
}

fn direction() -> impl Strategy<Value = [i16; 3]> {
    let unit = [-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64].prop_map(|parts| {
        let length = parts.iter().map(|part| part * part).sum::<f64>().sqrt().max(0.1);
        parts.map(|part| (part / length * 256.0).round().clamp(-255.0, 255.0) as i16)
    });
    let part = -255..=255_i16;
    prop_oneof![4 => unit, 1 => [part.clone(), part.clone(), part], 1 => Just([0; 3]), 1 => Just([255, -255, 255])]
}

fn lights() -> impl Strategy<Value = Vec<ShaderLight>> {
    let brightness = prop_oneof![3 => any::<u8>(), 1 => Just(255), 1 => Just(0)];
    let light = (direction(), direction(), brightness).prop_map(|(direction, half, brightness)| ShaderLight {
        direction,
        half,
        brightness,
    });
    proptest::collection::vec(light, 0..5)
}

fn textures() -> impl Strategy<Value = Vec<Arc<Texture>>> {
    let texture = prop_oneof![4 => 0..5_u32, 1 => Just(7)].prop_flat_map(|level| {
        let texel = prop_oneof![3 => any::<[u8; 3]>(), 1 => Just([255; 3]), 1 => Just([0; 3])];
        proptest::collection::vec(texel, 1 << (2 * level))
            .prop_map(move |texels| Arc::new(Texture::new(level, texels).expect("as many texels")))
    });
    proptest::collection::vec(texture, 0..3)
}

fn shaders() -> impl Strategy<Value = Shader> {
    textures().prop_flat_map(|textures| {
        let count = textures.len() as u32;
        let texture = proptest::option::weighted(0.6, 0..count.max(1)).prop_map(move |t| t.filter(|_| count > 0));
        let specular = prop_oneof![2 => any::<u8>(), 1 => Just(0), 1 => Just(255)];
        let material = (prop::bool::weighted(0.8), texture, specular, 0..=7_u8)
            .prop_map(|(is_lit, texture, specular, squarings)| ShaderMaterial { is_lit, texture, specular, squarings });
        let materials = proptest::collection::vec(material, 1..6);
        (any::<[u8; 3]>(), any::<u8>(), lights(), materials, Just(textures)).prop_map(
            |(background, ambient, lights, materials, textures)| Shader {
                background,
                ambient,
                lights,
                materials,
                textures,
            },
        )
    })
}

/// Numbers of all magnitudes.
fn number() -> impl Strategy<Value = u16> {
    prop_oneof![3 => any::<u16>(), 2 => (any::<u16>(), 0..16_u32).prop_map(|(n, by)| n >> by), 1 => Just(u16::MAX), 1 => Just(0)]
}

fn component() -> impl Strategy<Value = i16> {
    prop_oneof![4 => any::<i16>(), 2 => -20..20_i16, 1 => Just(i16::MIN), 1 => Just(i16::MAX)]
}

/// Words whose u/w and v/w are below 256 times 1/w, as the front end sees to; or 1/w is 0.
fn words() -> impl Strategy<Value = Appearance> {
    let normal = [component(), component(), component()];
    let rest = (any::<[u8; 3]>(), [number(), number()], number(), any::<u8>(), any::<u8>());
    let covered = (0..(1_u32 << 24) - 2, normal, rest).prop_map(|(z, normal, (rgb, uv, scale, material, level))| {
        let bound = u32::from(scale) * 256;
        let uv = uv.map(|part| if scale == 0 { part } else { (u32::from(part) % bound) as u16 });
        Appearance::from(Parameters { z, normal, rgb, uv, material, level, scale })
    });
    prop_oneof![20 => covered, 1 => Just(Appearance::EMPTY)]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(150) })]

    #[test]
    fn colours_are_those_of_the_shader(shader in shaders(), words in proptest::collection::vec(words(), 40)) {
        for word in words {
            let word = match word.is_empty() {
                true => word,
                false => {
                    let own = word.parameters();
                    Appearance::from(Parameters { material: own.material % shader.materials.len() as u8, ..own })
                }
            };
            prop_assert_eq!(shaded(&shader, word), shader.shade(word), "{:?}", word.parameters());
        }
    }
}

/// The samples of a pixel: of 1 to 8 words, some empty.
fn samples() -> impl Strategy<Value = Vec<Appearance>> {
    let chosen = proptest::collection::vec((any::<prop::sample::Index>(), prop::bool::weighted(0.2)), 8);
    let choose = |(words, chosen): (Vec<Appearance>, Vec<(prop::sample::Index, bool)>)| {
        let one = |(word, is_empty): &(prop::sample::Index, bool)| match is_empty {
            true => Appearance::EMPTY,
            false => *word.get(&words),
        };
        chosen.iter().map(one).collect()
    };
    (proptest::collection::vec(words(), 1..=8), chosen).prop_map(choose).boxed()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(100) })]

    #[test]
    fn eight_samples_are_shaded_once_as_the_shader_does(
        shader in shaders(),
        samples in proptest::collection::vec((samples(), 1..=3_u8), 20),
    ) {
        for (words, materials) in samples {
            let word = |word: &Appearance| match word.is_empty() {
                true => *word,
                false => {
                    let own = word.parameters();
                    let material = own.material % materials % shader.materials.len() as u8;
                    Appearance::from(Parameters { material, ..own })
                }
            };
            let words = std::array::from_fn(|sample| word(&words[sample]));
            let found = shaded_once(&shader, &words);
            prop_assert_eq!(found, shader.shade_once(&words), "{:?}", words.map(|word| word.parameters()));
        }
    }
}
