//! Problems of the parts of a page.

use crate::page::{Page, Part};
use std::collections::BTreeSet;
use std::fmt;

/// All problems of a page, a sentence for each.
///
/// ```
/// use tilewright_report::{Page, Provenance, Section, Table};
///
/// let page = Page::new("Forms", Provenance::new("tilewright", "0.1.0", "tilewright list"))
///     .section(Section::new("Forms").part(Table::new("The Forms", "The three forms", ["form"])));
/// assert_eq!(page.files().unwrap_err().0.len(), 1);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problems(pub Vec<String>);

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.0.join("\n"))
    }
}

impl std::error::Error for Problems {}

/// Checks all parts.
pub fn problems(page: &Page) -> Result<(), Problems> {
    let mut found = Vec::new();
    let mut names = BTreeSet::from(["index", "report"].map(str::to_owned));
    for part in page.parts() {
        let Some((kind, id)) = part.name() else { continue };
        let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        if id.is_empty() || !id.chars().all(is_plain) {
            found.push(format!(
                "the {kind} `{id}` has a name that is not a plain file name: use lower-case letters, digits and hyphens"
            ));
        } else if !names.insert(id.to_owned()) {
            found.push(format!(
                "the {kind} `{id}` has a name that is taken: give each part another name, but not `index` or `report`"
            ));
        }
        found.extend(inside(part).map(|wrong| format!("the {kind} `{id}` {wrong}")));
    }
    if found.is_empty() { Ok(()) } else { Err(Problems(found)) }
}

/// The problem of the part itself, as the end of a sentence.
fn inside(part: &Part) -> Option<String> {
    match part {
        Part::Picture(picture) if picture.size().is_none() => {
            Some("is not a PNG file: give it the bytes of a PNG file".to_owned())
        }
        Part::Timeline(chart) => chart.problem(),
        Part::Table(table) => {
            let wrong = table.rows.iter().position(|row| row.len() != table.columns.len())?;
            let (cells, columns) = (table.rows[wrong].len(), table.columns.len());
            Some(format!(
                "has {cells} cells in row {} and {columns} columns: give each row a cell for each column",
                wrong + 1
            ))
        }
        Part::HeatMap(map) => {
            let cells = map.rows.first().map_or(0, Vec::len);
            if cells == 0 {
                return Some("has no cells: give it at least one row of numbers".to_owned());
            }
            let wrong = map.rows.iter().position(|row| row.len() != cells)?;
            let other = map.rows[wrong].len();
            Some(format!("has {other} cells in row {} and {cells} in row 1: give all rows one length", wrong + 1))
        }
        _ => None,
    }
}
