//! The integer rule of shading against float shading, and at its extremes.

use proptest::prelude::*;
use std::sync::{Arc, LazyLock};
use tilewright_scenes::Texture;
use tilewright_scenes::deferred::{Appearance, Parameters, Shader, ShaderLight, ShaderMaterial};

static CHECKER: LazyLock<Arc<Texture>> = LazyLock::new(|| Arc::new(Texture::generated("checker").unwrap()));

/// The shading of an untextured surface in floats, from the constants of the shader.
fn in_floats(shader: &Shader, parameters: &Parameters, material: ShaderMaterial) -> [f64; 3] {
    let normal = parameters.normal.map(f64::from);
    let length = normal.iter().map(|n| n * n).sum::<f64>().sqrt();
    let cosine = |direction: [i16; 3]| {
        let sum: f64 = normal.iter().zip(direction).map(|(n, d)| n * f64::from(d)).sum();
        (sum / (256.0 * length)).clamp(0.0, 1.0)
    };
    let (mut diffuse, mut specular) = (f64::from(shader.ambient) / 255.0, 0.0);
    for light in &shader.lights {
        let (brightness, lit) = (f64::from(light.brightness) / 255.0, cosine(light.direction));
        diffuse += brightness * lit;
        if lit > 0.0 {
            specular += brightness * cosine(light.half).powi(1 << material.squarings);
        }
    }
    let highlight = 255.0 * specular.min(1.0) * f64::from(material.specular) / 255.0;
    parameters.rgb.map(|channel| (f64::from(channel) * diffuse.min(1.0) + highlight).min(255.0))
}

fn direction() -> impl Strategy<Value = [i16; 3]> {
    [-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64].prop_map(|d| {
        let length = d.iter().map(|n| n * n).sum::<f64>().sqrt().max(1e-9);
        d.map(|n| (n / length * 256.0).round().clamp(-255.0, 255.0) as i16)
    })
}

fn light() -> impl Strategy<Value = ShaderLight> {
    (direction(), direction(), any::<u8>()).prop_map(|(direction, half, brightness)| ShaderLight {
        direction,
        half,
        brightness,
    })
}

fn shader() -> impl Strategy<Value = Shader> {
    let material = (any::<u8>(), 0..=7_u8).prop_map(|(specular, squarings)| ShaderMaterial {
        is_lit: true,
        texture: None,
        specular,
        squarings,
    });
    (0..80_u8, proptest::collection::vec(light(), 0..5), material).prop_map(|(ambient, lights, material)| Shader {
        background: [1, 2, 3],
        ambient,
        lights,
        materials: vec![material],
        textures: vec![CHECKER.clone()],
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(3000) })]

    /// At most one unit too bright, from a product. Too dark by at most a floor for each light and one each for sum and
    /// products. A highlight of power p multiplies the errors of a cosine, about four units of 2^-12, by at most p.
    #[test]
    fn shading_is_what_it_is_in_floats(shader in shader(), normal in direction(), length in 40..128_i16, rgb in any::<[u8; 3]>()) {
        let parameters = Parameters { normal: normal.map(|n| n * length), rgb, ..Parameters::default() };
        let material = shader.materials[0];
        let got = shader.shade(Appearance::from(parameters));
        let lights = shader.lights.len() as f64;
        let power = f64::from(1 << material.squarings);
        let most = 3.0 + lights + lights * f64::from(material.specular) * (4.0 * power / 4096.0).min(1.0);
        // Where a cosine is about 0, rounding decides whether there is a highlight.
        let turned = |light: &ShaderLight| {
            let sum: i32 = parameters.normal.iter().zip(light.direction).map(|(&n, d)| i32::from(n) * i32::from(d)).sum();
            sum > 0 && sum < 256 * 16 * i32::from(length)
        };
        prop_assume!(normal != [0; 3] && !shader.lights.iter().any(turned));
        for (got, exact) in got.iter().zip(in_floats(&shader, &parameters, material)) {
            let less = exact - f64::from(*got);
            prop_assert!((-1.0..most).contains(&less), "{} less than {} with {:?}", less, exact, parameters);
        }
    }

    /// Eight equal samples, shaded once, give the colour of each, up to a rounding of the normal.
    #[test]
    fn eight_samples_alike_are_as_one(shader in shader(), normal in direction(), rgb in any::<[u8; 3]>()) {
        let word = Appearance::from(Parameters { normal: normal.map(|n| n * 127), rgb, ..Parameters::default() });
        prop_assert_eq!(shader.shade_once(&[word; 8]), shader.shade(word));
        prop_assert_eq!(shader.shade_once(&[Appearance::EMPTY; 8]), shader.background);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

    /// For every word and every constant, nothing overflows (an unoptimised build checks this), with one shading per
    /// pixel or eight.
    #[test]
    fn no_word_overflows(
        mut shader in shader(),
        words in proptest::collection::vec(any::<[u8; 21]>(), 8),
        extreme in any::<bool>(),
        textured in any::<bool>(),
    ) {
        if extreme {
            let most = ShaderLight { direction: [-255; 3], half: [-255; 3], brightness: 255 };
            shader.lights = vec![most; 256];
            shader.ambient = 255;
        }
        shader.materials[0].texture = textured.then_some(0);
        let words = words.into_iter().map(|mut bytes| {
            bytes[3] = bytes[3].saturating_sub(200);
            bytes[17] = 0;
            Appearance::from_bytes(bytes)
        });
        let words: Vec<Appearance> = words.collect();
        words.iter().for_each(|&word| { shader.shade(word); });
        shader.shade_once(&words.try_into().unwrap());
    }
}

/// A light straight ahead on a surface of 200, by hand.
#[test]
fn a_colour_is_the_sum_of_its_parts() {
    let light = ShaderLight { direction: [0, 0, -255], half: [0, 0, -255], brightness: 128 };
    let lit = ShaderMaterial { is_lit: true, texture: None, specular: 51, squarings: 5 };
    let shader = Shader {
        background: [9; 3],
        ambient: 30,
        lights: vec![light],
        materials: vec![lit, ShaderMaterial { is_lit: false, ..lit }],
        textures: Vec::new(),
    };
    let of = |material, normal| {
        Appearance::from(Parameters { normal, rgb: [200, 100, 0], material, ..Parameters::default() })
    };
    // The unit normal is 4095, the cosine floor(4095 255 / 256) = 4079, diffuse 30 + floor(128 4080 / 4096) = 157; the cosine's power 32
    // is 3574, so the highlight is floor(111 52 / 256) = 22.
    assert_eq!(shader.shade(of(0, [0, 0, -32767])), [123 + 22, 61 + 22, 22]);
    // From behind and without a normal there is only ambient light.
    assert_eq!(shader.shade(of(0, [0, 0, 32767])), [24, 12, 0]);
    assert_eq!(shader.shade(of(0, [0; 3])), [24, 12, 0]);
    assert_eq!(shader.shade(of(1, [0; 3])), [200, 100, 0]);
    assert_eq!(shader.shade(Appearance::EMPTY), [9; 3]);
}

/// As above, but on five samples of eight: less of the surface's colour, of its highlight, and of the background each.
#[test]
fn a_highlight_is_as_large_as_what_is_covered() {
    let light = ShaderLight { direction: [0, 0, -255], half: [0, 0, -255], brightness: 128 };
    let lit = ShaderMaterial { is_lit: true, texture: None, specular: 51, squarings: 5 };
    let shader =
        Shader { background: [80; 3], ambient: 30, lights: vec![light], materials: vec![lit], textures: Vec::new() };
    let near = Appearance::from(Parameters { normal: [0, 0, -32767], rgb: [200, 100, 0], ..Parameters::default() });
    let samples = std::array::from_fn(|i| if i < 5 { near } else { Appearance::EMPTY });
    // Colours are 125, 63 and 0, at 158/256; of the highlight 22 it is floor(22 5 / 8) = 13, and of the background 30.
    assert_eq!(shader.shade_once(&samples), [77 + 13 + 30, 38 + 13 + 30, 13 + 30]);
}

/// Six samples of a surface, of which two have another colour; one of another material, which counts as the least; and one of nothing.
#[test]
fn samples_in_part_covered_are_mixed_with_the_background() {
    let materials = vec![ShaderMaterial::default(), ShaderMaterial::default()];
    let shader = Shader { background: [80, 0, 255], ambient: 0, lights: Vec::new(), materials, textures: Vec::new() };
    let of =
        |z, red, material| Appearance::from(Parameters { z, rgb: [red, 10, 255], material, ..Parameters::default() });
    let (near, far, other) = (of(5, 100, 0), of(6, 20, 0), of(9, 0, 1));
    let samples = [near, far, near, Appearance::EMPTY, near, other, far, near];
    // (5 100 + 2 20 + 4) / 8 = 68 and 10 of background; (7 10 + 4) / 8; (7 255 + 4) / 8 = 223 and 32.
    assert_eq!(shader.shade_once(&samples), [68 + 10, 9, 223 + 32]);
}
