//! A statement of a paper beside what was found of it here.

use crate::csv;
use crate::number::shown;
use crate::origin::Origin;
use crate::verdict::{Point, Rule, Verdict, in_words};
use maud::{Markup, html};
use serde::Serialize;
use serde::ser::{SerializeStruct, Serializer};

/// A statement of a paper, the rule by which it is judged, and the numbers that the rule is asked of. The verdict follows from these.
///
/// ```
/// use tilewright_report::{Origin, Rule, Statement, Verdict};
///
/// let statement = Statement::new("MPG-EQ4", "Beyond S = 1.8 pixels the gain slows down at k = 2", Rule::Within { percent: 5.0 })
///     .unit("pixels")
///     .paper([1.8])
///     .found(Origin::rtl([1, 2]), [1.84]);
/// assert_eq!(statement.rule_in_words(), "within 5 % of the paper’s value");
/// assert_eq!(statement.verdict(), Verdict::Holds);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Statement {
    fact: String,
    pub(crate) text: String,
    rule: Rule,
    unit: String,
    reference: Option<Numbers>,
    found: Option<Numbers>,
    obstacle: Option<String>,
    pub(crate) reason: Option<String>,
}

/// Numbers of one origin.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Numbers {
    origin: Origin,
    points: Vec<Point>,
}

impl Numbers {
    fn new<P: Into<Point>>(origin: Origin, points: impl IntoIterator<Item = P>) -> Numbers {
        Numbers { origin, points: points.into_iter().map(Into::into).collect() }
    }
}

impl Statement {
    /// A statement: the fact's id, the statement in words, and its rule.
    ///
    /// ```
    /// use tilewright_report::{Rule, Statement};
    ///
    /// let statement = Statement::new("MPG-F5A", "Performance grows with k", Rule::Increases { with: "k".to_owned() });
    /// assert_eq!(statement.verdict().to_string(), "cannot be compared: nothing was found");
    /// ```
    pub fn new(fact: impl Into<String>, text: impl Into<String>, rule: Rule) -> Statement {
        let (fact, text) = (fact.into(), text.into());
        Statement { fact, text, rule, unit: String::new(), reference: None, found: None, obstacle: None, reason: None }
    }

    /// The unit of all its numbers.
    ///
    /// ```
    /// use tilewright_report::{Rule, Statement};
    ///
    /// let statement = Statement::new("VC1-TM", "A merging round takes T_m", Rule::Equals).unit("clocks");
    /// assert_eq!(statement.verdict().to_string(), "cannot be compared: nothing was found");
    /// ```
    pub fn unit(self, unit: impl Into<String>) -> Statement {
        Statement { unit: unit.into(), ..self }
    }

    /// What the paper prints: a number, or several with their places.
    ///
    /// ```
    /// use tilewright_report::{Origin, Rule, Statement};
    ///
    /// let statement = Statement::new("MPG-EQ4", "S_k", Rule::Within { percent: 1.0 }).paper([("k = 2", 1.8), ("k = 3", 23.3)]);
    /// let found = statement.found(Origin::Formula, [("k = 2", 1.8044), ("k = 3", 23.3351)]);
    /// assert_eq!(found.verdict().to_string(), "holds");
    /// ```
    pub fn paper<P: Into<Point>>(self, points: impl IntoIterator<Item = P>) -> Statement {
        Statement { reference: Some(Numbers::new(Origin::Paper, points)), ..self }
    }

    /// What the paper's formula gives, where that is what the rule compares with.
    ///
    /// ```
    /// use tilewright_report::{Origin, Rule, Statement};
    ///
    /// let statement = Statement::new("MPG-EQ1", "No more windows than eq. 1 says", Rule::AtMost).formula([("S = 100", 20.5)]);
    /// assert_eq!(statement.rule_in_words(), "at most the formula’s value");
    /// assert_eq!(statement.found(Origin::rtl([1]), [("S = 100", 19.8)]).verdict().to_string(), "holds");
    /// ```
    pub fn formula<P: Into<Point>>(self, points: impl IntoIterator<Item = P>) -> Statement {
        Statement { reference: Some(Numbers::new(Origin::Formula, points)), ..self }
    }

    /// What was found here.
    ///
    /// ```
    /// use tilewright_report::{Origin, Rule, Statement};
    ///
    /// let statement = Statement::new("MPG-F5A", "Performance grows with k", Rule::Increases { with: "k".to_owned() });
    /// let found = statement.found(Origin::model([1]), [("k = 1", 0.088), ("k = 2", 0.127), ("k = 3", 0.12)]);
    /// assert_eq!(found.verdict().to_string(), "differs by 5.5 % (k = 2 to k = 3)");
    /// ```
    pub fn found<P: Into<Point>>(self, origin: Origin, points: impl IntoIterator<Item = P>) -> Statement {
        Statement { found: Some(Numbers::new(origin, points)), ..self }
    }

    /// Says why it cannot be compared, as the end of a sentence.
    ///
    /// ```
    /// use tilewright_report::{Rule, Statement};
    ///
    /// let statement = Statement::new("MPG-TREE", "As fast as a tree", Rule::AtLeast).cannot_be_compared("the bound is illegible");
    /// assert_eq!(statement.verdict().to_string(), "cannot be compared: the bound is illegible");
    /// ```
    pub fn cannot_be_compared(self, why: impl Into<String>) -> Statement {
        Statement { obstacle: Some(why.into()), ..self }
    }

    /// Says why it differs, if it does.
    ///
    /// ```
    /// use tilewright_report::{Origin, Rule, Statement, Verdicts};
    ///
    /// let of = |found: f64| Statement::new("VC1-TM", "T_m", Rule::Equals).paper([25.3]).found(Origin::Formula, [found]).because("β is ours");
    /// let reasons = |found| Verdicts::new("statements", "Statements").state(of(found)).differing().count();
    /// assert_eq!([25.3, 26.0].map(reasons), [0, 1]);
    /// ```
    pub fn because(self, reason: impl Into<String>) -> Statement {
        Statement { reason: Some(reason.into()), ..self }
    }

    /// What its rule says of its numbers.
    ///
    /// ```
    /// use tilewright_report::{Origin, Rule, Statement};
    ///
    /// let statement = Statement::new("MPG-F6A", "At S = 1000 four times the speed from step to step", Rule::Within { percent: 5.0 });
    /// let compared = statement.paper([4.0]).found(Origin::Formula, [3.0]);
    /// assert_eq!(compared.verdict().to_string(), "differs by 25 %");
    /// ```
    pub fn verdict(&self) -> Verdict {
        fn points(numbers: &Option<Numbers>) -> &[Point] {
            numbers.as_ref().map_or(&[], |numbers| numbers.points.as_slice())
        }
        let is_copied = self.found.as_ref().is_some_and(|found| found.origin == Origin::Paper);
        let copied = is_copied.then(|| "what was found here would be the paper’s own".to_owned());
        match self.obstacle.clone().or(copied) {
            Some(why) => Verdict::CannotBeCompared { why },
            None => self.rule.judge(points(&self.reference), points(&self.found)),
        }
    }

    /// The rule as it stands beside the statement.
    ///
    /// ```
    /// use tilewright_report::{Rule, Statement};
    ///
    /// let statement = Statement::new("MPG-QP", "Less efficient than the stack matrix", Rule::AtMost).paper([1.0]);
    /// assert_eq!(statement.rule_in_words(), "at most the paper’s value");
    /// ```
    pub fn rule_in_words(&self) -> String {
        let is_formula = self.reference.as_ref().is_some_and(|reference| reference.origin == Origin::Formula);
        in_words(&self.rule, if is_formula { "the formula’s value" } else { "the paper’s value" })
    }

    pub(crate) fn html(&self) -> Markup {
        let verdict = self.verdict();
        let named = match &verdict {
            Verdict::Differs { at, .. } => at.as_slice(),
            _ => &[],
        };
        html! {
            tr role="row" {
                th role="rowheader" scope="row" {
                    span.fact { (self.fact) } " " span.statement { (self.text) }
                    span.rule { "Rule: " (self.rule_in_words()) }
                }
                td role="cell" data-label="Reference" { (numbers(&self.reference, &self.unit, named)) }
                td role="cell" data-label="Found here" { (numbers(&self.found, &self.unit, named)) }
                td role="cell" data-label="Verdict" { (in_table(&verdict)) }
            }
        }
    }

    /// A row for each place.
    pub(crate) fn rows(&self) -> Vec<Vec<String>> {
        let verdict = self.verdict().to_string();
        let row = |at: &str| {
            // A number without a place counts for all.
            let value = |numbers: &Option<Numbers>| {
                let point = |numbers: &Numbers| {
                    numbers.points.iter().find(|point| point.at == at || point.at.is_empty()).map(|point| point.value)
                };
                let both = numbers.as_ref().and_then(|numbers| Some((&numbers.origin, point(numbers)?)));
                both.map_or([String::new(), String::new()], |(origin, value)| {
                    [origin.name().to_owned(), csv::cell(value)]
                })
            };
            let mut row =
                vec![self.fact.clone(), self.text.clone(), self.rule_in_words(), at.to_owned(), self.unit.clone()];
            row.extend(value(&self.reference));
            row.extend(value(&self.found));
            row.push(self.found.as_ref().map_or(String::new(), |found| found.origin.seeds_in_words()));
            row.push(verdict.clone());
            row
        };
        let places = [&self.found, &self.reference]
            .into_iter()
            .flatten()
            .map(|numbers| &numbers.points)
            .find(|points| !points.is_empty());
        places.map_or_else(|| vec![row("")], |points| points.iter().map(|point| row(&point.at)).collect())
    }
}

/// The verdict stands beside what it follows from.
impl Serialize for Statement {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut it = serializer.serialize_struct("Statement", 9)?;
        it.serialize_field("fact", &self.fact)?;
        it.serialize_field("text", &self.text)?;
        it.serialize_field("rule", &self.rule)?;
        it.serialize_field("rule_in_words", &self.rule_in_words())?;
        it.serialize_field("unit", &self.unit)?;
        it.serialize_field("reference", &self.reference)?;
        it.serialize_field("found", &self.found)?;
        it.serialize_field("verdict", &self.verdict())?;
        it.serialize_field("verdict_in_words", &self.verdict().to_string())?;
        it.end()
    }
}

/// The verdict with its colour and its sign, of which it needs neither.
fn in_table(verdict: &Verdict) -> Markup {
    let (class, sign, words, more) = match verdict {
        Verdict::Holds => ("holds", "✓", "holds".to_owned(), String::new()),
        Verdict::Differs { by, at } => {
            let place = match at.as_slice() {
                [] => String::new(),
                [only] => format!("at {only}"),
                several => format!("from {}", several.join(" to ")),
            };
            // Its number and unit stay on one line.
            ("differs", "≠", format!("differs {by}").replace(" %", "\u{a0}%"), place)
        }
        Verdict::CannotBeCompared { why } => ("unknown", "–", "cannot be compared".to_owned(), why.clone()),
    };
    html! {
        div {
            span.verdict.(class) { span aria-hidden="true" { (sign) } " " (words) }
            @if !more.is_empty() { span.detail { (more) } }
        }
    }
}

/// How many numbers a cell of the table shows, besides those that a verdict names; the CSV file has all.
const SHOWN: usize = 6;

fn numbers(numbers: &Option<Numbers>, unit: &str, named: &[String]) -> Markup {
    let Some(Numbers { origin, points }) = numbers else { return html! { span { "–" } } };
    let is_shown = |(index, point): &(usize, &Point)| *index < SHOWN || named.contains(&point.at);
    let shown_points: Vec<&Point> = points.iter().enumerate().filter(is_shown).map(|(_, point)| point).collect();
    let left = points.len() - shown_points.len();
    html! {
        div {
            ul.numbers {
                @for point in shown_points {
                    li { @if !point.at.is_empty() { span.at { (point.at) } " " } span { (shown(point.value)) } }
                }
            }
            @if left > 0 { span.detail { "and " (left) " more" } }
            span.origin { @if !unit.is_empty() { (unit) ", " } (in_full(origin)) }
        }
    }
}

/// The origin with its seeds, of which many are counted.
pub(crate) fn in_full(origin: &Origin) -> String {
    match origin.seeds() {
        [] => origin.name().to_owned(),
        [seed] => format!("{}, seed {seed}", origin.name()),
        seeds if seeds.len() <= 4 => format!("{}, seeds {}", origin.name(), origin.seeds_in_words()),
        seeds => format!("{}, {} seeds", origin.name(), seeds.len()),
    }
}
