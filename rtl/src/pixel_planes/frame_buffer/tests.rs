//! The frame buffer clock by clock, and with the regions of a picture in any sequence.

use std::ops::Range;

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::*;

type Frame = Simulation<FrameBufferIn, FrameBufferOut>;

fn started(frame: &FrameBuffer) -> Frame {
    let mut sim = Simulation::of(frame).unwrap().seeded(3);
    sim.reset();
    sim
}

/// Sends some planes of a line.
fn send(sim: &mut Frame, region: u64, line: u64, words: &[u64], planes: Range<u64>) {
    for plane in planes {
        let bits = (0..).zip(words).map(|(at, word)| (word >> plane & 1) << at).sum();
        sim.set(sim.i.planes.valid, 1);
        let p = sim.i.planes.payload;
        for (port, value) in [(p.region, region), (p.line, line), (p.plane, plane), (p.bits, bits)] {
            sim.set(port, value);
        }
        sim.step();
    }
    // Inputs that are not valid are ignored.
    sim.set(sim.i.planes.valid, 0);
    sim.set(sim.i.planes.payload.region, 0xffff);
}

fn read(sim: &mut Frame, region: u32, line: u32) -> Vec<u64> {
    sim.set(sim.i.read.region, region);
    sim.set(sim.i.read.line, line);
    sim.set(sim.i.read.enable, 1);
    sim.step();
    sim.set(sim.i.read.enable, 0);
    sim.lanes(sim.o.words)
}

#[test]
fn a_line_is_written_with_its_last_plane() {
    let mut sim = started(&FrameBuffer { screen: Screen { width: 4, height: 2 }, side: 2 });
    send(&mut sim, 1, 0, &[7, 9], 0..48);
    send(&mut sim, 1, 1, &[1 << 47, 3], 0..48);
    let (first, second) = ([7, 9], [6, 1 << 46]);
    send(&mut sim, 1, 0, &second, 0..47);
    assert_eq!(read(&mut sim, 1, 0), first);
    send(&mut sim, 1, 0, &second, 47..48);
    assert_eq!(sim.lanes(sim.o.words), first);
    assert_eq!(read(&mut sim, 1, 0), second);
    assert_eq!(read(&mut sim, 1, 1), [1 << 47, 3]);
}

#[test]
#[should_panic(expected = "the planes of a line arrive in sequence")]
fn a_plane_that_is_left_out_is_an_error() {
    let mut sim = started(&FrameBuffer { screen: Screen { width: 4, height: 2 }, side: 2 });
    sim.set(sim.i.planes.valid, 1);
    sim.run(2);
}

#[test]
#[should_panic(expected = "the region belongs to the screen")]
fn a_region_that_is_beyond_the_screen_is_an_error() {
    let mut sim = started(&FrameBuffer { screen: Screen { width: 4, height: 2 }, side: 2 });
    send(&mut sim, 2, 0, &[7, 9], 0..48);
}

#[test]
fn there_are_numbers_for_65536_regions() {
    let screen = Screen { width: 2048, height: 2048 };
    let of = |side| FrameBuffer { screen, side }.checked();
    assert_eq!(of(8).unwrap().regions(), 65_536);
    let sentence = "it has to be a power of two, from 8 to 256. The regions of a screen have numbers of 16 bits.";
    for side in [0, 4, 12, 512] {
        assert_eq!(of(side).unwrap_err().to_string(), format!("`side` of `FrameBuffer` is {side}: {sentence}"));
    }
    assert!(FrameBuffer { screen: Screen { width: 512, height: 512 }, side: 2 }.checked().is_ok());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_pixel_is_where_its_region_is(
        (width, height) in (1..25u32, 1..17u32),
        order in any::<u64>(),
    ) {
        const SIDE: u32 = 8;
        let frame = FrameBuffer { screen: Screen { width, height }, side: SIDE };
        let mut sim = started(&frame);
        // Lines of all regions, mixed up; each word encodes its pixel's position.
        let mut lines: Vec<(u32, u32)> = (0..frame.regions()).flat_map(|region| (0..SIDE).map(move |line| (region, line))).collect();
        lines.sort_by_key(|(region, line)| (u64::from(region * SIDE + line) + 1).wrapping_mul(order | 1) >> 7 & 0xff);
        let word = |x: u32, y: u32| u64::from(y) << 40 | u64::from(x) << 3 | 5;
        for &(region, line) in &lines {
            let (left, y) = (region % frame.columns() * SIDE, region / frame.columns() * SIDE + line);
            let words: Vec<u64> = (left..left + SIDE).map(|x| word(x, y)).collect();
            send(&mut sim, region.into(), line.into(), &words, 0..48);
        }
        for y in 0..height {
            for left in (0..width).step_by(SIDE as usize) {
                let region = y / SIDE * frame.columns() + left / SIDE;
                let expected: Vec<u64> = (left..left + SIDE).map(|x| word(x, y)).collect();
                prop_assert_eq!(read(&mut sim, region, y % SIDE), expected);
            }
        }
    }
}
