//! Counters, shift registers and number sequences.

use proptest::prelude::*;
use tilewright_blocks::*;
use tilewright_sim::Simulation;

#[test]
fn a_counter() {
    let mut sim = Simulation::of(&Counter::new(3)).unwrap();
    sim.reset();
    let rows = [(0, 1), (0, 1), (0, 0), (0, 1), (0, 1), (1, 1), (0, 0)];
    let seen = sim.stream(rows.map(|(restart, enable)| CounterIn { restart, enable }));
    let expected = [(0, 0), (1, 0), (2, 0), (2, 1), (0, 0), (1, 0), (0, 0)];
    assert_eq!(seen, expected.map(|(count, wraps)| CounterOut { count, wraps }));
}

#[test]
fn a_counter_of_one_number() {
    let mut sim = Simulation::of(&Counter::new(1)).unwrap();
    sim.reset();
    assert_eq!(sim.stream([CounterIn { restart: 0, enable: 1 }; 2]), [CounterOut { count: 0, wraps: 1 }; 2]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_counter_counts_up_to_its_limit(
        limit in 1..40u64,
        rows in prop::collection::vec((prop::bool::weighted(0.05), prop::bool::weighted(0.8)), 1..200),
        seed in any::<u64>(),
    ) {
        let mut sim = Simulation::of(&Counter::new(limit)).unwrap().seeded(seed);
        sim.reset();
        let mut count = 0;
        for (restart, enable) in rows {
            sim.drive(CounterIn { restart: restart.into(), enable: enable.into() });
            let wraps = enable && !restart && count == limit - 1;
            prop_assert_eq!(sim.read_u64(), CounterOut { count, wraps: wraps.into() });
            sim.step();
            count = if restart { 0 } else { (count + u64::from(enable)) % limit };
        }
    }

    #[test]
    fn a_counter_goes_around_at_both_ends(
        limit in 2..40i64,
        rows in prop::collection::vec((prop::bool::weighted(0.05), any::<bool>(), any::<bool>()), 1..200),
        seed in any::<u64>(),
    ) {
        let mut sim = Simulation::of(&UpDownCounter::new(limit as u64)).unwrap().seeded(seed);
        sim.reset();
        let mut count = 0i64;
        for (restart, up, down) in rows {
            let moved = (count + i64::from(up) - i64::from(down)).rem_euclid(limit);
            let next = if restart { 0 } else { moved };
            sim.drive(UpDownCounterIn { restart: restart.into(), up: up.into(), down: down.into() });
            prop_assert_eq!(sim.read_u64(), UpDownCounterOut { count: count as u64, next: next as u64 });
            sim.step();
            count = next;
        }
    }
}

#[test]
fn a_counter_in_both_directions() {
    let mut sim = Simulation::of(&UpDownCounter::new(3)).unwrap();
    sim.reset();
    let rows = [(0, 0, 1), (0, 0, 1), (0, 1, 0), (0, 1, 1), (0, 1, 0), (0, 1, 0), (1, 1, 0), (0, 0, 0)];
    let seen = sim.stream(rows.map(|(restart, up, down)| UpDownCounterIn { restart, up, down }));
    let expected = [(0, 2), (2, 1), (1, 2), (2, 2), (2, 0), (0, 1), (1, 0), (0, 0)];
    assert_eq!(seen, expected.map(|(count, next)| UpDownCounterOut { count, next }));
}

#[test]
fn a_shift_register() {
    let mut sim = Simulation::of(&ShiftRegister::new(4)).unwrap().seeded(7);
    sim.reset();
    let row = |load, word, shift, bit_in| ShiftRegisterIn { load, word, shift, bit_in };
    let seen = sim.stream([row(1, 0b1010, 1, 1), row(0, 0, 1, 1), row(0, 0, 0, 1), row(0, 0, 1, 0), row(0, 0, 0, 0)]);
    let expected = [(0, 0), (0b1010, 1), (0b0101, 0), (0b0101, 0), (0b1010, 1)];
    assert_eq!(seen, expected.map(|(held, bit_out)| ShiftRegisterOut { held, bit_out }));
}

#[test]
fn short_sequences_have_all_numbers() {
    for width in 2..=10 {
        let mut sim = Simulation::of(&Lfsr::new(width)).unwrap();
        sim.reset();
        let period = (1 << width) - 1;
        let seen = sim.stream((0..=period).map(|_| LfsrIn { enable: 1 }));
        let mut numbers: Vec<u64> = seen.iter().map(|out| out.number).collect();
        for pair in numbers.windows(2) {
            let parity = Lfsr::new(width).taps().iter().fold(0, |parity, tap| parity ^ pair[0] >> (tap - 1) & 1);
            assert_eq!(pair[1], (pair[0] << 1 | parity) & period, "{width} bits");
        }
        assert_eq!((numbers.pop(), numbers[0]), (Some(1), 1), "the sequence begins again after {period}");
        numbers.sort_unstable();
        assert_eq!(numbers, (1..=period).collect::<Vec<_>>(), "{width} bits");
        sim.set(sim.i.enable, 0);
        let before = sim.read_u64();
        sim.step();
        assert_eq!(sim.read_u64(), before);
    }
}

/// The product of two polynomials over GF(2), modulo a third of that degree.
fn product(mut a: u64, mut b: u64, modulus: u64, degree: u32) -> u64 {
    let mut product = 0;
    while b != 0 {
        product ^= a * (b & 1);
        b >>= 1;
        a <<= 1;
        a ^= modulus * (a >> degree);
    }
    product
}

fn power(mut exponent: u64, modulus: u64, degree: u32) -> u64 {
    let (mut result, mut square) = (1, 2);
    while exponent != 0 {
        if exponent & 1 == 1 {
            result = product(result, square, modulus, degree);
        }
        square = product(square, square, modulus, degree);
        exponent >>= 1;
    }
    result
}

/// The period is the multiplicative order of x modulo the taps' polynomial: 2^width - 1, and no proper divisor of it.
#[test]
fn the_taps_of_every_width_give_the_longest_period() {
    for width in 3..=32u32 {
        let taps = Lfsr::new(width).taps().iter().fold(0, |taps, tap| taps | 1u64 << (tap - 1));
        // Bit i of the register was shifted in i + 1 clocks ago: x to the width has the terms x to the (width - 1 - i).
        let modulus = 1 << width | (0..width).filter(|i| taps >> i & 1 == 1).fold(0, |m, i| m | 1 << (width - 1 - i));
        let period = (1u64 << width) - 1;
        assert_eq!(power(period, modulus, width), 1, "{width} bits");
        let (mut rest, mut factor) = (period, 2);
        while rest > 1 {
            factor = if factor * factor > rest { rest } else { factor };
            if rest % factor != 0 {
                factor += 1;
                continue;
            }
            assert_ne!(power(period / factor, modulus, width), 1, "{width} bits, a period of {}", period / factor);
            while rest % factor == 0 {
                rest /= factor;
            }
        }
    }
}

#[test]
#[should_panic(expected = "a counter of 0 numbers counts nothing")]
fn a_counter_of_nothing() {
    Counter::new(0);
}

#[test]
#[should_panic(expected = "a counter of 1 numbers has no two directions: it has 2 or more")]
fn a_counter_without_a_direction() {
    UpDownCounter::new(1);
}

#[test]
#[should_panic(expected = "a shift register of 1 bits has nothing to shift: it has 2 or more")]
fn nothing_to_shift() {
    ShiftRegister::new(1);
}

#[test]
#[should_panic(expected = "an LFSR of 33 bits: it has from 2 to 32")]
fn a_sequence_that_is_too_wide() {
    Lfsr::new(33);
}
