//! Boxes and the regions they meet.

use super::*;

/// A box meets the regions that its pixels are in, one by one, and the one that its far border touches.
#[test]
fn a_box_is_in_the_regions_that_it_meets() {
    let boxes = Boxes { sides: [10, 40], region: [16, 8], regions: [3, 4], seed: 5 };
    let mut most = 0;
    for index in 0..2000 {
        let mut random = Random::new(boxes.seed, index);
        let x = random.between(0, 3 * 16 * 16 - 1);
        let y = random.between(0, 4 * 8 * 16 - 1);
        let mut met: Vec<u16> = (x..=x + 160)
            .flat_map(|px| (y..=y + 640).step_by(64).map(move |py| (px / 256 % 3 + py / 128 % 4 * 3) as u16))
            .collect();
        met.sort_unstable();
        met.dedup();
        let mut found: Vec<u16> = boxes.regions_of(index).collect();
        found.sort_unstable();
        assert_eq!(found, met, "({x}, {y})");
        most = most.max(found.len());
    }
    // All four lines, and never one of them twice.
    assert_eq!(most, 8);
}

#[test]
fn bins_have_all_places_and_each_primitive_first_once() {
    let boxes = Boxes { sides: [30, 30], region: [16, 8], regions: [5, 6], seed: 5 };
    let workload = Workload::of_boxes(boxes, 500, 3, 7).unwrap();
    for share in &workload.shares {
        let bins = share.bins(workload.regions);
        assert_eq!(bins.iter().flatten().filter(|binned| binned.is_first).count(), share.primitives());
        assert_eq!(bins.iter().flatten().map(|binned| binned.draws).sum::<Ticks>(), share.draws());
    }
}

#[test]
fn too_many_regions_are_refused() {
    let boxes = Boxes { sides: [1, 1], region: [1, 1], regions: [256, 256], seed: 1 };
    assert!(Workload::of_boxes(boxes, 1, 1, 1).is_err_and(|error| error.0.contains("65536 regions")));
    assert!(Workload::of_boxes(Boxes { regions: [2, 2], ..boxes }, 1, 0, 1).is_err());
}
