//! Blocks that work on many numbers at once.

use proptest::prelude::*;
use std::collections::VecDeque;
use tilewright_blocks::*;
use tilewright_sim::Simulation;

/// The least of the numbers, and its first position.
fn least(words: &[u64]) -> (u64, u64) {
    let word = *words.iter().min().unwrap();
    (word, words.iter().position(|other| *other == word).unwrap() as u64)
}

#[test]
fn a_minimum() {
    let mut sim = Simulation::of(&Minimum::new(3, 4)).unwrap();
    let seen = [0x789, 0x377, 0x737, 0x777].map(|words| {
        sim.drive(MinimumIn { words });
        sim.read_u64()
    });
    let out = |word, index| MinimumOut { word, index };
    assert_eq!(seen, [out(7, 2), out(3, 2), out(3, 1), out(7, 0)]);
}

#[test]
fn a_minimum_in_two_stages() {
    let mut sim = Simulation::of(&PipelinedMinimum::new(3, 4)).unwrap().seeded(7);
    sim.reset();
    let row = |valid, words| PipelinedMinimumIn { valid, words };
    let seen = sim.stream([row(1, 0x789), row(0, 0), row(1, 0x777), row(1, 0x737), row(0, 0), row(0, 0)]);
    let found = seen.iter().map(|out| (out.found == 1).then_some((out.word, out.index))).collect::<Vec<_>>();
    assert_eq!(found, [None, None, Some((7, 2)), None, Some((7, 0)), Some((3, 1))]);
}

#[test]
fn a_reset_of_all_stages() {
    let mut sim = Simulation::of(&PipelinedMinimum::new(8, 4)).unwrap().seeded(7);
    sim.drive(PipelinedMinimumIn { valid: 1, words: 0 });
    sim.run(5);
    sim.reset();
    sim.drive(PipelinedMinimumIn { valid: 0, words: 0 });
    for clock in 0..5 {
        assert_eq!(sim.get_u64(sim.o.found), 0, "clock {clock}");
        sim.step();
    }
}

/// Beyond the edges there are zeros, and without `enable` the sums stay.
#[test]
fn a_filter_of_three_by_three() {
    let mut sim = Simulation::of(&BoxFilter::new(3, 3, 4)).unwrap();
    let mut sums = |enable: u64, cells: [u64; 9]| {
        sim.set(sim.i.enable, enable);
        sim.set_lanes(sim.i.cells, cells);
        sim.step();
        sim.lanes(sim.o.sums)
    };
    assert_eq!(sums(1, [0, 0, 0, 0, 1, 0, 0, 0, 0]), [1, 1, 1, 1, 1, 1, 1, 1, 1]);
    assert_eq!(sums(1, [7, 0, 0, 0, 0, 0, 0, 0, 0]), [7, 7, 0, 7, 7, 0, 0, 0, 0]);
    assert_eq!(sums(0, [15; 9]), [7, 7, 0, 7, 7, 0, 0, 0, 0]);
    assert_eq!(sums(1, [15; 9]), [60, 90, 60, 90, 135, 90, 60, 90, 60]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn minima(
        words in (2usize..11).prop_flat_map(|words| prop::collection::vec(prop::collection::vec(0u64..64, words), 1..40)),
        width in 1u32..7,
        pauses in any::<u64>(),
        seed in any::<u64>(),
    ) {
        let count = words[0].len() as u32;
        let stages = (count - 1).ilog2() as usize + 1;
        let mut plain = Simulation::of(&Minimum::new(count, width)).unwrap();
        let mut piped = Simulation::of(&PipelinedMinimum::new(count, width)).unwrap().seeded(seed);
        piped.reset();
        let mut inside = VecDeque::new();
        for (clock, words) in words.iter().enumerate() {
            // Narrow numbers are often equal.
            let words: Vec<u64> = words.iter().map(|word| word & ((1 << width) - 1)).collect();
            let (word, index) = least(&words);
            plain.set_lanes(plain.i.words, words.iter().copied());
            prop_assert_eq!(plain.read_u64(), MinimumOut { word, index });

            let valid = pauses >> clock & 1;
            piped.set(piped.i.valid, valid);
            piped.set_lanes(piped.i.words, words);
            piped.step();
            inside.push_back((valid == 1).then_some((word, index)));
            if inside.len() > stages {
                inside.pop_front();
            }
            let out = piped.read_u64();
            let found = (out.found == 1).then_some((out.word, out.index));
            prop_assert_eq!(found, if inside.len() == stages { inside[0] } else { None });
        }
    }

    #[test]
    fn sums_of_windows(
        (rows, columns) in (2i64..6, 2i64..6), width in 1u32..8, numbers in prop::collection::vec(0u64..128, 36), seed in any::<u64>(),
    ) {
        let cells: Vec<u64> = numbers[..(rows * columns) as usize].iter().map(|number| number & ((1 << width) - 1)).collect();
        let at = |row: i64, column: i64| {
            let is_inside = (0..rows).contains(&row) && (0..columns).contains(&column);
            if is_inside { cells[(row * columns + column) as usize] } else { 0 }
        };
        let around = |row, column| (-1..=1).flat_map(|y| (-1..=1).map(move |x| (y, x))).map(|(y, x)| at(row + y, column + x)).sum();
        let expected: Vec<u64> = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))).map(|(row, column)| around(row, column)).collect();
        let mut sim = Simulation::of(&BoxFilter::new(rows as u32, columns as u32, width)).unwrap().seeded(seed);
        sim.set(sim.i.enable, 1);
        sim.set_lanes(sim.i.cells, cells.iter().copied());
        sim.step();
        prop_assert_eq!(sim.lanes(sim.o.sums), expected);
    }
}

#[test]
#[should_panic(expected = "a minimum of 1 words of 4 bits: it has 2 words of 1 bit or more")]
fn a_minimum_of_one_word() {
    Minimum::new(1, 4);
}

#[test]
#[should_panic(expected = "a minimum of 4 words of 0 bits: it has 2 words of 1 bit or more")]
fn a_minimum_of_nothing() {
    PipelinedMinimum::new(4, 0);
}

#[test]
#[should_panic(expected = "a filter of 1 rows and 4 columns of 8 bits: it has 2, 2 and 1 or more")]
fn a_filter_of_a_row() {
    BoxFilter::new(1, 4, 8);
}
