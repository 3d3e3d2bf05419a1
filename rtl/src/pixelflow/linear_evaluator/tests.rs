//! The evaluator clock by clock, for all small coefficients, and for random ones.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::*;

/// An expression, and the number of its bytes that are sent.
#[derive(Debug, Clone, Copy)]
struct Sent {
    coefficients: [u64; 3],
    bytes: u32,
    /// The clocks in which bytes are sent that belong to no expression.
    pause: u32,
}

/// Sends expressions one after another, and compares each pixel's bytes with a x + b y + c.
fn expect_sums(evaluator: LinearEvaluator, all: &[Sent]) {
    let LinearEvaluator { width, height } = evaluator;
    let mut sim = Simulation::of(&evaluator).unwrap().seeded(u64::from(width + height));
    sim.reset();
    let clocks = all.iter().flat_map(|sent| (0..sent.bytes + sent.pause).map(move |clock| (*sent, clock)));
    let clocks: Vec<(Sent, u32)> = clocks.collect();
    for time in 0..clocks.len() + evaluator.latency() as usize {
        if let Some(&(Sent { coefficients, bytes, .. }, clock)) = clocks.get(time) {
            let byte = |number: u64| if clock < bytes { number >> (8 * clock) & 0xff } else { 0xff };
            let [a, b, c] = coefficients.map(byte);
            let [first, sends] = [clock == 0, clock < bytes].map(u64::from);
            sim.drive(LinearEvaluatorIn { coefficients: Coefficients { a, b, c }, first, sends });
        }
        let seen = time.checked_sub(evaluator.latency() as usize).map(|sent| &clocks[sent]);
        if let Some(&(Sent { coefficients: [a, b, c], bytes, .. }, clock)) =
            seen.filter(|(sent, clock)| *clock < sent.bytes)
        {
            let at = |pixel: u32| {
                let [x, y] = [pixel % width, pixel / width].map(u64::from);
                a.wrapping_mul(x).wrapping_add(b.wrapping_mul(y)).wrapping_add(c) >> (8 * clock) & 0xff
            };
            let expected: Vec<u64> = (0..width * height).map(at).collect();
            assert_eq!(sim.lanes(sim.o.value), expected, "byte {clock} of {bytes} of {a} x + {b} y + {c}");
        }
        sim.step();
    }
}

#[test]
fn each_level_takes_a_clock() {
    let mut sim = Simulation::of(&LinearEvaluator { width: 4, height: 2 }).unwrap();
    sim.reset();
    let wave =
        sim.record(["first", "sends", "coefficients_a", "coefficients_c", "value[0][0]", "value[0][3]", "value[0][7]"]);
    // 0x00c0 x + 0x0010 y + 0x0105, then -x - 1 without a gap, and then nothing.
    for (a, b, c, sends) in [(0x00c0, 0x0010, 0x0105, 1), (0xffff, 0, 0xffff, 1), (0, 0, 0, 0)] {
        for byte in 0..2 {
            let [a, b, c] = [a, b, c].map(|number: u64| number >> (8 * byte) & 0xff);
            sim.drive(LinearEvaluatorIn { coefficients: Coefficients { a, b, c }, first: u64::from(byte == 0), sends });
            sim.step();
        }
    }
    sim.run(4);
    wave.expect(
        r"
        clk            |~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/
        first          |~~~~\____/~~~~\____/~~~~\_________________________
        sends          |~~~~~~~~~~~~~~~~~~~\______________________________
        coefficients_a | c0 | 0  | ff      | 0                           |
        coefficients_c | 5  | 1  | ff      | 0                           |
        value[0][0]    | 0                 | 5  | 1  | ff                |
        value[0][3]    | 0                 | 45 | 3  | fc | ff           |
        value[0][7]    | 0                 | 55 | 3  | fc | ff           |
        ",
    );
}

#[test]
fn a_reset_ends_what_is_under_way() {
    let evaluator = LinearEvaluator { width: 8, height: 8 };
    let mut sim = Simulation::of(&evaluator).unwrap();
    for byte in 0..10 {
        let [a, b, c] = [3, 5, 37 * byte % 256];
        let [first, sends] = [u64::from(byte == 0), 1];
        sim.drive(LinearEvaluatorIn { coefficients: Coefficients { a, b, c }, first, sends });
        sim.step();
    }
    sim.set(sim.i.sends, 0);
    sim.reset();
    let value = sim.lanes(sim.o.value);
    for _ in 0..=evaluator.latency() {
        sim.step();
        assert_eq!(sim.lanes(sim.o.value), value);
    }
}

/// Covers all shifts of a coefficient's bits, and all carries between its two bytes.
#[test]
fn it_gives_all_sums_of_two_bytes_whose_border_is_crossed() {
    let numbers = [0x0000, 0x0001, 0x007f, 0x0080, 0x00c0, 0x00ff, 0x0100, 0x7fff, 0x8000, 0xff80, 0xffff];
    for [width, height] in [[2, 2], [8, 2], [2, 8], [4, 4]] {
        let triples = numbers.iter().flat_map(|a| numbers.iter().flat_map(move |b| numbers.map(|c| [*a, *b, c])));
        let sent: Vec<Sent> = triples.map(|coefficients| Sent { coefficients, bytes: 2, pause: 0 }).collect();
        expect_sums(LinearEvaluator { width, height }, &sent);
    }
}

/// Covers all bytes of both coefficients, with a constant that causes carries and one that does not.
#[test]
fn it_gives_all_sums_of_a_byte_on_2x2_pixels() {
    for c in [0, 0xff] {
        let numbers = (0..1u64 << 16).map(|ab| [ab & 0xff, ab >> 8, c]);
        let sent: Vec<Sent> = numbers.map(|coefficients| Sent { coefficients, bytes: 1, pause: 0 }).collect();
        expect_sums(LinearEvaluator { width: 2, height: 2 }, &sent);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]

    /// Tests expressions of any length, with and without pauses.
    #[test]
    fn it_gives_the_sums_of_any_coefficients(
        levels in prop::array::uniform2(1..6u32),
        all in prop::collection::vec(
            (any::<[u64; 3]>(), 1..9u32, prop_oneof![Just(0), 0..3u32])
                .prop_map(|(coefficients, bytes, pause)| Sent { coefficients, bytes, pause }),
            1..12,
        ),
    ) {
        let [width, height] = levels.map(|level| 1 << level);
        expect_sums(LinearEvaluator { width, height }, &all);
    }
}

#[test]
fn it_gives_the_sums_of_the_machine_s_region() {
    let sent = |a: i64, b: i64, c: i64, bytes| {
        let coefficients = [a as u64, b as u64, c as u64];
        Sent { coefficients, bytes, pause: 0 }
    };
    let all = [sent(-70_000, 50_000, 1 << 30, 5), sent(-1, -1, 255, 2), sent(0x7f_ffff_ffff, 1 << 38, -1, 5)];
    expect_sums(LinearEvaluator { width: 128, height: 64 }, &all);
}
