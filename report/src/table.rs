//! A plain table.

use crate::csv;
use crate::number::shown;
use maud::{Markup, html};
use serde::Serialize;

/// The content of a table's cell.
///
/// ```
/// use tilewright_report::Cell;
///
/// assert_eq!(Cell::from(2.5), Cell::Number(2.5));
/// assert_eq!(Cell::from("pipe"), Cell::Text("pipe".to_owned()));
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Cell {
    /// A number, shown with four digits. Files of data have all digits.
    Number(f64),
    /// Words.
    Text(String),
}

impl Cell {
    /// Whether it stands for a missing number.
    fn is_missing(&self) -> bool {
        matches!(self, Cell::Text(text) if text == "–")
    }
}

impl From<f64> for Cell {
    fn from(value: f64) -> Cell {
        Cell::Number(value)
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Cell {
        Cell::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Cell {
        Cell::Text(text)
    }
}

/// A table with a row of names on top. The first cell of a row is its heading.
///
/// ```
/// use tilewright_report::Table;
///
/// let table = Table::new("forms", "The three forms", ["form", "clocks"]).row(["pipe".into(), 5.0.into()]);
/// assert_eq!(table.csv_text(), "form,clocks\npipe,5\n");
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Table {
    pub(crate) id: String,
    pub(crate) title: String,
    pub(crate) note: String,
    pub(crate) columns: Vec<String>,
    pub(crate) rows: Vec<Vec<Cell>>,
}

impl Table {
    /// A table without rows. `id` names it in addresses and files: lower-case letters, digits, hyphens.
    ///
    /// ```
    /// assert_eq!(tilewright_report::Table::new("forms", "The three forms", ["form", "clocks"]).csv_text(), "form,clocks\n");
    /// ```
    pub fn new<S: Into<String>>(
        id: impl Into<String>,
        title: impl Into<String>,
        columns: impl IntoIterator<Item = S>,
    ) -> Table {
        let columns = columns.into_iter().map(Into::into).collect();
        Table { id: id.into(), title: title.into(), note: String::new(), columns, rows: Vec::new() }
    }

    /// A note below the title, in the caption.
    ///
    /// ```
    /// use tilewright_report::Table;
    ///
    /// assert_eq!(Table::new("forms", "The three forms", ["form"]).note("Per polygon.").csv_text(), "form\n");
    /// ```
    pub fn note(self, note: impl Into<String>) -> Table {
        Table { note: note.into(), ..self }
    }

    /// Adds a row with a cell for each column.
    ///
    /// ```
    /// use tilewright_report::Table;
    ///
    /// let table = Table::new("forms", "The three forms", ["form", "why"]).row(["a, b".into(), "is quoted".into()]);
    /// assert_eq!(table.csv_text(), "form,why\n\"a, b\",is quoted\n");
    /// ```
    pub fn row(mut self, cells: impl IntoIterator<Item = Cell>) -> Table {
        self.rows.push(cells.into_iter().collect());
        self
    }

    /// Its cells, with all digits of numbers.
    ///
    /// ```
    /// use tilewright_report::Table;
    ///
    /// let table = Table::new("thirds", "A third", ["third"]).row([(1.0 / 3.0).into()]);
    /// assert_eq!(table.csv_text(), "third\n0.3333333333333333\n");
    /// ```
    pub fn csv_text(&self) -> String {
        let text = |cell: &Cell| match cell {
            Cell::Number(value) => csv::cell(*value),
            Cell::Text(text) => text.clone(),
        };
        let rows = self.rows.iter().map(|row| row.iter().map(text).collect());
        String::from_utf8_lossy(&csv::csv([self.columns.clone()].into_iter().chain(rows))).into_owned()
    }

    pub(crate) fn html(&self) -> Markup {
        // The name of a column of numbers is above them, even if some are missing.
        let is_number = |column: usize| {
            let mut cells =
                self.rows.iter().filter_map(|row| row.get(column)).filter(|cell| !cell.is_missing()).peekable();
            cells.peek().is_some() && cells.all(|cell| matches!(cell, Cell::Number(_)))
        };
        html! {
            div.scroll tabindex="0" role="region" aria-label=(self.title) {
                table.data {
                    thead { tr { @for (column, name) in self.columns.iter().enumerate() { th.number[is_number(column)] scope="col" { (name) } } } }
                    tbody { @for row in &self.rows { tr { @for (column, cell) in row.iter().enumerate() { (in_table(column, cell, is_number(column))) } } } }
                }
            }
        }
    }
}

fn in_table(column: usize, cell: &Cell, is_number: bool) -> Markup {
    let is_number = is_number || matches!(cell, Cell::Number(_));
    let text = match cell {
        Cell::Number(value) => shown(*value),
        Cell::Text(text) => text.clone(),
    };
    html! {
        @if column == 0 { th.number[is_number] scope="row" { (text) } } @else { td.number[is_number] { (text) } }
    }
}
