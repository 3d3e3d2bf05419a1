//! The clocks of all programs, and the arithmetic of shading.

use proptest::prelude::*;

use super::super::emulator::{Pixel, expression};
use super::super::fields::shading::*;
use super::super::fields::{Field, appearance, bank};
use super::super::schedule::{one_at_a_time, side_by_side};
use super::arithmetic::{Division, Writer};
use super::assembler::load;
use super::light::{self, Combinations};
use super::*;

const REGION: [u32; 2] = [128, 64];
const WORDS: Words = Words { kept: bank(0), new: 0 };

const LIGHTS: [Light; 4] = [
    Light { direction: [-148, -148, -147], half: [-82, -82, -227], brightness: 255 },
    Light { direction: [201, -99, -124], half: [115, -57, -221], brightness: 170 },
    Light { direction: [57, 170, -183], half: [31, 91, -237], brightness: 85 },
    Light { direction: [-240, 77, 44], half: [-197, 63, -151], brightness: 119 },
];

/// A material with a texture of 1024 x 1024 texels, and highlights of power 32.
const SHINY: Material =
    Material { is_lit: true, texture: Some(Texture { number: 0, finest: 10 }), specular: 180, squarings: 5 };

fn of_lights(lights: &[Light]) -> Vec<Instruction<u64>> {
    let (mut w, mut sums) = (Writer::default(), Combinations::default());
    lights.iter().for_each(|it| light::light(&mut w, &mut sums, it, Some([5, 5])));
    w.0
}

/// A row of the table: the program, its clocks one at a time and side by side, and figures to compare.
type Row = (&'static str, Vec<Instruction<u64>>, [u64; 2], &'static str);

fn table() -> Vec<Row> {
    let edges = [(3, 4, -99), (-9, 1, 300), (2, -8, 111)].map(|(a, b, c)| Expression { a, b, c });
    let plane = Expression { a: 1, b: 2, c: 3 };
    let surface = Surface { z: plane, rgb: [plane; 3] };
    let all = Appearance { surface, normal: [plane; 3], uv: [plane; 2], scale: plane, material: 1, level: 2 };
    let flat = |form| gouraud(Region { size: REGION, edges: form }, WORDS, &edges, &surface);
    let full = |form| super::appearance(Region { size: REGION, edges: form }, WORDS, &edges, &all);
    let shader = Shader { background: [0; 3], ambient: 20, lights: LIGHTS.to_vec(), materials: vec![SHINY] };
    let shading = Shading { shader: &shader, word: bank(0), colour: bank(1) };
    let plain = Material { texture: None, ..SHINY };
    let untextured = Shader { materials: vec![plain], ..shader.clone() };
    let once = ShadingOnce { shading };
    let taken: Vec<_> = (0..8).flat_map(|number| once.take(number, bank(0))).collect();
    vec![
        ("clear", clear(bank(0), appearance::BYTES), [21, 21], ""),
        ("gouraud, edges fixed", flat(Edges::Fixed), [32, 28], "paper 62; facts 32"),
        ("gouraud, edges least", flat(Edges::Least), [26, 22], "facts 26"),
        ("appearance, edges fixed", full(Edges::Fixed), [72, 58], "paper 83; facts 70"),
        ("appearance, edges least", full(Edges::Least), [66, 58], "facts 64"),
        ("covered", covered(bank(0)), [4, 4], ""),
        ("unit normal", normalize::normalize(bank(0)), [690, 690], "facts 746 to 949"),
        ("four lights", of_lights(&LIGHTS), [1414, 1414], "facts 4398 to 5993"),
        ("two coordinates", perspective::coordinates(bank(0)), [432, 432], ""),
        ("level", perspective::level(bank(0)), [52, 52], "with coordinates: facts 442 to 506"),
        ("weights", filter::weights(10), [48, 48], ""),
        ("trilinear filter", filter::trilinear(), [508, 508], "facts 1050 to 1386"),
        ("before the texture unit", shading.before_texture(), [490, 490], "paper 1540"),
        ("during the texture unit", shading.under_texture(), [2123, 2123], "paper 9500 (the look-up)"),
        ("after the texture unit", shading.after_texture(), [673, 673], ""),
        ("all", shading.program(), [3286, 3286], "paper 11040"),
        ("all, without textures", Shading { shader: &untextured, ..shading }.program(), [2188, 2188], ""),
        ("add a sample to sums", add_sample(bank(0), 0), [9, 9], ""),
        ("mean of eight", average(0, bank(0)), [18, 18], ""),
        ("take eight samples", taken.clone(), [550, 550], ""),
        ("combine eight samples", once.combine(), [499, 499], ""),
        ("all, once for eight samples", [taken, once.combine(), once.program()].concat(), [4356, 4356], ""),
    ]
}

#[test]
fn the_table_of_pixelflow() {
    println!("| program | one at a time | side by side | to compare |\n|---|---|---|---|");
    for (name, program, _, compared) in table() {
        println!("| {name} | {} | {} | {compared} |", one_at_a_time(&program), side_by_side(&program));
    }
    for (name, program, clocks, _) in table() {
        assert_eq!([one_at_a_time(&program), side_by_side(&program)], clocks, "{name}");
    }
}

/// An edge that may cross a region.
fn edges() -> impl Strategy<Value = Expression> {
    let slope = || prop_oneof![2 => -65_535..=65_535_i64, 1 => -9..9_i64, 1 => Just(65_535), 1 => Just(-65_535)];
    (slope(), slope(), 0..128_i64, 0..64_i64, -3..3_i64).prop_map(|(a, b, x, y, off)| Expression {
        a,
        b,
        c: off - a * x - b * y,
    })
}

/// A component of a direction.
fn part() -> impl Strategy<Value = i16> {
    -255..=255_i16
}

/// A component of a unit normal, any three of which have a length below 4096.
fn component() -> impl Strategy<Value = i16> {
    -2364..=2364_i16
}

fn byte(pixel: &Pixel, address: u64) -> u32 {
    pixel.memory[address as usize].into()
}

fn number(pixel: &Pixel, field: Field) -> u32 {
    (0..field.bytes).rev().fold(0, |number, at| number << 8 | byte(pixel, field.byte(at)))
}

fn put(pixel: &mut Pixel, field: Field, number: u32) {
    (0..field.bytes).for_each(|at| pixel.memory[field.byte(at) as usize] = (number >> (8 * at)) as u8);
}

/// A pixel with nonzero values everywhere, except where zero is required.
fn littered() -> Pixel {
    let mut pixel = Pixel::new();
    pixel.memory = [0xa5; 384];
    pixel.memory[ZERO as usize] = 0;
    pixel
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(1000) })]

    /// The tested sign is that of the edge in all forms. It takes at most 4 bytes, or 2 for the least half-plane.
    #[test]
    fn edges_keep_their_signs(edge in edges(), x in 0..128_u32, y in 0..64_u32) {
        let value = edge.a * i64::from(x) + edge.b * i64::from(y) + edge.c;
        for (form, most) in [(Edges::Fixed, 4), (Edges::Own, 4), (Edges::Least, 2)] {
            let Some(program) = super::edges::tests(REGION, form, &[edge]) else {
                prop_assert!(value < 0);
                continue;
            };
            let mut pixel = Pixel::new();
            pixel.run(&program, x, y);
            prop_assert_eq!(pixel.is_enabled(), value >= 0, "{:?} of {:?}", form, expression(&program[0], x, y));
            prop_assert!(one_at_a_time(&program) <= most);
        }
    }

    #[test]
    fn four_lights_take_at_most_1476_clocks(directions in prop::collection::vec([part(), part(), part()], 8)) {
        let light = |two: &[[i16; 3]]| Light { direction: two[0], half: two[1], brightness: 255 };
        let lights: Vec<Light> = directions.chunks(2).map(light).collect();
        prop_assert!(one_at_a_time(&of_lights(&lights)) <= 1476);
    }

    #[test]
    fn products_are_exact(a: u8, b: u8, start: u8) {
        let mut w = Writer::default();
        w.push(load(100));
        w.product(102, 101, 8, [HIGH, LOW]);
        w.scaled(100, 101, 103);
        w.scaled(100, 101, 100);
        let mut pixel = littered();
        pixel.memory[100..103].copy_from_slice(&[a, b, start]);
        pixel.run(&w.0, 0, 0);
        let [a, b, start] = [a, b, start].map(u32::from);
        prop_assert_eq!(byte(&pixel, HIGH) << 8 | byte(&pixel, LOW), a * b + start);
        prop_assert_eq!([byte(&pixel, 103), byte(&pixel, 100)], [(a * (b + 1)) >> 8; 2]);
    }

    /// Each step is a step of long division, for all remainders below a divisor of up to 16 bits.
    #[test]
    fn remainders_are_exact(divisor in 1..=u16::MAX, dividend: u32, shift in 0..16_u32) {
        let divisor = u32::from(divisor >> shift).max(1);
        let mut remainder = dividend % divisor;
        let (at, by) = (Field::new(100, 2), Field::new(102, 2));
        let mut pixel = littered();
        put(&mut pixel, at, remainder);
        put(&mut pixel, by, divisor);
        for _ in 0..20 {
            let mut w = Writer::default();
            w.divided([at.byte(0), at.byte(1)], at, by, Division { comes_in: false, may_leave: true, is_last: false });
            pixel.run(&w.0, 0, 0);
            prop_assert_eq!(pixel.flag, 2 * remainder < divisor);
            remainder = 2 * remainder % divisor;
            prop_assert_eq!(number(&pixel, at), remainder);
        }
    }

    /// Cosines are floors of the exact quotients, limited to 0 to 4095.
    #[test]
    fn cosines_are_floors(unit in [component(), component(), component()], direction in [part(), part(), part()]) {
        let mut pixel = littered();
        UNIT.iter().zip(unit).for_each(|(field, part)| put(&mut pixel, *field, (part as u16).into()));
        let (mut w, mut sums) = (Writer::default(), Combinations::default());
        sums.cosine(&mut w, direction, LIT);
        pixel.run(&w.0, 0, 0);
        let exact: i32 = unit.iter().zip(direction).map(|(n, d)| i32::from(*n) * i32::from(d)).sum();
        prop_assert_eq!(number(&pixel, LIT) as i32, (exact >> 8).clamp(0, 4095));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(1000) })]

    #[test]
    fn means_of_eight_are_rounded(colours: [[u8; 3]; 8], ends: [bool; 8], sums in 0..250_u64) {
        let colours: Vec<[u8; 3]> = colours.iter().zip(ends).map(|(own, end)| if end { [255, own[1], 0] } else { *own }).collect();
        let colour = bank(1) + 4;
        let mut pixel = littered();
        pixel.run(&begin_sums(sums), 0, 0);
        for own in &colours {
            pixel.memory[colour as usize..][..3].copy_from_slice(own);
            pixel.run(&add_sample(colour, sums), 0, 0);
        }
        pixel.run(&average(sums, colour), 0, 0);
        for channel in 0..3 {
            let sum: u32 = colours.iter().map(|own| u32::from(own[channel])).sum();
            prop_assert_eq!(byte(&pixel, colour + channel as u64), (sum + 4) / 8);
        }
        // Nothing else is written.
        let own = [sums..sums + SUM_BYTES, colour..colour + 3];
        let others = (1..384_u64).filter(|at| !own.iter().any(|range| range.contains(at)));
        prop_assert!(others.into_iter().all(|at| byte(&pixel, at) == 0xa5));
    }
}

#[test]
fn all_cosines_are_squared_exactly() {
    let mut w = Writer::default();
    light::squared(&mut w, HIGHLIGHT, super::super::pixel::Mask::Everybody);
    for cosine in 0..4096 {
        let mut pixel = littered();
        put(&mut pixel, HIGHLIGHT, cosine);
        pixel.run(&w.0, 0, 0);
        assert_eq!(number(&pixel, HIGHLIGHT), (cosine * cosine) >> 12, "{cosine}");
    }
}
