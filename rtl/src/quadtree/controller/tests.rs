//! The video controller clock by clock, and with software buffers.

use proptest::prelude::*;
use tilewright_sim::{Pauses, Simulation, monitor};

use super::super::format::Matrix;
use super::super::testing::small;
use super::*;

#[test]
fn the_first_group_comes_after_2_clocks_and_a_group_that_waits_stays() {
    let mut sim = Simulation::of(&VideoController { format: small() }).unwrap();
    sim.reset();
    let (i, o) = (sim.i, sim.o);
    sim.set_lanes(i.words, [1, 2, (1u64 << 48) - 1, 4]);
    sim.set(i.show.background, 0x10_20_30);
    let wave = sim.record([
        "show_start",
        "column",
        "line",
        "scan_enable[0]",
        "scan_enable[2]",
        "pixels_valid",
        "pixels_ready",
        "busy",
    ]);
    for clock in 0..12 {
        if clock == 4 {
            assert_eq!(sim.lanes(o.pixels.payload), [1, 2]);
        }
        sim.set(i.show.start, clock == 1);
        sim.set(o.pixels.ready, clock != 4 && clock != 5);
        sim.step();
    }
    wave.expect(
        r"
        clk            |~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        show_start     |___/~~~\________________________________________
        column         | 0         | 1 | 2         | 3 | 0 | 1 | 2 | 3 |
        line           | 0                             | 1             |
        scan_enable[0] |_______/~~~~~~~\_______/~~~~~~~\________________
        scan_enable[2] |_______________________________/~~~~~~~~~~~~~~~~
        pixels_valid   |___________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        pixels_ready   |~~~~~~~~~~~~~~~\_______/~~~~~~~~~~~~~~~~~~~~~~~~
        busy           |_______/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        ",
    );
    // The second line: the background shows where nothing was drawn.
    assert_eq!(sim.lanes(o.pixels.payload), [0xff_ffff << 24 | 0x10_20_30, 4]);
}

#[test]
#[should_panic(expected = "a picture is requested only while none is being read")]
fn a_second_start_is_an_error() {
    let mut sim = Simulation::of(&VideoController { format: small() }).unwrap();
    sim.reset();
    sim.set(sim.i.show.start, 1);
    sim.run(2);
}

/// A word that encodes its position, or an empty one.
fn word(x: u64, y: u64) -> u64 {
    if (x + 3 * y).is_multiple_of(5) { (1 << 48) - 1 } else { x << 12 | y }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// Two pictures, line by line, from buffers that send the word requested in the previous clock, and keep it.
    #[test]
    fn it_reads_the_buffers_as_one_picture(
        (width, height, p, q) in (1..20u32, 1..9u32, 0..4u32, 0..4u32),
        (percent, seed) in (0..80u64, any::<u64>()),
    ) {
        let (p, q) = (1 << p, 1 << q);
        let format = Format::new(Screen { width, height }, Matrix::new(p, q).unwrap(), 3).unwrap();
        let mut sim = Simulation::of(&VideoController { format }).unwrap().seeded(seed);
        sim.reset();
        let (i, o) = (sim.i, sim.o);
        let groups = (format.columns() * height) as usize;
        let t = sim.testbench();
        t.limit(10_000);
        let lanes = |bits: Bits, width: u32| {
            let lane = move |lane: u32| bits.slice(lane * width..(lane + 1) * width).to_u64().unwrap();
            (0..p * q).map(lane).collect::<Vec<_>>()
        };
        let buffers = async {
            let mut words = vec![Bits::zero(48); (p * q) as usize];
            loop {
                t.step().await;
                let enable = lanes(t.get(o.scan.enable), 1);
                let xs = lanes(t.get(o.scan.x), below(format.columns()).bits());
                let ys = lanes(t.get(o.scan.y), below(format.rows()).bits());
                for (number, word_of) in words.iter_mut().enumerate().filter(|(number, _)| enable[*number] == 1) {
                    let (column, row) = (number as u64 % u64::from(p), number as u64 / u64::from(p));
                    let at = [u64::from(p) * xs[number] + column, u64::from(q) * ys[number] + row];
                    *word_of = Bits::new(48, word(at[0], at[1]));
                }
                t.set(i.words, Bits::join(&words));
            }
        };
        t.set(i.show.background, 0x10_20_30);
        let show = async {
            let mut pauses = Pauses::percent(percent, seed);
            let mut pictures = Vec::new();
            for _ in 0..2 {
                t.set(i.show.start, 1);
                t.step().await;
                t.set(i.show.start, 0);
                let mut pixels = Vec::new();
                for _ in 0..groups {
                    t.wait(pauses.next_length().into()).await;
                    let group = t.receive_bits(o.pixels).await;
                    pixels.extend((0..p).map(|lane| group.slice(48 * lane..48 * lane + 48).to_u64().unwrap()));
                }
                t.expect_silence(o.pixels, 20).await;
                pictures.push(pixels);
            }
            pictures
        };
        let (pictures, _, _) = t.run((show, monitor(buffers), monitor(t.holds_bits(o.pixels))));
        drop(t);
        prop_assert_eq!(sim.get_u64(o.busy), 0);
        let shown = |x: u64, y: u64| if word(x, y) == (1 << 48) - 1 { 0xff_ffff << 24 | 0x10_20_30 } else { word(x, y) };
        for pixels in pictures {
            for (y, line) in (0u64..).zip(pixels.chunks((format.columns() * p) as usize)) {
                let expected: Vec<_> = (0..u64::from(width)).map(|x| shown(x, y)).collect();
                prop_assert_eq!(&line[..width as usize], &expected[..]);
            }
        }
    }
}
