//! Regions and samples, one by one.

use proptest::prelude::*;

use super::*;

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_box_is_in_the_regions_of_its_samples(
        [width, height] in [1..60_u32, 1..60_u32],
        first in [0..3_u32, 0..3_u32],
        step in [1..4_u32, 1..5_u32],
        ends in [0..60_u32, 0..60_u32, 0..60_u32, 0..60_u32],
    ) {
        let picture = Size::new(width, height).unwrap();
        let Ok(screen) = Screen::sampled(picture, Pattern { first, step }, [8, 16]) else {
            prop_assert!(first[0] >= width || first[1] >= height);
            return Ok(());
        };
        let [left, right] = [ends[0].min(width - 1), ends[1].min(width - 1)];
        let [top, bottom] = [ends[2].min(height - 1), ends[3].min(height - 1)];
        let bounds = PixelBox { left, top, right, bottom };
        let has_samples = |region: &usize| {
            let Corner { at: [x, y], step: [across, down] } = screen.corner(*region);
            let is_inside = |i: u32, j: u32| bounds.contains(x + across * i, y + down * j);
            (0..16).any(|j| (0..8).any(|i| is_inside(i, j)))
        };
        let expected: Vec<usize> = (0..screen.count()).filter(has_samples).collect();
        prop_assert_eq!(screen.of(&bounds), expected);
    }
}
