//! A table of statements with their verdicts.

use crate::csv;
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
    statements: Vec<Statement>,
}

impl Verdicts {
    /// A table without statements. `id` names it in addresses and files: lower-case letters, digits, hyphens.
    ///
    /// ```
    /// assert_eq!(tilewright_report::Verdicts::new("statements", "Statements of the paper").count(), [0, 0, 0]);
    /// ```
    pub fn new(id: impl Into<String>, title: impl Into<String>) -> Verdicts {
        Verdicts { id: id.into(), title: title.into(), statements: Vec::new() }
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

    /// How many statements hold, differ, and cannot be compared.
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

    /// The statements that differ, in words, each with the reason if one is known.
    ///
    /// ```
    /// use tilewright_report::{Origin, Rule, Statement, Verdicts};
    ///
    /// let slow = Statement::new("VC1-33", "It takes 33.3 ms.", Rule::Equals).paper([33.3]).found(Origin::model([]), [50.0]);
    /// let verdicts = Verdicts::new("statements", "Statements").state(slow.because("A page is lacking."));
    /// assert_eq!(verdicts.differing().collect::<Vec<_>>(), [("It takes 33.3 ms.", Some("A page is lacking."))]);
    /// ```
    pub fn differing(&self) -> impl Iterator<Item = (&str, Option<&str>)> {
        let differing = self.statements.iter().filter(|it| matches!(it.verdict(), Verdict::Differs { .. }));
        differing.map(|it| (it.text.as_str(), it.reason.as_deref()))
    }

    pub(crate) fn html(&self) -> Markup {
        html! {
            table.verdicts role="table" {
                thead role="rowgroup" {
                    tr role="row" {
                        @for name in ["Statement and rule", "Reference", "Found here", "Verdict"] { th role="columnheader" scope="col" { (name) } }
                    }
                }
                tbody role="rowgroup" { @for statement in &self.statements { (statement.html()) } }
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
