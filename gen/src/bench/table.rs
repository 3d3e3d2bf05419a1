//! What a testbench does at each step, as data: one row a step, many rows in a constant.
//!
//! The inputs of a machine change once in hundreds of steps, its clocks at each. Side by side in one row both would be written at each.
//!
//! A statement for each row would be simpler to read and slow to compile: a frame of 18,000 steps is 60 MB of C++ then.

use crate::verilog::{self, pattern, range};
use tilewright_circuit::{Bits, width_below};

/// The most bits of a constant of several rows: a simulator takes time for the square of this.
const MOST_BITS: u32 = 16_384;

/// Up to so many rows have a line each.
const MOST_LINES: usize = 1000;

/// How long a line of several rows is at most.
const LINE: usize = 120;

/// What each step has of one kind, such as the values of the inputs.
pub struct Column {
    /// The register that has the value during the step.
    pub register: String,
    pub width: u32,
    pub values: Vec<Bits>,
}

/// Columns in one memory. They have a value for each row.
pub struct Table {
    columns: Vec<Column>,
    rows: usize,
    /// Steps that are alike, one after another, have one row, whose first column says how many they are.
    merged: bool,
    names: Names,
}

/// What a table declares.
#[derive(Default)]
struct Names {
    /// The memory, its task, and the number of the next row.
    steps: String,
    put: String,
    next: String,
    /// In how many steps from this one on the row is the same.
    times: String,
}

impl Names {
    /// Those that begin with `before`, if nothing else is called so.
    fn new(before: &str, names: &mut verilog::Names) -> Names {
        let mut fresh = |name: &str| names.fresh(&format!("{before}{name}"));
        Names { steps: fresh("steps"), put: fresh("put"), next: fresh("next"), times: fresh("times") }
    }
}

/// All columns: in one table, or each in its own where they change so seldom, or at such different steps, that they take less than half
/// of it.
pub fn tables(columns: &[Column], steps: usize, names: &mut verilog::Names) -> Vec<Table> {
    let one = Table::new(columns, steps);
    let each: Vec<Table> = columns.chunks(1).map(|column| Table::new(column, steps)).collect();
    let taken: u64 = each.iter().map(Table::bits).sum();
    if one.bits() <= MOST_BITS.into() || 2 * taken >= one.bits() {
        return vec![one.named("", names)];
    }
    let own = |table: Table| {
        let before = format!("{}_", table.columns.last().expect("it has one").register);
        table.named(&before, names)
    };
    each.into_iter().map(own).collect()
}

impl Table {
    /// The table of columns that have a value for each of so many steps.
    fn new(columns: &[Column], steps: usize) -> Table {
        let same = |step: usize| step > 0 && columns.iter().all(|it| it.values[step] == it.values[step - 1]);
        let starts: Vec<usize> = (0..steps).filter(|step| !same(*step)).collect();
        let of_rows = |column: &Column, rows: &[usize]| {
            let values = rows.iter().map(|row| column.values[*row].clone()).collect();
            Column { register: column.register.clone(), width: column.width, values }
        };
        if columns.is_empty() || starts.len() > steps * 3 / 4 {
            let all: Vec<usize> = (0..steps).collect();
            let columns = columns.iter().map(|column| of_rows(column, &all)).collect();
            return Table { columns, rows: steps, merged: false, names: Names::default() };
        }
        let ends = starts.iter().skip(1).copied().chain([steps]);
        let times: Vec<u64> = starts.iter().zip(ends).map(|(start, end)| (end - start) as u64).collect();
        let times = numbers(String::new(), &times);
        let columns = [times].into_iter().chain(columns.iter().map(|column| of_rows(column, &starts))).collect();
        Table { columns, rows: starts.len(), merged: true, names: Names::default() }
    }

    /// The table with names for what it declares.
    fn named(mut self, before: &str, names: &mut verilog::Names) -> Table {
        self.names = Names::new(before, names);
        if self.merged {
            self.columns[0].register = self.names.times.clone();
        }
        self
    }

    /// The bits of a row.
    fn width(&self) -> u32 {
        self.columns.iter().map(|column| column.width).sum()
    }

    /// The bits of all rows.
    fn bits(&self) -> u64 {
        self.rows as u64 * u64::from(self.width())
    }

    /// The most rows of a constant.
    fn at_once(&self) -> usize {
        ((MOST_BITS / self.width()).max(1) as usize).min(self.rows.max(1))
    }

    /// The declaration of the registers that have a row, and of the memory of all rows.
    pub fn declarations(&self) -> Vec<String> {
        let register = |column: &Column| format!("reg {}{};", range(column.width), column.register);
        let mut out: Vec<String> = self.columns.iter().map(register).collect();
        if !self.columns.is_empty() {
            out.push(format!("reg {}{} [0:{}];", range(self.width()), self.names.steps, self.rows.max(1) - 1));
        }
        if self.merged {
            out.push(format!("integer {};", self.names.next));
        }
        out
    }

    /// What comes before the first step.
    pub fn start(&self) -> Vec<String> {
        let Names { times, next, .. } = &self.names;
        match self.merged {
            true => vec![format!("{times} = {}'d0;", self.columns[0].width), format!("{next} = 0;")],
            false => Vec::new(),
        }
    }

    /// The statements that take the row of a step out, and leave it where it is if the next step has the same.
    pub fn read(&self, cycle: &str) -> Vec<String> {
        let registers: Vec<&str> = self.columns.iter().map(|column| column.register.as_str()).collect();
        let Names { times, next, steps, .. } = &self.names;
        let take = |row: &str| match registers[..] {
            [register] => format!("{register} = {steps}[{row}];"),
            _ => format!("{{{}}} = {steps}[{row}];", registers.join(", ")),
        };
        if self.columns.is_empty() {
            return Vec::new();
        }
        if !self.merged {
            return vec![take(cycle)];
        }
        let width = self.columns[0].width;
        vec![
            format!("if ({times} == {width}'d0) begin"),
            format!("    {}", take(next)),
            format!("    {next} = {next} + 1;"),
            "end".to_string(),
            format!("{times} = {times} - {width}'d1;"),
        ]
    }

    /// The calls that write all rows to the memory.
    pub fn calls(&self) -> Vec<String> {
        match self.columns.is_empty() {
            true => Vec::new(),
            false => (0..self.rows).step_by(self.at_once()).flat_map(|first| self.call(first)).collect(),
        }
    }

    /// The task that writes the rows of a constant to the memory. Its own names are in `inside`.
    pub fn task(&self, inside: &Inside) -> Vec<String> {
        if self.columns.is_empty() {
            return Vec::new();
        }
        let (Names { steps, put, .. }, Inside { first, count, rows, row }) = (&self.names, inside);
        let width = self.width();
        vec![
            String::new(),
            "// The first row is the most significant. Above it is a 1.".to_string(),
            format!("task {put};"),
            format!("    input integer {first};"),
            format!("    input integer {count};"),
            format!("    input {}{rows};", range(width * self.at_once() as u32 + 1)),
            format!("    integer {row};"),
            "begin".to_string(),
            format!("    for ({row} = 0; {row} < {count}; {row} = {row} + 1)"),
            format!("        {steps}[{first} + {row}] = {rows}[{width} * ({count} - 1 - {row}) +: {width}];"),
            "end".to_string(),
            "endtask".to_string(),
        ]
    }

    /// The call that writes the rows from `first` on. The 1 on top is for Verilator 5.006, which writes past the end of
    /// a wide constant whose first word is 0.
    fn call(&self, first: usize) -> Vec<String> {
        let last = self.rows.min(first + self.at_once());
        let mut out = vec![format!("    {}({first}, {}, {{ 1'b1,", self.names.put, last - first)];
        let missing = self.at_once() - (last - first);
        if missing > 0 {
            out.push(format!("        {},", pattern(&Bits::zero(missing as u32 * self.width()))));
        }
        // Short rows stand side by side where they are many.
        let mut line = String::new();
        for step in first..last {
            let values: Vec<String> = self.columns.iter().map(|column| pattern(&column.values[step])).collect();
            let (row, comma) = (values.join(", "), if step + 1 < last { "," } else { "" });
            if !line.is_empty() && (self.rows <= MOST_LINES || line.len() + row.len() > LINE) {
                out.push(std::mem::take(&mut line));
            }
            line += if line.is_empty() { "        " } else { " " };
            line += &format!("{row}{comma}");
        }
        out.extend([line, "    });".to_string()]);
        out
    }
}

/// The names inside of each table's task.
pub struct Inside {
    first: String,
    count: String,
    rows: String,
    row: String,
}

impl Inside {
    /// Names that nothing else has.
    pub fn new(names: &mut verilog::Names) -> Inside {
        let [first, count, rows, row] = ["first", "count", "rows", "row"].map(|name| names.fresh(name));
        Inside { first, count, rows, row }
    }
}

/// A column of numbers, as wide as the greatest needs.
pub fn numbers(register: String, numbers: &[u64]) -> Column {
    let greatest = numbers.iter().copied().max().unwrap_or(0);
    let width = width_below(u128::from(greatest) + 1);
    Column { register, width, values: numbers.iter().map(|number| Bits::new(width, *number)).collect() }
}
