//! A statement of a paper, with the numbers found here.

use crate::csv;
use crate::evidence::{Numbers, evidence, places};
use crate::origin::Origin;
use crate::reason::Reason;
use crate::verdict::{Point, Rule, Verdict, in_words};
use maud::{Markup, html};
use serde::Serialize;
use serde::ser::{SerializeStruct, Serializer};

/// A statement of a paper, its rule, and the numbers that the rule compares. The verdict follows from these.
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
    text: String,
    rule: Rule,
    unit: String,
    reference: Option<Numbers>,
    found: Option<Numbers>,
    obstacle: Option<String>,
    pub(crate) reason: Option<Reason>,
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

    /// The paper's number, or several numbers with their places.
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

    /// The values of the paper's formula, if the rule compares with them.
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

    /// The numbers found here.
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

    /// Adds why it cannot be compared, as the end of a sentence.
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

    /// Adds why it differs, and what would have to change to make it true. The page shows that only if it differs.
    ///
    /// ```
    /// use tilewright_report::{Origin, Page, Provenance, Rule, Section, Statement, Verdicts};
    ///
    /// let page = |found: f64| {
    ///     let statement = Statement::new("VC1-TM", "T_m", Rule::Equals).paper([25.3]).found(Origin::Formula, [found]);
    ///     let verdicts = Verdicts::new("statements", "Statements").state(statement.because(["β is ours.", "The paper would have to print β."]));
    ///     let page = Page::new("T_m", Provenance::new("tilewright", "0.1.0", "tilewright list")).section(Section::new("T_m").part(verdicts));
    ///     String::from_utf8(page.files().unwrap().remove(0).bytes).unwrap()
    /// };
    /// assert_eq!([25.3, 26.0].map(|found| page(found).contains("β is ours.")), [false, true]);
    /// ```
    pub fn because(self, reason: impl Into<Reason>) -> Statement {
        Statement { reason: Some(reason.into()), ..self }
    }

    /// The verdict of its rule on its numbers.
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

    /// The rule in the words that stand beside the statement.
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

    /// The statement with its rule, its reason, and its verdict unless its place shows that. The numbers stand beside these.
    pub(crate) fn html(&self, more: Markup) -> Markup {
        let verdict = self.verdict();
        let named = match &verdict {
            Verdict::Differs { at, .. } => at.as_slice(),
            _ => &[],
        };
        html! {
            div.statement {
                div.words {
                    p.text { (self.text) " " span.fact { (self.fact) } }
                    p.rule { "Rule: " (self.rule_in_words()) (in_words_beside(&verdict)) }
                    (more)
                }
                (evidence(&self.reference, &self.found, &self.unit, named))
            }
        }
    }

    /// A row for each place.
    pub(crate) fn rows(&self) -> Vec<Vec<String>> {
        let verdict = self.verdict().to_string();
        let row = |at: &str| {
            let value = |numbers: &Option<Numbers>| {
                let both = numbers.as_ref().and_then(|numbers| Some((&numbers.origin, numbers.at(at)?)));
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
        let places = places(&self.reference, &self.found);
        if places.is_empty() { vec![row("")] } else { places.into_iter().map(row).collect() }
    }
}

/// The verdict stands beside its numbers.
impl Serialize for Statement {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut it = serializer.serialize_struct("Statement", 10)?;
        it.serialize_field("fact", &self.fact)?;
        it.serialize_field("text", &self.text)?;
        it.serialize_field("rule", &self.rule)?;
        it.serialize_field("rule_in_words", &self.rule_in_words())?;
        it.serialize_field("unit", &self.unit)?;
        it.serialize_field("reference", &self.reference)?;
        it.serialize_field("found", &self.found)?;
        it.serialize_field("verdict", &self.verdict())?;
        it.serialize_field("verdict_in_words", &self.verdict().to_string())?;
        it.serialize_field("reason_if_it_differs", &self.reason)?;
        it.end()
    }
}

/// The verdict on a statement that is not true, with its colour and its sign. It is readable without either.
fn in_words_beside(verdict: &Verdict) -> Markup {
    let (class, sign, words) = match verdict {
        Verdict::Holds => return html! {},
        // Number and unit stay on one line.
        Verdict::Differs { by, at } => ("differs", "≠", format!("differs {by}{}", place(at)).replace(" %", "\u{a0}%")),
        Verdict::CannotBeCompared { why } => ("unknown", "–", format!("cannot be compared: {why}")),
    };
    html! { br; span.verdict.(class) { span aria-hidden="true" { (sign) } " " (words) } }
}

fn place(at: &[String]) -> String {
    match at {
        [] => String::new(),
        [only] => format!(" at {only}"),
        several => format!(" from {}", several.join(" to ")),
    }
}

/// The origin with its seeds, or with their number if there are many.
pub(crate) fn in_full(origin: &Origin) -> String {
    match origin.seeds() {
        [] => origin.name().to_owned(),
        [seed] => format!("{}, seed {seed}", origin.name()),
        seeds if seeds.len() <= 4 => format!("{}, seeds {}", origin.name(), origin.seeds_in_words()),
        seeds => format!("{}, {} seeds", origin.name(), seeds.len()),
    }
}
