//! Counts are what the formulas say, the study is repeatable, and it can be broken off.

use super::*;
use std::sync::atomic::AtomicBool;

fn study(lengths: &[f64], angles: &[f64], vectors: u64) -> Study {
    Study { lengths: lengths.to_vec(), angles: angles.to_vec(), vectors, ..Study::paper(3) }
}

fn points(study: &Study) -> Vec<Point> {
    study.run(&mut Watch::default()).expect("they fit").expect("nobody breaks it off")
}

fn each(point: &Point) -> [(Mean, f64); 3] {
    let Bins { by_box, by_columns, tight } = point.counted;
    let formula = point.by_formula;
    [(by_box, formula.by_box), (by_columns, formula.by_columns), (tight, formula.tight)]
}

/// PP5-HVB and PP5-HV, and the vector itself: within 0.5 %, for short and long vectors at all angles.
#[test]
fn counts_are_within_half_a_percent_of_the_formulas() {
    for point in points(&study(&[50.0, 300.0], &[0.0, 20.0, 45.0, 70.0, 90.0, 160.0], 60_000)) {
        for (counted, formula) in each(&point) {
            let off = (counted.mean / formula - 1.0).abs();
            assert!(off < 0.005, "{off} of {point:?}");
            // Snapping changes the extents by 1/32 pixel at most.
            assert!((counted.mean - formula).abs() < 4.5 * counted.error + 0.002, "{point:?}");
        }
    }
}

/// The vector itself has fewer regions than either of the others has; which of these has fewer changes at L cos t = S.
#[test]
fn the_tight_count_is_below_both() {
    for point in points(&study(&[30.0, 120.0, 128.0, 250.0, 500.0], &[5.0, 30.0, 45.0, 60.0], 20_000)) {
        let Bins { by_box, by_columns, tight } = point.counted;
        assert!(tight.mean < by_box.mean && tight.mean < by_columns.mean, "{point:?}");
        let (sine, cosine) = point.shape.angle.to_radians().sin_cos();
        match point.shape.length * sine.max(cosine) / 128.0 {
            long if long > 1.05 => assert!(by_columns.mean < by_box.mean, "{point:?}"),
            long if long < 0.95 => assert!(by_columns.mean > by_box.mean, "{point:?}"),
            _ => {}
        }
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let study = study(&[20.0, 90.0], &[10.0, 80.0, 250.0], 2 * PART + 300);
    let on = |threads| study.run_on(threads, &mut Watch::default()).expect("they fit");
    assert_eq!(on(1), on(3));
    assert_eq!(on(1).map(|points| points.len()), Some(6));
    assert_ne!(points(&study), points(&Study { seed: 4, ..study.clone() }));
}

#[test]
fn progress_rises_to_1_and_a_raised_flag_ends_the_study() {
    let study = study(&[20.0, 90.0], &[10.0, 80.0], 10);
    let mut seen = Vec::new();
    let mut progress = |progress: crate::Progress| seen.push(progress.fraction);
    study.run(&mut Watch { progress: Some(&mut progress), cancel: None }).expect("they fit");
    assert_eq!(seen, [0.25, 0.5, 0.75, 1.0]);
    let cancel = AtomicBool::new(true);
    assert_eq!(study.run(&mut Watch { progress: None, cancel: Some(&cancel) }), Ok(None));
}

#[test]
fn an_impossible_study_is_a_sentence() {
    let sentence = |study: Study| study.run(&mut Watch::default()).expect_err("impossible").to_string();
    assert_eq!(sentence(study(&[5.0], &[0.0], 0)), "a study of 0 vectors: it has to have at least 1");
    assert!(sentence(study(&[5.0, 900.0], &[90.0], 1)).starts_with("vectors of 900 pixels on a screen of 1280x1024"));
}
