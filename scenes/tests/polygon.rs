//! Polygon set-up against the exact oracle of triangles (facts E0, A3; MPG-RP).

use crate::oracle;
use proptest::prelude::*;
use tilewright_scenes::packet::{FARTHEST_VERTEX, MOST_EDGES, NEAREST_VERTEX};
use tilewright_scenes::{
    PixelBox, Polygon, ScreenVertex, Size, frame, golden, set_up, set_up_polygon, set_up_polygon_of_any_size,
    signed_area2,
};

const SIDE: u32 = 40;

fn screen() -> Size {
    Size::new(SIDE, SIDE).unwrap()
}

fn pixels() -> impl Iterator<Item = (u32, u32)> {
    (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)))
}

fn fan(vertices: &[ScreenVertex]) -> Vec<[ScreenVertex; 3]> {
    (2..vertices.len()).map(|i| [vertices[0], vertices[i - 1], vertices[i]]).collect()
}

/// How many packets cover a pixel, bounds and all.
fn times(packets: &[Polygon], x: u32, y: u32) -> usize {
    packets.iter().filter(|packet| packet.bounds.contains(x, y) && packet.covers(x, y)).count()
}

/// Positions near the screen, on a coarse grid with many lines and repetitions, or anywhere in the guard band.
fn position() -> impl Strategy<Value = i32> {
    prop_oneof![
        4 => -64..16 * SIDE as i32 + 64,
        3 => (0..6).prop_map(|i| 128 * i + 8),
        1 => i32::from(i16::MIN)..=i32::from(i16::MAX),
    ]
}

/// The convex hull of random points, from a random one of them, in a random direction.
fn convex() -> impl Strategy<Value = Vec<(i32, i32)>> {
    let points = proptest::collection::vec((position(), position()), 3..40);
    (points, any::<prop::sample::Index>(), any::<bool>()).prop_map(|(points, start, mirrored)| {
        let mut hull = hull(points);
        let start = start.index(hull.len());
        hull.rotate_left(start);
        if mirrored {
            hull.reverse();
        }
        hull
    })
}

/// Andrew's monotone chain.
fn hull(mut points: Vec<(i32, i32)>) -> Vec<(i32, i32)> {
    points.sort_unstable();
    points.dedup();
    let turns = |p: (i32, i32), q: (i32, i32), r: (i32, i32)| {
        let d = |p: i32, q: i32| i64::from(q) - i64::from(p);
        d(p.0, q.0) * d(p.1, r.1) - d(p.1, q.1) * d(p.0, r.0) > 0
    };
    let half = |points: &mut dyn Iterator<Item = (i32, i32)>| {
        let mut chain: Vec<(i32, i32)> = Vec::new();
        for point in points {
            while chain.len() > 1 && !turns(chain[chain.len() - 2], chain[chain.len() - 1], point) {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut all = half(&mut points.iter().copied());
    all.extend(half(&mut points.iter().rev().copied()));
    all
}

fn tilt() -> impl Strategy<Value = (i32, i32)> {
    prop_oneof![Just((0, 0)), (-90..90i32, -90..90i32)]
}

/// Depth and colours that are linear over the screen and its guard band, with halves and less rounded off.
fn in_one_plane(points: &[(i32, i32)], tilt: (i32, i32), base: u32) -> Vec<ScreenVertex> {
    let linear =
        |(x, y): (i32, i32), scale: i64| (i64::from(x) * i64::from(tilt.0) + i64::from(y) * i64::from(tilt.1)) >> scale;
    let vertex = |&point: &(i32, i32)| ScreenVertex {
        x: point.0,
        y: point.1,
        z: (i64::from(base) + linear(point, 4)) as u32,
        rgb: [127 + linear(point, 16), 128 - linear(point, 16), 9].map(|channel| channel as u8),
    };
    points.iter().map(vertex).collect()
}

fn vertex() -> impl Strategy<Value = ScreenVertex> {
    let depth =
        prop_oneof![NEAREST_VERTEX..=FARTHEST_VERTEX, NEAREST_VERTEX..NEAREST_VERTEX + 3, Just(FARTHEST_VERTEX)];
    let channel = prop_oneof![any::<u8>(), 0..2u8, 254..=255u8];
    (position(), position(), depth, [channel.clone(), channel.clone(), channel])
        .prop_map(|(x, y, z, rgb)| ScreenVertex { x, y, z, rgb })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(400) })]

    /// Every polygon covers the pixels of its fan's triangles.
    #[test]
    fn coverage_is_that_of_the_fan(vertices in proptest::collection::vec(vertex(), 3..12), flat in any::<bool>()) {
        let level = |v: ScreenVertex| if flat { ScreenVertex { z: 9, rgb: [9; 3], ..v } } else { v };
        let vertices: Vec<ScreenVertex> = vertices.into_iter().map(level).collect();
        let packets = set_up_polygon(&vertices, screen());
        for (x, y) in pixels() {
            let covered = fan(&vertices).iter().any(|triangle| oracle::covers(triangle, x, y));
            prop_assert_eq!(times(&packets, x, y) > 0, covered, "pixel ({}, {})", x, y);
        }
    }

    /// A convex polygon in one plane is one packet for each eight edges, and covers each pixel once.
    #[test]
    fn a_flat_convex_polygon_is_one_packet(points in convex(), tilt in tilt(), base in 2_000_000..14_000_000u32) {
        let vertices = in_one_plane(&points, tilt, base);
        let packets = set_up_polygon(&vertices, screen());
        // On a tilted one depths are rounded, so that a sliver of a first triangle may leave the others out of its plane.
        if tilt == (0, 0) {
            let parts = points.len().saturating_sub(2).div_ceil(MOST_EDGES - 2);
            prop_assert!(packets.len() <= parts, "{} packets of {} vertices", packets.len(), points.len());
        }
        prop_assert!(packets.iter().all(|packet| (3..=MOST_EDGES).contains(&packet.edges.len())));
        for (x, y) in pixels() {
            let covered = fan(&vertices).iter().any(|triangle| oracle::covers(triangle, x, y));
            prop_assert_eq!(times(&packets, x, y), usize::from(covered), "pixel ({}, {})", x, y);
        }
    }

    /// Depth and colour are those of the plane through a triangle of the fan, to half a unit and 0.13, and nowhere values that no
    /// vertex could have.
    #[test]
    fn depth_and_colour_are_of_the_first_proper_triangle(
        points in convex(),
        tilt in tilt(),
        base in 2_000_000..14_000_000u32,
        bent in proptest::option::of((any::<prop::sample::Index>(), 0..4u32)),
    ) {
        let mut vertices = in_one_plane(&points, tilt, base);
        if let Some((index, by)) = bent
            && !vertices.is_empty()
        {
            let last = vertices.len();
            vertices[index.index(last)].z += by;
        }
        for packet in set_up_polygon(&vertices, screen()) {
            let fits = |triangle: &[ScreenVertex; 3]| {
                signed_area2(triangle) != 0
                    && pixels().filter(|&(x, y)| packet.covers(x, y)).all(|(x, y)| {
                        let exact = oracle::plane(triangle, triangle.map(|v| v.z.into()), x, y);
                        let red = oracle::plane(triangle, triangle.map(|v| v.rgb[0].into()), x, y);
                        exact.is_within(packet.depth(x, y).into(), 32 + 9) && red.is_within(packet.rgb(x, y)[0].into(), 32 + 9)
                    })
            };
            prop_assert!(fan(&vertices).iter().any(fits));
            for (x, y) in pixels().filter(|&(x, y)| packet.covers(x, y)) {
                prop_assert!((NEAREST_VERTEX..=FARTHEST_VERTEX).contains(&packet.depth(x, y)));
            }
        }
    }

    /// A triangle gives the same result with and without the rules for polygons.
    #[test]
    fn a_triangle_stays_as_it_is(vertices in [vertex(), vertex(), vertex()]) {
        let expected: Vec<Polygon> = set_up(&vertices, screen()).map(Polygon::from).into_iter().collect();
        prop_assert_eq!(set_up_polygon(&vertices, screen()), expected);
    }

    /// Those that enclose no centre come on top of the others, in empty bounds that no neighbour's centre is between.
    #[test]
    fn of_any_size_are_those_with_centres_and_empty_ones(vertices in proptest::collection::vec(small(), 3..7)) {
        let all = set_up_polygon_of_any_size(&vertices, screen());
        for PixelBox { left, top, right, bottom } in all.iter().map(|packet| packet.bounds) {
            prop_assert!(left < SIDE && left <= right + 1 && right < SIDE, "{} to {}", left, right);
            prop_assert!(top < SIDE && top <= bottom + 1 && bottom < SIDE, "{} to {}", top, bottom);
        }
        let (empty, full): (Vec<_>, Vec<_>) = all.into_iter().partition(|packet| packet.bounds.is_empty());
        prop_assert_eq!(full, set_up_polygon(&vertices, screen()));
        prop_assert!(pixels().all(|(x, y)| times(&empty, x, y) == 0));
    }
}

/// Vertices of polygons of a pixel or so, on the screen and at its borders.
fn small() -> impl Strategy<Value = ScreenVertex> {
    let border = 16 * SIDE as i32;
    let position = || prop_oneof![300..320, -24..12, border - 12..border + 24];
    (position(), position(), 1..3u32).prop_map(|(x, y, z)| ScreenVertex { x, y, z, rgb: [0; 3] })
}

#[test]
fn bounds_between_centres_are_empty_along_that_axis() {
    let bounds = |x: [i32; 2], y: [i32; 2]| {
        let at = |x, y| ScreenVertex { x, y, z: 1, rgb: [0; 3] };
        let corners = [at(x[0], y[0]), at(x[1], y[0]), at(x[1], y[1]), at(x[0], y[1])];
        let packets = set_up_polygon_of_any_size(&corners, screen());
        packets.iter().map(|packet| packet.bounds).collect::<Vec<_>>()
    };
    let only = |left, right, top, bottom| vec![PixelBox { left, top, right, bottom }];
    // Centres are at 8, 24, 40, 56 .. 632.
    assert_eq!(bounds([25, 39], [25, 39]), only(2, 1, 2, 1));
    assert_eq!(bounds([24, 39], [25, 40]), only(1, 1, 2, 2));
    assert_eq!(bounds([9, 57], [25, 39]), only(1, 3, 2, 1));
    assert_eq!(bounds([9, 57], [30, 30]), [], "no area");
    // Before the first centre and behind the last there is nothing between two centres of the screen.
    assert_eq!(bounds([0, 7], [25, 39]), []);
    assert_eq!(bounds([0, 8], [25, 39]), only(0, 0, 2, 1));
    assert_eq!(bounds([633, 640], [25, 39]), []);
    assert_eq!(bounds([632, 640], [25, 39]), only(39, 39, 2, 1));
    assert_eq!(bounds([25, 39], [-90, -80]), []);
    assert_eq!(bounds([25, 39], [700, 710]), []);
}

fn at(x: i32, y: i32, z: u32) -> ScreenVertex {
    ScreenVertex { x: 16 * x, y: 16 * y, z, rgb: [0, 255, 7] }
}

fn edges(vertices: &[ScreenVertex]) -> Vec<usize> {
    set_up_polygon(vertices, screen()).iter().map(|packet| packet.edges.len()).collect()
}

#[test]
fn one_unit_is_the_most_that_a_vertex_may_leave_the_plane() {
    let square = |z| [at(2, 2, 1000), at(9, 2, 2000), at(9, 9, 4000), at(2, 9, z)];
    assert_eq!([2999, 3000, 3001].map(|z| edges(&square(z))), [[4]; 3]);
    assert_eq!([2998, 3002].map(|z| edges(&square(z))), [[3, 3]; 2]);
    // No vertex has the depth 0, or a channel of 256, which would be 0 again.
    let depth = |z| edges(&[at(2, 2, 1), at(9, 2, 2), at(9, 9, 2), at(2, 9, z)]);
    assert_eq!([depth(1), depth(2)], [[4], [4]]);
    assert_eq!(edges(&[at(2, 2, 2), at(9, 2, 3), at(9, 9, 2), at(2, 9, 1)]), [4]);
    assert_eq!(edges(&[at(2, 2, 1), at(9, 2, 2), at(9, 9, 1), at(2, 9, 1)]), [3, 3]);
    let green = |levels: [u8; 4]| {
        let corners = [at(2, 2, 5), at(9, 2, 5), at(9, 9, 5), at(2, 9, 5)];
        edges(&[0, 1, 2, 3].map(|i| ScreenVertex { rgb: [0, levels[i], 0], ..corners[i] }))
    };
    assert_eq!(green([254, 253, 254, 255]), [4]);
    assert_eq!(green([255, 254, 255, 255]), [3, 3]);
}

#[test]
fn what_is_not_convex_is_fanned_and_repetitions_are_no_edges() {
    let arrow = [at(2, 2, 5), at(20, 2, 5), at(6, 6, 5), at(2, 20, 5)];
    assert_eq!(edges(&arrow), [3, 3]);
    let star: Vec<ScreenVertex> = [(20, 2), (31, 35), (2, 14), (38, 14), (9, 35)].map(|(x, y)| at(x, y, 5)).to_vec();
    assert_eq!(edges(&star), [3, 3, 3]);
    let repeated = [at(2, 2, 5), at(2, 2, 5), at(9, 2, 5), at(9, 9, 5), at(9, 9, 5), at(2, 9, 5), at(2, 2, 5)];
    assert_eq!(edges(&repeated), [4]);
    assert_eq!(edges(&[at(2, 2, 5), at(9, 9, 5), at(4, 4, 5), at(3, 3, 5)]), [0; 0]);
    assert_eq!(edges(&[at(2, 2, 5), at(9, 9, 5)]), [0; 0]);
}

#[test]
fn many_edges_are_several_packets_of_one_plane() {
    let round = |count: i32| -> Vec<ScreenVertex> {
        let angle = |i: i32| std::f64::consts::TAU * f64::from(i) / f64::from(count);
        let place = |c: f64| (320.0 + 300.0 * c) as i32;
        (0..count)
            .map(|i| ScreenVertex { x: place(angle(i).cos()), y: place(angle(i).sin()), ..at(0, 0, 77) })
            .collect()
    };
    assert_eq!(edges(&round(8)), [8]);
    assert_eq!(edges(&round(9)), [8, 3]);
    assert_eq!(edges(&round(20)), [8, 8, 8]);
    let packets = set_up_polygon(&round(20), screen());
    assert!(packets.iter().all(|packet| (packet.z, packet.rgb) == (packets[0].z, packets[0].rgb)));
    let frame = golden::render(screen(), &packets, [0; 3]);
    let covers = |x, y| fan(&round(20)).iter().any(|triangle| oracle::covers(triangle, x, y));
    let expected =
        pixels().map(|(x, y)| if covers(x, y) { frame::word(77, [0, 255, 7]) } else { frame::blank([0; 3]) });
    assert!(frame.words.into_iter().eq(expected));
    let doubled: i64 = fan(&round(20)).iter().map(signed_area2).sum();
    assert_eq!(packets.iter().map(|packet| packet.area2).sum::<i64>(), doubled.abs());
}
