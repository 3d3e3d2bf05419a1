//! Pipelines with an enable, a CRC, and the position of a knob.

use proptest::prelude::*;
use std::collections::VecDeque;
use tilewright_blocks::*;
use tilewright_hdl::Codes;
use tilewright_sim::Simulation;

/// The shifted word.
fn shifted(word: u64, places: u32, kind: Shifting, width: u32) -> u64 {
    let most = u64::MAX >> (64 - width);
    let signed = (word << (64 - width)) as i64 >> (64 - width);
    let shifted = match kind {
        Shifting::Left => word << places,
        Shifting::Right => word >> places,
        Shifting::Arithmetic => (signed >> places) as u64,
    };
    shifted & most
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn products_come_out_one_clock_with_enable_per_stage_later(
        (digits, stages) in (1u32..5, 1u32..6),
        steps in prop::collection::vec((prop::bool::weighted(0.8), any::<u64>(), any::<u64>()), 1..60),
        seed in any::<u64>(),
    ) {
        let width = digits * stages;
        let mut sim = Simulation::of(&Multiplier::new(width, stages)).unwrap().seeded(seed);
        sim.reset();
        let mut inside = VecDeque::new();
        for (enable, left, right) in steps {
            let [left, right] = [left, right].map(|factor| factor & (u64::MAX >> (64 - width)));
            sim.drive(MultiplierIn { enable: enable.into(), left, right });
            sim.step();
            if enable {
                inside.push_back(left * right);
            }
            if inside.len() > stages as usize {
                inside.pop_front();
            }
            if inside.len() == stages as usize {
                prop_assert_eq!(sim.get_u64(sim.o.product), inside[0]);
            }
        }
    }

    #[test]
    fn words_are_shifted_by_any_number_of_places(
        width in 2u32..20,
        steps in prop::collection::vec((prop::bool::weighted(0.8), any::<u64>(), any::<u32>(), 0..3usize), 1..60),
        seed in any::<u64>(),
    ) {
        let mut sim = Simulation::of(&Shifter::new(width)).unwrap().seeded(seed);
        sim.reset();
        let stages = (width - 1).ilog2() as usize + 1;
        let mut inside = VecDeque::new();
        for (enable, word, places, kind) in steps {
            let (word, places, kind) = (word & (u64::MAX >> (64 - width)), places % width, Shifting::ALL[kind]);
            sim.drive(ShifterIn { enable: enable.into(), word, places: places.into(), kind: kind.code() });
            sim.step();
            if enable {
                inside.push_back(shifted(word, places, kind, width));
            }
            if inside.len() > stages {
                inside.pop_front();
            }
            if inside.len() == stages {
                prop_assert_eq!(sim.get_u64(sim.o.shifted), inside[0]);
            }
        }
    }

    #[test]
    fn words_are_rotated(
        width in 2u32..65,
        steps in prop::collection::vec((prop::bool::weighted(0.8), any::<u64>(), any::<u32>()), 1..60),
        seed in any::<u64>(),
    ) {
        let mut sim = Simulation::of(&Rotator::new(width)).unwrap().seeded(seed);
        let most = u64::MAX >> (64 - width);
        let mut expected = None;
        for (enable, word, places) in steps {
            let (word, places) = (word & most, places % width);
            sim.drive(RotatorIn { enable: enable.into(), word, places: places.into() });
            sim.step();
            if enable {
                expected = Some((word << places | word.checked_shr(width - places).unwrap_or(0)) & most);
            }
            if let Some(expected) = expected {
                prop_assert_eq!(sim.get_u64(sim.o.rotated), expected);
            }
        }
    }

    /// Few sums, so that consecutive clocks often add to the same one.
    #[test]
    fn products_are_added_to_sums(
        (sums, factor, room) in (2u64..5, 1u32..6, 0u32..4),
        steps in prop::collection::vec((prop::bool::weighted(0.8), any::<u64>(), prop::bool::weighted(0.2), any::<u64>(), any::<u64>()), 1..80),
        seed in any::<u64>(),
    ) {
        let width = 2 * factor + room;
        let mut sim = Simulation::of(&MultiplyAccumulate::new(sums as u32, factor, width)).unwrap().seeded(seed);
        sim.reset();
        let (mut model, mut inside) = (vec![None; sums as usize], VecDeque::from([None]));
        for (valid, to, restart, left, right) in steps {
            let (to, [left, right]) = (to % sums, [left, right].map(|factor_bits| factor_bits & ((1 << factor) - 1)));
            // Nothing is known about a sum that was never begun.
            let restart = restart || model[to as usize].is_none();
            sim.drive(MultiplyAccumulateIn { valid: valid.into(), to, restart: restart.into(), left, right });
            sim.step();
            let added = valid.then(|| {
                let before = model[to as usize].filter(|_| !restart).unwrap_or(0);
                let sum = (before + left * right) & ((1 << width) - 1);
                model[to as usize] = Some(sum);
                (to, sum)
            });
            inside.push_back(added);
            let out = sim.read_u64();
            prop_assert_eq!((out.done == 1).then_some((out.at, out.sum)), inside.pop_front().unwrap());
        }
    }

    /// The position follows an angle that moves by a quarter of a step, or stays, or jumps by two, which no decoder can
    /// see.
    #[test]
    fn a_knob_is_followed(
        width in 2u32..10, start in 0i64..4, moves in prop::collection::vec(-1i64..=2, 1..80), seed in any::<u64>(),
    ) {
        let mut sim = Simulation::of(&Quadrature::new(width)).unwrap().seeded(seed);
        sim.reset();
        let (mut angle, mut position, mut before) = (start, 0i64, 0);
        // The knob starts at any angle, and does not move in the first clock.
        for quarter in [0].into_iter().chain(moves) {
            angle += quarter;
            let [a, b] = [[0, 0], [1, 0], [1, 1], [0, 1]][angle.rem_euclid(4) as usize];
            sim.drive(QuadratureIn { a, b });
            sim.step();
            let turn = match quarter {
                1 => Turn::Up,
                -1 => Turn::Down,
                _ => Turn::Still,
            };
            position += if before == 2 { 0 } else { before };
            before = quarter;
            let most = (1 << width) - 1;
            prop_assert_eq!(sim.read_u64(), QuadratureOut { position: position as u64 & most, turn: turn.code() });
        }
    }

    /// Compares with long division, bit by bit.
    #[test]
    fn a_check_is_the_remainder(
        width in 2u32..65, polynomial in any::<u64>(), start in any::<u64>(), least_first: bool,
        bytes in prop::collection::vec((prop::bool::weighted(0.05), prop::bool::weighted(0.8), any::<u8>()), 0..40),
    ) {
        let most = u64::MAX >> (64 - width);
        let (polynomial, start) = (polynomial & most, start & most);
        let order = if least_first { BitOrder::LeastFirst } else { BitOrder::MostFirst };
        let mut sim = Simulation::of(&Crc::new(width, polynomial, start, order)).unwrap();
        sim.reset();
        let mut rest = start;
        let mut expected = |restart: bool, take: bool, byte: u8| {
            for place in 0..if restart || !take { 0 } else { 8 } {
                let sent = if least_first { byte >> place } else { byte >> (7 - place) } & 1;
                let leaves = rest >> (width - 1) ^ u64::from(sent);
                rest = ((rest << 1) & most) ^ (polynomial * leaves);
            }
            rest = if restart { start } else { rest };
            if least_first { rest.reverse_bits() >> (64 - width) } else { rest }
        };
        for (restart, take, byte) in bytes {
            sim.drive(CrcIn { restart: restart.into(), take: take.into(), data: byte.into() });
            sim.step();
            prop_assert_eq!(sim.get_u64(sim.o.crc), expected(restart, take, byte));
        }
    }
}

#[test]
fn a_rotator() {
    let mut sim = Simulation::of(&Rotator::new(5)).unwrap();
    let row = |enable, places| RotatorIn { enable, word: 0b10110, places };
    let seen = sim.stream([row(1, 0), row(1, 1), row(0, 2), row(1, 4), row(0, 0)]);
    let rotated: Vec<u64> = seen.iter().skip(1).map(|out| out.rotated).collect();
    assert_eq!(rotated, [0b10110, 0b01101, 0b01101, 0b01011]);
}

/// Products are added to a sum that was last changed one, two and three clocks before.
#[test]
fn products_in_two_stages() {
    let mut sim = Simulation::of(&MultiplyAccumulate::new(2, 3, 8)).unwrap().seeded(7);
    sim.reset();
    let row = |valid, to, restart, left, right| MultiplyAccumulateIn { valid, to, restart, left, right };
    let rows = [
        row(1, 0, 1, 2, 3),
        row(1, 0, 0, 4, 5),
        row(1, 1, 1, 7, 7),
        row(1, 0, 0, 1, 1),
        row(0, 0, 0, 7, 7),
        row(1, 1, 0, 1, 2),
        row(0, 0, 0, 0, 0),
        row(0, 0, 0, 0, 0),
    ];
    let seen = sim.stream(rows);
    let added: Vec<_> = seen.iter().map(|out| (out.done == 1).then_some((out.at, out.sum))).collect();
    let expected = [None, None, Some((0, 6)), Some((0, 26)), Some((1, 49)), Some((0, 27)), None, Some((1, 51))];
    assert_eq!(added, expected);
}

#[test]
fn a_reset_of_both_stages() {
    let mut sim = Simulation::of(&MultiplyAccumulate::new(2, 3, 8)).unwrap().seeded(7);
    sim.drive(MultiplyAccumulateIn { valid: 1, to: 0, restart: 1, left: 1, right: 1 });
    sim.run(3);
    sim.reset();
    sim.set(sim.i.valid, 0);
    for clock in 0..3 {
        assert_eq!(sim.get_u64(sim.o.done), 0, "clock {clock}");
        sim.step();
    }
}

#[test]
#[should_panic(expected = "the number of a sum is in range")]
fn a_sum_that_there_is_not() {
    let mut sim = Simulation::of(&MultiplyAccumulate::new(3, 2, 4)).unwrap();
    sim.set(sim.i.to, 3);
    sim.step();
}

#[test]
#[should_panic(
    expected = "4 sums of 7 bits of factors of 4 bits: there are 2 sums or more, each at least twice as wide as a factor"
)]
fn sums_without_room_for_a_product() {
    MultiplyAccumulate::new(4, 4, 7);
}

#[test]
#[should_panic(expected = "a rotator of 1 bits has nothing to rotate: it has 2 or more")]
fn a_rotator_of_a_bit() {
    Rotator::new(1);
}

/// The checks of "123456789" in the catalogue of parametrised CRC algorithms.
#[test]
fn checks_that_are_known() {
    let known = [
        (Crc::new(32, 0x04c1_1db7, 0xffff_ffff, BitOrder::LeastFirst), 0xffff_ffff, 0xcbf4_3926), // ISO-HDLC
        (Crc::new(32, 0x04c1_1db7, 0xffff_ffff, BitOrder::MostFirst), 0xffff_ffff, 0xfc89_1918),  // BZIP2
        (Crc::new(16, 0x1021, 0xffff, BitOrder::MostFirst), 0, 0x29b1), // IBM-3740, often called CCITT
        (Crc::new(8, 0x07, 0, BitOrder::MostFirst), 0, 0xf4),           // SMBUS
        (Crc::new(5, 0x05, 0x1f, BitOrder::LeastFirst), 0x1f, 0x19),    // USB
    ];
    for (crc, exchanged, check) in known {
        let mut sim = Simulation::of(&crc).unwrap();
        sim.reset();
        for byte in b"123456789" {
            sim.drive(CrcIn { restart: 0, take: 1, data: u64::from(*byte) });
            sim.step();
        }
        assert_eq!(sim.get_u64(sim.o.crc) ^ exchanged, check, "{crc:?}");
    }
}

#[test]
#[should_panic(expected = "a word that enters has a valid direction")]
fn a_kind_of_shift_that_there_is_not() {
    let mut sim = Simulation::of(&Shifter::new(4)).unwrap();
    sim.drive(ShifterIn { enable: 1, word: 0, places: 0, kind: 3 });
    sim.step();
}

#[test]
fn a_kind_of_shift_does_not_matter_where_nothing_enters() {
    let mut sim = Simulation::of(&Shifter::new(4)).unwrap();
    sim.drive(ShifterIn { enable: 0, word: 0, places: 0, kind: 3 });
    sim.step();
}

#[test]
#[should_panic(expected = "a multiplier of 8 bits in 3 stages: each stage needs the same number of bits, 1 or more")]
fn digits_that_cannot_be_shared_out() {
    Multiplier::new(8, 3);
}

#[test]
#[should_panic(expected = "a shifter of 1 bits has nothing to shift: it has 2 or more")]
fn a_shifter_of_a_bit() {
    Shifter::new(1);
}

#[test]
#[should_panic(expected = "a position of 1 bits: it has 2 or more")]
fn a_position_of_a_sign() {
    Quadrature::new(1);
}

#[test]
#[should_panic(expected = "a CRC of 65 bits: it has from 2 to 64")]
fn a_check_that_is_too_wide() {
    Crc::new(65, 1, 0, BitOrder::MostFirst);
}

#[test]
#[should_panic(
    expected = "a CRC of 8 bits by 0x107 from 0x0 on: both have 8 bits, the highest term of the polynomial left out"
)]
fn a_polynomial_with_its_highest_term() {
    Crc::new(8, 0x107, 0, BitOrder::MostFirst);
}
