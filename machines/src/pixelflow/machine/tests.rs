//! Frames of small machines.

use proptest::prelude::*;
use tilewright_scenes::deferred::{Samples, project_deferred};
use tilewright_scenes::{Field, Scene, Size, compare, golden, project_polygons, project_samples};

use super::*;
use crate::pixelflow::costs::Costs;

fn config(size: Size, nodes: u32, shaders: u32) -> Config {
    Config { nodes, shaders, array: [16, 8], ..Config::new(size) }
}

#[test]
fn a_resident_frame_is_the_golden_image() {
    let size = Size::new(44, 30).unwrap();
    let scene = Scene::builtin("star").unwrap();
    let polygons = project_polygons(&scene, size).unwrap();
    let golden = golden::render(size, &polygons.polygons, scene.background);
    for nodes in [2, 3, 5] {
        let machine = Machine::new(config(size, nodes, 0)).unwrap();
        let (frame, report) = machine.render_resident(&polygons, scene.background, &mut Watch::default()).unwrap();
        assert_eq!(compare(&frame, &golden).differing, 0, "{nodes} nodes");
        assert_eq!(report.turns.len(), 12);
    }
}

#[test]
fn a_deferred_frame_is_the_golden_image() {
    let size = Size::new(44, 30).unwrap();
    let scene = Scene::builtin("star").unwrap();
    let deferred = project_deferred(&scene, size, Samples::One).unwrap();
    let golden = golden::render_deferred(&deferred);
    // A front end that has all before, or that makes instructions while the network reads.
    for (nodes, shaders, pre_sort) in [(3, 1, false), (4, 2, false), (7, 3, false), (3, 1, true), (5, 2, true)] {
        let machine = Machine::new(Config { pre_sort, ..config(size, nodes, shaders) }).unwrap();
        let (frame, report) = machine.render(&deferred, &mut Watch::default()).unwrap();
        assert_eq!(compare(&frame, &golden).differing, 0, "{nodes} nodes");
        assert_eq!(report.turns.len(), 12);
        // The second pass is a stage of its own, behind the front end.
        let text = report.to_string();
        let second = text.lines().find_map(|line| line.strip_prefix("second pass "));
        let us = |ticks: u64| format!("{:.2}", ticks as f64 / 200.0);
        let expected = [report.second, report.front, report.front + report.second].map(us).to_vec();
        let printed = second.map(|line| line.split_whitespace().map(str::to_owned).collect());
        assert_eq!(printed, pre_sort.then_some(expected), "{text}");
    }
}

#[test]
fn a_textured_frame_is_the_golden_image() {
    let size = Size::new(40, 24).unwrap();
    let scene = Scene::builtin("textured").unwrap();
    let deferred = project_deferred(&scene, size, Samples::One).unwrap();
    assert!(!deferred.shader.textures.is_empty());
    let machine = Machine::new(config(size, 5, 2)).unwrap();
    let (frame, _) = machine.render(&deferred, &mut Watch::default()).unwrap();
    assert_eq!(compare(&frame, &golden::render_deferred(&deferred)).differing, 0);
}

#[test]
fn arrays_that_have_drawn_a_frame_draw_others() {
    let size = Size::new(20, 12).unwrap();
    let textured = Scene::builtin("textured").unwrap();
    let deferred = project_deferred(&textured, size, Samples::One).unwrap();
    let polygons = project_polygons(&textured, size).unwrap();
    let first = Machine::new(config(size, 5, 2)).unwrap();
    let alone = first.render(&deferred, &mut Watch::default()).unwrap();
    for _ in 0..2 {
        // More nodes than there are spare arrays, then fewer.
        let resident = first.another(config(size, 7, 0)).unwrap();
        let (frame, _) = resident.render_resident(&polygons, textured.background, &mut Watch::default()).unwrap();
        let golden = golden::render(size, &polygons.polygons, textured.background);
        assert_eq!(compare(&frame, &golden).differing, 0);
        assert_eq!(first.render(&deferred, &mut Watch::default()).unwrap(), alone);
    }
    // Arrays of another size are new ones.
    let larger = first.another(Config { array: [32, 16], ..config(size, 5, 2) }).unwrap();
    let (frame, _) = larger.render(&deferred, &mut Watch::default()).unwrap();
    assert_eq!(frame, alone.0);
}

#[test]
fn eight_samples_are_the_golden_image() {
    let size = Size::new(20, 12).unwrap();
    let scene = Scene::builtin("textured").unwrap();
    let eight = |shading| project_deferred(&scene, size, Samples::Eight(shading)).unwrap();
    let deferred = eight(Shading::EachSample);
    let machine = Machine::new(config(size, 5, 2)).unwrap();
    let (frame, report) = machine.render(&deferred, &mut Watch::default()).unwrap();
    assert_eq!(compare(&frame, &golden::render_deferred(&deferred)).differing, 0);
    // 40 x 24 pixels, twice: what comes of both renderings of a region is written at once.
    assert_eq!((report.turns.len(), report.size, report.samples), (2 * 9, [20, 12], 8));
    let clocks = report.frame_buffer.clocks();
    for turns in report.turns.chunks(2) {
        assert!(turns.iter().all(|turn| !turn.sent.is_empty()) && turns[0].loaded.is_empty());
        assert_eq!(turns[1].loaded.end - turns[1].loaded.start, 2 * clocks);
    }
}

#[test]
fn eight_samples_shaded_once_are_the_golden_image() {
    let once = Samples::Eight(Shading::OncePerPixel);
    let draw = |name: &str, [width, height]: [u32; 2], nodes, shaders, field| {
        let size = Size::new(width, height).unwrap();
        let deferred = project_deferred(&Scene::builtin(name).unwrap(), size, once).unwrap();
        let machine = Machine::new(Config { field, ..config(size, nodes, shaders) }).unwrap();
        let (frame, report) = machine.render(&deferred, &mut Watch::default()).unwrap();
        let golden = golden::render_deferred(&deferred);
        let golden = field.map_or(golden.clone(), |field| field.lines(&golden).unwrap());
        assert_eq!(compare(&frame, &golden).differing, 0, "{name}");
        report
    };
    let report = draw("textured", [36, 12], 5, 2, None);
    assert_eq!((report.turns.len(), report.samples), (8 * 6, 8));
    // The eighth sample of a region ends in the frame buffer; a shader takes the others in turn.
    for turns in report.turns.chunks(8) {
        assert!(turns[..7].iter().all(|turn| turn.sent.is_empty() && turn.loaded.is_empty()));
        assert!(!turns[7].sent.is_empty());
        assert!(turns.windows(2).all(|pair| pair[0].shaded.end <= pair[1].shaded.start));
    }
    let report = draw("star", [20, 27], 3, 1, Some(Field::Odd));
    assert_eq!(report.turns.len(), 8 * 4);
}

#[test]
fn a_field_is_each_second_line_of_the_golden_image() {
    // Of an odd number of lines, in both systems.
    let size = Size::new(20, 27).unwrap();
    let scene = Scene::builtin("star").unwrap();
    let deferred = project_deferred(&scene, size, Samples::One).unwrap();
    let polygons = project_polygons(&scene, size).unwrap();
    let resident = golden::render(size, &polygons.polygons, scene.background);
    for (field, lines) in [(Field::Even, 14), (Field::Odd, 13)] {
        let config = |nodes, shaders| Config { field: Some(field), ..config(size, nodes, shaders) };
        let machine = Machine::new(config(4, 1)).unwrap();
        let (frame, report) = machine.render(&deferred, &mut Watch::default()).unwrap();
        assert_eq!(compare(&frame, &field.lines(&golden::render_deferred(&deferred)).unwrap()).differing, 0);
        assert_eq!((report.size, report.turns.len()), ([20, lines], 4));
        let machine = Machine::new(config(3, 0)).unwrap();
        let (frame, _) = machine.render_resident(&polygons, scene.background, &mut Watch::default()).unwrap();
        assert_eq!(compare(&frame, &field.lines(&resident).unwrap()).differing, 0);
    }
}

#[test]
fn eight_samples_one_after_another_are_the_golden_image() {
    let size = Size::new(44, 27).unwrap();
    let scene = Scene::builtin("star").unwrap();
    let passes = project_samples(&scene, size, Samples::Eight(Shading::EachSample)).unwrap();
    let golden = golden::render_samples(&passes, scene.background);
    for (nodes, field) in [(2, None), (5, None), (4, Some(Field::Odd))] {
        let machine = Machine::new(Config { field, ..config(size, nodes, 0) }).unwrap();
        let draw = |passes| machine.render_resident_samples(passes, scene.background, &mut Watch::default());
        let (frame, report) = draw(&passes).unwrap();
        let golden = field.map_or(golden.clone(), |field| field.lines(&golden).unwrap());
        assert_eq!(compare(&frame, &golden).differing, 0, "{nodes} nodes");
        let regions = if field.is_none() { 12 } else { 6 };
        assert_eq!((report.turns.len(), report.samples), (8 * regions, 8));
        // The memory of the frame gets the last sample's, one region behind the other.
        let (added, written) = report.turns.split_at(7 * regions);
        assert!(added.iter().all(|turn| turn.loaded.is_empty() && turn.shaded.start >= turn.composed.end));
        assert!(written.windows(2).all(|pair| pair[0].loaded.end <= pair[1].loaded.start));
        // 7 bytes of 32 pixels of a chip.
        for sample in report.turns.chunks(regions) {
            assert!(sample.iter().all(|turn| turn.composed.end - turn.composed.start == 7 * 32));
        }
        assert!(draw(&passes[..1]).is_err_and(|error| error.to_string().contains("two passes of 88x54")));
    }
}

/// Sides of arrays.
fn sides() -> impl Strategy<Value = [u32; 2]> {
    let side = || prop_oneof![Just(8_u32), Just(16), Just(32)];
    (side(), side()).prop_map(|(width, height)| [width, height])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 10, failure_persistence: None, ..ProptestConfig::default() })]

    /// Any machine, and any rasterizer for each triangle: they are dealt in turn, so in another order others have them. Instructions may come while
    /// others are carried out and words are sent, in any tick.
    #[test]
    fn who_draws_what_does_not_matter(
        array in sides(),
        shaders in 1..4u32,
        rasterizers in 1..6u32,
        [width, height] in [9..50u32, 9..40u32],
        scene in prop_oneof![Just("star"), Just("teapot"), Just("textured")],
        one_at_a_time in any::<bool>(),
        made in prop::option::of((0..300u64, 0..3000u64)),
        turned in any::<prop::sample::Index>(),
    ) {
        let size = Size::new(width, height).unwrap();
        let mut deferred = project_deferred(&Scene::builtin(scene).unwrap(), size, Samples::One).unwrap();
        let golden = golden::render_deferred(&deferred);
        let packets = &mut deferred.passes[0].packets;
        let count = packets.len();
        packets.rotate_left(turned.index(count));
        packets[..count / 2].reverse();
        let nodes = 1 + rasterizers + shaders;
        let [sort, generate] = made.map_or([0.0; 2], |(sort, generate)| [sort, generate].map(|ticks| ticks as f64 / 200.0));
        let costs = Costs { sort, generate, ..Costs::default() };
        let pre_sort = made.is_some();
        let config = Config { nodes, shaders, array, side_by_side: !one_at_a_time, pre_sort, costs, ..Config::new(size) };
        let (frame, report) = Machine::new(config).unwrap().render(&deferred, &mut Watch::default()).unwrap();
        prop_assert_eq!(compare(&frame, &golden).differing, 0);
        prop_assert_eq!(report.rasterizers.iter().map(|node| node.primitives).sum::<usize>(), count);
    }
}
