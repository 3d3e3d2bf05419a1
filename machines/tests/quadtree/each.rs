//! Each polygon by itself, in the hardware and in the model: its clocks on every level are what the paper's equations make of its
//! windows, to the clock.
//!
//! The tests that are always run take some polygons. 10,000, in six minutes of processor time, with what was counted:
//! `cargo test --release -p tilewright-machines --test all -- --ignored --nocapture quadtree::each`.

use crate::quadtree::polygons::{BOTH, Random, size};
use std::time::Instant;
use tilewright_machines::Watch;
use tilewright_machines::quadtree::model::{Counts, Model, Packets, Run, Simulated};
use tilewright_machines::quadtree::{Config, Queues, Rasters, Rectangles, Search, Shape, Stages, Test, Windows};
use tilewright_scenes::{Polygon, Size};

/// Polygons of a test that is always run.
const SOME: usize = 100;
/// Polygons of one that is run by hand.
const ALL: usize = 10_000;

/// Parameters of a surface, kp: depth and three colours.
const PARAMETERS: u64 = 4;

/// Queues that are full at once.
const SHORT: Queues = Queues { broadcast: 1, packets: 1, windows: 1 };
/// Queues that hold all that a few polygons are divided into.
const DEEP: Queues = Queues { broadcast: 2, packets: 16, windows: 2048 };

fn screen() -> Size {
    size(32, 32)
}

/// Random packets of 3 to 8 edges, some of them partly or wholly off the screen.
fn polygons(count: usize) -> Vec<Polygon> {
    let mut random = Random(6);
    let mut polygons: Vec<Polygon> = Vec::new();
    while polygons.len() < count {
        polygons.extend(random.polygon(screen(), 8));
    }
    polygons.truncate(count);
    assert!((3..=8).all(|edges| polygons.iter().any(|it| it.edges.len() == edges)));
    polygons
}

/// A generator in simulation and its model, which have to agree on every clock and counter, also on those of stalls.
struct Both {
    model: Model,
    simulated: Simulated,
    search: Search,
    test: Test,
}

impl Both {
    fn new(config: &Config) -> Both {
        let generator = config.generator().expect("possible");
        Both {
            model: Model::new(&generator).expect("possible"),
            simulated: Simulated::new(&generator).expect("sound"),
            search: Search::new(config.windows().expect("possible")).expect("possible"),
            test: config.test,
        }
    }

    /// What both do with those packets.
    #[track_caller]
    fn run(&mut self, polygons: &[Polygon]) -> Run {
        let (packets, mut watch) = (Packets::at_once(polygons), Watch::default());
        let run = self.model.run(packets, &mut watch).expect("nobody breaks it off");
        assert_eq!(self.simulated.run(packets, &mut watch).expect("its assertions hold"), run, "{polygons:?}");
        run
    }

    /// What the plain count finds of a packet in each video processor, with the clocks of each level: MPG-EQ5.
    fn expected(&self, polygon: &Polygon) -> Vec<(Windows, Vec<u64>)> {
        let edges = polygon.edges.len() as u64;
        let clocks = |above: u64, windows: u64| match self.test {
            Test::Serial => 4 * above * edges + windows * PARAMETERS,
            Test::Parallel => 4 * above + windows * PARAMETERS,
        };
        let of_processor = |processor| {
            let windows = self.search.windows(polygon, processor);
            let clocks = windows.passed.windows(2).map(|pair| clocks(pair[0], pair[1])).collect();
            (windows, clocks)
        };
        self.search.processors().map(of_processor).collect()
    }
}

/// Clocks of the set-up: an edge and a plane a clock.
fn set_up(polygon: &Polygon) -> u64 {
    PARAMETERS.max(polygon.edges.len() as u64)
}

fn config(form: &str, matrix: (u32, u32), test: Test, queues: Queues) -> Config {
    Config { matrix, edges: 8, form: form.to_owned(), test, queues, aperture: 2, ..Config::new(screen()) }
}

/// MPG-EQ5, MPG-EQ6, MPG-EQ9 and MPG-EQ10 of the clocks counted of one polygon after another. Gives the clocks in which windows waited.
fn assert_clocks(form: &str, matrix: (u32, u32), polygons: &[Polygon]) -> u64 {
    let mut waited = 0;
    for test in BOTH {
        let now = Instant::now();
        let mut both = Both::new(&config(form, matrix, test, SHORT));
        let (mut clocks, mut windows) = (0, 0);
        for polygon in polygons {
            let run = both.run(std::slice::from_ref(polygon));
            clocks += run.clocks;
            for (counted, (found, expected)) in run.processors.iter().zip(both.expected(polygon)) {
                let [set_up_unit, levels @ ..] = &counted.units[..] else { panic!("there is a set-up") };
                assert_eq!((set_up_unit.busy, set_up_unit.results), (set_up(polygon), 1), "{polygon:?}");
                let of_levels = |of: fn(&Counts) -> u64| levels.iter().map(of).collect::<Vec<u64>>();
                assert_eq!(of_levels(|unit| unit.busy), expected, "{polygon:?}");
                assert_eq!(of_levels(|unit| unit.results), found.passed[1..], "{polygon:?}");
                assert_eq!(counted.fragments, found.fragments, "{polygon:?}");
                assert_stages(&of_levels(|unit| unit.busy), &expected);
                waited += of_levels(|unit| unit.stalled).iter().sum::<u64>();
                windows += of_levels(|unit| unit.results).iter().sum::<u64>();
            }
        }
        println!(
            "{form}, {}x{}, {test}: {} polygons, {windows} windows, {clocks} clocks, agreed in {:.1?}",
            matrix.0,
            matrix.1,
            polygons.len(),
            now.elapsed()
        );
    }
    waited
}

/// The sum, the slowest stage and the utilisation that [`Stages`] makes of clocks counted, against plain arithmetic on those expected.
fn assert_stages(counted: &[u64], expected: &[u64]) {
    let stages = Stages::new(counted.iter().map(|&clocks| clocks as f64).collect());
    let (sum, most) = (expected.iter().sum::<u64>(), *expected.iter().max().expect("there are levels"));
    assert_eq!(stages.total(), sum as f64, "MPG-EQ6");
    assert_eq!(stages.slowest().expect("there are levels").1, most as f64, "MPG-EQ9");
    let load = sum as f64 / (most * expected.len() as u64) as f64;
    assert!((stages.load() / load - 1.0).abs() < 1e-15, "MPG-EQ10: {} and {load}", stages.load());
}

/// All forms: what a unit does of a polygon costs the same, however it shares the work with others.
fn assert_clocks_of_all_forms(count: usize) {
    let polygons = polygons(count);
    assert!(assert_clocks("pipe", (4, 4), &polygons) > 0, "full queues make units wait, which counts apart");
    assert_eq!(assert_clocks("stack", (2, 2), &polygons), 0, "nothing is in the way of a stack");
    assert!(assert_clocks("stack:1+tree:2+pipe:1", (2, 2), &polygons) > 0);
}

#[test]
fn clocks_of_each_polygon_are_those_of_its_windows() {
    assert_clocks_of_all_forms(SOME);
}

#[test]
#[ignore = "takes minutes in the profile of tests"]
fn clocks_of_each_of_10_000_polygons_are_those_of_its_windows() {
    assert_clocks_of_all_forms(ALL);
}

/// MPG-EQ9 and MPG-EQ6 on the clock: where each follows another like it, a polygon takes what the slowest level does in a pipe, the sum of
/// all levels in a stack; or its set-up, if that takes longer.
fn assert_periods(form: &str, matrix: (u32, u32), polygons: &[Polygon]) {
    for test in BOTH {
        let now = Instant::now();
        let mut both = Both::new(&config(form, matrix, test, DEEP));
        for polygon in polygons {
            let clocks: Vec<Vec<u64>> = both.expected(polygon).into_iter().map(|(_, clocks)| clocks).collect();
            let of_processor = |clocks: &Vec<u64>| match form {
                "stack" => clocks.iter().sum(),
                _ => *clocks.iter().max().expect("there are levels"),
            };
            let period = clocks.iter().map(of_processor).max().expect("there are processors").max(set_up(polygon));
            // The slowest stage has caught up with the one before it by then.
            let mut run = |count| both.run(&vec![polygon.clone(); count]).clocks;
            assert_eq!(run(9) - run(8), period, "{clocks:?}, {polygon:?}");
        }
        let took = now.elapsed();
        println!("{form}, {}x{}, {test}: periods of {} polygons in {took:.1?}", matrix.0, matrix.1, polygons.len());
    }
}

#[test]
fn each_polygon_takes_the_slowest_level_of_a_pipe_and_all_levels_of_a_stack() {
    let polygons = polygons(SOME);
    assert_periods("pipe", (4, 4), &polygons);
    assert_periods("stack", (4, 4), &polygons);
}

#[test]
#[ignore = "takes minutes in the profile of tests"]
fn each_of_10_000_polygons_takes_the_slowest_level_of_a_pipe() {
    assert_periods("pipe", (4, 4), &polygons(ALL));
}

#[test]
#[ignore = "takes minutes in the profile of tests"]
fn each_of_10_000_polygons_takes_all_levels_of_a_stack() {
    assert_periods("stack", (4, 4), &polygons(ALL));
}

/// MPG-EQ1 with the paper's screen, form and aperture: on the mean the hardware and the model count no more windows than the formula.
/// (On matrices of 8x8 and more the border of the screen adds up to 1 % for the smallest polygons: `study/tests.rs`.)
/// So many standard errors more are allowed.
fn assert_bounds(k: u32, area: f64, count: usize, errors: f64) {
    let (screen, now) = (size(1024, 1024), Instant::now());
    let side = 1 << k;
    let config = Config { matrix: (side, side), edges: 4, aperture: 2, test: Test::Serial, ..Config::new(screen) };
    let (mut both, matrix) = (Both::new(&config), Rasters::square(k, 10));
    let rectangles = Rectangles::new(screen, area, 5.0, 1).expect("they fit");
    let mut samples = vec![Vec::with_capacity(count); matrix.levels as usize + 1];
    for polygon in (0..count as u64).map(|index| rectangles.polygon(index)) {
        let run = both.run(std::slice::from_ref(&polygon));
        for (counted, (found, expected)) in run.processors.iter().zip(both.expected(&polygon)) {
            assert!(counted.units.iter().map(|unit| unit.results).eq(found.passed.iter().copied()), "{polygon:?}");
            assert!(counted.units[1..].iter().map(|unit| unit.busy).eq(expected), "{polygon:?}");
        }
        for (level, samples) in samples.iter_mut().enumerate() {
            let windows: u64 = run.processors.iter().map(|it| it.units[level].results).sum();
            samples.push(windows as f64 / matrix.processors() as f64);
        }
    }
    let ratio = |level: u32| {
        let (samples, count) = (&samples[level as usize], count as f64);
        let mean = samples.iter().sum::<f64>() / count;
        let error = (samples.iter().map(|it| (it - mean).powi(2)).sum::<f64>() / count / (count - 1.0)).sqrt();
        let bound = matrix.windows_of(Shape::rectangle(area, 5.0), level);
        assert!(mean <= bound + errors * error, "level {level}: {mean} +- {error} of {bound}");
        mean / bound
    };
    let ratios: Vec<f64> = (1..=matrix.levels).map(ratio).collect();
    let took = now.elapsed();
    println!("{count} rectangles of {area} pixels, k = {k}: windows over MPG-EQ1 {ratios:.4?}, in {took:.1?}");
}

#[test]
fn rectangles_have_at_most_the_windows_of_equation_1() {
    assert_bounds(2, 157.0, SOME, 3.0);
}

#[test]
#[ignore = "takes minutes in the profile of tests"]
fn each_of_10_000_rectangles_counted_they_have_at_most_the_windows_of_equation_1() {
    for k in [1, 2] {
        for area in [1.0, 23.3, 157.0] {
            assert_bounds(k, area, ALL, 0.0);
        }
    }
}

/// MPG-PMAX: five tests a polygon, four for the root and one, of kp = ke clocks, for the window that passes.
fn assert_saturation(count: usize) {
    let config = Config { aperture: 0, edges: 4, ..config("pipe", (1, 1), Test::Serial, DEEP) };
    let mut both = Both::new(&config);
    let rectangles = Rectangles::new(screen(), 1.0, 5.0, 7).expect("they fit");
    let has_one_window_a_level = |it: &Polygon| both.expected(it)[0].0.passed.iter().all(|&windows| windows == 1);
    let polygons = (0..).map(|number| rectangles.polygon(number)).filter(has_one_window_a_level);
    let polygons: Vec<Polygon> = polygons.take(count).collect();
    // Both end with the same polygons, and so alike.
    let few = &polygons[count - 20..];
    assert_eq!(both.run(&polygons).clocks - both.run(few).clocks, (count as u64 - 20) * 5 * 4);
    println!("{count} small polygons: one every 5 tests");
}

#[test]
fn small_polygons_come_every_five_tests() {
    assert_saturation(SOME);
}

#[test]
#[ignore = "takes minutes in the profile of tests"]
fn each_of_10_000_small_polygons_comes_every_five_tests() {
    assert_saturation(ALL);
}
