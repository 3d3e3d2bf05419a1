//! Whole frames: rasterized and shaded, region by region.

use tilewright_machines::pixelflow::Corner;
use tilewright_rtl::pixelflow::emulator::Pixel;
use tilewright_rtl::pixelflow::fields::appearance;
use tilewright_rtl::pixelflow::programs::{self, Edges, Region, Words};
use tilewright_scenes::deferred::{Samples, project_deferred};
use tilewright_scenes::{Scene, Size, golden};

use super::shading::{WORD, run};

const REGION: [u32; 2] = [16, 8];
const WORDS: Words = Words { kept: WORD, new: 0 };

#[test]
fn frames_are_the_golden_ones() {
    for (name, width, height) in [("textured", 48, 32), ("teapot", 32, 24), ("star", 32, 16)] {
        let scene = Scene::builtin(name).expect("a built-in scene");
        let deferred =
            project_deferred(&scene, Size::new(width, height).expect("in range"), Samples::One).expect("in sight");
        let expected = golden::render_deferred(&deferred);
        let corners = (0..height / REGION[1]).flat_map(|y| (0..width / REGION[0]).map(move |x| [16 * x, 8 * y]));
        for corner in corners {
            let drawn = deferred.passes[0].packets.iter().flat_map(|packet| {
                let (at, region) = (Corner::of(corner), Region { size: REGION, edges: Edges::Least });
                programs::appearance(region, WORDS, &at.edges(&packet.triangle), &at.appearance(packet))
            });
            let program = [programs::clear(WORD, appearance::BYTES), drawn.collect(), programs::covered(WORD)].concat();
            for (x, y) in (0..REGION[1]).flat_map(|y| (0..REGION[0]).map(move |x| (x, y))) {
                let mut pixel = Pixel::new();
                pixel.run(&program, x, y);
                let found = run(&mut pixel, &deferred.shader);
                let [x, y] = [corner[0] + x, corner[1] + y];
                assert_eq!(found, expected.rgb(x, y), "{name} at {x}, {y}");
            }
        }
    }
}
