//! The study is repeatable and can be broken off, and what it counts is what the formulas say, as far as they say it.

use super::super::windows::Windows;
use super::*;
use crate::random::Random;
use std::sync::atomic::{AtomicBool, Ordering};
use tilewright_scenes::{PixelBox, Polygon};

fn study(samples: &[(f64, u64)]) -> Study {
    let samples = samples.iter().map(|&(area, polygons)| Sample { area, polygons }).collect();
    Study { samples, ..Study::paper(7) }
}

fn points(study: &Study) -> Vec<Point> {
    study.run(&mut Watch::default()).expect("possible").expect("nobody breaks it off")
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let study = study(&[(3.0, 70), (40.0, 130), (900.0, 3)]);
    let on = |threads| study.run_on(threads, &mut Watch::default()).expect("possible");
    let one = on(1);
    assert_eq!(one, on(3));
    assert_eq!(one.map(|points| points.len()), Some(15));
    assert_ne!(points(&study), points(&Study { seed: 8, ..study.clone() }));
}

#[test]
fn progress_rises_to_1_and_a_raised_flag_ends_the_study() {
    let mut seen = Vec::new();
    let mut progress = |progress: crate::Progress| seen.push(progress.fraction);
    study(&[(5.0, 10), (50.0, 100)]).run(&mut Watch { progress: Some(&mut progress), cancel: None }).expect("possible");
    assert_eq!((seen.len(), seen.last()), (10 + 50, Some(&1.0)));
    assert!(seen.is_sorted_by(|before, after| before < after));
    // A study of minutes: it would not end.
    let cancel = AtomicBool::new(false);
    let mut raise = |_| cancel.store(true, Ordering::Relaxed);
    let mut watch = Watch { progress: Some(&mut raise), cancel: Some(&cancel) };
    assert_eq!(study(&[(2.0, 640), (5.0, 1_000_000)]).run(&mut watch), Ok(None));
    assert_eq!(study(&[(5.0, 10)]).run(&mut watch), Ok(None), "it was raised before");
}

#[test]
fn an_impossible_study_is_a_sentence() {
    let sentence = |study: Study| study.run(&mut Watch::default()).expect_err("impossible").to_string();
    let possible = study(&[(5.0, 10)]);
    assert_eq!(
        sentence(study(&[(5.0, 10), (9.5, 0)])),
        "a sample of 0 rectangles of 9.5 pixels: it has to have at least 1"
    );
    assert!(sentence(study(&[(3e5, 1)])).starts_with("rectangles of 300000 pixels and 5:1 on a screen of 1024x1024:"));
    assert!(sentence(Study { aperture: 3, ..possible.clone() }).starts_with("an aperture of 3x3 pixels:"));
    assert_eq!(
        sentence(Study { sizes: vec![1, 10], ..possible.clone() }),
        "a matrix whose windows are divided 0 times: it has to have at least 1 level"
    );
    assert!(
        sentence(Study { m: 12, ..possible.clone() }).starts_with("an image of 4096x4096 pixels cannot be rendered")
    );
    assert!(sentence(Study { m: 40, ..possible }).starts_with("a matrix of"));
}

/// Every covered pixel is one processor's, so all of them together have the area; a mean's error says how far it is off.
#[test]
fn covered_pixels_are_the_area() {
    for point in points(&study(&[(10.0, 600), (300.0, 200)])) {
        let processors = point.matrix.processors() as f64;
        let (mean, error) = (point.fragments.mean * processors, point.fragments.error * processors);
        assert!((mean - point.area).abs() < 4.0 * error, "{mean} +- {error} of {}", point.area);
        assert!(error < 0.01 * mean, "{error}");
        assert!((point.area / point.sample.area - 1.0).abs() < 0.005);
    }
}

/// The clocks of a level, in tests, are those of the windows counted (MPG-EQ5 with kp = ke).
#[test]
fn stages_are_clocks_of_windows() {
    for point in points(&study(&[(20.0, 40)])) {
        for (level, time) in point.stages.times().iter().enumerate() {
            let expected = 4.0 * point.windows[level].mean + point.windows[level + 1].mean;
            assert!((time / expected - 1.0).abs() < 1e-12, "{time} and {expected}");
        }
    }
}

/// MPG-EQ1 bounds what is counted, but that small polygons have up to 1 % more of the upper windows of large matrices: one of the gaps
/// between windows lies at the border of the screen, and polygons that are on the screen as a whole are there less often.
#[test]
fn windows_are_within_their_bounds() {
    for Point { matrix, sample, windows, bounds, .. } in
        points(&study(&[(1.0, 300), (23.3, 300), (157.0, 150), (2000.0, 40)]))
    {
        for (level, (counted, bound)) in windows.iter().zip(&bounds).enumerate() {
            let slack = if matrix.p >= 8 && sample.area < 50.0 && level < 5 { 0.012 } else { 0.0 };
            let most = bound * (1.0 + slack) + 3.0 * counted.error;
            assert!(counted.mean <= most, "{matrix:?}, {sample:?}, level {level}: {counted:?} of {bound}");
            assert!(counted.mean > 0.78 * bound, "{matrix:?}, {sample:?}, level {level}: {counted:?} of {bound}");
        }
    }
}

/// Of polygons that are equally often everywhere in the windows' spacing, MPG-EQ1 is a bound on every level, and the mean is the
/// exact one of convex sets: area, perimeters' product over 2 pi, area of the window. Bounds hold their ends, which adds 1/32 pixel
/// on each side of a window.
#[test]
fn windows_far_from_the_border_are_the_exact_mean() {
    for (k, area, count) in [(0, 100.0, 4000), (1, 20.0, 2000), (3, 23.3, 600), (4, 5.0, 400), (4, 157.0, 200)] {
        let matrix = Rasters::square(k, 10);
        let search = Search::new(matrix).expect("possible");
        let screen = Size::new(1024, 1024).expect("in range");
        let rectangles = Rectangles::new(screen, area, RATIO, 9).expect("they fit");
        let mut random = Random::new(9, u64::MAX);
        let counts: Vec<Windows> =
            (0..count).map(|index| search.all_windows(&moved(rectangles.polygon(index), &mut random))).collect();
        for level in 1..=matrix.levels {
            let (mean, error) = mean(counts.iter().map(|windows| windows.passed[level as usize]), matrix.processors());
            let bound = matrix.windows_of(Shape::rectangle(area, RATIO), level);
            let (window, spacing) = (f64::from(matrix.window(level).0), f64::from(matrix.spacing(level).0));
            let perimeter = 12.0 * (area / 5.0).sqrt();
            let sum = area + 2.0 * window * perimeter / std::f64::consts::PI + window * window + 4.0 * window / 32.0;
            let exact = sum / (spacing * spacing);
            assert!(mean <= bound + 3.0 * error, "k {k}, area {area}, level {level}: {mean} +- {error} of {bound}");
            assert!(
                (mean - exact).abs() < 4.0 * error + 0.002 * exact,
                "k {k}, area {area}, level {level}: {mean} +- {error}, {exact}"
            );
        }
    }
}

/// A small packet moved by whole pixels to anywhere in the middle quarter of the screen, in both axes with the period of all windows.
fn moved(mut packet: Polygon, random: &mut Random) -> Polygon {
    let PixelBox { left, top, .. } = packet.bounds;
    let (x, y) = (random.between(256, 767) - left as i32, random.between(256, 767) - top as i32);
    packet.edges.iter_mut().for_each(|edge| edge.c -= edge.a * x + edge.b * y);
    let PixelBox { left, top, right, bottom } = &mut packet.bounds;
    for (bound, by) in [(left, x), (top, y), (right, x), (bottom, y)] {
        *bound = bound.wrapping_add_signed(by);
    }
    packet
}

/// The mean in a processor, and its standard error.
fn mean(values: impl ExactSizeIterator<Item = u64> + Clone, processors: u64) -> (f64, f64) {
    let count = values.len() as f64;
    let in_one = values.map(|value| value as f64 / processors as f64);
    let mean = in_one.clone().sum::<f64>() / count;
    let squares = in_one.map(|value| (value - mean).powi(2)).sum::<f64>();
    (mean, (squares / count / (count - 1.0)).sqrt())
}

/// Performance is a little above the formulas', as their windows are bounds; the paper's statements hold of clocks counted, too.
#[test]
fn counted_figures_are_near_those_of_the_formulas() {
    let points = points(&study(&[(1.0, 250), (100.0, 100), (1000.0, 50)]));
    for Point { matrix, sample, figures: counted, figures_by_formula: formula, .. } in &points {
        let pairs = [
            (counted.p_s, formula.p_s),
            (counted.p_p, formula.p_p),
            (counted.q_a, formula.q_a),
            (counted.q_p, formula.q_p),
            (counted.r_p, formula.r_p),
        ];
        for (counted, formula) in pairs {
            assert!((0.96..1.08).contains(&(counted / formula)), "{matrix:?}, {sample:?}: {counted} and {formula}");
        }
    }
    for matrices in points.chunks(5) {
        assert!(matrices.is_sorted_by(|less, more| less.figures.q_a > more.figures.q_a), "MPG-F5B");
        assert!(matrices.is_sorted_by(|less, more| less.figures.p_s < more.figures.p_s), "MPG-F5A");
        assert!(matrices.iter().all(|point| point.figures.q_p <= point.figures.q_a), "MPG-QP");
        assert!(matrices[1..].iter().all(|point| point.figures.r_p > matrices[0].figures.r_p), "MPG-F6B");
    }
}

#[test]
fn each_size_is_searched_as_it_is_beside_one_processor() {
    let run = |sizes: &[u32]| {
        let it = Study { sizes: sizes.to_vec(), ..study(&[(40.0, 50)]) };
        it.run(&mut Watch::default()).expect("possible").expect("done")
    };
    assert_eq!(run(&[2]), run(&[0, 2])[1..]);
}

#[test]
fn the_papers_samples_are_sixteen_areas_with_fewer_and_fewer_polygons() {
    let paper = Study::paper(1).samples;
    let areas: Vec<f64> = paper.iter().map(|it| it.area).collect();
    assert_eq!(areas, [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1e3, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5]);
    let polygons: Vec<u64> = paper.iter().step_by(3).map(|it| it.polygons).collect();
    assert_eq!(polygons, [20_000, 15_000, 8_000, 4_000, 1_000, 500]);
}
