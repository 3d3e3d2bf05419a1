//! The rules for statements of a paper, and their verdicts.

use crate::number::percent;
use serde::Serialize;
use std::fmt;

/// A number, and its place on a curve or in a list.
///
/// ```
/// use tilewright_report::Point;
///
/// assert_eq!(Point::from(("k = 2", 1.8)), Point { at: "k = 2".to_owned(), value: 1.8 });
/// assert_eq!(Point::from(0.2).at, ""); // the only one
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Point {
    /// The place, such as `k = 2`; empty for a single number.
    pub at: String,
    /// The number.
    pub value: f64,
}

impl From<f64> for Point {
    fn from(value: f64) -> Point {
        Point { at: String::new(), value }
    }
}

impl<S: Into<String>> From<(S, f64)> for Point {
    fn from((at, value): (S, f64)) -> Point {
        Point { at: at.into(), value }
    }
}

/// How numbers are compared with those of a reference, or with each other. Each number is compared with the reference's number at the same
/// place. A reference of one number without a place counts for all places.
///
/// ```
/// use tilewright_report::{Difference, Rule, Verdict};
///
/// let rule = Rule::Within { percent: 2.0 };
/// assert_eq!(rule.judge(&[100.0.into()], &[101.0.into()]), Verdict::Holds);
/// assert_eq!(rule.judge(&[100.0.into()], &[103.1.into()]).to_string(), "differs by 3.1 %");
///
/// let rule = Rule::Increases { with: "k".to_owned() };
/// assert_eq!(rule.judge(&[], &[("k = 1", 5.0).into(), ("k = 2", 6.0).into()]), Verdict::Holds);
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Rule {
    /// The reference, with at most this difference.
    Within {
        /// The greatest allowed difference, in percent of the reference.
        percent: f64,
    },
    /// Between the reference divided by a factor and the reference times that factor.
    WithinFactor {
        /// The factor, 1 or more.
        factor: f64,
    },
    /// Exactly the reference.
    Equals,
    /// Exactly 0, without a reference: for what must not occur, such as pixels that differ.
    Zero,
    /// The reference or less.
    AtMost,
    /// The reference or more.
    AtLeast,
    /// Each number is greater than the one before it.
    Increases {
        /// What grows from number to number.
        with: String,
    },
    /// Each number is less than the one before it.
    Decreases {
        /// What grows from number to number.
        with: String,
    },
    /// No number is less than the one before it.
    NeverDecreases {
        /// What grows from number to number.
        with: String,
    },
    /// No number is greater than the one before it.
    NeverIncreases {
        /// What grows from number to number.
        with: String,
    },
}

/// The result of a rule. Only a rule gives the first two.
///
/// ```
/// use tilewright_report::Rule;
///
/// let verdict = Rule::AtMost.judge(&[("k = 3", 8.0).into()], &[("k = 3", 10.0).into()]);
/// assert_eq!(verdict.to_string(), "differs by 25 % (k = 3)");
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Verdict {
    /// All numbers satisfy the rule.
    Holds,
    /// A number violates the rule.
    Differs {
        /// The difference of the worst number.
        by: Difference,
        /// Its place; for a rule of growth, the two places of the step. Empty if there is one number.
        at: Vec<String>,
    },
    /// There are no numbers for the rule.
    CannotBeCompared {
        /// Why, as the end of a sentence.
        why: String,
    },
}

/// The distance of a number from the values that satisfy a rule.
///
/// ```
/// use tilewright_report::Difference;
///
/// assert_eq!(Difference::Factor(10.92).to_string(), "by a factor of 11");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Difference {
    /// Percent of the reference, or of the previous number.
    Percent(f64),
    /// Times the reference, or the reference divided by this.
    Factor(f64),
    /// The number itself, if the reference is zero.
    FromZero(f64),
    /// A number should have changed and did not.
    NoChange,
}

impl Difference {
    /// A size by which differences are compared; the worst is greatest.
    fn size(self) -> f64 {
        match self {
            Difference::NoChange => 0.0,
            Difference::Percent(size) | Difference::Factor(size) => size,
            Difference::FromZero(_) => f64::INFINITY,
        }
    }

    fn from(reference: f64, value: f64) -> Difference {
        match reference == 0.0 {
            true => Difference::FromZero(value),
            false => Difference::Percent(((value - reference) / reference).abs() * 100.0),
        }
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Difference::Percent(size) => write!(f, "by {} %", percent(*size)),
            Difference::Factor(size) => write!(f, "by a factor of {}", percent(*size)),
            Difference::FromZero(value) => write!(f, "by {} from 0", crate::number::shown(*value)),
            Difference::NoChange => write!(f, "by not changing"),
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Verdict::Holds => write!(f, "holds"),
            Verdict::Differs { by, at } if at.is_empty() => write!(f, "differs {by}"),
            Verdict::Differs { by, at } => write!(f, "differs {by} ({})", at.join(" to ")),
            Verdict::CannotBeCompared { why } => write!(f, "cannot be compared: {why}"),
        }
    }
}

impl Rule {
    /// Compares the numbers found with a reference. [`Rule::Zero`] and rules of growth need none.
    ///
    /// ```
    /// use tilewright_report::Rule;
    ///
    /// let verdict = Rule::Equals.judge(&[("k = 2", 16.0).into()], &[("k = 3", 64.0).into()]);
    /// assert_eq!(verdict.to_string(), "cannot be compared: nothing was found at k = 2");
    /// ```
    pub fn judge(&self, reference: &[Point], found: &[Point]) -> Verdict {
        let differences = match self.trend() {
            _ if found.is_empty() => Err("nothing was found".to_owned()),
            Some(is_kept) => steps(found, is_kept),
            None if *self == Rule::Zero => Rule::Equals.distances(&[0.0.into()], found),
            None => self.distances(reference, found),
        };
        match differences {
            Err(why) => Verdict::CannotBeCompared { why },
            // The first of the worst, so that the verdict does not depend on later numbers.
            Ok(all) => match all.into_iter().rev().max_by(|(one, _), (other, _)| one.size().total_cmp(&other.size())) {
                Some((by, at)) => Verdict::Differs { by, at },
                None => Verdict::Holds,
            },
        }
    }

    /// The comparison of a number with the next, if the rule compares numbers with each other.
    fn trend(&self) -> Option<fn(f64, f64) -> bool> {
        match self {
            Rule::Increases { .. } => Some(|before, value| value > before),
            Rule::Decreases { .. } => Some(|before, value| value < before),
            Rule::NeverDecreases { .. } => Some(|before, value| value >= before),
            Rule::NeverIncreases { .. } => Some(|before, value| value <= before),
            _ => None,
        }
    }

    /// The numbers that violate the rule, with their places.
    fn distances(&self, reference: &[Point], found: &[Point]) -> Result<Vec<(Difference, Vec<String>)>, String> {
        let (reference, found) = (finite(reference)?, finite(found)?);
        let for_all = match reference {
            [] => return Err("there is nothing to compare with".to_owned()),
            [only] if only.at.is_empty() => Some(only.value),
            several => match several.iter().find(|point| !found.iter().any(|it| it.at == point.at)) {
                Some(Point { at, .. }) => return Err(format!("nothing was found at {at}")),
                None => None,
            },
        };
        let mut differences = Vec::new();
        for Point { at, value } in found {
            let same = || reference.iter().find(|point| point.at == *at).map(|point| point.value);
            let wanted = for_all.or_else(same).ok_or_else(|| format!("there is nothing to compare with at {at}"))?;
            let place = || (!at.is_empty()).then(|| at.clone()).into_iter().collect();
            differences.extend(self.distance(wanted, *value).map(|difference| (difference, place())));
        }
        Ok(differences)
    }

    /// The difference of a number that violates the rule.
    fn distance(&self, wanted: f64, value: f64) -> Option<Difference> {
        let is_kept = match self {
            Rule::Within { percent } => (value - wanted).abs() <= percent / 100.0 * wanted.abs(),
            Rule::WithinFactor { factor } => {
                let ratio = value / wanted;
                let is_kept = value == wanted || (1.0 / factor..=*factor).contains(&ratio);
                if !is_kept && wanted != 0.0 && ratio > 0.0 {
                    return Some(Difference::Factor(ratio.max(1.0 / ratio)));
                }
                is_kept
            }
            Rule::AtMost => value <= wanted,
            Rule::AtLeast => value >= wanted,
            _ => value == wanted,
        };
        (!is_kept).then(|| Difference::from(wanted, value))
    }
}

/// The steps from number to number that violate the rule.
fn steps(found: &[Point], is_kept: fn(f64, f64) -> bool) -> Result<Vec<(Difference, Vec<String>)>, String> {
    if finite(found)?.len() < 2 {
        return Err("a single number neither increases nor decreases".to_owned());
    }
    let wrong = found.windows(2).filter(|pair| !is_kept(pair[0].value, pair[1].value));
    let places = |pair: &[Point]| pair.iter().map(|point| point.at.clone()).collect();
    Ok(wrong.map(|pair| (step(pair[0].value, pair[1].value), places(pair))).collect())
}

fn step(before: f64, value: f64) -> Difference {
    if before == value { Difference::NoChange } else { Difference::from(before, value) }
}

/// The numbers, if there are any and each is finite.
fn finite(points: &[Point]) -> Result<&[Point], String> {
    match points.iter().find(|point| !point.value.is_finite()) {
        Some(Point { at, .. }) if at.is_empty() => Err("a value is not a finite number".to_owned()),
        Some(Point { at, .. }) => Err(format!("the value at {at} is not a finite number")),
        None => Ok(points),
    }
}

/// The rule in the words that stand beside a statement; `reference` names the reference, such as "the paper's value".
pub(crate) fn in_words(rule: &Rule, reference: &str) -> String {
    match rule {
        Rule::Within { percent } => format!("within {percent} % of {reference}"),
        Rule::WithinFactor { factor } => format!("within a factor of {factor} of {reference}"),
        Rule::Equals => format!("exactly {reference}"),
        Rule::Zero => "exactly 0".to_owned(),
        Rule::AtMost => format!("at most {reference}"),
        Rule::AtLeast => format!("at least {reference}"),
        Rule::Increases { with } => format!("increases with {with}, at each step"),
        Rule::Decreases { with } => format!("decreases with {with}, at each step"),
        Rule::NeverDecreases { with } => format!("does not decrease with {with}"),
        Rule::NeverIncreases { with } => format!("does not increase with {with}"),
    }
}
