//! One-hot codes and priorities, as functions and as blocks.

use proptest::prelude::*;
use tilewright_blocks::*;
use tilewright_hdl::*;
use tilewright_sim::Simulation;

block! {
    /// All functions of encode.rs.
    struct Encode { width: u32 }
    in(self) EncodeIn { word: bits(self.width), index: bits(3) }
    out EncodeOut { first: _, first_index: _, index_of: _, one_hot: _ }
}

impl Encode {
    fn build(&self, _: Module, i: EncodeIn) -> EncodeOut {
        EncodeOut {
            first: first(i.word),
            first_index: first_index(i.word),
            index_of: index_of(i.word),
            one_hot: one_hot(i.index, self.width),
        }
    }
}

#[test]
fn codes_of_every_word() {
    for width in 1..=9u32 {
        let mut sim = Simulation::of(&Encode { width }).unwrap();
        for word in 0..1u64 << width {
            let index = word % 8;
            sim.drive(EncodeIn { word, index });
            let out = sim.read_u64();
            let place = if word == 0 { 0 } else { u64::from(word.trailing_zeros()) };
            assert_eq!(out.first, word & word.wrapping_neg(), "{word:b}");
            assert_eq!(out.first_index, place, "{word:b}");
            assert!(!word.is_power_of_two() || out.index_of == place, "{word:b}");
            assert_eq!(out.one_hot, (1 << index) & ((1 << width) - 1), "{index} of {width}");
        }
    }
}

/// Tests every number of a line, and every number without one.
#[test]
fn a_decoder() {
    let mut sim = Simulation::of(&Decoder::new(5)).unwrap();
    let seen = [0, 1, 2, 3, 4, 5, 6, 7].map(|index| {
        sim.drive(DecoderIn { index });
        sim.read_u64().one_hot
    });
    assert_eq!(seen, [0b00001, 0b00010, 0b00100, 0b01000, 0b10000, 0, 0, 0]);
}

#[test]
fn an_encoder() {
    let mut sim = Simulation::of(&Encoder::new(5)).unwrap();
    let seen = [0b00001, 0b00010, 0b00100, 0b01000, 0b10000, 0].map(|one_hot| {
        sim.drive(EncoderIn { one_hot });
        sim.read_u64().index
    });
    assert_eq!(seen, [0, 1, 2, 3, 4, 0]);
}

#[test]
fn a_priority_encoder() {
    let mut sim = Simulation::of(&PriorityEncoder::new(5)).unwrap();
    let seen = [0b00000, 0b10000, 0b11010, 0b11111].map(|requests| {
        sim.drive(PriorityEncoderIn { requests });
        sim.read_u64()
    });
    let out = |first, index, any| PriorityEncoderOut { first, index, any };
    assert_eq!(seen, [out(0, 0, 0), out(0b10000, 4, 1), out(0b00010, 1, 1), out(0b00001, 0, 1)]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn codes_of_many_lines(lines in 2u32..64, number in any::<u64>(), requests in any::<u64>()) {
        let number = number % u64::from(lines);
        let mut decoder = Simulation::of(&Decoder::new(lines)).unwrap();
        decoder.drive(DecoderIn { index: number });
        let one_hot = decoder.read_u64().one_hot;
        prop_assert_eq!(one_hot, 1 << number);
        let mut encoder = Simulation::of(&Encoder::new(lines)).unwrap();
        encoder.drive(EncoderIn { one_hot });
        prop_assert_eq!(encoder.read_u64().index, number);

        let mut priority = Simulation::of(&PriorityEncoder::new(lines)).unwrap();
        // Few lines are high, so that the first may be anywhere.
        let requests = requests & requests.rotate_left(17) & requests.rotate_left(31) & ((1 << lines) - 1);
        priority.drive(PriorityEncoderIn { requests });
        let lowest = (0..lines).find(|line| requests >> line & 1 == 1);
        prop_assert_eq!(priority.read_u64(), PriorityEncoderOut {
            first: lowest.map_or(0, |line| 1 << line),
            index: lowest.unwrap_or(0).into(),
            any: lowest.is_some().into(),
        });
    }
}

#[test]
#[should_panic(expected = "a decoder of 1 lines: it has 2 or more")]
fn a_decoder_of_a_line() {
    Decoder::new(1);
}

#[test]
#[should_panic(expected = "an encoder of 1 lines: it has 2 or more")]
fn an_encoder_of_a_line() {
    Encoder::new(1);
}

#[test]
#[should_panic(expected = "a priority encoder of 1 lines: it has 2 or more")]
fn a_priority_encoder_of_a_line() {
    PriorityEncoder::new(1);
}
