//! What is measured is what the counters say, on both machines the same, and differences are found.

use super::*;
use crate::quadtree::study::Study;
use std::sync::atomic::Ordering;

fn small(samples: &[(f64, u64, bool)]) -> Trials {
    let trial =
        |&(area, polygons, on_hardware): &(f64, u64, bool)| Trial { sample: Sample { area, polygons }, on_hardware };
    Trials { m: 6, largest: 2, trials: samples.iter().map(trial).collect(), ..Trials::paper(5) }
}

fn outcomes(trials: &Trials) -> Vec<Outcome> {
    trials.run(&mut Watch::default()).expect("possible").expect("nobody breaks it off")
}

/// The plain count of the same rectangles has the same windows and the same figures, to the last bit.
#[test]
fn counters_give_what_is_counted() {
    let trials = small(&[(2.0, 30, true), (60.0, 10, true)]);
    let samples = trials.trials.iter().map(|trial| trial.sample).collect();
    let study = Study { m: 6, sizes: vec![0, 1, 2], aperture: 2, samples, seed: 5 };
    let points = study.run(&mut Watch::default()).expect("possible").expect("nobody breaks it off");
    let outcomes = outcomes(&trials);
    assert_eq!(outcomes.len(), points.len());
    for (outcome, point) in outcomes.iter().zip(&points) {
        let hardware = outcome.hardware.as_ref().expect("it ran");
        assert_eq!((outcome.matrix, outcome.sample), (point.matrix, point.sample));
        assert_eq!((hardware.differs_from_model, hardware.differs_from_count), (0, 0));
        assert_eq!(hardware.measured, outcome.model);
        assert_eq!(hardware.measured.figures, point.figures);
        let counted = point.windows.iter().map(|windows| windows.mean);
        assert!(hardware.measured.windows.iter().zip(counted).all(|(one, other)| (one - other).abs() < 1e-12));
        // As they ran they also waited for each other, and for the first window to reach the last level.
        assert!(hardware.measured.pipes_ran < point.figures.p_p && hardware.measured.stacks_ran < point.figures.p_s);
        assert!(hardware.measured.pipes_ran > point.figures.p_p / 3.0);
    }
}

#[test]
fn a_number_that_differs_is_counted() {
    let trials = small(&[(20.0, 5, true)]);
    let job = &trials.jobs().expect("possible")[3];
    let both = job.run(None).expect("its assertions hold");
    let differences = |change: fn(&mut Run)| {
        let mut run = both.model.clone();
        change(&mut run);
        let checked = job.checked(run, &both.model);
        (checked.differs_from_model, checked.differs_from_count)
    };
    assert_eq!(differences(|_| {}), (0, 0));
    assert_eq!(differences(|run| run.clocks += 1), (1, 0));
    assert_eq!(differences(|run| run.taken[1] += 1), (1, 0));
    assert_eq!(differences(|run| run.taken.truncate(4)), (1, 0));
    assert_eq!(differences(|run| run.broadcast.stalled += 1), (1, 0));
    assert_eq!(differences(|run| run.processors[3].units[2].stalled += 1), (1, 0));
    assert_eq!(differences(|run| run.processors[3].units[2].results += 1), (1, 1));
    assert_eq!(differences(|run| run.processors[0].units[1].busy -= 1), (1, 1));
    assert_eq!(differences(|run| run.processors[0].fragments += 1), (1, 1));
}

#[test]
fn the_number_of_threads_changes_nothing_and_the_seed_does() {
    let trials = small(&[(2.0, 20, true), (60.0, 5, false)]);
    let on = |threads| trials.run_on(threads, &mut Watch::default()).expect("possible").expect("nobody breaks it off");
    let one = on(1);
    assert_eq!(one, on(3));
    assert_eq!(one.iter().map(|it| it.hardware.is_some()).collect::<Vec<_>>(), [true, true, true, false, false, false]);
    assert_ne!(one, outcomes(&Trials { seed: 6, ..trials }));
}

#[test]
fn progress_rises_to_1_and_a_raised_flag_ends_the_trials() {
    let mut seen = Vec::new();
    let mut progress = |progress: crate::Progress| seen.push(progress.fraction);
    let trials = Trials { largest: 1, ..small(&[(5.0, 3, false)]) };
    assert!(trials.run(&mut Watch { progress: Some(&mut progress), cancel: None }).expect("possible").is_some());
    assert_eq!(seen, [0.25, 0.5, 0.75, 1.0]);
    // Trials of hours: they would not end.
    let cancel = AtomicBool::new(false);
    let mut raise = |_| cancel.store(true, Ordering::Relaxed);
    let mut watch = Watch { progress: Some(&mut raise), cancel: Some(&cancel) };
    let long = small(&[(500.0, 1_000_000, true), (5.0, 3, true)]);
    assert!(long.run(&mut watch).expect("possible").is_none());
}

#[test]
fn impossible_trials_are_a_sentence() {
    let sentence = |trials: Trials| trials.run(&mut Watch::default()).expect_err("impossible").to_string();
    assert!(sentence(small(&[(5.0, 0, true)])).starts_with("a sample of 0 rectangles of 5 pixels"));
    let possible = small(&[(5.0, 1, true)]);
    assert!(sentence(Trials { largest: 5, ..possible.clone() }).starts_with("a matrix of 32x32 video processors"));
    assert!(
        sentence(Trials { m: 3, trials: small(&[(500.0, 1, true)]).trials, ..possible })
            .starts_with("rectangles of 500")
    );
}
