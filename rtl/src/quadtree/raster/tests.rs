//! Raster processors of all forms against the samples that a polygon may cover, and the stack's depth.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::format::{Matrix, Work};
use super::super::model::{Convex, Raster};
use super::super::testing::{
    NO_STALLS, Stalls, divide, first, formats, parts, polygons, rasters, small, sorted, stalls,
};
use super::*;

const FORMS: [&str; 5] = ["stack", "pipe", "tree:1+pipe", "pipe:1+tree:1+stack", "stack:1+pipe:1+tree"];

fn processor(format: Format, form: &str, test: Test, queue: u32) -> Option<RasterProcessor> {
    // Some forms have more levels than small screens, or fewer than large ones.
    Form::parse(form, &format).ok().map(|form| RasterProcessor { format, form, test, queue })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]

    /// In each form the leaves are the samples that a polygon may cover. Leaves of the same sample come in the sequence
    /// of their polygons. Each level works for the same number of clocks (MPG-EQ5).
    #[test]
    fn all_forms_find_the_samples_of_polygons(
        (raster, polygons) in formats(24).prop_flat_map(|format| {
            (rasters(format), prop::collection::vec(polygons(format), 1..5))
        }),
        form in prop::sample::select(&FORMS[..]),
        (queue, stalls) in (1..4u32, stalls()),
    ) {
        let roots: Vec<_> = polygons.iter().map(|polygon| raster.work(polygon, raster.root())).collect();
        let leaves: Vec<_> = polygons.iter().flat_map(|polygon| parts(&raster, polygon, raster.root(), 0)).collect();
        let leaves = sorted(leaves);
        let counts: Vec<_> = polygons.iter().map(|polygon| (polygon.edges.len() as u64, raster.counts(polygon))).collect();
        for test in [Test::Serial, Test::Parallel] {
            for form in ["stack", form] {
                let Some(processor) = processor(raster.format, form, test, queue) else { continue };
                let (found, tally) = divide(&processor, roots.clone(), leaves.len(), stalls);
                prop_assert_eq!(&sorted(found), &leaves, "{:?}", processor);
                for (level, tally) in tally.iter().enumerate() {
                    let busy = |(edges, counts): &(u64, Vec<[u64; 2]>)| {
                        let [divided, left] = counts[level];
                        4 * divided * if test == Test::Serial { *edges } else { 1 } + 4 * left
                    };
                    let results = counts.iter().map(|(_, counts)| counts[level][1]).sum();
                    prop_assert_eq!((tally.busy, tally.results), (counts.iter().map(busy).sum(), results));
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, failure_persistence: None, ..ProptestConfig::default() })]

    /// Stack, pipe and tree each by itself, with windows at any place.
    #[test]
    fn each_part_divides_any_windows(
        polygons in prop::collection::vec(polygons(unequal()), 1..4),
        (from, levels) in prop::sample::select(vec![(4, 2), (4, 3), (3, 2), (3, 3), (2, 2)]),
        (queue, stalls) in (1..4u32, stalls()),
    ) {
        let (format, test, raster) = (unequal(), Test::Parallel, first(unequal()));
        let windows = |size| -> Vec<Work<Bits>> {
            polygons.iter().flat_map(|polygon| parts(&raster, polygon, raster.root(), size)).collect()
        };
        let (works, expected) = (windows(from), sorted(windows(from - levels)));
        let found = [
            divide(&Stack { format, test, from, levels }, works.clone(), expected.len(), stalls),
            divide(&Pipe { format, test, from, levels, queue }, works.clone(), expected.len(), stalls),
            divide(&Tree { format, test, from, levels, queue }, works, expected.len(), stalls),
        ];
        for (parts, _) in found {
            prop_assert_eq!(&sorted(parts), &expected);
        }
    }
}

/// 13x11 samples, which are divided four times; polygons of up to five edges.
fn unequal() -> Format {
    Format::new(Screen { width: 13, height: 11 }, Matrix::new(1, 1).unwrap(), 5).unwrap()
}

/// A polygon around all samples.
fn all(raster: &Raster) -> (Convex, usize) {
    let Screen { width, height } = raster.format.screen();
    let edges = vec![[1, 0, 0], [0, 1, 0], [-1, -1, i64::from(width + height)]];
    let polygon = Convex { edges, planes: [[0; 3]; 4], bounds: [0, 0, width - 1, height - 1] };
    let count = parts(raster, &polygon, raster.root(), 0).len();
    (polygon, count)
}

#[test]
fn a_stack_holds_three_windows_of_each_size_and_no_more() {
    let format = Format::new(Screen { width: 16, height: 16 }, small().matrix(), 3).unwrap();
    let raster = first(format);
    let (polygon, count) = all(&raster);
    let stack = Stack { format, test: Test::Parallel, from: 3, levels: 3 };
    let mut sim = Simulation::of(&stack).unwrap();
    sim.reset();
    let (i, parts) = (sim.i.works, sim.o.parts);
    let t = sim.testbench();
    let receive = async {
        for _ in 0..count {
            t.receive_bits(parts).await;
        }
    };
    t.run((t.send_bits(i, raster.work(&polygon, raster.root())), receive));
    drop(t);
    // An assertion of the stack says that it never stores more: three of each size but the root's.
    assert_eq!(sim.covered("the stack is full").unwrap(), 1);
}

/// On each level only the last quarter passes. It is divided next, although the stack is empty and another polygon
/// waits.
#[test]
fn a_stack_divides_what_comes_back_before_another_polygon() {
    let format = Format::new(Screen { width: 16, height: 16 }, small().matrix(), 3).unwrap();
    let raster = first(format);
    let polygon = Convex { bounds: [14, 14, 15, 15], ..all(&raster).0 };
    let work = raster.work(&polygon, raster.root());
    let leaf = &parts(&raster, &polygon, raster.root(), 0)[..];
    let processor = processor(format, "stack", Test::Parallel, 1).unwrap();
    let (found, _) = divide(&processor, vec![work; 2], 2, NO_STALLS);
    assert_eq!(found, [leaf, leaf].concat());
}

/// Windows that the polygon covers completely, and a receiver so slow that all queues are full.
#[test]
fn nothing_is_lost_where_the_receiver_is_slow() {
    let (format, test, from, levels, queue) = (small(), Test::Parallel, 2, 2, 1);
    let raster = first(format);
    let (polygon, count) = all(&raster);
    let works = vec![raster.work(&polygon, raster.root()); 8];
    let expected = sorted([&parts(&raster, &polygon, raster.root(), 0)[..]; 8].concat());
    let slow = Stalls { senders: 0, receivers: 90, seed: 7 };
    let found = [
        divide(&Pipe { format, test, from, levels, queue }, works.clone(), 8 * count, slow),
        divide(&Tree { format, test, from, levels, queue }, works, 8 * count, slow),
    ];
    for (found, tally) in found {
        assert_eq!(sorted(found), expected);
        let results: Vec<u64> = tally.iter().map(|level| level.results).collect();
        assert_eq!(results, [8 * 4, 8 * count as u64]);
    }
}

#[test]
fn a_stack_takes_the_clocks_of_all_windows_and_a_pipe_those_of_the_slowest_level() {
    let format = Format::new(Screen { width: 16, height: 16 }, small().matrix(), 3).unwrap();
    let raster = first(format);
    let (polygon, count) = all(&raster);
    let work = raster.work(&polygon, raster.root());
    let clocks = |form: &str| {
        let processor = processor(format, form, Test::Serial, 2).unwrap();
        let mut sim = Simulation::of(&processor).unwrap();
        sim.reset();
        let (i, parts, start) = (sim.i.works, sim.o.parts, sim.time());
        let t = sim.testbench();
        let receive = async {
            for _ in 0..4 * count {
                t.receive_bits(parts).await;
            }
            (t.time() - start) / 10_000
        };
        let send = async {
            for _ in 0..4 {
                t.send_bits(i, work.clone()).await;
            }
        };
        t.run((send, receive)).1
    };
    let of_windows = |windows: u64| windows * (4 * 3 + 4 * 4);
    // One clock more, in which the first window is taken. A pipe has one more for each queue; its last level begins
    // when the two before it have their first quarter, after 7 clocks each.
    assert_eq!(clocks("stack"), 4 * of_windows(1 + 4 + 16) + 1);
    assert_eq!(clocks("pipe"), 4 * of_windows(16) + 1 + 3 + 2 * 7);
    // The leaves of a tree come one after another, one a clock as soon as all of its units have some.
    assert_eq!(clocks("tree"), 4 * 64 + 39);
}

#[test]
fn without_a_pause_no_unit_of_a_stack_waits() {
    let raster = first(small());
    let (polygon, count) = all(&raster);
    let processor = processor(small(), "stack", Test::Serial, 1).unwrap();
    let (_, tally) = divide(&processor, vec![raster.work(&polygon, raster.root()); 2], 2 * count, NO_STALLS);
    assert!(tally.iter().all(|level| level.stalled == 0), "{tally:?}");
}

#[test]
fn a_form_that_cannot_be_is_refused_in_a_sentence() {
    let refused = |text: &str| Form::parse(text, &small()).unwrap_err().to_string();
    assert_eq!(refused("stack:1"), "the form `stack:1`: it divides 1 levels; 8x8 pixels on a matrix of 2x2 have 2");
    assert_eq!(refused("stack:2+pipe"), "the form `stack:2+pipe:0`: each part has to divide at least one level");
    let large = Format::new(Screen { width: 64, height: 64 }, small().matrix(), 3).unwrap();
    let tree = Form::parse("tree", &large).unwrap_err().to_string();
    assert_eq!(tree, "the form `tree:5`: a tree divides at most 4 levels, with 85 units");
    let help = "a form is made of `stack`, `pipe` and `tree`, each with its levels, as in `stack:2+pipe:3+tree:1`";
    for (text, problem) in [
        ("stack:0x", "levels are a number from 1 to 2"),
        ("stack:3", "levels are a number from 1 to 2"),
        ("pipe+tree", "only one part may leave out its levels"),
        ("ring", "there is no part `ring`"),
    ] {
        assert_eq!(refused(text), format!("the form `{text}`: {problem}; {help}"));
    }
}
