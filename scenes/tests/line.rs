//! Line set-up against an exact oracle of its own (facts E0).

use proptest::prelude::*;
use tilewright_scenes::packet::{FARTHEST_VERTEX, NEAREST_VERTEX};
use tilewright_scenes::{Packet, Polygon, ScreenVertex, Size, golden, line_corners, set_up, set_up_line};

const SIDE: u32 = 40;

fn screen() -> Size {
    Size::new(SIDE, SIDE).unwrap()
}

fn pixels() -> impl Iterator<Item = (u32, u32)> {
    (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)))
}

/// Positions near the screen, on centres and borders of pixels, or anywhere in the guard band that lines may end in.
fn position() -> impl Strategy<Value = i32> {
    prop_oneof![
        4 => -64..16 * SIDE as i32 + 64,
        2 => (-2..2 * SIDE as i32 + 2).prop_map(|i| 8 * i),
        1 => i32::from(i16::MIN)..=i32::from(i16::MAX),
        1 => prop_oneof![Just(i16::MIN), Just(i16::MAX)].prop_map(i32::from),
    ]
}

fn end() -> impl Strategy<Value = ScreenVertex> {
    let depth =
        prop_oneof![NEAREST_VERTEX..=FARTHEST_VERTEX, NEAREST_VERTEX..NEAREST_VERTEX + 3, Just(FARTHEST_VERTEX)];
    (position(), position(), depth, any::<[u8; 3]>()).prop_map(|(x, y, z, rgb)| ScreenVertex { x, y, z, rgb })
}

/// Two ends, often close together, so that lines are short, flat, steep, or diagonal.
fn ends() -> impl Strategy<Value = [ScreenVertex; 2]> {
    let step = || prop_oneof![Just(0), -40..40i32, (-6..6i32).prop_map(|i| 16 * i)];
    let near = (end(), end(), step(), step(), any::<bool>()).prop_map(|(p, q, dx, dy, diagonal)| {
        let dy = if diagonal { dx } else { dy };
        let limit = |place: i32| place.clamp(i16::MIN.into(), i16::MAX.into());
        [p, ScreenVertex { x: limit(p.x + dx), y: limit(p.y + dy), ..q }]
    });
    prop_oneof![2 => [end(), end()], 1 => near]
}

/// A line as a function: its range of coordinates, and its values at each, in exact numbers.
struct Run {
    is_flat: bool,
    /// The end with the lesser coordinate along the major axis: that coordinate, and the other.
    from: (i128, i128),
    to: (i128, i128),
    values: [(i128, i128); 4],
}

impl Run {
    fn of([p, q]: [ScreenVertex; 2]) -> Run {
        let is_flat = (p.x - q.x).abs() >= (p.y - q.y).abs();
        let place = |v: ScreenVertex| match is_flat {
            true => (i128::from(v.x), i128::from(v.y)),
            false => (i128::from(v.y), i128::from(v.x)),
        };
        let (p, q) = if place(p).0 <= place(q).0 { (p, q) } else { (q, p) };
        let value = |of: fn(ScreenVertex) -> u32| (of(p).into(), of(q).into());
        let values =
            [value(|v| v.z), value(|v| v.rgb[0].into()), value(|v| v.rgb[1].into()), value(|v| v.rgb[2].into())];
        Run { is_flat, from: place(p), to: place(q), values }
    }

    /// Along the major and the minor axis.
    fn axes(&self, x: u32, y: u32) -> (i128, i128) {
        let centre = |i: u32| i128::from(16 * i + 8);
        if self.is_flat { (centre(x), centre(y)) } else { (centre(y), centre(x)) }
    }

    /// Whether the line covers the sample of pixel (x, y), which is its centre moved right by an infinitesimal and down by a smaller one.
    fn covers(&self, x: u32, y: u32) -> bool {
        let (along, across) = self.axes(x, y);
        let (length, rise) = (self.to.0 - self.from.0, self.to.1 - self.from.1);
        // The centre's distance from the line times the length, and its change by the infinitesimals, the larger one
        // first.
        let beside = (across - self.from.1) * length - (along - self.from.0) * rise;
        let changes = if self.is_flat { [-rise, length] } else { [length, -rise] };
        let grows = changes.into_iter().find(|&change| change != 0).is_some_and(|change| change > 0);
        let half = 8 * length;
        let is_beside = -half < beside && beside < half || beside == -half && grows || beside == half && !grows;
        self.from.0 <= along && along < self.to.0 && is_beside
    }

    /// Whether that is the exact value number `which` at pixel (x, y), within `parts` parts of 64: depth, red, green,
    /// blue.
    fn is_near(&self, which: usize, (x, y): (u32, u32), value: u32, parts: i128) -> bool {
        let ((first, last), length) = (self.values[which], self.to.0 - self.from.0);
        let exact = first * length + (last - first) * (self.axes(x, y).0 - self.from.0);
        64 * (i128::from(value) * length - exact).abs() <= parts * length
    }
}

fn covered(packet: &Option<Polygon>, x: u32, y: u32) -> bool {
    packet.as_ref().is_some_and(|packet| packet.bounds.contains(x, y) && packet.covers(x, y))
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(600) })]

    #[test]
    fn coverage_is_exact(ends in ends()) {
        let (packet, run) = (set_up_line(ends, screen()), Run::of(ends));
        for (x, y) in pixels() {
            prop_assert_eq!(covered(&packet, x, y), run.covers(x, y), "pixel ({}, {})", x, y);
        }
        prop_assert!(packet.is_none_or(|packet| packet.edges.len() == 4));
    }

    /// Each column whose centre is between the ends has one pixel of the line, if it is on the screen; the same is true
    /// of rows.
    #[test]
    fn a_column_has_one_pixel(ends in ends()) {
        let (packet, run) = (set_up_line(ends, screen()), Run::of(ends));
        for i in 0..SIDE {
            let at = |j: u32| if run.is_flat { (i, j) } else { (j, i) };
            let count = (0..SIDE).filter(|&j| covered(&packet, at(j).0, at(j).1)).count();
            let centre = i128::from(16 * i + 8);
            let is_between = run.from.0 <= centre && centre < run.to.0;
            // The line's own place there, in pixels.
            let place = |side: i128| {
                let (length, rise) = (run.to.0 - run.from.0, run.to.1 - run.from.1);
                (run.from.1 * length + (centre - run.from.0) * rise).cmp(&(side * 16 * length))
            };
            let is_inside = is_between && place(0).is_gt() && place(SIDE.into()).is_lt();
            let is_outside = !is_between || place(0).is_lt() || place(SIDE.into()).is_gt();
            prop_assert!(is_inside && count == 1 || is_outside && count == 0 || !is_inside && !is_outside && count <= 1, "{}", count);
        }
    }

    /// Within half a unit and the 1/16 that the gradient may lose over the guard band; and never beyond the values of
    /// the ends.
    #[test]
    fn depth_and_colour_change_along_the_major_axis(ends in ends()) {
        let run = Run::of(ends);
        if let Some(packet) = set_up_line(ends, screen()) {
            for (x, y) in pixels().filter(|&(x, y)| packet.covers(x, y)) {
                let [r, g, b] = packet.rgb(x, y).map(u32::from);
                for (which, value) in [packet.depth(x, y), r, g, b].into_iter().enumerate() {
                    prop_assert!(run.is_near(which, (x, y), value, 32 + 5), "{} at ({}, {})", value, x, y);
                    let (first, last) = run.values[which];
                    prop_assert!((first.min(last)..=first.max(last)).contains(&value.into()));
                }
            }
            let across = |plane: tilewright_scenes::Plane| if run.is_flat { plane.y } else { plane.x };
            prop_assert_eq!([packet.z, packet.rgb[0], packet.rgb[1], packet.rgb[2]].map(across), [0; 4]);
        }
    }

    #[test]
    fn the_direction_does_not_matter([p, q] in ends()) {
        prop_assert_eq!(set_up_line([p, q], screen()), set_up_line([q, p], screen()));
    }

    /// As two triangles, for machines that draw no other polygons, a line has the same pixels, each of them once.
    #[test]
    fn the_halves_are_the_line(ends in ends()) {
        let corners = line_corners(ends);
        let halves: Vec<_> =
            [[0, 1, 2], [0, 2, 3]].iter().filter_map(|half| set_up(&half.map(|i| corners[i]), screen())).collect();
        let line: Vec<Polygon> = set_up_line(ends, screen()).into_iter().collect();
        let whole = golden::render(screen(), &line, [7; 3]);
        prop_assert_eq!(golden::render(screen(), &halves, [7; 3]), whole);
        for (x, y) in pixels() {
            let times = halves.iter().filter(|half| half.covers(x, y)).count();
            prop_assert_eq!(times, usize::from(line.iter().any(|line| line.covers(x, y))));
        }
    }

    /// Successive lines along an axis have one pixel in each column, even where one ends and the next begins.
    #[test]
    fn a_chain_has_no_gap_and_no_overlap(steps in proptest::collection::vec((1..90i32, -16..=16i32), 1..12), swapped in any::<bool>()) {
        let mut place = (3, 320);
        let mut chain = vec![place];
        for (dx, slope) in steps {
            place = (place.0 + dx, (place.1 + dx * slope / 17).clamp(16, 624));
            chain.push(place);
        }
        let vertex = |&(x, y): &(i32, i32)| ScreenVertex {
            x: if swapped { y } else { x },
            y: if swapped { x } else { y },
            z: 1,
            rgb: [0; 3],
        };
        let lines: Vec<_> = chain
            .array_windows()
            .filter_map(|[p, q]| set_up_line([vertex(p), vertex(q)], screen()))
            .collect();
        for i in 0..SIDE {
            let at = |j: u32| if swapped { (j, i) } else { (i, j) };
            let times: usize = (0..SIDE).map(|j| lines.iter().filter(|line| line.covers(at(j).0, at(j).1)).count()).sum();
            let centre = 16 * i as i32 + 8;
            prop_assert_eq!(times, usize::from(3 <= centre && centre < place.0), "column {}", i);
        }
    }

    /// Ends anywhere in the guard band leave edges of 17 bits, of halves 18, and keep an edge function below 2^30 on the largest screen
    /// (DES-W).
    #[test]
    fn edges_fit(ends in ends()) {
        let (largest, corners) = (Size::new(2048, 2048).unwrap(), line_corners(ends));
        let halves = [[0, 1, 2], [0, 2, 3]].map(|half| set_up(&half.map(|i| corners[i]), largest).map(Polygon::from));
        for (packet, bits) in halves.into_iter().map(|half| (half, 17)).chain([(set_up_line(ends, largest), 16)]) {
            for edge in packet.iter().flat_map(|packet| &packet.edges) {
                prop_assert!(edge.a.abs() < 1 << bits && edge.b.abs() < 1 << bits);
                for (x, y) in [(0, 0), (2047, 0), (0, 2047), (2047, 2047)] {
                    let value = i64::from(edge.a) * x + i64::from(edge.b) * y + i64::from(edge.c);
                    prop_assert!(value.abs() < 1 << 30, "{}", value);
                }
            }
        }
    }
}

fn at(x: i32, y: i32) -> ScreenVertex {
    ScreenVertex { x, y, z: 9, rgb: [0; 3] }
}

fn drawn(packet: &Polygon) -> Vec<(u32, u32)> {
    pixels().filter(|&(x, y)| packet.covers(x, y)).collect()
}

/// From the middle pixel to eight sides, between centres: seven pixels, the first of them where the coordinate is less.
#[test]
fn octants() {
    let to = |x: i32, y: i32| {
        let packet = set_up_line([at(328, 328), at(328 + 16 * x, 328 + 16 * y)], screen()).expect("seven pixels");
        let places = drawn(&packet).into_iter();
        places.map(|(x, y)| (x as i32 - 20, y as i32 - 20)).collect::<Vec<_>>()
    };
    let run = |of: fn(i32) -> (i32, i32)| (0..7).map(of).collect::<Vec<_>>();
    let sorted = |mut places: Vec<(i32, i32)>| {
        places.sort_by_key(|&(x, y)| (y, x));
        places
    };
    assert_eq!(to(7, 0), run(|i| (i, 0)));
    assert_eq!(to(-7, 0), run(|i| (i - 7, 0)));
    assert_eq!(to(0, 7), run(|i| (0, i)));
    assert_eq!(to(0, -7), run(|i| (0, i - 7)));
    assert_eq!(to(7, 7), run(|i| (i, i)));
    assert_eq!(to(-7, -7), run(|i| (i - 7, i - 7)));
    assert_eq!(to(7, -7), sorted(run(|i| (i, -i))));
    assert_eq!(to(-7, 7), sorted(run(|i| (i - 7, 7 - i))));
    for (x, y) in [(7, 3), (7, -3), (-7, 3), (-7, -3), (3, 7), (-3, 7), (3, -7), (-3, -7)] {
        let places = to(x, y);
        assert_eq!(places.len(), 7, "({x}, {y})");
        let (major, minor): (Vec<i32>, Vec<i32>) = match x.abs() > y.abs() {
            true => places.iter().copied().unzip(),
            false => places.iter().map(|&(x, y)| (y, x)).unzip(),
        };
        // The nearest row of each column, which is never half way.
        for (column, row) in major.into_iter().zip(minor) {
            let exact = 3 * column * if x * y > 0 { 1 } else { -1 };
            assert!((7 * row - exact).abs() * 2 < 7, "({x}, {y}): {row} in {column}");
        }
    }
}

#[test]
fn points_and_lines_between_centres_have_no_pixel() {
    let none = |p, q| set_up_line([p, q], screen()).is_none_or(|packet: Packet<_>| drawn(&packet).is_empty());
    assert!(set_up_line([at(328, 328); 2], screen()).is_none());
    assert!(none(at(329, 328), at(343, 335)), "between the centres at 328 and 344");
    assert!(none(at(329, 328), at(344, 335)), "the end with the greater coordinate has no column");
    assert!(!none(at(328, 328), at(329, 328)), "and the one with the lesser has");
    assert!(none(at(-500, 30), at(-1, 90)) && none(at(30, 641 + 8), at(900, 900)));
}
