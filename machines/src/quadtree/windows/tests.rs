//! The count against brute force over windows and over pixels.

use super::super::formulas::Shape;
use super::super::rectangles::Rectangles;
use super::*;
use proptest::prelude::*;
use tilewright_scenes::{Polygon, ScreenVertex, Size, set_up_polygon, set_up_polygon_of_any_size};

const SIDE: i32 = 32;

fn size() -> Size {
    Size::new(SIDE as u32, SIDE as u32).expect("in range")
}

fn pixels() -> impl Iterator<Item = (u32, u32)> {
    (0..SIDE as u32).flat_map(|y| (0..SIDE as u32).map(move |x| (x, y)))
}

/// Matrices for 32x32 pixels, or a little more where three is among their sides.
fn matrices() -> impl Strategy<Value = Rasters> {
    let sizes = prop_oneof![
        Just((1, 1, 5)),
        Just((2, 2, 4)),
        Just((4, 4, 3)),
        Just((2, 4, 4)),
        Just((3, 2, 4)),
        Just((8, 8, 2))
    ];
    (sizes, 0..4_u32, 0..4_u32).prop_map(|((p, q, levels), a, b)| Rasters { p, q, levels, aperture: (2 * a, 2 * b) })
}

/// Corners in 1/16 pixel: on the screen, many of them on pixel centres, or in a small part of it.
fn corners(count: impl Into<proptest::collection::SizeRange>) -> impl Strategy<Value = Vec<(i32, i32)>> {
    let wide = || prop_oneof![2 => 8..16 * SIDE - 8, 1 => (0..SIDE).prop_map(|pixel| 16 * pixel + 8)];
    let narrow = |from: i32| from..from + 40;
    let count = count.into();
    prop_oneof![
        proptest::collection::vec((wide(), wide()), count.clone()),
        (8..16 * SIDE - 48, 8..16 * SIDE - 48)
            .prop_flat_map(move |(x, y)| proptest::collection::vec((narrow(x), narrow(y)), count.clone())),
    ]
}

fn vertices(corners: &[(i32, i32)]) -> Vec<ScreenVertex> {
    corners.iter().map(|&(x, y)| ScreenVertex { x, y, z: 7, rgb: [1, 2, 3] }).collect()
}

fn search(matrix: Rasters) -> Search {
    Search::new(matrix).expect("a possible matrix")
}

/// The definition without a recursion: all windows of a level, each by the values at its four corners, and by the greatest and
/// the least position of the vertices in place of bounds.
fn by_definition(matrix: &Rasters, packet: &Polygon, corners: &[(i32, i32)], (i, j): (u32, u32), level: u32) -> u64 {
    let samples = 1_i64 << (matrix.levels - level);
    let extent = |start: i64, processors: u32, index: u32, aperture: u32| {
        let (p, i, grown) = (i64::from(processors), i64::from(index), i64::from(aperture) / 2);
        (p * start + i - grown, p * (start + samples - 1) + i + grown)
    };
    // Pixel centres, in 1/16 pixel, against positions of vertices.
    let meets = |(first, last): (i64, i64), axis: &dyn Fn(&(i32, i32)) -> i32| {
        let positions = corners.iter().map(|corner| i64::from(axis(corner)));
        let (least, greatest) = (positions.clone().min().expect("corners"), positions.max().expect("corners"));
        16 * last + 8 >= least && 16 * first + 8 <= greatest
    };
    let starts = || (0..1_i64 << level).map(move |index| index * samples);
    let passes = |(x0, y0): (i64, i64)| {
        let (x, y) = (extent(x0, matrix.p, i, matrix.aperture.0), extent(y0, matrix.q, j, matrix.aperture.1));
        let value = |edge: &Edge, x: i64, y: i64| i64::from(edge.a) * x + i64::from(edge.b) * y + i64::from(edge.c);
        let reaches =
            |edge: &Edge| [(x.0, y.0), (x.1, y.0), (x.0, y.1), (x.1, y.1)].iter().any(|&(x, y)| value(edge, x, y) >= 0);
        meets(x, &|corner| corner.0) && meets(y, &|corner| corner.1) && packet.edges.iter().all(reaches)
    };
    starts().flat_map(|y0| starts().map(move |x0| (x0, y0))).filter(|&window| passes(window)).count() as u64
}

/// Pixels of processor (i, j) that golden's rule covers.
fn covered(matrix: &Rasters, packet: &Polygon, (i, j): (u32, u32)) -> u64 {
    let own = pixels().filter(|(x, y)| x % matrix.p == i && y % matrix.q == j);
    own.filter(|&(x, y)| packet.bounds.contains(x, y) && packet.covers(x, y)).count() as u64
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(150) })]

    /// Recursion loses no window, and integer bounds, empty ones among them, lose none either.
    #[test]
    fn windows_are_those_of_the_definition(matrix in matrices(), corners in corners(3)) {
        for packet in set_up_polygon_of_any_size(&vertices(&corners), size()) {
            for processor in search(matrix).processors() {
                let windows = search(matrix).windows(&packet, processor);
                let levels = (1..=matrix.levels).map(|level| by_definition(&matrix, &packet, &corners, processor, level));
                prop_assert_eq!(&windows.passed[1..], levels.collect::<Vec<_>>(), "in processor {:?}", processor);
                prop_assert_eq!(windows.passed[0], 1);
            }
        }
    }

    /// Fragments are the pixels that golden draws; without an aperture the search ends with no others.
    #[test]
    fn fragments_are_the_covered_pixels(matrix in matrices(), corners in corners(3..8)) {
        for packet in set_up_polygon_of_any_size(&vertices(&corners), size()) {
            for processor in search(matrix).processors() {
                let expected = covered(&matrix, &packet, processor);
                prop_assert_eq!(search(matrix).windows(&packet, processor).fragments, expected);
                let exact = search(Rasters { aperture: (0, 0), ..matrix }).windows(&packet, processor);
                prop_assert_eq!((exact.passed.last(), exact.fragments), (Some(&expected), expected));
            }
        }
    }

    /// A larger aperture has no less windows on any level; a window has at most four in it, and one at least where windows meet.
    #[test]
    fn windows_grow_with_the_aperture_and_divide_in_four(matrix in matrices(), corners in corners(3..8)) {
        let larger = Rasters { aperture: (matrix.aperture.0 + 2, matrix.aperture.1 + 2), ..matrix };
        for packet in set_up_polygon_of_any_size(&vertices(&corners), size()) {
            let (windows, more) = (search(matrix).all_windows(&packet), search(larger).all_windows(&packet));
            prop_assert!(windows.passed.iter().zip(&more.passed).all(|(few, many)| few <= many));
            prop_assert_eq!(windows.fragments, more.fragments);
            prop_assert!(windows.passed.windows(2).all(|pair| pair[1] <= 4 * pair[0]));
            if matrix.aperture.0 >= matrix.p && matrix.aperture.1 >= matrix.q {
                prop_assert!(windows.passed.is_sorted());
            }
        }
    }

    /// Each pixel of a fan round an inner point is found once, whatever the matrix.
    #[test]
    fn a_fan_is_found_once(matrix in matrices(), centre in (17..495_i32, 17..495_i32), top in 1..511_i32, low in 1..511_i32) {
        let end = 16 * SIDE;
        let ring = [(0, 0), (top, 0), (end, 0), (end, end), (low, end), (0, end)];
        let triangle = |index: usize| set_up_polygon(&vertices(&[centre, ring[index], ring[(index + 1) % 6]]), size());
        let fan: Vec<Polygon> = (0..6).flat_map(triangle).collect();
        for processor in search(matrix).processors() {
            let own = pixels().filter(|(x, y)| x % matrix.p == processor.0 && y % matrix.q == processor.1).count() as u64;
            let found = fan.iter().map(|packet| search(matrix).windows(packet, processor).fragments);
            prop_assert_eq!(found.sum::<u64>(), own);
        }
    }
}

#[test]
fn clocks_are_tests_and_windows_of_each_level() {
    let windows = Windows { passed: vec![1, 3, 5], fragments: 4 };
    assert_eq!(windows.tests().collect::<Vec<_>>(), [4, 12]);
    let busy = |unit| windows.busy(Costs::new(unit, 5, 4)).collect::<Vec<_>>();
    assert_eq!(busy(Test::Serial), [4 * 5 + 3 * 4, 12 * 5 + 5 * 4]);
    assert_eq!(busy(Test::Parallel), [4 + 3 * 4, 12 + 5 * 4]);
    let mut sum = Windows::none(2);
    sum += &windows;
    sum += &windows;
    assert_eq!(sum, Windows { passed: vec![2, 6, 10], fragments: 8 });
}

#[test]
fn empty_bounds_still_meet_windows() {
    // Left of the centre of column 4 by 1/16 pixel, between those of rows 5 and 6.
    let packet = set_up_polygon_of_any_size(&vertices(&[(8, 89), (71, 89), (71, 103), (8, 103)]), size()).remove(0);
    assert_eq!(packet.bounds, PixelBox { left: 0, top: 6, right: 3, bottom: 5 });
    let passed = |q: u32, levels| search(Rasters { p: q, q, levels, aperture: (0, 0) }).all_windows(&packet).passed;
    // A window from row 5 or above to row 6 or below has it; so of two samples j and j+4 those of the processors of rows 2 and 3.
    assert_eq!(passed(1, 5)[1..], [1, 1, 1, 0, 0]);
    assert_eq!(passed(4, 3), [16, 16, 8, 0]);
}

/// Windows pass beyond the corners of a polygon if its edges alone are tested: with those alone MPG-EQ1 would be no bound (facts B).
#[test]
fn bounds_keep_windows_out_that_edges_let_pass() {
    let screen = Size::new(1024, 1024).expect("in range");
    let rectangles = Rectangles::new(screen, 23.3, 5.0, 1).expect("they fit");
    let matrix = Rasters::square(3, 10);
    let (mut bounded, mut by_edges) = (Windows::none(7), Windows::none(7));
    for packet in (0..200).map(|index| rectangles.polygon(index)) {
        let search = search(matrix);
        bounded += &search.all_windows(&packet);
        let bounds = PixelBox { left: 0, top: 0, right: 1023, bottom: 1023 };
        by_edges += &search.all_windows(&Polygon { bounds, ..packet });
    }
    assert_eq!(bounded.fragments, by_edges.fragments);
    let mean = |windows: &Windows, level: u32| windows.passed[level as usize] as f64 / (200.0 * 64.0);
    let bound = |level| matrix.windows_of(Shape::paper(23.3), level);
    assert!((1..=6).all(|level| mean(&by_edges, level) > 1.15 * bound(level)), "{by_edges:?}");
    assert!((1..=7).all(|level| mean(&bounded, level) < 1.01 * bound(level)), "{bounded:?}");
}
