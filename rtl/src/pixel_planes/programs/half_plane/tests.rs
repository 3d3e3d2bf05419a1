//! The least half-planes against all half-planes of small regions, and against random ones in large regions.

use std::collections::HashMap;

use proptest::prelude::*;

use super::super::edges::{bits, range};
use super::*;

/// Whether each pixel is inside, line by line.
fn pixels(side: u32, &Expression { a, b, c }: &Expression) -> impl Iterator<Item = bool> {
    let side = i64::from(side);
    (0..side).flat_map(move |y| (0..side).map(move |x| a * x + b * y + c >= 0))
}

fn inside(side: u32, edge: &Expression) -> Vec<bool> {
    pixels(side, edge).collect()
}

fn width(side: u32, edge: &Expression) -> u32 {
    let [least, greatest] = range(side, edge);
    bits(least).max(bits(greatest))
}

/// All half-planes that cross a region, with coefficients up to twice its side.
fn all(side: u32) -> impl Iterator<Item = Expression> {
    let most = 2 * i64::from(side);
    let slopes = (-most..=most).flat_map(move |a| (-most..=most).map(move |b| (a, b)));
    slopes.flat_map(move |(a, b)| {
        let [least, greatest] = range(side, &Expression { a, b, c: 0 });
        (-greatest..-least).map(move |c| Expression { a, b, c })
    })
}

#[test]
fn no_half_plane_of_a_small_region_has_fewer_bits() {
    for side in 2..=7 {
        let mut fewest = HashMap::new();
        for edge in all(side) {
            let width = width(side, &edge);
            let kept = fewest.entry(inside(side, &edge)).or_insert(width);
            *kept = width.min(*kept);
        }
        for edge in all(side) {
            let pixels = inside(side, &edge);
            let least = least(side, &edge);
            assert_eq!(inside(side, &least), pixels, "side {side}: {edge:?} is not {least:?}");
            assert_eq!(width(side, &least), fewest[&pixels], "side {side}: {edge:?} as {least:?}");
        }
    }
}

/// Any slope, through a pixel of the region or near one.
fn edges(side: u32, most: i64) -> impl Strategy<Value = Expression> {
    let coefficient = move || prop_oneof![4 => -most..=most, 1 => -3..4i64, 1 => Just(most), 1 => Just(-most)];
    let place = move || 0..i64::from(side);
    (coefficient(), coefficient(), place(), place(), -3..4i64).prop_map(|(a, b, x, y, more)| Expression {
        a,
        b,
        c: more - a * x - b * y,
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    /// Facts E3: "every half-plane on a 128x128 grid equals one with |A|, |B| <= 127, so 15 bits suffice".
    #[test]
    fn it_is_the_same_in_15_bits_at_the_limits_of_the_contract(edge in edges(128, 65_535)) {
        const SIDE: u32 = 128;
        let least = least(SIDE, &edge);
        prop_assert_eq!(inside(SIDE, &least), inside(SIDE, &edge));
        prop_assert!(least.a.abs().max(least.b.abs()) < SIDE.into(), "{:?}", least);
        prop_assert!(width(SIDE, &least) <= 15 && width(SIDE, &least) <= width(SIDE, &edge), "{:?}", least);
    }

    /// Regions too large for an exhaustive search: no half-plane with the same |A| + |B| and fewer bits has the same
    /// pixels.
    #[test]
    fn none_that_is_simpler_is_the_same((side, edge) in (8..32u32).prop_flat_map(|side| (Just(side), edges(side, 2000)))) {
        let least = least(side, &edge);
        let inside = inside(side, &edge);
        prop_assert!(pixels(side, &least).eq(inside.iter().copied()));
        let sum = least.a.abs() + least.b.abs();
        let slopes = (-sum..=sum).flat_map(|a| [a.abs() - sum, sum - a.abs()].map(|b| (a, b)));
        for (a, b) in slopes {
            let [low, high] = range(side, &Expression { a, b, c: 0 });
            for c in -high..-low {
                let other = Expression { a, b, c };
                if width(side, &other) < width(side, &least) {
                    prop_assert!(!pixels(side, &other).eq(inside.iter().copied()), "{:?} and {:?}", other, least);
                }
            }
        }
    }
}
