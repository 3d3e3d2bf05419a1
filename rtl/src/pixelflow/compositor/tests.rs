//! The compositor byte by byte, and compared with the lesser of two words.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::*;

#[test]
fn the_first_byte_that_differs_decides() {
    let mut sim = Simulation::of(&Compositor { pixels: 2, width: 8 }).unwrap();
    sim.reset();
    let (i, o) = (sim.i, sim.o);
    let wave = sim.record([i.first, i.pixel, i.upstream, i.own, o.downstream]);
    // For pixel 0 the upstream word is the lesser from its first byte on. For pixel 1 the node's own word is, from the
    // second byte on.
    let bytes = [(1, 0, 3, 4), (1, 1, 7, 7), (0, 0, 9, 1), (0, 1, 6, 5), (0, 0, 8, 2), (0, 1, 1, 8)];
    for (first, pixel, upstream, own) in bytes {
        sim.drive(CompositorIn { mode: Mode::Composite.code(), advances: 1, first, pixel, upstream, own });
        sim.step();
    }
    sim.step();
    wave.expect(
        r"
        clk        |~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        first      |~~~~~~~\____________________
        pixel      |___/~~~\___/~~~\___/~~~~~~~~
        upstream   | 3 | 7 | 9 | 6 | 8 | 1     |
        own        | 4 | 7 | 1 | 5 | 2 | 8     |
        downstream | 0 | 3 | 7 | 9 | 5 | 8     |
        ",
    );
}

/// The words that a node passes on for its pixels.
fn sent(
    mode: Mode,
    upstream: &[Vec<u64>],
    own: &[Vec<u64>],
    width: u32,
    advances: impl Fn(usize) -> bool,
) -> Vec<Vec<u64>> {
    let pixels = upstream.len();
    let mut sim = Simulation::of(&Compositor { pixels: pixels as u32, width }).unwrap();
    sim.reset();
    let mut words = vec![Vec::new(); pixels];
    let mut clock = 0;
    for byte in 0..upstream[0].len() {
        for pixel in 0..pixels {
            let (first, upstream, own) = (u64::from(byte == 0), upstream[pixel][byte], own[pixel][byte]);
            let inputs = CompositorIn { mode: mode.code(), advances: 1, first, pixel: pixel as u64, upstream, own };
            while !advances(clock) {
                // These values do not matter.
                sim.drive(CompositorIn { advances: 0, upstream: own, own: upstream, ..inputs });
                sim.step();
                clock += 1;
            }
            sim.drive(inputs);
            sim.step();
            clock += 1;
            words[pixel].push(sim.get_u64(sim.o.downstream));
        }
    }
    words
}

/// Words have two bytes of 2 bits. Each of two pixels gets all pairs of words.
#[test]
fn of_all_small_words_the_lesser_goes_on() {
    let word = |number: u64| vec![number >> 2, number & 3];
    for (upstream, own) in (0..16).flat_map(|upstream| (0..16).map(move |own| (upstream, own))) {
        // The other pixel has the two words exchanged, or other words.
        for other in [[own, upstream], [upstream, 15 - own]] {
            let words = |of: [u64; 2]| of.map(word).to_vec();
            let (above, below) = (words([upstream, other[0]]), words([own, other[1]]));
            let lesser = words([upstream.min(own), other[0].min(other[1])]);
            assert_eq!(sent(Mode::Composite, &above, &below, 2, |clock| clock % 3 != 1), lesser);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    /// Tests each mode with words that mostly share their first bytes, and with gaps anywhere.
    #[test]
    fn each_mode_sends_what_it_says(
        (upstream, own) in (1..9usize, 1..7usize).prop_flat_map(|(pixels, bytes)| {
            let words = || prop::collection::vec(prop::collection::vec(0..3u64, bytes), pixels);
            (words(), words())
        }),
        gaps in prop::collection::vec(any::<bool>(), 1..20),
    ) {
        let advances = |clock: usize| clock % 21 == 20 || gaps[clock % gaps.len()];
        for (mode, expected) in [
            (Mode::Forward, upstream.clone()),
            (Mode::Unload, upstream.clone()),
            (Mode::Load, own.clone()),
            (Mode::Composite, upstream.iter().zip(&own).map(|(a, b)| a.min(b).clone()).collect()),
        ] {
            prop_assert_eq!(sent(mode, &upstream, &own, 8, advances), expected);
        }
    }
}
