//! Whole regions: the request of each pixel, and the texels that it gets.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::texture_memory::tests::{around, contents};
use super::*;

/// The registers of each pixel of each chip, which the port accesses.
type Registers = Vec<Vec<[u64; 64]>>;

/// Serves a region, from the clock of `start` to that of `done`; returns the number of clocks.
fn serve(unit: &TextureUnit, finest: &[u32], registers: &mut Registers) -> u64 {
    let mut sim = Simulation::of(unit).unwrap().seeded(3);
    sim.reset();
    let i = sim.i;
    for inputs in contents(finest).0 {
        sim.set_record(i.write, inputs.write);
        sim.set_record(i.describe, inputs.describe);
        sim.step();
    }
    sim.set(i.write.valid, 0);
    sim.set(i.describe.valid, 0);
    sim.set(i.start, 1);
    sim.step();
    sim.set(i.start, 0);
    for clock in 1.. {
        assert!(clock <= unit.clocks(), "the unit is not done in time");
        let port = sim.o.port;
        let [pixel, address, writes] = [port.pixel, port.address, port.writes].map(|port| sim.get_u64(port));
        // In rounds that only write, the read address may be any value.
        let byte = |chip: &Vec<[u64; 64]>| chip.get(pixel as usize).map_or(0, |pixel| pixel[address as usize]);
        let seen: Vec<u64> = registers.iter().map(byte).collect();
        sim.set_lanes(i.seen, seen);
        if writes == 1 {
            let bytes = sim.lanes(sim.o.port.bytes);
            registers.iter_mut().zip(bytes).for_each(|(chip, byte)| chip[pixel as usize][address as usize] = byte);
        }
        let done = sim.get_u64(sim.o.done) == 1;
        sim.step();
        if done {
            return clock;
        }
    }
    unreachable!("the unit ends or is too late")
}

/// The request of a pixel: texture, point and level.
type Asked = (u64, [u64; 2], u64);

fn expect_texels(chips: u32, pixels: u32, finest: &[u32], asked: impl Fn(usize) -> Asked) -> u64 {
    let memory = TextureMemory { texels: contents(finest).1 as u32, textures: finest.len() as u32 };
    let unit = TextureUnit { chips, pixels, memory };
    let number = |chip: u32, pixel: u32| (chip * pixels + pixel) as usize;
    let fresh = |chip: u32, pixel: u32| {
        let (texture, [u, v], level) = asked(number(chip, pixel));
        let mut registers = [0xee; 64];
        registers[..6].copy_from_slice(&[u & 0xff, u >> 8, v & 0xff, v >> 8, level, texture]);
        registers
    };
    let mut registers: Registers =
        (0..chips).map(|chip| (0..pixels).map(|pixel| fresh(chip, pixel)).collect()).collect();
    let clocks = serve(&unit, finest, &mut registers);
    for (chip, pixel) in (0..chips).flat_map(|chip| (0..pixels).map(move |pixel| (chip, pixel))) {
        let mut expected = fresh(chip, pixel);
        let (texture, place, level) = asked(number(chip, pixel));
        for (texel, colour) in around(texture, finest[texture as usize], place, level).into_iter().enumerate() {
            (0..3).for_each(|channel| expected[8 + 3 * texel + channel] = colour >> (8 * channel) & 0xff);
        }
        assert_eq!(registers[chip as usize][pixel as usize], expected, "pixel {pixel} of chip {chip}");
    }
    clocks
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn each_pixel_gets_the_texels_that_it_asks_for(
        chips in prop_oneof![1..5u32, Just(29), Just(30), Just(31), Just(40)],
        pixels in 1..5u32,
        finest in prop::collection::vec(0..4u32, 1..3),
        places in prop::collection::vec((0..2usize, any::<[u16; 2]>(), 0..6u64), 1..20),
    ) {
        expect_texels(chips, pixels, &finest, |number| {
            let (texture, place, level) = places[number % places.len()];
            ((texture % finest.len()) as u64, place.map(u64::from), level)
        });
    }
}

/// PFL-SHADE: the paper's worst case is 95 us.
#[test]
fn a_region_of_8192_pixels_takes_82_56_us() {
    let clocks = expect_texels(32, 256, &[4, 2], |number| {
        let number = number as u64;
        (number % 2, [number * 977 % 0x1_0000, number * 31_337 % 0x1_0000], number / 7 % 5)
    });
    assert_eq!(clocks, 8256);
    assert!(clocks * super::super::ARRAY.period.picoseconds() < 95_000_000);
}

#[test]
#[should_panic(expected = "the texture unit begins only when it is done")]
fn a_second_start_is_an_error() {
    let memory = TextureMemory { texels: contents(&[0]).1 as u32, textures: 1 };
    let mut sim = Simulation::of(&TextureUnit { chips: 1, pixels: 1, memory }).unwrap();
    sim.reset();
    sim.set(sim.i.start, 1);
    sim.run(2);
}
