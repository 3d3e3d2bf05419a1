//! The clocks of all programs.

use super::super::fields::{appearance, bank, texture};
use super::super::schedule::{one_at_a_time, side_by_side};
use super::light::{Combinations, light};
use super::*;

/// The words of a region of the machine.
const WORDS: Words = Words { kept: bank(0), new: 0 };

const FOUR: [Light; 4] = [
    Light { direction: [-148, -148, -147], half: [-82, -82, -227], brightness: 255 },
    Light { direction: [201, -99, -124], half: [115, -57, -221], brightness: 170 },
    Light { direction: [57, 170, -183], half: [31, 91, -237], brightness: 85 },
    Light { direction: [-240, 77, 44], half: [-197, 63, -151], brightness: 119 },
];

fn shiny() -> Material {
    Material { is_lit: true, texture: Some(Texture { number: 0, finest: 10 }), specular: 180, squarings: 5 }
}

#[test]
fn the_table_of_pixelflow() {
    let edges = [(3, 4, -99), (-9, 1, 300), (2, -8, 111)].map(|(a, b, c)| Expression { a, b, c });
    let plane = Expression { a: 1, b: 2, c: 3 };
    let surface = Surface { z: plane, rgb: [plane; 3] };
    let all = Appearance { surface, normal: [plane; 3], uv: [plane; 2], scale: plane, material: 1, level: 2 };
    let region = |edges| Region { size: [128, 64], edges };
    let mut w = super::arithmetic::Writer::default();
    let mut sums = Combinations::default();
    FOUR.iter().for_each(|it| light(&mut w, &mut sums, it, Some([5, 5])));
    let shader = Shader { background: [0; 3], ambient: 20, lights: FOUR.to_vec(), materials: vec![shiny()] };
    let shading = Shading { shader: &shader, word: bank(0), colour: bank(1) };
    let rows = [
        ("clear", clear(bank(0), appearance::BYTES)),
        ("gouraud fixed", gouraud(region(Edges::Fixed), WORDS, &edges, &surface)),
        ("gouraud least", gouraud(region(Edges::Least), WORDS, &edges, &surface)),
        ("appearance fixed", super::appearance(region(Edges::Fixed), WORDS, &edges, &all)),
        ("appearance least", super::appearance(region(Edges::Least), WORDS, &edges, &all)),
        ("covered", covered(bank(0))),
        ("normalize", normalize::normalize(bank(0))),
        ("four lights", w.0),
        ("coordinates", perspective::coordinates(bank(0))),
        ("level", perspective::level(bank(0))),
        ("weights", filter::weights(10)),
        ("trilinear", filter::trilinear()),
        ("base", filter::base(bank(0))),
        ("before", shading.before_texture()),
        ("under", shading.under_texture()),
        ("after", shading.after_texture()),
        ("whole", shading.program()),
    ];
    let _ = texture::LEVEL;
    for (name, program) in rows {
        println!("| {name} | {} | {} |", one_at_a_time(&program), side_by_side(&program));
    }
}
