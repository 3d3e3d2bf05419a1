//! Functions of numbers between streams.

use crate::streams::property::FORWARD;
use crate::streams::stalls::{passed, stalls};
use proptest::prelude::*;
use std::f64::consts::TAU;
use tilewright_blocks::*;
use tilewright_hdl::{Block, Module, Width, bits, lit, stream};
use tilewright_sim::Simulation;

/// A block of records, wrapped as a block of words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Words {
    Divider(u32),
    SquareRoot(u32),
    SineCosine(u32),
}

impl Block for Words {
    type In = StreamIn;
    type Out = StreamOut;

    fn inputs(&self) -> StreamIn<Width> {
        let (Words::Divider(half) | Words::SquareRoot(half)) = *self else {
            let Words::SineCosine(width) = *self else { unreachable!() };
            return StreamIn { into: stream(bits(width)) };
        };
        StreamIn { into: stream(bits(2 * half)) }
    }

    fn build(&self, m: Module, i: StreamIn) -> StreamOut {
        let out = match *self {
            Words::Divider(width) => {
                let like = Operands { dividend: lit(width, 0), divisor: lit(width, 0) };
                let operands = i.into.unpacked(&like);
                m.instance("u_divider", &Divider::new(width), DividerIn { operands }).results.packed()
            }
            Words::SquareRoot(width) => m.instance("u_root", &SquareRoot::new(width), i).roots.packed(),
            Words::SineCosine(width) => m.instance("u_sine", &SineCosine::new(width), i).points.packed(),
        };
        StreamOut { out }
    }
}

fn words() -> impl Strategy<Value = (u32, Vec<u64>)> {
    let words = |width: u32| prop::collection::vec(0..1u64 << (2 * width), 0..40);
    (2u32..9).prop_flat_map(move |width| (Just(width), words(width)))
}

/// The quotient above the remainder, for a dividend above a divisor.
fn divided(word: u64, width: u32) -> u64 {
    let most = (1 << width) - 1;
    let (dividend, divisor) = (word >> width, word & most);
    dividend.checked_div(divisor).unwrap_or(most) << width | dividend.checked_rem(divisor).unwrap_or(dividend)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 16, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn quotients((width, words) in words(), stalls in stalls()) {
        let expected: Vec<u64> = words.iter().map(|word| divided(*word, width)).collect();
        prop_assert_eq!(passed(&Words::Divider(width), &words, words.len(), stalls, FORWARD), expected);
    }

    #[test]
    fn square_roots((width, words) in words(), stalls in stalls()) {
        let drawn = |word: &u64| (word.isqrt() << (width + 1)) | (word - word.isqrt().pow(2));
        let expected: Vec<u64> = words.iter().map(drawn).collect();
        prop_assert_eq!(passed(&Words::SquareRoot(width), &words, words.len(), stalls, FORWARD), expected);
    }

    #[test]
    fn points_of_a_circle(width in 4u32..25, words in prop::collection::vec(any::<u64>(), 0..40), stalls in stalls()) {
        let words: Vec<u64> = words.iter().map(|word| word & ((1 << width) - 1)).collect();
        let points = passed(&Words::SineCosine(width), &words, words.len(), stalls, FORWARD);
        for (angle, point) in words.iter().zip(points) {
            let signed = |number: u64| ((number << (64 - width)) as i64 >> (64 - width)) as f64;
            let (circle, one) = (2f64.powi(width as i32), 2f64.powi(width as i32 - 2));
            let (sine, cosine) = (*angle as f64 / circle * TAU).sin_cos();
            for (seen, expected) in [(point >> width, cosine * one), (point, sine * one)] {
                let wrong = (signed(seen) - expected).abs();
                prop_assert!(wrong <= 2.0, "{angle} of {circle}: {} for {expected}", signed(seen));
            }
        }
    }
}

/// Tests every division of numbers of three bits, also by 0.
#[test]
fn all_quotients_of_three_bits() {
    let mut sim = Simulation::of(&Words::Divider(3)).unwrap();
    sim.reset();
    sim.set(sim.o.out.ready, 1);
    for word in 0..64 + 3 {
        sim.set(sim.i.into.valid, 1);
        sim.set(sim.i.into.payload, word % 64);
        if word >= 3 {
            assert_eq!(sim.get_u64(sim.o.out.payload), divided(word - 3, 3), "of {:o}", word - 3);
        }
        sim.step();
    }
}

#[test]
#[should_panic(expected = "a divider of 1 bits: it has 2 or more")]
fn a_divider_of_a_bit() {
    Divider::new(1);
}

#[test]
#[should_panic(expected = "a square root of 1 bits: it has 2 or more")]
fn a_root_of_a_bit() {
    SquareRoot::new(1);
}

#[test]
#[should_panic(expected = "a sine of 25 bits: it has from 4 to 24")]
fn a_sine_that_is_too_wide() {
    SineCosine::new(25);
}
