//! Bins hold every region that has a pixel of a primitive, and the tight ones none but what the primitive meets.

use super::*;
use proptest::prelude::*;
use tilewright_scenes::{Polygon, angle, set_up_line, set_up_polygon, signed_area2};

const WIDTH: u32 = 90;
const HEIGHT: u32 = 70;

fn screen() -> Size {
    Size::new(WIDTH, HEIGHT).expect("in range")
}

fn regions(side: u32) -> Regions {
    Regions::new(screen(), side).expect("in range")
}

/// Positions round the screen, on borders of regions and of pixels, on centres, or far away.
fn position() -> impl Strategy<Value = i32> {
    prop_oneof![
        3 => -400..1800i32,
        3 => (-2..14i32).prop_map(|i| 128 * i),
        2 => (-8..200i32).prop_map(|i| 8 * i),
        1 => -32_768..=32_767i32,
    ]
}

fn vertices(count: std::ops::Range<usize>) -> impl Strategy<Value = Vec<ScreenVertex>> {
    let vertex = (position(), position()).prop_map(|(x, y)| ScreenVertex { x, y, z: 1, rgb: [0; 3] });
    proptest::collection::vec(vertex, count)
}

/// Corners of a convex polygon, on an ellipse.
fn convex() -> impl Strategy<Value = Vec<ScreenVertex>> {
    let radius = || prop_oneof![0..60i32, 0..2000i32];
    (position(), position(), radius(), radius(), 3..=8i32, 0..360i32)
        .prop_map(|(x, y, a, b, corners, turn)| {
            let corner = |k: i32| {
                let (sine, cosine) = angle::sin_cos(f64::from(turn) + f64::from(k) * 360.0 / f64::from(corners));
                let [x, y] = [(x, a, cosine), (y, b, sine)].map(|(middle, radius, part)| {
                    (middle + (f64::from(radius) * part).round() as i32).clamp(-32_768, 32_767)
                });
                ScreenVertex { x, y, z: 1, rgb: [0; 3] }
            };
            (0..corners).map(corner).collect()
        })
        .prop_filter("snapping may dent it", |vertices: &Vec<ScreenVertex>| {
            let round = vertices.iter().cycle().copied();
            let mut turns = round.clone().zip(round.clone().skip(1)).zip(round.skip(2)).take(vertices.len());
            turns.all(|((p, q), r)| signed_area2(&[p, q, r]) >= 0)
        })
}

fn side() -> impl Strategy<Value = u32> {
    proptest::sample::select(&[8, 16, 17, 32, 128][..])
}

fn pixels() -> impl Iterator<Item = (u32, u32)> {
    (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)))
}

/// The numbers of the regions in which some packet has a pixel.
fn drawn(regions: &Regions, packets: &[Polygon]) -> Vec<usize> {
    let covers = |&(x, y): &(u32, u32)| packets.iter().any(|packet| packet.covers(x, y));
    let mut drawn: Vec<usize> = pixels().filter(covers).map(|(x, y)| regions.of_pixel(x, y)).collect();
    drawn.sort_unstable();
    drawn.dedup();
    drawn
}

fn is_within(inner: &[usize], outer: &[usize]) -> bool {
    inner.iter().all(|region| outer.contains(region))
}

/// Whether a triangle or a segment meets a region: no axis separates them. On `touch` it is enough to meet its border.
fn meets(v: &[ScreenVertex], side: u32, (column, row): (i64, i64), touch: bool) -> bool {
    let unit = i64::from(side) * 16;
    let corners = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| ((column + i) * unit, (row + j) * unit));
    let places: Vec<(i64, i64)> = v.iter().map(|v| (v.x.into(), v.y.into())).collect();
    let next = places.iter().cycle().skip(1);
    let normals = places.iter().zip(next).map(|(p, q)| (q.1 - p.1, p.0 - q.0));
    let axes = normals.chain([(1, 0), (0, 1)]);
    let separates = |axis: (i64, i64)| {
        let along = |p: &(i64, i64)| p.0 * axis.0 + p.1 * axis.1;
        let range = |places: &[(i64, i64)]| {
            (places.iter().map(along).min().unwrap_or_default(), places.iter().map(along).max().unwrap_or_default())
        };
        let ((a, b), (c, d)) = (range(&places), range(&corners));
        if touch { b < c || d < a } else { b <= c || d <= a }
    };
    !axes.into_iter().any(separates)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(500) })]

    #[test]
    fn every_region_with_a_pixel_of_a_polygon_is_binned(vertices in prop_oneof![vertices(3..4), convex()], side in side()) {
        let regions = regions(side);
        let drawn = drawn(&regions, &set_up_polygon(&vertices, screen()));
        for binner in Binner::ALL {
            let bins = regions.of(&Outline::of(&vertices), binner);
            prop_assert!(is_within(&drawn, &bins), "{:?}: {:?} in {:?}", binner, drawn, bins);
        }
    }

    #[test]
    fn every_region_with_a_pixel_of_a_line_is_binned(ends in vertices(2..3), side in side()) {
        let regions = regions(side);
        let line: Vec<Polygon> = set_up_line([ends[0], ends[1]], screen()).into_iter().collect();
        let drawn = drawn(&regions, &line);
        for binner in Binner::ALL {
            let bins = regions.of(&Outline::of(&ends), binner);
            prop_assert!(is_within(&drawn, &bins), "{:?}: {:?} in {:?}", binner, drawn, bins);
        }
    }

    /// A tight bin is below both others, in ascending order, and a line has at most two regions in each column, or in each row.
    #[test]
    fn tight_bins_are_below_both(vertices in vertices(2..7), side in side()) {
        let regions = regions(side);
        let outline = Outline::of(&vertices);
        let [by_box, by_columns, tight] = Binner::ALL.map(|binner| regions.of(&outline, binner));
        prop_assert!(is_within(&tight, &by_box) && is_within(&tight, &by_columns));
        for bins in [&by_box, &by_columns, &tight] {
            prop_assert!(bins.is_sorted_by(|less, more| less < more) && bins.iter().all(|&region| region < regions.count()));
        }
        if let [p, q] = vertices[..] {
            let is_steep = (p.x - q.x).abs() < (p.y - q.y).abs();
            let columns = regions.columns() as usize;
            let lane = |region: usize| if is_steep { region / columns } else { region % columns };
            let most = (0..regions.count()).map(|i| by_columns.iter().filter(|&&region| lane(region) == i).count()).max();
            prop_assert!(most <= Some(2), "{:?}", by_columns);
        } else {
            prop_assert_eq!(by_box, by_columns);
        }
    }

    /// What is in a tight bin meets the triangle, and what the triangle meets in more than its border is in the bin.
    #[test]
    fn tight_bins_are_what_a_triangle_meets(vertices in vertices(3..4), side in side()) {
        let regions = regions(side);
        let tight = regions.of(&Outline::of(&vertices), Binner::Tight);
        for region in 0..regions.count() {
            let place = (region as i64 % i64::from(regions.columns()), region as i64 / i64::from(regions.columns()));
            let is_binned = tight.contains(&region);
            prop_assert!(!is_binned || meets(&vertices, side, place, true), "{} is binned", region);
            prop_assert!(is_binned || !meets(&vertices, side, place, false), "{} is not", region);
        }
    }

    #[test]
    fn bins_have_each_primitive_in_order(all in proptest::collection::vec(vertices(2..5), 0..12), side in side()) {
        let regions = regions(side);
        let bins = regions.bins(&all, Binner::Tight);
        prop_assert!(bins.iter().all(|bin| bin.is_sorted_by(|less, more| less < more)));
        for (number, vertices) in all.iter().enumerate() {
            let of: Vec<usize> = (0..bins.len()).filter(|&region| bins[region].contains(&(number as u32))).collect();
            prop_assert_eq!(of, regions.of(&Outline::of(vertices), Binner::Tight));
        }
    }
}

/// Where a line runs along a border of regions, it is binned to the one that has its pixels, and to no other.
#[test]
fn a_line_on_a_border_is_above_it_or_left_of_it() {
    let at = |x: i32, y: i32| ScreenVertex { x: 16 * x, y: 16 * y, z: 1, rgb: [0; 3] };
    let regions = regions(32);
    for (ends, expected) in [([at(3, 32), at(60, 32)], vec![0, 1]), ([at(32, 3), at(32, 60)], vec![0, 3])] {
        let line: Vec<Polygon> = set_up_line(ends, screen()).into_iter().collect();
        assert_eq!(drawn(&regions, &line), expected);
        for binner in Binner::ALL {
            assert_eq!(regions.of(&Outline::of(&ends), binner), expected, "{binner:?}");
        }
    }
}

#[test]
fn regions_tile_the_screen() {
    for side in [1, 8, 17, 64, 128] {
        let regions = regions(side);
        let mut seen = vec![0; regions.count()];
        for (x, y) in pixels() {
            let region = regions.of_pixel(x, y);
            assert!(regions.pixels(region).contains(x, y), "({x}, {y}) of {side}");
            seen[region] += 1;
        }
        let all: u32 = (0..regions.count())
            .map(|region| {
                let PixelBox { left, top, right, bottom } = regions.pixels(region);
                assert!(right < WIDTH && bottom < HEIGHT);
                (right - left + 1) * (bottom - top + 1)
            })
            .sum();
        assert_eq!(all, WIDTH * HEIGHT);
        assert!(seen.iter().all(|&pixels| pixels > 0));
    }
}

#[test]
fn impossible_regions_are_a_sentence() {
    let refused = |side| Regions::new(screen(), side).expect_err("impossible").to_string();
    assert_eq!(refused(0), "regions of 0x0 pixels: they have to be of 1 to 2048 a side");
    assert_eq!(refused(2049), "regions of 2049x2049 pixels: they have to be of 1 to 2048 a side");
}
