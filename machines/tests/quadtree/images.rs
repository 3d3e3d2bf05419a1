//! Every frame is the golden one.

use crate::quadtree::polygons::{BACKGROUND, random, render, scene, size};
use tilewright_machines::quadtree::{Config, Queues, Test};
use tilewright_scenes::{Polygon, compare, golden};

/// Lines are packets of four edges, most of them thin and slanting.
#[test]
fn lines_are_the_golden_ones() {
    for (name, size) in [("star", size(61, 47)), ("wireframe", size(80, 60))] {
        let packets = scene(name, size);
        assert!(packets.len() > 200 && packets.iter().all(|packet| packet.edges.len() == 4));
        let usual = Config::for_packets(size, &packets);
        let lines = |form: &str, test, strict| Config { form: form.to_owned(), test, strict, ..usual.clone() };
        assert_golden(&lines("pipe", Test::Parallel, false), &packets);
        assert_golden(&lines("tree:1+stack", Test::Serial, true), &packets);
    }
}

/// Queues of one place each.
const SHORT: Queues = Queues { broadcast: 1, packets: 1, windows: 1 };

#[track_caller]
fn assert_golden(config: &Config, packets: &[Polygon]) {
    let (frame, _) = render(config, packets);
    let golden = match config.strict {
        true => golden::render_strict(config.size, packets, BACKGROUND),
        false => golden::render(config.size, packets, BACKGROUND),
    };
    let comparison = compare(&frame, &golden);
    assert!(comparison.is_equal(), "{config:?}: {comparison}");
}

/// All k of the paper, matrices that are no squares, all forms and mixes, short and long queues, both tests, with and without an aperture.
#[test]
fn every_machine_draws_the_golden_frame_of_polygons_of_any_number_of_edges() {
    use Test::{Parallel, Serial};
    let long = Queues { broadcast: 3, packets: 9, windows: 5 };
    let cases = [
        ((1, 1), "stack", Serial, SHORT, 0),
        ((1, 1), "pipe:3+tree:2+stack", Parallel, SHORT, 2),
        ((2, 2), "pipe:3+stack", Serial, SHORT, 2),
        ((4, 4), "stack:2+pipe:1+tree", Serial, long, 2),
        ((4, 4), "pipe", Parallel, SHORT, 0),
        ((8, 8), "stack", Serial, long, 8),
        ((16, 16), "stack", Parallel, SHORT, 0),
        ((2, 8), "tree:1+stack", Parallel, long, 0),
        ((16, 1), "pipe:1+stack", Serial, long, 4),
    ];
    // No power of two, and no multiple of the matrix.
    let size = size(43, 29);
    let packets = random(1, 24, size, 12);
    let edges: Vec<usize> = (3..=8).filter(|&edges| packets.iter().any(|packet| packet.edges.len() == edges)).collect();
    assert_eq!(edges, [3, 4, 5, 6, 7, 8]);
    for (matrix, form, test, queues, aperture) in cases {
        let form = form.to_owned();
        assert_golden(
            &Config { matrix, form, test, queues, aperture, ..Config::for_packets(size, &packets) },
            &packets,
        );
    }
}

#[test]
fn the_built_in_scenes_are_drawn() {
    for (name, matrix) in [("teapot", (4, 4)), ("ter1k", (8, 8))] {
        let size = size(20, 15);
        let packets = scene(name, size);
        assert!(packets.len() > 300, "{name}: {}", packets.len());
        let form = if matrix == (4, 4) { "pipe" } else { "stack" }.to_owned();
        assert_golden(&Config { matrix, form, ..Config::for_packets(size, &packets) }, &packets);
    }
}

#[test]
fn of_equal_depths_the_first_stays_where_that_is_asked_for() {
    let size = size(32, 24);
    let packets = random(2, 40, size, 12);
    let [strict, least] = [golden::render_strict, golden::render].map(|render| render(size, &packets, BACKGROUND));
    assert!(!compare(&strict, &least).is_equal(), "the rules differ on these");
    for form in ["stack", "pipe", "tree:1+stack"] {
        assert_golden(&Config { form: form.to_owned(), strict: true, ..Config::for_packets(size, &packets) }, &packets);
    }
}

/// The paper's screen with its largest matrix, and the VC-1's: `cargo test --release -p tilewright-machines --test all -- --ignored quadtree::images`.
#[test]
#[ignore = "takes minutes in the profile of tests"]
fn large_screens_are_drawn() {
    for (width, height, matrix) in [(1024, 1024, (16, 16)), (640, 480, (4, 4))] {
        let size = size(width, height);
        let packets = random(3, 40, size, 50);
        assert_golden(&Config { matrix, ..Config::for_packets(size, &packets) }, &packets);
    }
}

#[test]
fn a_screen_may_be_one_pixel_and_a_frame_empty() {
    let one = size(1, 1);
    let packets = random(4, 40, one, 3);
    assert_golden(&Config::for_packets(one, &packets), &packets);
    assert_golden(&Config::new(size(20, 11)), &[]);
}
