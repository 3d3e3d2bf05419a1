//! Frames of two eyes on small machines.

use std::ops::Range;

use tilewright_scenes::deferred::{Samples, project_deferred};
use tilewright_scenes::{Frame, Scene, Size, compare, golden, project_polygons, project_samples, side_by_side};

use super::*;
use crate::Watch;
use crate::pixelflow::{Machine, Samples as Count, Software, System};

/// What is drawn of a scene, by which system.
#[derive(Clone, Copy, Debug)]
enum Work {
    Deferred(Samples),
    Resident,
    ResidentSamples,
}

impl Work {
    /// The frame of an eye, the golden one, and what it took.
    fn draw(self, config: &Config, scene: &Scene) -> (Frame, Frame, Report) {
        let machine = Machine::new(config.clone()).unwrap();
        let (background, mut watch) = (scene.background, Watch::default());
        let eight = Samples::Eight(Default::default());
        let (golden, (frame, report)) = match self {
            Work::Deferred(samples) => {
                let deferred = project_deferred(scene, config.size, samples).unwrap();
                (golden::render_deferred(&deferred), machine.render(&deferred, &mut watch).unwrap())
            }
            Work::Resident => {
                let polygons = project_polygons(scene, config.size).unwrap();
                let golden = golden::render(config.size, &polygons.polygons, background);
                (golden, machine.render_resident(&polygons, background, &mut watch).unwrap())
            }
            Work::ResidentSamples => {
                let passes = project_samples(scene, config.size, eight).unwrap();
                let golden = golden::render_samples(&passes, background);
                (golden, machine.render_resident_samples(&passes, background, &mut watch).unwrap())
            }
        };
        (frame, golden, report)
    }
}

/// No two of them have a tick in common.
fn are_apart(mut all: Vec<Range<Ticks>>) -> bool {
    all.retain(|range| !range.is_empty());
    all.sort_by_key(|range| range.start);
    all.windows(2).all(|two| two[0].end <= two[1].start)
}

/// Whether the right frame, so many ticks behind the left one, has no unit at the same time.
fn is_free([left, right]: [&Report; 2], behind: Ticks) -> bool {
    let ranges = |of: &dyn Fn(usize, &Done) -> Range<Ticks>| {
        let moved = |report: &Report, by: Ticks| {
            let range = move |(number, turn): (usize, &Done)| of(number, turn).start + by..of(number, turn).end + by;
            report.turns.iter().enumerate().map(range).collect::<Vec<_>>()
        };
        [moved(left, 0), moved(right, behind)].concat()
    };
    let network = ranges(&|_, turn| turn.composed.clone());
    let (returns, memory) = (ranges(&|_, turn| turn.sent.clone()), ranges(&|_, turn| turn.loaded.clone()));
    let rasterizes = left.turns.iter().map(|turn| turn.composed.end).max() <= Some(behind);
    rasterizes && [network, returns, memory].into_iter().all(are_apart)
}

/// Draws both eyes' frames; they have to be the golden ones.
fn draw(stereo: Stereo, work: Work, [nodes, shaders]: [u32; 2]) -> StereoReport {
    let size = Size::new(20, 12).unwrap();
    let config = stereo.eye(&Config { nodes, shaders, array: [16, 8], ..Config::new(size) }).unwrap();
    let scene = Scene::builtin("star").unwrap();
    let eyes = scene.eyes(scene.camera.eye_distance()).unwrap();
    let [left, right] = eyes.map(|scene| work.draw(&config, &scene));
    let both = side_by_side(&[left.0, right.0]).unwrap();
    assert_eq!(compare(&both, &side_by_side(&[left.1, right.1]).unwrap()).differing, 0, "{work:?}");
    StereoReport::new(stereo, 1.0, [left.2, right.2])
}

#[test]
fn halves_draw_at_the_same_time() {
    for (work, nodes) in [(Work::Deferred(Samples::One), [6, 2]), (Work::Resident, [4, 0])] {
        let report = draw(Stereo::Halved, work, nodes);
        assert_eq!(report.ends, [report.left.latency(), report.right.latency()]);
        assert_eq!([report.left.nodes, report.right.nodes], [nodes[0] / 2; 2]);
    }
}

#[test]
fn one_after_another_no_unit_has_both_frames_at_once() {
    for (work, nodes) in
        [(Work::Deferred(Samples::One), [3, 1]), (Work::Resident, [3, 0]), (Work::ResidentSamples, [2, 0])]
    {
        let report = draw(Stereo::Sequential, work, nodes);
        let StereoReport { left, right, ends, .. } = &report;
        let behind = ends[1] - right.back() - left.delay();
        assert!(is_free([left, right], behind), "{work:?}");
        // The front end goes on at once.
        assert!(behind + left.delay() >= left.front + left.second + right.delay(), "{work:?}");
        assert!(report.latency() < left.latency() + right.latency(), "{work:?}");
    }
}

#[test]
fn a_frame_follows_as_soon_as_the_last_unit_lets_it() {
    let turn = |times: [Ticks; 5], lasts: Ticks| {
        let [composed, shaded, sent, loaded] = [1, 2, 3, 4].map(|stage| times[stage]..times[stage] + lasts);
        Done { rasterized: times[0], composed, shaded, sent, loaded }
    };
    let size = Size::new(36, 20).unwrap();
    let config = Config { nodes: 4, shaders: 1, array: [16, 8], ..Config::new(size) };
    let (.., report) = Work::Deferred(Samples::One).draw(&config, &Scene::builtin("star").unwrap());
    let of = |times, lasts| Report { turns: vec![turn(times, lasts)], ..report.clone() };
    let short = of([5, 10, 20, 30, 40], 5);
    // Rasterizers until 110; shaders until 120, from 10 on; the frame buffer until 140, from 30 on.
    for (composed, shaded, loaded, expected) in [(105, 106, 107, 110), (0, 120, 123, 115), (0, 0, 140, 115)] {
        let long = of([0, composed, shaded, 0, loaded], 5);
        assert_eq!(follows(&long, &short), expected);
    }
}

#[test]
fn distances_are_short() {
    assert_eq!([0.34051, 1234.56, 0.25, 0.0, 12345.6].map(four_digits), ["0.3405", "1235", "0.2500", "0", "12346"]);
}

#[test]
fn mistakes_are_said() {
    let said = |nodes, shaders| {
        let config = Config { nodes, shaders, ..Config::new(Size::VGA) };
        Stereo::Halved.eye(&config).unwrap_err().to_string()
    };
    assert!(said(5, 0).contains("5 nodes have no halves for two eyes: give an even number"));
    assert!(said(4, 2).contains("in each half, 2 nodes with 1 shaders"));
}

#[test]
fn when_which_is_faster() {
    let eight = Count::Eight { rasterizations: 2.0 };
    // Primitives of each eye from which on one after another is faster; the base system with one shader has one in each half, too.
    for (system, shaders, from) in [
        (System::Base, 4, [13_849, 8_306]),
        (System::Base, 1, [34_258, 19_920]),
        (System::PreSort, 4, [18_549, 9_994]),
        (System::PreSort, 1, [40_695, 24_112]),
        (System::NonTexturing, 0, [40_883, 68_532]),
    ] {
        for (samples, from) in [Count::One, eight].into_iter().zip(from) {
            let software = Software::paper(system, Nodes::paper(shaders), samples);
            let found = software.sequential_from().expect("a machine has more rasterizers than its halves");
            assert_eq!(found.round() as u64, from, "{system:?}, {shaders} shaders, {samples:?}");
            let both = |stereo| software.stereo_latency(found, stereo);
            assert!((both(Stereo::Halved) - both(Stereo::Sequential)).abs() < 1e-6);
        }
    }
}
