//! Where a report comes from: everything that is needed to repeat it.

use maud::{Markup, html};
use serde::Serialize;

/// The program, the command line and the parameters of a report. It has no time and no place, so that the same input gives the same bytes.
///
/// ```
/// use tilewright_report::Provenance;
///
/// let provenance = Provenance::new("tilewright", "0.1.0", "tilewright reproduce quadtree -o report/")
///     .seeds([1, 2, 3])
///     .parameter("levels m", "10", "as in the paper");
/// assert_eq!(provenance.program(), "tilewright 0.1.0");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Provenance {
    name: String,
    version: String,
    command: String,
    seeds: Vec<u64>,
    parameters: Vec<Parameter>,
}

#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
struct Parameter {
    name: String,
    value: String,
    why: String,
}

impl Provenance {
    /// The program's name, its version, and the command line that makes the report.
    ///
    /// ```
    /// assert_eq!(tilewright_report::Provenance::new("tilewright", "0.1.0", "tilewright list").program(), "tilewright 0.1.0");
    /// ```
    pub fn new(name: impl Into<String>, version: impl Into<String>, command: impl Into<String>) -> Provenance {
        let (name, version, command) = (name.into(), version.into(), command.into());
        Provenance { name, version, command, seeds: Vec::new(), parameters: Vec::new() }
    }

    /// All seeds of random numbers.
    ///
    /// ```
    /// let provenance = tilewright_report::Provenance::new("tilewright", "0.1.0", "tilewright list").seeds(1..=10);
    /// assert_eq!(provenance.program(), "tilewright 0.1.0");
    /// ```
    pub fn seeds(self, seeds: impl IntoIterator<Item = u64>) -> Provenance {
        Provenance { seeds: seeds.into_iter().collect(), ..self }
    }

    /// A parameter: its name, its value, and the reason for that value.
    ///
    /// ```
    /// let provenance = tilewright_report::Provenance::new("tilewright", "0.1.0", "tilewright list");
    /// assert_eq!(provenance.parameter("aperture", "2", "as in the paper").program(), "tilewright 0.1.0");
    /// ```
    pub fn parameter(
        mut self,
        name: impl Into<String>,
        value: impl Into<String>,
        why: impl Into<String>,
    ) -> Provenance {
        self.parameters.push(Parameter { name: name.into(), value: value.into(), why: why.into() });
        self
    }

    /// The program and its version.
    ///
    /// ```
    /// assert_eq!(tilewright_report::Provenance::new("tilewright", "0.1.0", "tilewright list").program(), "tilewright 0.1.0");
    /// ```
    pub fn program(&self) -> String {
        format!("{} {}", self.name, self.version)
    }

    pub(crate) fn html(&self) -> Markup {
        let seeds: Vec<String> = self.seeds.iter().map(u64::to_string).collect();
        html! {
            p { "Made by " (self.program()) ". The same command gives the same bytes:" }
            pre { code { (self.command) } }
            @if !seeds.is_empty() { p { (if seeds.len() == 1 { "Seed: " } else { "Seeds: " }) (seeds.join(", ")) "." } }
            @if !self.parameters.is_empty() {
                dl.parameters {
                    @for Parameter { name, value, why } in &self.parameters {
                        div { dt { (name) } dd { (value) } @if !why.is_empty() { dd.why { (why) } } }
                    }
                }
            }
        }
    }
}
