//! Numbers of fewer bits, and how many bits are ones.

use proptest::prelude::*;
use tilewright_blocks::*;
use tilewright_hdl::*;
use tilewright_sim::Simulation;

bundle! {
    struct NumberIn<T> { number: T }
    struct NumberOut<T> { up: T, even: T, saturated: T, ones: T }
}

/// All functions of rounding.rs and count_ones.rs.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Fewer {
    width: u32,
    signed: bool,
    places: u32,
    kept: u32,
}

impl Block for Fewer {
    type In = NumberIn;
    type Out = NumberOut;

    fn inputs(&self) -> NumberIn<Width> {
        let width = bits(self.width);
        NumberIn { number: if self.signed { width.signed() } else { width } }
    }

    fn build(&self, _: Module, NumberIn { number }: NumberIn) -> NumberOut {
        NumberOut {
            up: round(number, self.places, Ties::Up),
            even: round(number, self.places, Ties::Even),
            saturated: saturate(number, self.kept),
            ones: count_ones(number),
        }
    }
}

/// The bits of a number in two's complement.
fn bits_of(number: i128, width: u32) -> u64 {
    number as u64 & (u64::MAX >> (64 - width))
}

/// The number that bits are.
fn number_of(bits: u64, Fewer { width, signed, .. }: &Fewer) -> i128 {
    if *signed { i128::from((bits << (64 - width)) as i64 >> (64 - width)) } else { bits.into() }
}

/// What the four functions are, computed from quotients.
fn expected(block: &Fewer, number: i128) -> NumberOut<u64> {
    let &Fewer { width, signed, places, kept } = block;
    let unit = 1i128 << places;
    let below = number.div_euclid(unit);
    let twice_above = 2 * (number - below * unit);
    let nearest = |tie: i128| match twice_above.cmp(&unit) {
        std::cmp::Ordering::Less => below,
        std::cmp::Ordering::Equal => tie,
        std::cmp::Ordering::Greater => below + 1,
    };
    let (least, most) = if signed { (-(1i128 << (kept - 1)), (1 << (kept - 1)) - 1) } else { (0, (1 << kept) - 1) };
    NumberOut {
        up: bits_of(nearest(below + 1), width - places + 1),
        even: bits_of(nearest(if below % 2 == 0 { below } else { below + 1 }), width - places + 1),
        saturated: bits_of(number.clamp(least, most), kept),
        ones: bits_of(number, width).count_ones().into(),
    }
}

#[test]
fn every_number_of_five_bits() {
    for (places, kept, signed) in (0..5).zip([1, 3, 5, 6, 9]).flat_map(|(p, k)| [(p, k, false), (p, k, true)]) {
        let block = Fewer { width: 5, signed, places, kept };
        let mut sim = Simulation::of(&block).unwrap();
        for number in 0..32 {
            sim.drive(NumberIn { number });
            assert_eq!(sim.read_u64(), expected(&block, number_of(number, &block)), "{number} in {block:?}");
        }
    }
}

#[test]
fn ties_and_limits() {
    let mut sim = Simulation::of(&Quantizer { width: 6, places: 2, kept: 3, ties: Ties::Even }).unwrap();
    sim.reset();
    // -2.5, -1.5, 2.5, 3.75, -8, and 1 without `enable`.
    let rows = [(1, -10), (1, -6), (1, 10), (1, 15), (1, -32), (0, 4), (0, 4)];
    let seen = sim.stream(rows.map(|(enable, number)| QuantizerIn { enable, number: bits_of(number, 6) }));
    let rounded: Vec<u64> = seen.iter().skip(1).map(|out| out.rounded).collect();
    assert_eq!(rounded, [-2, -2, 2, 3, -4, -4].map(|number| bits_of(number, 3)));
}

#[test]
fn ones() {
    let mut sim = Simulation::of(&CountOnes { width: 7 }).unwrap();
    let seen = [0, 1, 0b100_0000, 0b101_0101, 0b111_1111].map(|word| {
        sim.drive(CountOnesIn { word });
        sim.read_u64().ones
    });
    assert_eq!(seen, [0, 1, 1, 4, 7]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn numbers_of_fewer_bits(
        (width, places) in (1u32..64).prop_flat_map(|width| (Just(width), 0..width)), kept in 1u32..64, signed: bool,
        numbers in prop::collection::vec(any::<u64>(), 1..40),
    ) {
        let block = Fewer { width, signed, places, kept };
        let mut sim = Simulation::of(&block).unwrap();
        // Numbers of all sizes, and halfway ones.
        let numbers = numbers.iter().flat_map(|drawn| [*drawn, drawn >> (drawn % 64), drawn << places | 1 << places >> 1]);
        for number in numbers.map(|number| number & (u64::MAX >> (64 - width))) {
            sim.drive(NumberIn { number });
            prop_assert_eq!(sim.read_u64(), expected(&block, number_of(number, &block)));
        }
    }
}

#[test]
fn a_number_that_keeps_nothing() {
    let problem = elaborate(&Quantizer { width: 8, places: 8, kept: 1, ties: Ties::Up }).unwrap_err().to_string();
    assert!(problem.starts_with("`places` of `Quantizer` is 8: it has to be at least 1 and below 8"), "{problem}");
    let all = Fewer { width: 4, signed: false, places: 4, kept: 4 };
    let problem = elaborate(&all).unwrap_err().to_string();
    assert!(problem.contains("blocks/tests/small/rounding.rs:"), "{problem}");
}
