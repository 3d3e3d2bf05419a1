//! The symbols of DVI 1.0.

use proptest::prelude::*;
use std::collections::BTreeSet;
use tilewright_blocks::*;
use tilewright_sim::Simulation;

/// The symbol of a byte by the flow chart of DVI 1.0, figure 3-5, and the disparity after it.
fn encoded(data: u64, count: i64) -> (u64, i64) {
    let ones = |word: u64| i64::from(word.count_ones());
    let bit = |place: u64| data >> place & 1;
    let by_xnor = ones(data) > 4 || ones(data) == 4 && bit(0) == 0;
    let mut minimized = bit(0);
    for place in 1..8 {
        let combined = minimized >> (place - 1) & 1 ^ bit(place);
        minimized |= (combined ^ u64::from(by_xnor)) << place;
    }
    let by_xor = !by_xnor;
    let more_ones = 2 * ones(minimized) - 8;
    let (inverts, count) = if count == 0 || more_ones == 0 {
        (!by_xor, if by_xor { count + more_ones } else { count - more_ones })
    } else if (count > 0) == (more_ones > 0) {
        (true, count + 2 * i64::from(by_xor) - more_ones)
    } else {
        (false, count - 2 * i64::from(!by_xor) + more_ones)
    };
    let word = if inverts { !minimized & 0xff } else { minimized };
    (u64::from(inverts) << 9 | u64::from(by_xor) << 8 | word, count)
}

/// The byte of a symbol, by figure 3-6.
fn decoded(symbol: u64) -> u64 {
    let word = if symbol >> 9 == 1 { !symbol & 0xff } else { symbol & 0xff };
    let edges = (word ^ word << 1) & 0xff;
    if symbol >> 8 & 1 == 1 { edges } else { edges ^ 0xfe }
}

/// How many neighbours in the symbol differ.
fn edges(symbol: u64) -> u32 {
    ((symbol ^ symbol >> 1) & 0x1ff).count_ones()
}

#[test]
fn symbols_of_control() {
    let mut sim = Simulation::of(&TmdsEncoder).unwrap().seeded(7);
    sim.reset();
    let rows = [0, 1, 2, 3, 0, 0].map(|control| TmdsEncoderIn { active: 0, data: 0xff, control });
    let symbols: Vec<u64> = sim.stream(rows).into_iter().skip(2).map(|out| out.symbol).collect();
    assert_eq!(symbols, [0b1101010100, 0b0010101011, 0b0101010100, 0b1010101011]);
    assert!(symbols.into_iter().all(|symbol| edges(symbol) >= 7));
}

/// 0 begins with 0x100, which has 8 zeros more than ones, so the next one is inverted.
#[test]
fn a_row_of_black() {
    let mut sim = Simulation::of(&TmdsEncoder).unwrap().seeded(7);
    sim.reset();
    let row = |active| TmdsEncoderIn { active, data: 0, control: 0 };
    let rows = [1, 1, 1, 1, 1, 0, 1, 0, 0].map(row);
    let symbols: Vec<u64> = sim.stream(rows).into_iter().skip(2).map(|out| out.symbol).collect();
    assert_eq!(symbols, [0x100, 0x3ff, 0x100, 0x3ff, 0x100, 0b1101010100, 0x100]);
}

/// Every byte after each disparity that there can be.
#[test]
fn the_flow_chart_keeps_what_it_promises() {
    let (mut known, mut new) = (BTreeSet::new(), vec![0]);
    while let Some(count) = new.pop() {
        if !known.insert(count) {
            continue;
        }
        for data in 0..256 {
            let (symbol, after) = encoded(data, count);
            assert_eq!(decoded(symbol), data);
            assert!(edges(symbol & 0xff) <= 4, "{symbol:010b}");
            assert_eq!(after, count + 2 * i64::from(symbol.count_ones()) - 10);
            new.push(after);
        }
    }
    assert_eq!((known.first(), known.last()), (Some(&-8), Some(&8)));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn pixels_and_control(
        runs in prop::collection::vec((any::<bool>(), prop::collection::vec(any::<u64>(), 1..40)), 1..8), seed in any::<u64>(),
    ) {
        let mut sim = Simulation::of(&TmdsEncoder).unwrap().seeded(seed);
        sim.reset();
        let row = |active: bool, drawn: u64| TmdsEncoderIn { active: active.into(), data: drawn & 0xff, control: drawn >> 8 & 3 };
        let rows = runs.iter().flat_map(|(active, drawn)| drawn.iter().map(|drawn| row(*active, *drawn)));
        let rows: Vec<_> = rows.chain([row(false, 0); 2]).collect();
        let mut count = 0;
        let expected = rows.iter().map(|row| {
            if row.active == 0 {
                count = 0;
                return [0b1101010100, 0b0010101011, 0b0101010100, 0b1010101011][row.control as usize];
            }
            let (symbol, after) = encoded(row.data, count);
            count = after;
            symbol
        });
        let expected: Vec<u64> = expected.take(rows.len() - 2).collect();
        let symbols: Vec<u64> = sim.stream(rows).into_iter().skip(2).map(|out| out.symbol).collect();
        prop_assert_eq!(symbols, expected);
    }
}
