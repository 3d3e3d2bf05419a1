//! What the hardware counts is what the plain model counts, and its clocks are those of the paper's cost model.

use crate::quadtree::polygons::{BOTH, random, render, size};
use tilewright_machines::quadtree::{
    Config, Costs, Queues, Rectangles, Report, Search, Stages, Test, UnitReport, Windows,
};
use tilewright_scenes::Polygon;

/// Queues in which hardly anything has to wait.
const DEEP: Queues = Queues { broadcast: 2, packets: 16, windows: 32 };

/// By video processor what the plain model says: the windows and busy clocks of the set-up and of each level, and fragments.
fn expected(config: &Config, packets: &[Polygon]) -> Vec<(Vec<(u64, u64)>, u64)> {
    let search = Search::new(config.windows().expect("possible")).expect("possible");
    let of_processor = |processor| {
        let mut windows = Windows::none(search.matrix().levels);
        let mut busy = vec![0; search.matrix().levels as usize + 1];
        for packet in packets {
            let (found, edges) = (search.windows(packet, processor), packet.edges.len() as u64);
            busy[0] += edges.max(4);
            let clocks = found.busy(Costs::new(config.test, edges, 4));
            busy[1..].iter_mut().zip(clocks).for_each(|(sum, clocks)| *sum += clocks);
            windows += &found;
        }
        (windows.passed.into_iter().zip(busy).collect(), windows.fragments)
    };
    search.processors().map(of_processor).collect()
}

#[track_caller]
fn assert_counts(config: &Config, packets: &[Polygon], report: &Report) {
    let counted = |it: &UnitReport| (it.windows, it.busy);
    let counted: Vec<_> =
        report.processors.iter().map(|it| (it.units.iter().map(counted).collect::<Vec<_>>(), it.fragments)).collect();
    assert_eq!(counted, expected(config, packets), "{config:?}");
}

/// MPG-EQ5: serial 4 w_(i-1) ke + w_i kp clocks, parallel 4 w_(i-1) + w_i kp, all polygons in one run; stalls are apart.
fn assert_cost_model(polygons: usize, form: &str, matrix: (u32, u32)) {
    let size = size(32, 32);
    let packets = random(5, polygons, size, 4);
    assert!(packets.len() * 10 >= polygons * 9 && packets.iter().any(|packet| packet.bounds.is_empty()));
    for test in BOTH {
        let form = form.to_owned();
        let config = Config { matrix, form, test, ..Config::for_packets(size, &packets) };
        let (_, report) = render(&config, &packets);
        assert_counts(&config, &packets, &report);
        assert!(report.stages.iter().any(|stage| stage.stalled.all > 0), "nothing had to wait: {report}");
    }
}

#[test]
fn busy_clocks_and_windows_are_those_of_the_cost_model() {
    assert_cost_model(150, "pipe", (1, 1));
    assert_cost_model(150, "stack:2+pipe:1+tree:1", (2, 2));
}

/// MPG-EQ9 and MPG-EQ10: where queues are deep, the slowest level is all but always busy, and the mean load is R_p.
#[test]
fn the_slowest_level_of_a_pipe_limits_it() {
    let size = size(64, 64);
    let rectangles = Rectangles::new(size, 40.0, 5.0, 1).expect("possible");
    let packets: Vec<Polygon> = (0..150).map(|number| rectangles.polygon(number)).collect();
    let config = Config { matrix: (1, 1), test: Test::Serial, queues: DEEP, ..Config::for_packets(size, &packets) };
    let (_, report) = render(&config, &packets);
    let times = report.processors[0].units[1..].iter().map(|unit| unit.busy as f64).collect();
    let stages = Stages::new(times);
    let (level, slowest) = stages.slowest().expect("there are levels");
    let clocks = report.drawing_clocks() as f64;
    assert!((0.95..=1.0).contains(&(slowest / clocks)), "level {level} is busy for {slowest} of {clocks} clocks");
    let load = report.stages[1..].iter().map(|stage| stage.load[0]).sum::<f64>() / stages.times().len() as f64;
    assert!((0.95..=1.0).contains(&(load / stages.load())), "{load} of {}", stages.load());
}

/// MPG-EQ6: a stack's unit works all the time, for as long as all levels together.
#[test]
fn the_unit_of_a_stack_never_waits() {
    let size = size(64, 64);
    let packets = random(8, 60, size, 6);
    for test in BOTH {
        let form = "stack".to_owned();
        let config = Config { matrix: (1, 1), form, test, ..Config::for_packets(size, &packets) };
        let (_, report) = render(&config, &packets);
        let busy: u64 = report.stages[1..].iter().map(|stage| stage.busy.all).sum();
        let most = report.machine.edges as u64;
        // Until the first window comes, and from the last to its pixel.
        assert!((0..=most + 8).contains(&(report.drawing_clocks() - busy)), "{} of {report}", busy);
    }
}
