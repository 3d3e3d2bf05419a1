//! A table of statements with their verdicts.

use crate::csv;
use crate::reason::Reason;
use crate::statement::Statement;
use crate::verdict::Verdict;
use maud::{Markup, html};
use serde::Serialize;

/// A table of statements with their verdicts.
///
/// ```
/// use tilewright_report::{Origin, Rule, Statement, Verdicts};
///
/// let equal = |found| Statement::new("VC1-TM", "T_m in merge clocks", Rule::Equals).paper([316_864.0]).found(Origin::rtl([]), [found]);
/// let verdicts = Verdicts::new("statements", "Statements of the paper").state(equal(316_864.0)).state(equal(316_865.0));
/// assert_eq!(verdicts.count(), [1, 1, 0]);
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Verdicts {
    pub(crate) id: String,
    pub(crate) title: String,
    pub(crate) note: String,
    statements: Vec<Statement>,
}

impl Verdicts {
    /// A table without statements. `id` names it in addresses and files: lower-case letters, digits, hyphens.
    ///
    /// ```
    /// assert_eq!(tilewright_report::Verdicts::new("statements", "Statements of the paper").count(), [0, 0, 0]);
    /// ```
    pub fn new(id: impl Into<String>, title: impl Into<String>) -> Verdicts {
        Verdicts { id: id.into(), title: title.into(), note: String::new(), statements: Vec::new() }
    }

    /// A note below the title, in the caption.
    ///
    /// ```
    /// use tilewright_report::Verdicts;
    ///
    /// assert_eq!(Verdicts::new("statements", "Statements").note("Of a small screen.").count(), [0, 0, 0]);
    /// ```
    pub fn note(self, note: impl Into<String>) -> Verdicts {
        Verdicts { note: note.into(), ..self }
    }

    /// Adds a statement.
    ///
    /// ```
    /// use tilewright_report::{Rule, Statement, Verdicts};
    ///
    /// let table = Verdicts::new("table", "Statements").state(Statement::new("A", "Nobody asked", Rule::Equals));
    /// assert_eq!(table.count(), [0, 0, 1]);
    /// ```
    pub fn state(mut self, statement: Statement) -> Verdicts {
        self.statements.push(statement);
        self
    }

    /// Adds several.
    ///
    /// ```
    /// use tilewright_report::{Rule, Statement, Verdicts};
    ///
    /// let asked = ["A", "B"].map(|fact| Statement::new(fact, "Nobody asked", Rule::Equals));
    /// assert_eq!(Verdicts::new("table", "Statements").states(asked).count(), [0, 0, 2]);
    /// ```
    pub fn states(mut self, statements: impl IntoIterator<Item = Statement>) -> Verdicts {
        self.statements.extend(statements);
        self
    }

    /// The numbers of statements that hold, that differ, and that cannot be compared.
    ///
    /// ```
    /// assert_eq!(tilewright_report::Verdicts::new("table", "Statements").count(), [0, 0, 0]);
    /// ```
    pub fn count(&self) -> [usize; 3] {
        let mut count = [0; 3];
        for statement in &self.statements {
            count[match statement.verdict() {
                Verdict::Holds => 0,
                Verdict::Differs { .. } => 1,
                Verdict::CannotBeCompared { .. } => 2,
            }] += 1;
        }
        count
    }

    /// The statements that differ, with their reasons; then, folded, those that hold, and those that cannot be compared.
    pub(crate) fn html(&self) -> Markup {
        let [holds, differs, unknown] = self.count();
        let of = |kind: fn(&Verdict) -> bool| self.statements.iter().filter(move |it| kind(&it.verdict()));
        let folded = |class: &str, sign: &str, words: String, kind: fn(&Verdict) -> bool| {
            html! {
                details.statements {
                    summary.(class) { span aria-hidden="true" { (sign) } " " (words) }
                    ol.statements { @for it in of(kind) { li { (it.html(html! {})) } } }
                }
            }
        };
        html! {
            @if differs > 0 {
                p.count.differs { span aria-hidden="true" { "≠" } " " (differs) @if differs == 1 { " differs" } @else { " differ" } }
                ol.statements.differing {
                    @for (reason, statements) in by_reason(of(|it| matches!(it, Verdict::Differs { .. }))) {
                        @let reason = reason.map_or(html! {}, Reason::html);
                        li {
                            @match statements.as_slice() {
                                [only] => (only.html(reason)),
                                several => { @for it in several { (it.html(html! {})) } (reason) }
                            }
                        }
                    }
                }
            }
            @if holds > 0 {
                (folded("holds", "✓", format!("{holds} hold{}", if holds == 1 { "s" } else { "" }), |it| *it == Verdict::Holds))
            }
            @if unknown > 0 {
                (folded("unknown", "–", format!("{unknown} cannot be compared"), |it| matches!(it, Verdict::CannotBeCompared { .. })))
            }
        }
    }

    pub(crate) fn csv(&self) -> Vec<u8> {
        let names = [
            "fact",
            "statement",
            "rule",
            "at",
            "unit",
            "reference from",
            "reference",
            "found by",
            "found",
            "seeds",
            "verdict",
        ];
        csv::csv(
            [names.map(str::to_owned).to_vec()].into_iter().chain(self.statements.iter().flat_map(Statement::rows)),
        )
    }
}

/// Groups of statements that differ for the same reason, in the sequence of their first statements.
fn by_reason<'a>(statements: impl Iterator<Item = &'a Statement>) -> Vec<(Option<&'a Reason>, Vec<&'a Statement>)> {
    let mut groups: Vec<(Option<&Reason>, Vec<&Statement>)> = Vec::new();
    for it in statements {
        let reason = it.reason.as_ref();
        match groups.iter_mut().find(|(other, _)| reason.is_some() && *other == reason) {
            Some((_, group)) => group.push(it),
            None => groups.push((reason, vec![it])),
        }
    }
    groups
}
