//! The sweep is repeatable and can be broken off, and deeper queues lose less.

use super::*;
use crate::quadtree::study::Study;
use std::sync::atomic::Ordering;

fn sweep(samples: &[(f64, u64)]) -> Sweep {
    let samples = samples.iter().map(|&(area, polygons)| Sample { area, polygons }).collect();
    Sweep { samples, ..Sweep::paper(7) }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let sweep =
        Sweep { sizes: vec![0, 2], packets: vec![1, 8], windows: vec![1, 4], ..sweep(&[(3.0, 60), (40.0, 30)]) };
    let on = |threads| sweep.run_on(threads, &mut Watch::default()).expect("possible").expect("nobody breaks it off");
    let points = on(1);
    assert_eq!(points, on(3));
    assert_eq!(points.len(), 16);
    assert_ne!(
        points,
        Sweep { seed: 8, ..sweep.clone() }.run_on(2, &mut Watch::default()).expect("possible").expect("done")
    );
}

#[test]
fn progress_rises_to_1_and_a_raised_flag_ends_the_sweep() {
    let mut seen = Vec::new();
    let mut progress = |progress: crate::Progress| seen.push(progress.fraction);
    let small = Sweep { sizes: vec![1, 2], packets: vec![1], ..sweep(&[(5.0, 10)]) };
    assert!(small.run(&mut Watch { progress: Some(&mut progress), cancel: None }).expect("possible").is_some());
    assert_eq!(seen, [0.25, 0.5, 0.75, 1.0]);
    // A sweep of hours: it would not end.
    let cancel = AtomicBool::new(false);
    let mut raise = |_| cancel.store(true, Ordering::Relaxed);
    let mut watch = Watch { progress: Some(&mut raise), cancel: Some(&cancel) };
    let long = Sweep { samples: vec![small.samples[0], Sample { area: 1e5, polygons: 10_000 }], ..small.clone() };
    assert_eq!(long.run(&mut watch), Ok(None));
    assert_eq!(small.run(&mut watch), Ok(None), "it was raised before");
}

#[test]
fn an_impossible_sweep_is_a_sentence() {
    let sentence = |sweep: Sweep| sweep.run(&mut Watch::default()).expect_err("impossible").to_string();
    let possible = sweep(&[(5.0, 10)]);
    assert_eq!(
        sentence(Sweep { packets: vec![], ..possible.clone() }),
        "a sweep over no depths of packet queues: it has to have at least one"
    );
    assert_eq!(
        sentence(Sweep { packets: vec![2, 0], ..possible.clone() }),
        "`queues.packets` of `VideoProcessor` is 0: it has to be from 1 to 4096"
    );
    assert_eq!(
        sentence(Sweep { sizes: vec![5], ..possible.clone() }),
        "a matrix of 32x32 video processors: each side has to be 1, 2, 4, 8 or 16"
    );
    assert!(sentence(Sweep { forms: vec!["heap".to_owned()], ..possible.clone() }).starts_with("the form `heap`:"));
    assert!(sentence(sweep(&[(5.0, 0)])).starts_with("a sample of 0 rectangles of 5 pixels"));
    assert!(sentence(Sweep { m: 12, ..possible }).contains("4096"));
}

/// MPG-LIM: the matrix takes no less than the slowest of its processors, nearly that with deep queues, and deeper ones are not slower. With
/// queues of one packet a large matrix of stacks loses by it, of small polygons; one of pipes, whose stages hold packets, too, hardly does.
#[test]
fn deeper_queues_lose_less() {
    let sweep = Sweep { sizes: vec![0, 2, 4], ..sweep(&[(1.0, 300), (100.0, 60)]) };
    for point in sweep.run(&mut Watch::default()).expect("possible").expect("nobody breaks it off") {
        let losses: Vec<f64> = point.by_depth.iter().map(|run| run.loss_by_depth).collect();
        let clocks: Vec<u64> = point.by_depth.iter().map(|run| run.clocks).collect();
        assert!(clocks.is_sorted_by(|shallow, deep| shallow >= deep), "{point:?}");
        assert!(losses.iter().all(|loss| *loss >= 0.0) && losses[6] < 0.002, "{point:?}");
        assert!(point.by_depth.iter().all(|run| run.loss >= run.loss_by_depth), "{point:?}");
        let is_lossy = point.matrix.p == 16 && point.form == "stack" && point.sample.area == 1.0;
        assert_eq!(losses[0] > 0.02, is_lossy, "{point:?}");
    }
}

/// Rates of the running matrix are near those that follow from the clocks of each level (MPG-EQ8, MPG-EQ9), and below: processors differ, the
/// stages of a pipe wait for each other, and the first polygon has to come through.
#[test]
fn performance_is_near_that_of_the_stages_clocks() {
    let sweep = Sweep { sizes: vec![0, 3], packets: vec![64], ..sweep(&[(10.0, 400), (300.0, 100)]) };
    let points = sweep.run(&mut Watch::default()).expect("possible").expect("nobody breaks it off");
    let study = Study { samples: sweep.samples.clone(), sizes: sweep.sizes.clone(), ..Study::paper(7) };
    let counted = study.run(&mut Watch::default()).expect("possible").expect("nobody breaks it off");
    for (forms, counted) in points.chunks(2).zip(&counted) {
        assert_eq!((forms[0].matrix, forms[0].sample), (counted.matrix, counted.sample));
        let [pipe, stack] = [0, 1].map(|form| &forms[form].by_depth[0]);
        for (measured, expected) in [(pipe.performance, counted.figures.p_p), (stack.performance, counted.figures.p_s)]
        {
            assert!((0.9..1.0).contains(&(measured / expected)), "{measured} of {expected}: {forms:?}");
        }
        let load = pipe.load[1..].iter().sum::<f64>() / f64::from(counted.matrix.levels);
        assert!((0.9..1.0).contains(&(load / counted.figures.r_p)), "{load} of {}", counted.figures.r_p);
    }
}
