//! The integer contract against an exact oracle, on random triangles (facts E0; DES-EDGE, DES-ONCE, DES-Z, DES-MIN, DES-W).

use crate::oracle;
use proptest::prelude::*;
use std::ops::ControlFlow;
use tilewright_scenes::packet::{EMPTY, FARTHEST_VERTEX, NEAREST_VERTEX};
use tilewright_scenes::{Frame, Plane, ScreenVertex, Size, Triangle, frame, golden, set_up};

const SIDE: u32 = 40;

fn screen() -> Size {
    Size::new(SIDE, SIDE).unwrap()
}

/// Positions near the screen, on exact pixel centres, on a coarse grid (many ties), or anywhere in the guard band.
fn position() -> impl Strategy<Value = i32> {
    prop_oneof![
        4 => -64..16 * SIDE as i32 + 64,
        2 => (0..SIDE as i32).prop_map(|i| 16 * i + 8),
        1 => (0..6).prop_map(|i| 128 * i),
        1 => i32::from(i16::MIN)..=i32::from(i16::MAX),
    ]
}

fn depth() -> impl Strategy<Value = u32> {
    prop_oneof![
        4 => NEAREST_VERTEX..=FARTHEST_VERTEX,
        1 => NEAREST_VERTEX..NEAREST_VERTEX + 3,
        1 => FARTHEST_VERTEX - 2..=FARTHEST_VERTEX,
    ]
}

fn vertex() -> impl Strategy<Value = ScreenVertex> {
    (position(), position(), depth(), any::<[u8; 3]>()).prop_map(|(x, y, z, rgb)| ScreenVertex { x, y, z, rgb })
}

fn corners() -> impl Strategy<Value = [ScreenVertex; 3]> {
    [vertex(), vertex(), vertex()]
}

fn pixels() -> impl Iterator<Item = (u32, u32)> {
    (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)))
}

fn packets(all: &[[ScreenVertex; 3]]) -> Vec<Triangle> {
    all.iter().filter_map(|v| set_up(v, screen())).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(400) })]

    /// DES-EDGE: the reduced edge test is the sub-pixel test with the top-left rule, and the bounds leave no covered pixel out.
    #[test]
    fn coverage_is_exact(v in corners()) {
        let packet = set_up(&v, screen());
        for (x, y) in pixels() {
            let drawn = packet.as_ref().is_some_and(|t| t.bounds.contains(x, y) && t.covers(x, y));
            prop_assert_eq!(drawn, oracle::covers(&v, x, y), "pixel ({}, {})", x, y);
            if let Some(t) = &packet {
                prop_assert_eq!(t.covers(x, y), drawn, "outside the bounds at ({}, {})", x, y);
            }
        }
    }

    /// The sequence of a triangle's vertices does not affect coverage.
    #[test]
    fn orientation_does_not_matter(v in corners(), turn in 0..3usize) {
        let mirrored = [v[turn], v[(turn + 2) % 3], v[(turn + 1) % 3]];
        let (one, other) = (set_up(&v, screen()), set_up(&mirrored, screen()));
        prop_assert_eq!(one.is_some(), other.is_some());
        if let (Some(one), Some(other)) = (one, other) {
            prop_assert_eq!(one.area2, other.area2);
            for (x, y) in pixels() {
                prop_assert_eq!(one.covers(x, y), other.covers(x, y));
            }
        }
    }

    /// DES-Z: at covered centres the depth is within half a unit and 0.13 of the exact plane (v0 may be in the far
    /// guard band), and always a value that a vertex could have.
    #[test]
    fn depth_is_exact_to_a_rounding(v in corners()) {
        let Some(t) = set_up(&v, screen()) else { return Ok(()) };
        for (x, y) in pixels().filter(|&(x, y)| t.covers(x, y)) {
            let exact = oracle::plane(&v, v.map(|v| v.z.into()), x, y);
            let z = t.depth(x, y);
            prop_assert!(exact.is_within(z.into(), 32 + 9), "pixel ({}, {}): {} for {:?}", x, y, z, exact);
            prop_assert!((NEAREST_VERTEX..=FARTHEST_VERTEX).contains(&z));
        }
    }

    /// Colour: within one unit of the exact plane, and never beyond the corners' own values, so no clamp is needed.
    #[test]
    fn colour_is_exact_to_a_rounding(v in corners()) {
        let Some(t) = set_up(&v, screen()) else { return Ok(()) };
        for (x, y) in pixels().filter(|&(x, y)| t.covers(x, y)) {
            for channel in 0..3 {
                let values = v.map(|v| v.rgb[channel]);
                let got = t.rgb(x, y)[channel];
                let exact = oracle::plane(&v, values.map(i128::from), x, y);
                prop_assert!(exact.is_within(got.into(), 32 + 9), "{} for {:?}", got, exact);
                prop_assert!(values.iter().min() <= Some(&got) && Some(&got) <= values.iter().max());
            }
        }
    }

    /// DES-W: with vertices anywhere in the guard band, an edge function stays below 2^30 on the largest screen.
    #[test]
    fn edge_values_fit_32_bits(v in corners()) {
        let Some(t) = set_up(&v, Size::new(2048, 2048).unwrap()) else { return Ok(()) };
        for e in t.edges {
            prop_assert!(e.a.abs() < 1 << 16 && e.b.abs() < 1 << 16);
            for (x, y) in [(0, 0), (2047, 0), (0, 2047), (2047, 2047)] {
                let value = i64::from(e.a) * x + i64::from(e.b) * y + i64::from(e.c);
                prop_assert!(value.abs() < 1 << 30, "{}", value);
            }
        }
    }

    /// DES-ONCE: the triangles round an inner point cover every pixel of their square exactly once.
    #[test]
    fn a_fan_covers_each_pixel_once(
        (cx, cy) in (1..16 * SIDE as i32, 1..16 * SIDE as i32),
        cuts in proptest::collection::vec((0..4usize, prop_oneof![0..16 * SIDE as i32, (0..SIDE as i32).prop_map(|i| 16 * i + 8)]), 0..9),
    ) {
        let end = 16 * SIDE as i32;
        let mut ring: Vec<(usize, i32)> = cuts;
        ring.extend((0..4).map(|side| (side, 0)));
        ring.sort_unstable();
        let at = |(side, along): (usize, i32)| match side {
            0 => (along, 0),
            1 => (end, along),
            2 => (end - along, end),
            _ => (0, end - along),
        };
        let vertex = |(x, y)| ScreenVertex { x, y, z: 7, rgb: [1, 2, 3] };
        let fan: Vec<_> = (0..ring.len())
            .map(|i| [(cx, cy), at(ring[i]), at(ring[(i + 1) % ring.len()])].map(vertex))
            .collect();
        let fan = packets(&fan);
        for (x, y) in pixels() {
            let times = fan.iter().filter(|t| t.covers(x, y)).count();
            prop_assert_eq!(times, 1, "pixel ({}, {})", x, y);
        }
    }

    /// DES-MIN: the sequence of the triangles, their distribution over buffers, and the sequence of merging never
    /// change a pixel.
    #[test]
    fn order_and_partition_do_not_matter(
        all in proptest::collection::vec(corners(), 1..12),
        places in proptest::collection::vec((0..4usize, any::<u32>()), 12),
        background in any::<[u8; 3]>(),
    ) {
        let triangles = packets(&all);
        let whole = golden::render(screen(), &triangles, background);
        let mut shuffled: Vec<_> = triangles.iter().cloned().zip(&places).collect();
        shuffled.sort_by_key(|(_, (_, key))| *key);
        let mut merged = Frame::blank(screen(), background);
        for buffer in [2, 0, 3, 1] {
            let mine: Vec<_> = shuffled.iter().filter(|(_, p)| p.0 == buffer).map(|(t, _)| t.clone()).collect();
            let part = golden::render(screen(), &mine, [255; 3]);
            for (pixel, word) in merged.words.iter_mut().zip(&part.words) {
                *pixel = (*pixel).min(*word);
            }
        }
        prop_assert_eq!(merged, whole);
    }

    /// The frame equals the oracle's: at each pixel the nearest of the covering triangles, up to the rounding of depth.
    #[test]
    fn a_frame_shows_the_nearest_triangle(all in proptest::collection::vec(corners(), 1..8)) {
        let frame = golden::render(screen(), &packets(&all), [9, 9, 9]);
        for (x, y) in pixels() {
            let nearest = all
                .iter()
                .filter(|v| oracle::covers(v, x, y))
                .map(|v| oracle::plane(v, v.map(|v| v.z.into()), x, y))
                .min_by(|p, q| (p.numerator * q.denominator).cmp(&(q.numerator * p.denominator)));
            match nearest {
                None => prop_assert_eq!(frame.word(x, y), frame::blank([9, 9, 9])),
                Some(z) => prop_assert!(z.is_within(frame.depth(x, y).into(), 32 + 9)),
            }
        }
    }

    /// The strict rule gives the same depths, and the same colours wherever no exact tie is decided by colour.
    #[test]
    fn strict_differs_at_ties_alone(all in proptest::collection::vec(corners(), 1..8), twice in any::<bool>()) {
        let mut triangles = packets(&all);
        let once = golden::render_strict(screen(), &triangles, [0; 3]);
        if twice {
            let again = triangles.clone().into_iter().map(|mut t| {
                t.rgb[0].origin ^= 1 << 20;
                t
            });
            triangles.extend(again);
        }
        let loose = golden::render(screen(), &triangles, [0; 3]);
        let strict = golden::render_strict(screen(), &triangles, [0; 3]);
        let differ = loose.words.iter().zip(&strict.words).filter(|(p, q)| p != q).count() as u64;
        let ties = golden::ties(screen(), &triangles);
        prop_assert!(differ <= ties.decided_by_colour && ties.decided_by_colour <= ties.pixels);
        prop_assert!(loose.words.iter().zip(&strict.words).all(|(p, q)| p >> 24 == q >> 24));
        prop_assert_eq!(&strict, &once, "of equal depths the first submitted stays");
        if twice {
            prop_assert_eq!((ties.pixels, ties.decided_by_colour), (ties.covered, ties.covered));
        }
    }
}

#[test]
fn rendering_can_be_watched_and_stopped() {
    let at = |x, y| ScreenVertex { x, y, z: 9, rgb: [7; 3] };
    let triangles = packets(&[[at(0, 0), at(320, 0), at(0, 320)], [at(640, 0), at(640, 640), at(320, 0)]]);
    assert_eq!(triangles.len(), 2);
    let mut heard = Vec::new();
    let whole = golden::render_watched(screen(), &triangles, [1; 3], |done| {
        heard.push(done);
        ControlFlow::Continue(())
    });
    assert_eq!(heard, [0.0, 0.5]);
    assert_eq!(whole, Some(golden::render(screen(), &triangles, [1; 3])));
    let stopped = golden::render_watched(screen(), &triangles, [1; 3], |done| {
        if done == 0.0 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    assert_eq!(stopped, None);

    // The second of two at one depth is darker.
    let twice = [[90; 3], [7_u64; 3]].map(|rgb| Triangle { rgb: rgb.map(flat), ..triangles[0].clone() });
    let strict = golden::render_strict_watched(screen(), &twice, [1; 3], |_| ControlFlow::Continue(()));
    assert_eq!(strict, Some(golden::render_strict(screen(), &twice, [1; 3])));
    assert_ne!(strict, golden::render_watched(screen(), &twice, [1; 3], |_| ControlFlow::Continue(())));
}

/// The plane of a channel that is the same everywhere.
fn flat(channel: u64) -> Plane {
    Plane { x: 0, y: 0, origin: channel << 16 }
}

/// Packets against the numbers of the reference script (`setup` at the end of `check_facts.py`). A row of the file: three vertices
/// x y z, then `none`, or area2, three edges a b c, zx zy z0.
#[test]
fn set_up_gives_the_reference_numbers() {
    let largest = Size::new(2048, 2048).unwrap();
    let mut compared = 0;
    for row in include_str!("data/set_up.txt").lines().filter(|l| !l.starts_with('#')) {
        let words: Vec<i64> = row.split(' ').filter_map(|w| w.parse().ok()).collect();
        let vertex = |i: usize| ScreenVertex {
            x: words[3 * i] as i32,
            y: words[3 * i + 1] as i32,
            z: words[3 * i + 2] as u32,
            rgb: [0; 3],
        };
        let packet = set_up(&[vertex(0), vertex(1), vertex(2)], largest);
        let Some(t) = packet else {
            assert!(
                row.ends_with("none")
                    || tilewright_scenes::pixel_bounds(&[vertex(0), vertex(1), vertex(2)], largest).is_none(),
                "{row}"
            );
            continue;
        };
        let edges = t.edges.iter().flat_map(|e| [e.a, e.b, e.c].map(i64::from));
        let planes = [t.z.x, t.z.y, t.z.origin].map(|n| n as i64);
        let got: Vec<i64> = [t.area2].into_iter().chain(edges).chain(planes).collect();
        assert_eq!(got, words[9..], "{row}");
        compared += 1;
    }
    assert!(compared > 20);
}

#[test]
fn the_empty_word_is_the_identity_of_the_minimum() {
    assert_eq!(EMPTY, 0xffff_ffff_ffff);
    assert_eq!(EMPTY, frame::word(0xff_ffff, [255; 3]));
    assert_eq!(EMPTY, frame::blank([255; 3]));
}
