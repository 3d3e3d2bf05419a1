//! Each rule at its border, and what a verdict says.

use tilewright_report::{Difference, Origin, Point, Rule, Statement, Verdict};

fn points<const N: usize>(points: [(&str, f64); N]) -> Vec<Point> {
    points.into_iter().map(Point::from).collect()
}

/// The verdict on one number, as it reads.
fn judged(rule: &Rule, reference: f64, found: f64) -> String {
    rule.judge(&[reference.into()], &[found.into()]).to_string()
}

#[test]
fn within_a_share_of_the_reference() {
    let rule = Rule::Within { percent: 25.0 };
    let cases = [
        (8.0, 10.0, "holds"),
        (8.0, 6.0, "holds"),
        (-8.0, -10.0, "holds"),
        (8.0, 10.01, "differs by 25 %"),
        (8.0, 5.9, "differs by 26 %"),
        (-8.0, 8.0, "differs by 200 %"),
        (0.0, 0.0, "holds"),
        (0.0, -0.5, "differs by −0.5 from 0"),
    ];
    for (reference, found, verdict) in cases {
        assert_eq!(judged(&rule, reference, found), verdict, "{found} for {reference}");
    }
    assert_eq!(judged(&Rule::Within { percent: 1.0 }, 1000.0, 1031.0), "differs by 3.1 %");
}

#[test]
fn within_a_factor_of_the_reference() {
    let rule = Rule::WithinFactor { factor: 2.0 };
    let cases = [
        (1000.0, 2000.0, "holds"),
        (1000.0, 500.0, "holds"),
        (1000.0, 2001.0, "differs by a factor of 2"),
        (1000.0, 10_923.0, "differs by a factor of 11"),
        (1000.0, 250.0, "differs by a factor of 4"),
        (1000.0, -1000.0, "differs by 200 %"),
        (0.0, 0.0, "holds"),
        (0.0, 3.0, "differs by 3 from 0"),
    ];
    for (reference, found, verdict) in cases {
        assert_eq!(judged(&rule, reference, found), verdict, "{found} for {reference}");
    }
}

#[test]
fn nothing_of_what_must_not_be() {
    assert_eq!(Rule::Zero.judge(&[], &points([("teapot", 0.0), ("terrain", 0.0)])).to_string(), "holds");
    let one = points([("teapot", 0.0), ("terrain", 3.0)]);
    assert_eq!(Rule::Zero.judge(&[], &one).to_string(), "differs by 3 from 0 (terrain)");
    assert_eq!(Rule::Zero.judge(&[], &[]).to_string(), "cannot be compared: nothing was found");
}

#[test]
fn the_reference_itself_or_a_bound() {
    let cases = [
        (Rule::Equals, 316_864.0, "holds"),
        (Rule::Equals, 316_865.0, "differs by 0.00032 %"),
        (Rule::Equals, 158_432.0, "differs by 50 %"),
        (Rule::AtMost, 316_864.0, "holds"),
        (Rule::AtMost, 1.0, "holds"),
        (Rule::AtMost, 633_728.0, "differs by 100 %"),
        (Rule::AtLeast, 316_864.0, "holds"),
        (Rule::AtLeast, 1e9, "holds"),
        (Rule::AtLeast, 158_432.0, "differs by 50 %"),
    ];
    for (rule, found, verdict) in cases {
        assert_eq!(judged(&rule, 316_864.0, found), verdict, "{rule:?} {found}");
    }
}

#[test]
fn growth_from_step_to_step() {
    let with = || "k".to_owned();
    let (up, flat, down) = ([("1", 4.0), ("2", 5.0)], [("1", 4.0), ("2", 4.0)], [("1", 4.0), ("2", 3.0)]);
    let cases = [
        (Rule::Increases { with: with() }, up, "holds"),
        (Rule::Increases { with: with() }, flat, "differs by not changing (1 to 2)"),
        (Rule::Increases { with: with() }, down, "differs by 25 % (1 to 2)"),
        (Rule::Decreases { with: with() }, up, "differs by 25 % (1 to 2)"),
        (Rule::Decreases { with: with() }, flat, "differs by not changing (1 to 2)"),
        (Rule::Decreases { with: with() }, down, "holds"),
        (Rule::NeverDecreases { with: with() }, up, "holds"),
        (Rule::NeverDecreases { with: with() }, flat, "holds"),
        (Rule::NeverDecreases { with: with() }, down, "differs by 25 % (1 to 2)"),
        (Rule::NeverIncreases { with: with() }, up, "differs by 25 % (1 to 2)"),
        (Rule::NeverIncreases { with: with() }, flat, "holds"),
        (Rule::NeverIncreases { with: with() }, down, "holds"),
    ];
    for (rule, found, verdict) in cases {
        assert_eq!(rule.judge(&[], &points(found)).to_string(), verdict, "{rule:?} {found:?}");
    }
}

#[test]
fn the_worst_number_is_named() {
    let reference = points([("a", 10.0), ("b", 10.0), ("c", 10.0)]);
    let found = points([("c", 10.1), ("b", 14.0), ("a", 13.0)]);
    let verdict = Rule::Within { percent: 2.0 }.judge(&reference, &found);
    assert_eq!(verdict, Verdict::Differs { by: Difference::Percent(40.0), at: vec!["b".to_owned()] });
    // Of two that are equally bad, the first.
    let found = points([("c", 14.0), ("b", 14.0), ("a", 10.0)]);
    assert_eq!(Rule::Within { percent: 2.0 }.judge(&reference, &found).to_string(), "differs by 40 % (c)");
    // Nothing is worse than a number where none should be.
    let reference = points([("a", 0.0), ("b", 1.0)]);
    assert_eq!(
        Rule::Equals.judge(&reference, &points([("a", 0.1), ("b", 9.0)])).to_string(),
        "differs by 0.1 from 0 (a)"
    );
}

#[test]
fn one_reference_counts_for_all() {
    assert_eq!(Rule::AtLeast.judge(&[0.9.into()], &points([("a", 0.95), ("b", 0.9)])), Verdict::Holds);
    assert_eq!(
        Rule::AtLeast.judge(&[0.9.into()], &points([("a", 0.95), ("b", 0.45)])).to_string(),
        "differs by 50 % (b)"
    );
}

#[test]
fn what_cannot_be_compared_says_why() {
    let two = || points([("a", 1.0), ("b", 2.0)]);
    let grows = Rule::Increases { with: "k".to_owned() };
    let cases = [
        (Rule::Equals.judge(&two(), &[]), "nothing was found"),
        (grows.judge(&[], &[]), "nothing was found"),
        (grows.judge(&[], &points([("a", 1.0)])), "a single number neither increases nor decreases"),
        (grows.judge(&[], &points([("a", 1.0), ("b", f64::NAN)])), "the value at b is not a finite number"),
        (Rule::Equals.judge(&[], &two()), "there is nothing to compare with"),
        (Rule::Equals.judge(&points([("a", 1.0)]), &two()), "there is nothing to compare with at b"),
        (Rule::Equals.judge(&two(), &points([("a", 1.0)])), "nothing was found at b"),
        (Rule::Equals.judge(&[1.0.into()], &[f64::INFINITY.into()]), "a value is not a finite number"),
        (Rule::AtMost.judge(&[f64::NAN.into()], &[1.0.into()]), "a value is not a finite number"),
    ];
    for (verdict, why) in cases {
        assert_eq!(verdict, Verdict::CannotBeCompared { why: why.to_owned() });
    }
}

#[test]
fn a_reason_stands_before_numbers() {
    let equal = Statement::new("A", "One is one.", Rule::Equals).paper([1.0]).found(Origin::Formula, [1.0]);
    assert_eq!(equal.verdict(), Verdict::Holds);
    assert_eq!(
        equal.cannot_be_compared("the scan is torn").verdict().to_string(),
        "cannot be compared: the scan is torn"
    );
}

#[test]
fn what_comes_from_the_paper_was_not_found_here() {
    let copied = Statement::new("A", "One is one.", Rule::Equals).paper([1.0]).found(Origin::Paper, [1.0]);
    assert_eq!(copied.verdict().to_string(), "cannot be compared: what was found here would be the paper’s own");
}

#[test]
fn rules_in_words() {
    let with = || "k".to_owned();
    let cases = [
        (Rule::Within { percent: 0.5 }, "within 0.5 % of the paper’s value"),
        (Rule::WithinFactor { factor: 2.0 }, "within a factor of 2 of the paper’s value"),
        (Rule::Equals, "exactly the paper’s value"),
        (Rule::AtMost, "at most the paper’s value"),
        (Rule::AtLeast, "at least the paper’s value"),
        (Rule::Increases { with: with() }, "increases with k, at each step"),
        (Rule::Decreases { with: with() }, "decreases with k, at each step"),
        (Rule::NeverDecreases { with: with() }, "does not decrease with k"),
        (Rule::NeverIncreases { with: with() }, "does not increase with k"),
    ];
    for (rule, words) in cases {
        assert_eq!(Statement::new("A", "Text.", rule).rule_in_words(), words);
    }
}
