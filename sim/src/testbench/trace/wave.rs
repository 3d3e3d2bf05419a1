//! Text waves, for tests and terminals.
//!
//! A column is the time from one instant to the next and shows the values in that time; its last character is the
//! edge at its end. A bus shows its value where it changes: in hexadecimal, in decimal if it is signed, in the chosen
//! radix, or as the name of its code.
//!
//! ```text
//! clk    |___/~\_/~\_/~\_/
//! enable |___/~~~~~~~\____
//! count  | 0     | 1 | 2 |
//! ```

mod lines;
mod svg;

use std::fmt;
use std::ops::Range;
use std::sync::{Arc, Mutex, MutexGuard};

use tilewright_circuit::Bits;
use tilewright_circuit::ir::Kind;

use super::radix::{WaveRadix, text};
use super::{Observer, View};
use crate::engine::Engine;
use crate::engine::program::{Program, ValueId};
use crate::testbench::error::{Error, UnknownName};

pub use lines::{WaveLine, WaveLines};

/// The narrowest column, which still shows a clock, and the widest.
const COLUMN: std::ops::RangeInclusive<usize> = 4..=16;
/// The longest line; a longer wave continues in another block of lines.
const LINE: usize = 110;

/// A wave that a simulation draws while it runs; [`to_string`](ToString::to_string) shows it at any time.
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// let wave = sim.record([sim.i.enable, sim.o.square]);
/// sim.set(sim.i.enable, 1);
/// sim.run(5);
/// println!("{wave}");
/// wave.expect(r"
///     clk    |____/~~\_/~~\_/~~\_/~~\_/
///     enable |~~~~~~~~~~~~~~~~~~~~~~~~~
///     square | 0  | 1  | 4  | 9  | 10 |"); // numbers are hexadecimal
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Wave {
    data: Arc<Mutex<Data>>,
}

#[derive(Debug)]
struct Data {
    clocks: Vec<ClockLine>,
    rows: Vec<Row>,
    /// The start and end of every column, in picoseconds.
    columns: Vec<(u64, u64)>,
    /// The shown range of time, in picoseconds.
    times: Range<u64>,
    is_over: bool,
}

/// A clock's line.
#[derive(Debug)]
pub(crate) struct ClockLine {
    pub name: String,
    pub period: u64,
    /// Its edges are where it falls.
    pub falls: bool,
}

#[derive(Debug)]
struct Row {
    source: Source,
    values: Vec<Bits>,
    /// The chosen radix, if any.
    radix: Option<WaveRadix>,
}

/// The source of a row.
#[derive(Debug, Clone)]
pub(crate) struct Source {
    pub name: String,
    /// The name with records and their fields apart, such as `request.valid`.
    pub path: String,
    pub value: ValueId,
    pub lane: u32,
    pub kind: Kind,
}

impl Wave {
    pub(crate) fn new(clocks: Vec<ClockLine>, sources: Vec<Source>) -> Wave {
        let rows = sources.into_iter().map(|source| Row { source, values: Vec::new(), radix: None }).collect();
        let data = Data { clocks, rows, columns: Vec::new(), times: 0..u64::MAX, is_over: false };
        Wave { data: Arc::new(Mutex::new(data)) }
    }

    /// The values that its rows show.
    pub(crate) fn values(&self) -> Vec<ValueId> {
        self.data().rows.iter().map(|row| row.source.value).collect()
    }

    fn data(&self) -> MutexGuard<'_, Data> {
        self.data.lock().expect("no panic while drawing")
    }

    /// Shows the numbers of a port or net, given by the name of its row, in this radix. If it has lanes, all of them
    /// are shown so. A code keeps its name, and a signed number its sign.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, WaveRadix, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let wave = sim.record([sim.o.count, sim.o.square]).radix("square", WaveRadix::Decimal).cycles("clk", 9..12);
    /// sim.set(sim.i.enable, 1);
    /// sim.run(12);
    /// wave.expect(r"
    ///     clk    |~~\__/~~\__/~~\__/
    ///     count  | 9   | a   | b   |
    ///     square | 81  | 100 | 121 |");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// The wave has no such row.
    #[track_caller]
    pub fn radix(self, row: impl AsRef<str>, radix: WaveRadix) -> Wave {
        let (name, mut data) = (row.as_ref(), self.data());
        let is_it = |row: &str| row.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with('['));
        let mut found = false;
        for row in data.rows.iter_mut().filter(|row| is_it(&row.source.name)) {
            (row.radix, found) = (Some(radix), true);
        }
        let names: Vec<String> = data.rows.iter().map(|row| row.source.name.clone()).collect();
        drop(data);
        assert!(found, "{}", UnknownName::new("row", name, &names));
        self
    }

    /// Shows all numbers in this radix, as [`radix`](Wave::radix) does for a row.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, WaveRadix, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let wave = sim.record([sim.o.count, sim.o.square]).radix_of_all(WaveRadix::Binary);
    /// sim.set(sim.i.enable, 1);
    /// sim.run(3);
    /// wave.expect(r"
    ///     clk    |_____/~~\__/~~\__/
    ///     count  | 0   | 1   | 10  |
    ///     square | 0   | 1   | 100 |");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn radix_of_all(self, radix: WaveRadix) -> Wave {
        self.data().rows.iter_mut().for_each(|row| row.radix = Some(radix));
        self
    }

    /// Shows all numbers in decimal; [`radix`](Wave::radix) does so for one row.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let wave = sim.record([sim.o.square]).decimal();
    /// sim.set(sim.i.enable, 1);
    /// sim.run(5);
    /// wave.expect(r"
    ///     clk    |____/~~\_/~~\_/~~\_/~~\_/
    ///     square | 0  | 1  | 4  | 9  | 16 |");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn decimal(self) -> Wave {
        self.radix_of_all(WaveRadix::Decimal)
    }

    /// Draws only this range of picoseconds: all columns that overlap it.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let wave = sim.record([sim.o.count]).times(30_000..50_000);
    /// sim.set(sim.i.enable, 1);
    /// sim.run(10);
    /// wave.expect(r"
    ///     clk   |~\_/~\_/
    ///     count | 3 | 4 |");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn times(self, picoseconds: Range<u64>) -> Wave {
        self.data().times = picoseconds;
        self
    }

    /// Draws only these cycles of a clock, the first being 0.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let wave = sim.record([sim.o.count]).cycles("clk", 3..5);
    /// sim.set(sim.i.enable, 1);
    /// sim.run(10);
    /// wave.expect(r"
    ///     clk   |~\_/~\_/
    ///     count | 3 | 4 |");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// There is no such clock.
    #[track_caller]
    pub fn cycles(self, clock: impl AsRef<str>, cycles: Range<u64>) -> Wave {
        let (clock, data) = (clock.as_ref(), self.data());
        let is_it = |port: &str| port == clock || port.strip_suffix("_clk") == Some(clock);
        let period = data.clocks.iter().find(|clock| is_it(&clock.name)).map(|clock| clock.period);
        let names: Vec<String> = data.clocks.iter().map(|clock| clock.name.clone()).collect();
        drop(data);
        match period {
            Some(period) => self.times(cycles.start.saturating_mul(period)..cycles.end.saturating_mul(period)),
            None => panic!("{}", UnknownName::new("clock", clock, &names)),
        }
    }

    /// Adds a row of values from elsewhere behind the row of that name: one value a column, in the same radix.
    ///
    /// ```
    /// # use tilewright_hdl::Bits;
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let wave = sim.record([sim.o.count]);
    /// sim.set(sim.i.enable, 1);
    /// sim.run(3);
    /// let wave = wave.beside("count", "count by hand", [0, 1, 1].map(|count| Bits::new(8, count)));
    /// wave.expect(r"
    ///     clk           |___/~\_/~\_/
    ///     count         | 0 | 1 | 2 |
    ///     count by hand | 0 | 1     |");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// The wave has no such row, or another number of columns.
    #[track_caller]
    pub fn beside(self, row: impl AsRef<str>, name: impl Into<String>, values: impl IntoIterator<Item = Bits>) -> Wave {
        let (row, values) = (row.as_ref(), values.into_iter().collect::<Vec<Bits>>());
        let mut data = self.data();
        let Some(at) = data.rows.iter().position(|it| it.source.name == row) else {
            let names: Vec<String> = data.rows.iter().map(|row| row.source.name.clone()).collect();
            drop(data);
            panic!("{}", UnknownName::new("row", row, &names));
        };
        let columns = data.columns.len();
        assert!(values.len() == columns, "there are {} values for {columns} columns", values.len());
        let source = Source { name: name.into(), ..data.rows[at].source.clone() };
        let radix = data.rows[at].radix;
        data.rows.insert(at + 1, Row { source, values, radix });
        drop(data);
        self
    }

    /// Stops drawing, and keeps what was drawn so far.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let wave = sim.record([sim.o.count]);
    /// sim.set(sim.i.enable, 1);
    /// sim.run(2);
    /// wave.stop();
    /// sim.run(100);
    /// wave.expect(r"
    ///     clk   |___/~\_/
    ///     count | 0 | 1 |");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn stop(&self) {
        self.data().is_over = true;
    }

    /// Panics unless the wave is `expected`; common indentation and surrounding blank lines are ignored. The message
    /// shows both.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let wave = sim.record([sim.o.count]);
    /// sim.run(2);
    /// wave.expect(r"
    ///     clk   |___/~\_/
    ///     count | 0     |");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    #[track_caller]
    pub fn expect(&self, expected: &str) {
        let (expected, actual) = (unindent(expected), unindent(&self.to_string()));
        assert!(expected == actual, "the wave differs.\nexpected:\n{expected}\nactual:\n{actual}");
    }
}

/// Without common indentation, trailing blanks and surrounding blank lines.
fn unindent(text: &str) -> String {
    let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
    let indent = lines.iter().filter(|line| !line.is_empty()).map(|line| line.len() - line.trim_start().len()).min();
    let lines = lines.iter().map(|line| line.get(indent.unwrap_or(0)..).unwrap_or(""));
    lines.collect::<Vec<_>>().join("\n").trim_matches('\n').to_string()
}

/// Fills a wave.
pub(crate) struct Draw(pub Wave);

impl Observer for Draw {
    fn sample(&mut self, view: &mut View) -> Result<(), Error> {
        let mut data = self.0.data();
        data.is_over |= view.since >= data.times.end;
        if data.is_over || view.until <= data.times.start {
            return Ok(());
        }
        data.sample(view.program, &mut **view.engine, view.since, view.until);
        Ok(())
    }

    fn is_over(&self) -> bool {
        self.0.data().is_over
    }
}

impl fmt::Display for Wave {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let data = self.data();
        let names = data.clocks.iter().map(|clock| &clock.name).chain(data.rows.iter().map(|row| &row.source.name));
        let label = names.clone().map(|name| name.len()).max().unwrap_or(0);
        let column = data.column_width();
        let per_block = (LINE.saturating_sub(label + 2) / column).max(1);
        for start in (0..data.columns.len()).step_by(per_block) {
            let range = start..(start + per_block).min(data.columns.len());
            if start > 0 {
                writeln!(f)?;
            }
            for clock in &data.clocks {
                writeln!(f, "{:label$} |{}", clock.name, clock.line(&data.columns[range.clone()], column))?;
            }
            for row in &data.rows {
                let line = row.line(range.clone(), column);
                writeln!(f, "{:label$} |{}", row.source.name, line.trim_end())?;
            }
        }
        Ok(())
    }
}

impl Data {
    /// Adds a column with the present values.
    fn sample(&mut self, program: &Program, engine: &mut dyn Engine, since: u64, until: u64) {
        self.columns.push((since, until));
        // Lanes of one value are adjacent, and are read once.
        for rows in self.rows.chunk_by_mut(|a, b| a.source.value == b.source.value) {
            let value = program.value(rows[0].source.value);
            let lanes = engine.read(rows[0].source.value);
            for row in rows {
                let start = row.source.lane as usize * value.limbs();
                row.values.push(Bits::from_limbs(value.width, &lanes[start..start + value.limbs()]));
            }
        }
    }

    /// The narrowest width at which every value can be read. A row with a chosen radix may need more than twice as
    /// many digits.
    fn column_width(&self) -> usize {
        let buses = self.rows.iter().filter(|row| !row.is_bit());
        let needed = buses.flat_map(|row| {
            let widest = if row.radix.is_some() { LINE / 2 } else { *COLUMN.end() };
            let runs = row.runs(0..row.values.len()).into_iter();
            runs.map(move |(text, columns)| (text.len() + 3).div_ceil(columns).min(widest))
        });
        needed.max().unwrap_or(0).max(*COLUMN.start())
    }
}

impl Row {
    fn is_bit(&self) -> bool {
        self.source.kind == Kind::Number && self.values.first().is_some_and(|value| value.width() == 1)
    }

    fn text(&self, value: &Bits) -> String {
        text(value, self.source.kind, self.radix)
    }

    /// The values of some columns, each with the number of columns that it lasts.
    fn runs(&self, columns: Range<usize>) -> Vec<(String, usize)> {
        self.values[columns].chunk_by(|a, b| a == b).map(|run| (self.text(&run[0]), run.len())).collect()
    }

    fn line(&self, columns: Range<usize>, column: usize) -> String {
        match self.is_bit() {
            true => self.levels(columns, column),
            false => self.runs(columns).into_iter().map(|(text, count)| cell(&text, count * column)).collect(),
        }
    }

    fn levels(&self, columns: Range<usize>, column: usize) -> String {
        let high: Vec<bool> = self.values[columns].iter().map(|value| value.bit(0)).collect();
        let level = |high| if high { '~' } else { '_' };
        let mut line = String::new();
        for (i, &now) in high.iter().enumerate() {
            line.extend(std::iter::repeat_n(level(now), column - 1));
            line.push(match high.get(i + 1) {
                Some(true) if !now => '/',
                Some(false) if now => '\\',
                _ => level(now),
            });
        }
        line
    }
}

/// A bus value in `width` characters, the last of which is the border. A value that is too long ends in dots, or is
/// dots only.
fn cell(text: &str, width: usize) -> String {
    let room = width - 3;
    let dots = room.min(2);
    let text = if text.len() > room { format!("{}{}", &text[..room - dots], &".."[..dots]) } else { text.to_string() };
    format!(" {text:room$} |")
}

impl ClockLine {
    /// Its line in characters.
    fn line(&self, columns: &[(u64, u64)], width: usize) -> String {
        let line = rising(self.period, columns, width);
        if !self.falls {
            return line;
        }
        let inverted = |c| match c {
            '~' => '_',
            '_' => '~',
            '/' => '\\',
            _ => '/',
        };
        line.chars().map(inverted).collect()
    }
}

/// The line of a clock that rises at every multiple of its period and falls half a period later.
fn rising(period: u64, columns: &[(u64, u64)], width: usize) -> String {
    let is_high = |time: u64| time >= period && time % period < period / 2;
    let mut line = String::new();
    for &(since, until) in columns {
        let fall = since - since % period + period / 2;
        let body = width - 1;
        match is_high(since) {
            true if fall < until => {
                let high = (body - 1).div_ceil(2);
                line.extend(std::iter::repeat_n('~', high));
                line.push('\\');
                line.extend(std::iter::repeat_n('_', body - 1 - high));
            }
            true => line.extend(std::iter::repeat_n('~', body)),
            false => line.extend(std::iter::repeat_n('_', body)),
        }
        line.push(match (until % period == 0, is_high(since) && fall >= until) {
            (true, _) => '/',
            (false, true) if fall == until => '\\',
            (false, true) => '~',
            (false, false) => '_',
        });
    }
    line
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_value_without_room_is_dots() {
        let cells = [7, 6, 5, 4, 3].map(|width| super::cell("Overflow", width));
        assert_eq!(cells, [" Ov.. |", " O.. |", " .. |", " . |", "  |"]);
        assert_eq!(super::cell("9", 4), " 9 |");
    }
}
