//! What a testbench does at each step, as data: one row a step, many rows in a constant.
//!
//! A statement for each row would be simpler to read and slow to compile: a frame of 18,000 steps is 60 MB of C++ then.

use crate::verilog::{pattern, range};
use std::collections::BTreeMap;
use tilewright_hdl::{Bits, up_to};

/// The most bits of a constant of several rows: a simulator takes time for the square of this.
const MOST_BITS: u32 = 16_384;

/// The testbench's own names, by what they are for.
pub type OwnNames = BTreeMap<&'static str, String>;

/// What each step has of one kind, such as the values of the inputs.
pub struct Column {
    /// The register that has the value during the step, by the testbench's own names.
    pub name: &'static str,
    pub width: u32,
    pub values: Vec<Bits>,
}

/// All columns. They have a value for each row.
pub struct Table {
    columns: Vec<Column>,
    rows: usize,
    /// Steps that are alike, one after another, have one row, whose first column says how many they are.
    merged: bool,
}

impl Table {
    /// The names that [`Table::tasks`] uses, besides those of columns.
    pub const NAMES: [&str; 9] = ["times", "next", "steps", "fill", "put", "first", "count", "rows", "row"];

    /// The table of columns that have a value for each of so many steps.
    pub fn new(columns: Vec<Column>, steps: usize) -> Table {
        let same = |step: usize| step > 0 && columns.iter().all(|it| it.values[step] == it.values[step - 1]);
        let starts: Vec<usize> = (0..steps).filter(|step| !same(*step)).collect();
        if columns.is_empty() || starts.len() > steps * 3 / 4 {
            return Table { columns, rows: steps, merged: false };
        }
        let ends = starts.iter().skip(1).copied().chain([steps]);
        let times: Vec<u64> = starts.iter().zip(ends).map(|(start, end)| (end - start) as u64).collect();
        let times = numbers("times", &times);
        let of_rows = |column: Column| {
            let values = starts.iter().map(|start| column.values[*start].clone()).collect();
            Column { values, ..column }
        };
        let columns = [times].into_iter().chain(columns.into_iter().map(of_rows)).collect();
        Table { columns, rows: starts.len(), merged: true }
    }

    /// The bits of a row.
    fn width(&self) -> u32 {
        self.columns.iter().map(|column| column.width).sum()
    }

    /// The most rows of a constant.
    fn at_once(&self) -> usize {
        ((MOST_BITS / self.width()).max(1) as usize).min(self.rows.max(1))
    }

    /// The declaration of the registers that have a row, and of the memory of all rows.
    pub fn declarations(&self, own: &OwnNames) -> Vec<String> {
        let register = |column: &Column| format!("reg {}{};", range(column.width), own[column.name]);
        let mut out: Vec<String> = self.columns.iter().map(register).collect();
        if !self.columns.is_empty() {
            out.push(format!("reg {}{} [0:{}];", range(self.width()), own["steps"], self.rows.max(1) - 1));
        }
        if self.merged {
            out.push(format!("integer {};", own["next"]));
        }
        out
    }

    /// What comes before the first step.
    pub fn start(&self, own: &OwnNames) -> Vec<String> {
        match self.merged {
            true => vec![format!("{} = {}'d0;", own["times"], self.columns[0].width), format!("{} = 0;", own["next"])],
            false => Vec::new(),
        }
    }

    /// The statements that take the row of a step out, and leave it where it is if the next step has the same.
    pub fn read(&self, own: &OwnNames) -> Vec<String> {
        let columns: Vec<&str> = self.columns.iter().map(|column| own[column.name].as_str()).collect();
        let take = |row: &str| format!("{{{}}} = {}[{row}];", columns.join(", "), own["steps"]);
        if self.columns.is_empty() {
            return Vec::new();
        }
        if !self.merged {
            return vec![take(&own["cycle"])];
        }
        let [times, next] = ["times", "next"].map(|name| own[name].as_str());
        let width = self.columns[0].width;
        vec![
            format!("if ({times} == {width}'d0) begin"),
            format!("    {}", take(next)),
            format!("    {next} = {next} + 1;"),
            "end".to_string(),
            format!("{times} = {times} - {width}'d1;"),
        ]
    }

    /// The tasks that write all rows to the memory.
    pub fn tasks(&self, own: &OwnNames) -> Vec<String> {
        let name = |name: &str| own[name].as_str();
        let mut out = vec![String::new(), format!("task {};", name("fill")), "begin".to_string()];
        if self.columns.is_empty() {
            out.extend(["end".to_string(), "endtask".to_string()]);
            return out;
        }
        for first in (0..self.rows).step_by(self.at_once()) {
            out.extend(self.call(first, own));
        }
        out.extend(["end".to_string(), "endtask".to_string(), String::new()]);
        let [put, first, count, rows, row] = ["put", "first", "count", "rows", "row"].map(name);
        let width = self.width();
        out.extend([
            "// The first row is the most significant. Above it is a 1.".to_string(),
            format!("task {put};"),
            format!("    input integer {first};"),
            format!("    input integer {count};"),
            format!("    input {}{rows};", range(width * self.at_once() as u32 + 1)),
            format!("    integer {row};"),
            "begin".to_string(),
            format!("    for ({row} = 0; {row} < {count}; {row} = {row} + 1)"),
            format!("        {}[{first} + {row}] = {rows}[{width} * ({count} - 1 - {row}) +: {width}];", name("steps")),
            "end".to_string(),
            "endtask".to_string(),
        ]);
        out
    }

    /// The call that writes the rows from `first` on. The 1 on top is for Verilator 5.006, which writes past the end of
    /// a wide constant whose first word is 0.
    fn call(&self, first: usize, own: &OwnNames) -> Vec<String> {
        let last = self.rows.min(first + self.at_once());
        let mut out = vec![format!("    {}({first}, {}, {{ 1'b1,", own["put"], last - first)];
        let missing = self.at_once() - (last - first);
        if missing > 0 {
            out.push(format!("        {},", pattern(&Bits::zero(missing as u32 * self.width()))));
        }
        for step in first..last {
            let values: Vec<String> = self.columns.iter().map(|column| pattern(&column.values[step])).collect();
            let comma = if step + 1 < last { "," } else { "" };
            out.push(format!("        {}{comma}", values.join(", ")));
        }
        out.push("    });".to_string());
        out
    }
}

/// A column of numbers, as wide as the greatest needs.
pub fn numbers(name: &'static str, numbers: &[u64]) -> Column {
    let width = up_to(numbers.iter().copied().max().unwrap_or(0)).bits();
    Column { name, width, values: numbers.iter().map(|number| Bits::new(width, *number)).collect() }
}
