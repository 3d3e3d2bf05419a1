//! What triangles leave in the words of a region.

use proptest::prelude::*;
use tilewright_machines::pixelflow::Corner;
use tilewright_rtl::pixelflow::emulator::Pixel;
use tilewright_rtl::pixelflow::fields::{appearance, bank};
use tilewright_rtl::pixelflow::instruction::Instruction;
use tilewright_rtl::pixelflow::programs::{self, Edges, Region, Words};
use tilewright_scenes::deferred::{Appearance, AppearancePacket, AppearanceVertex, set_up_appearance};
use tilewright_scenes::{ScreenVertex, Size, Triangle, golden};

const FORMS: [Edges; 3] = Edges::ALL;
const WORDS: Words = Words { kept: bank(1), new: 0 };
const BACKGROUND: [u8; 3] = [7, 80, 255];

/// A region of the screen, not all of whose pixels are looked at.
#[derive(Debug, Clone, Copy)]
struct Tested {
    corner: [u32; 2],
    size: [u32; 2],
    /// Columns and lines of the screen from a pixel to the next.
    stride: [u32; 2],
    step: usize,
}

const SCREEN: [u32; 2] = [512, 256];
const REGIONS: [Tested; 6] = [
    Tested { corner: [24, 16], size: [8, 8], stride: [1, 1], step: 1 },
    Tested { corner: [240, 252], size: [16, 4], stride: [1, 1], step: 1 },
    Tested { corner: [128, 64], size: [128, 64], stride: [1, 1], step: 17 },
    Tested { corner: [25, 16], size: [8, 8], stride: [2, 2], step: 1 },
    Tested { corner: [24, 17], size: [16, 8], stride: [1, 2], step: 1 },
    Tested { corner: [1, 3], size: [128, 64], stride: [3, 3], step: 17 },
];

impl Tested {
    fn pixels(self) -> impl Iterator<Item = [u32; 2]> {
        let [width, height] = self.size;
        (0..height).flat_map(move |y| (0..width).map(move |x| [x, y])).step_by(self.step)
    }

    fn number(self, [x, y]: [u32; 2]) -> usize {
        let [across, down] = self.stride;
        ((self.corner[1] + down * y) * SCREEN[0] + self.corner[0] + across * x) as usize
    }

    fn at(self) -> Corner {
        Corner { at: self.corner, step: self.stride }
    }
}

fn screen() -> Size {
    Size::new(SCREEN[0], SCREEN[1]).expect("in range")
}

/// Vertices in the region, about it, and at the ends of the guard band; values that often are those of others.
fn vertices(region: Tested) -> impl Strategy<Value = [AppearanceVertex; 3]> {
    let place = move |axis: usize| {
        let (first, side) = (16 * region.corner[axis] as i32, (16 * region.size[axis] * region.stride[axis]) as i32);
        prop_oneof![4 => first..first + side, 3 => first - side..first + 2 * side, 1 => Just(-32_768), 1 => Just(32_767)]
    };
    let z = prop_oneof![4 => Just(900_u32), 2 => 899..902_u32, 1 => Just(1), 1 => Just((1 << 24) - 3), 2 => 1..(1_u32 << 24) - 2];
    let channel = || prop_oneof![2 => Just(200_u8), 1 => any::<u8>()];
    let word = || prop_oneof![2 => Just(40_000_u16), 1 => any::<u16>()];
    let part = || prop_oneof![2 => Just(-300_i16), 1 => -32_767..=32_767_i16];
    let vertex =
        (place(0), place(1), z, [channel(), channel(), channel()], [part(), part(), part()], [word(), word()], word())
            .prop_map(|(x, y, z, rgb, normal, uv, scale)| AppearanceVertex {
                at: ScreenVertex { x, y, z, rgb },
                normal,
                uv,
                scale,
            });
    proptest::array::uniform3(vertex)
}

fn packets() -> impl Strategy<Value = (Tested, Vec<AppearancePacket>)> {
    proptest::sample::select(&REGIONS[..]).prop_flat_map(|region| {
        let packet = (vertices(region), 0..3_u8, 0..3_u8)
            .prop_filter_map("it has an area", |(vertices, material, level)| {
                set_up_appearance(&vertices, material, level, screen())
            });
        (Just(region), proptest::collection::vec(packet, 1..12))
    })
}

fn run(region: Tested, program: &[Instruction<u64>], [x, y]: [u32; 2]) -> Pixel {
    let mut pixel = Pixel::new();
    pixel.memory = std::array::from_fn(|at| (at as u32 * 7 + x + 3 * y) as u8);
    (pixel.flag, pixel.enable, pixel.carry) = (true, 0xff, region.step > 1);
    pixel.run(program, x, y);
    pixel
}

/// The bytes of a word in the order of sending.
fn sent<const N: usize>(pixel: &Pixel, word: u64) -> [u8; N] {
    std::array::from_fn(|j| pixel.memory[word as usize + N - 1 - j])
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(120) })]

    #[test]
    fn appearance_words_are_those_that_are_visible((region, packets) in packets()) {
        let expected = golden::visible(screen(), &packets);
        for form in FORMS {
            let draw = |packets: &mut dyn Iterator<Item = &AppearancePacket>| {
                let corner = region.at();
                let drawn = packets.flat_map(|packet| {
                    let edges = corner.edges(&packet.triangle);
                    programs::appearance(Region { size: region.size, edges: form }, WORDS, &edges, &corner.appearance(packet))
                });
                [programs::clear(WORDS.kept, appearance::BYTES), drawn.collect(), programs::covered(WORDS.kept)].concat()
            };
            // In any order they leave the same.
            for program in [draw(&mut packets.iter()), draw(&mut packets.iter().rev())] {
                for at in region.pixels() {
                    let word = Appearance::from_bytes(sent(&run(region, &program, at), WORDS.kept));
                    prop_assert_eq!(word, expected[region.number(at)], "{:?} with edges {:?}", at, form);
                }
            }
        }
    }

    #[test]
    fn gouraud_words_are_those_of_the_frame((region, packets) in packets()) {
        let triangles: Vec<Triangle> = packets.into_iter().map(|packet| packet.triangle).collect();
        let expected = golden::render(screen(), &triangles, BACKGROUND);
        for form in FORMS {
            let corner = region.at();
            let drawn = triangles.iter().rev().flat_map(|triangle| {
                programs::gouraud(Region { size: region.size, edges: form }, WORDS, &corner.edges(triangle), &corner.surface(triangle))
            });
            let program = [programs::clear_to(WORDS.kept, BACKGROUND), drawn.collect()].concat();
            for at in region.pixels() {
                let [z2, z1, z0, zero, rgb @ ..] = sent::<7>(&run(region, &program, at), WORDS.kept);
                let [r, g, b] = rgb;
                let word = u64::from_be_bytes([0, 0, z2, z1, z0, r, g, b]);
                prop_assert_eq!((word, zero), (expected.words[region.number(at)], 0), "{:?} with edges {:?}", at, form);
            }
        }
    }
}
