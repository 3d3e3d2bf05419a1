//! Digits.

use proptest::prelude::*;
use tilewright_blocks::*;
use tilewright_sim::Simulation;

/// The digits that light each segment, the uppermost segment first.
const LIT_IN: [&str; 7] =
    ["02356789acef", "01234789ad", "013456789abd", "0235689bcde", "0268abcdef", "045689abcef", "2345689abdef"];

#[test]
fn a_digit_is_shown_a_clock_later() {
    let mut sim = Simulation::of(&SevenSegment).unwrap();
    sim.reset();
    for (digit, shown) in (0..).zip("0123456789abcdef".chars()) {
        sim.drive(SevenSegmentIn { digit });
        sim.step();
        let segments = (0..).zip(LIT_IN).map(|(place, digits)| u64::from(digits.contains(shown)) << place).sum();
        assert_eq!(sim.read_u64(), SevenSegmentOut { segments }, "{shown}");
    }
}

#[test]
fn a_number_stays_without_enable() {
    let mut sim = Simulation::of(&FromDecimal::new(3)).unwrap();
    let row = |enable, digits| FromDecimalIn { enable, digits };
    let seen = sim.stream([row(1, 0x123), row(1, 0x999), row(0, 0x456), row(1, 0), row(0, 0)]);
    let numbers: Vec<u64> = seen.iter().skip(1).map(|out| out.number).collect();
    assert_eq!(numbers, [123, 999, 999, 0]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn numbers_of_digits(digits in 1usize..17, number in any::<u64>()) {
        let number = number % 10u64.pow(digits as u32);
        let mut sim = Simulation::of(&FromDecimal::new(digits as u32)).unwrap();
        sim.set(sim.i.enable, 1);
        let written = format!("{number:0digits$}");
        sim.set_lanes(sim.i.digits, written.chars().rev().map(|digit| u64::from(digit.to_digit(10).unwrap())));
        sim.step();
        prop_assert_eq!(sim.read_u64(), FromDecimalOut { number });
    }
}

#[test]
#[should_panic(expected = "a number of 17 digits: it has from 1 to 16")]
fn a_number_of_too_many_digits() {
    FromDecimal::new(17);
}
