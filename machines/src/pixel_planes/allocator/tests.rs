//! The allocator keeps its rules and the paper's bounds, and both extremes of PP5-PW can be had.

use super::super::formulas::{greatest_load, greatest_load_of_whole_regions, least_load};
use super::super::outline::Binner;
use super::super::regions::Regions;
use super::*;
use proptest::prelude::*;
use tilewright_scenes::{ScreenVertex, Size};

fn loads(bins: &[Vec<u32>]) -> Vec<u64> {
    bins.iter().map(|bin| bin.len() as u64).collect()
}

/// A square of so many pixels a side, with its corner at a pixel.
fn square(x: i32, y: i32, side: i32) -> [ScreenVertex; 4] {
    [(0, 0), (side, 0), (side, side), (0, side)].map(|(dx, dy)| ScreenVertex {
        x: 16 * (x + dx),
        y: 16 * (y + dy),
        z: 1,
        rgb: [0; 3],
    })
}

/// Three small squares in the middle of each region: P_w = P/B.
#[test]
fn the_least_load_is_reached_where_each_primitive_is_in_one_region() {
    let regions = Regions::paper();
    let corners = (0..3 * regions.count()).map(|i| regions.pixels(i % regions.count()));
    let squares: Vec<_> = corners.map(|pixels| square(pixels.left as i32 + 60, pixels.top as i32 + 60, 8)).collect();
    let allocation = allocate(&loads(&regions.bins(&squares, Binner::Box)), 16, |size| 94 * size);
    assert_eq!(squares.len(), 240);
    assert_eq!(allocation.worst_load() as f64, least_load(240.0, 16));
    assert_eq!(allocation.worst_load(), 15);
    assert_eq!((allocation.imbalance(), allocation.time()), (1.0, 94 * 15));
}

/// Every primitive covers the screen: P_w = P R/B, 80 times as much.
#[test]
fn the_greatest_load_is_reached_where_all_cover_the_screen() {
    let regions = Regions::paper();
    let squares = vec![square(-40, -40, 1400); 240];
    for binner in Binner::ALL {
        let allocation = allocate(&loads(&regions.bins(&squares, binner)), 16, |size| 94 * size);
        assert_eq!(allocation.worst_load() as f64, greatest_load(240.0, 80, 16));
        assert_eq!(allocation.worst_load(), 80 * 15);
    }
    // 20 regions on 16 renderers: two for some of them, which is more than P R/B.
    let regions = Regions::new(Size::VGA, 128).expect("in range");
    let allocation = allocate(&loads(&regions.bins(&squares, Binner::Tight)), 16, |size| size);
    assert_eq!(allocation.worst_load(), greatest_load_of_whole_regions(240, 20, 16));
    assert_eq!(allocation.worst_load(), 480);
}

#[test]
fn large_bins_go_first_and_ties_by_number() {
    let regions = |bins: &[u64], renderers, clear| {
        let allocation = allocate(bins, renderers, |size| size + clear);
        allocation.renderers.into_iter().map(|renderer| renderer.regions).collect::<Vec<_>>()
    };
    assert_eq!(regions(&[5, 5, 5, 5], 2, 1), [[0, 2], [1, 3]]);
    assert_eq!(regions(&[1, 2, 3, 9], 2, 1), [vec![3], vec![2, 1, 0]]);
    assert_eq!(regions(&[0, 0], 3, 1), [vec![0], vec![1], vec![]]);
    assert_eq!(regions(&[], 2, 1), [[0; 0]; 2]);
    // Without a cost for what is empty, all of it goes to the one who is free.
    assert_eq!(regions(&[0, 0, 3], 2, 0), [vec![2], vec![0, 1]]);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Each region is in one renderer, the totals are sums, and nobody is given a region while another one is free earlier.
    #[test]
    fn regions_are_dealt_once(bins in proptest::collection::vec(0..50u64, 0..90), renderers in 1..20usize, clear in 0..30u64) {
        let cost = |size: u64| clear + 3 * size;
        let allocation = allocate(&bins, renderers, cost);
        prop_assert_eq!(allocation.renderers.len(), renderers);
        let mut dealt: Vec<usize> = allocation.renderers.iter().flat_map(|renderer| renderer.regions.clone()).collect();
        dealt.sort_unstable();
        prop_assert_eq!(dealt, (0..bins.len()).collect::<Vec<_>>());
        // When each region begins, and which.
        let mut begun: Vec<(u64, usize)> = Vec::new();
        for renderer in &allocation.renderers {
            let sum = |of: fn(u64) -> u64| renderer.regions.iter().map(|&region| of(bins[region])).sum::<u64>();
            prop_assert_eq!(renderer.primitives, sum(|size| size));
            prop_assert_eq!(renderer.busy, renderer.regions.iter().map(|&region| cost(bins[region])).sum::<u64>());
            let mut now = 0;
            for &region in &renderer.regions {
                begun.push((now, region));
                now += cost(bins[region]);
            }
        }
        let last = begun.iter().map(|(time, _)| *time).max().unwrap_or_default();
        prop_assert!(allocation.renderers.iter().all(|renderer| renderer.busy >= last), "someone is free earlier");
        begun.sort_by_key(|&(time, region)| (time, std::cmp::Reverse(bins[region]), region));
        prop_assert!(begun.is_sorted_by_key(|&(_, region)| std::cmp::Reverse(bins[region])));
    }

    /// PP5-PW, with regions of which renderers can have only whole ones.
    #[test]
    fn the_worst_load_is_within_the_bounds(
        squares in proptest::collection::vec((-50..700i32, -50..500i32, 1..900i32), 1..60),
        side in prop_oneof![Just(128), Just(64), Just(200)],
        renderers in 1..40usize,
        clear in 0..200u64,
        binner in proptest::sample::select(&Binner::ALL),
    ) {
        let regions = Regions::new(Size::VGA, side).expect("in range");
        let squares: Vec<_> = squares.into_iter().map(|(x, y, side)| square(x, y, side)).collect();
        let bins = regions.bins(&squares, binner);
        let mut seen: Vec<u32> = bins.concat();
        seen.sort_unstable();
        seen.dedup();
        let primitives = seen.len() as u64;
        let worst = allocate(&loads(&bins), renderers, |size| clear + 94 * size).worst_load();
        prop_assert!(worst as f64 >= least_load(primitives as f64, renderers));
        prop_assert!(worst <= greatest_load_of_whole_regions(primitives, regions.count(), renderers));
    }
}
