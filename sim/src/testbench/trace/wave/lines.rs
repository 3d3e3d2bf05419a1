//! Waves for a program that shows them in its own way: columns by hand, and lines of any length.

use std::ops::Range;

use tilewright_hdl::Bundle;

use super::Wave;
use crate::testbench::attach::Probe;
use crate::testbench::running::Running;
use crate::testbench::simulation::Simulation;

/// The lines of some columns of a [`Wave`].
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// let wave = sim.record([sim.o.count]);
/// sim.set(sim.i.enable, 1);
/// sim.run(3);
/// let lines = wave.lines(1..3);
/// assert_eq!(lines.column, 4); // characters
/// assert_eq!([&lines.lines[0].line, &lines.lines[1].line], ["~\\_/~\\_/", " 1 | 2 |"]);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WaveLines {
    /// The width of a column in characters. It is the same for all columns of the wave.
    pub column: usize,
    /// The clocks, then the rows.
    pub lines: Vec<WaveLine>,
}

/// A line of [`WaveLines`].
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// let wave = sim.record([sim.o.count]);
/// sim.set(sim.i.enable, 1);
/// sim.run(3);
/// let count = &wave.lines(0..3).lines[1];
/// assert_eq!((count.name.as_str(), &count.values[..]), ("count", &["0".to_owned(), "1".to_owned(), "2".to_owned()][..]));
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WaveLine {
    /// The name of the clock or the row.
    pub name: String,
    /// The characters, [`WaveLines::column`] for each column.
    pub line: String,
    /// The value in each column as text. A clock has none.
    pub values: Vec<String>,
}

impl Wave {
    /// The lines of some columns, the first column being 0. Unlike those of [`to_string`](ToString::to_string) they are
    /// not broken, however long they are.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let wave = sim.record([sim.o.count]);
    /// sim.run(1000);
    /// assert_eq!(wave.lines(0..1000).lines[1].line.len(), 4000);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// The wave has fewer columns.
    #[track_caller]
    pub fn lines(&self, columns: Range<usize>) -> WaveLines {
        let data = self.data();
        let column = data.column_width();
        let clocks = data.clocks.iter().map(|clock| WaveLine {
            name: clock.name.clone(),
            line: clock.line(&data.columns[columns.clone()], column),
            values: Vec::new(),
        });
        let rows = data.rows.iter().map(|row| WaveLine {
            name: row.source.name.clone(),
            line: row.line(columns.clone(), column),
            values: row.values[columns.clone()].iter().map(|value| row.text(value)).collect(),
        });
        WaveLines { column, lines: clocks.chain(rows).collect() }
    }
}

impl<I: Bundle, O: Bundle> Simulation<I, O> {
    /// A wave of these ports and signals as of [`Simulation::record`], but without columns. [`Simulation::add_column`]
    /// adds each by hand, so that the simulation may go back in between.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.remember(1 << 20);
    /// sim.set(sim.i.enable, 1);
    /// sim.run(100);
    /// let wave = sim.blank_wave(["count"]);
    /// for cycle in 9..12 {
    ///     sim.go_to_cycle("clk", cycle)?;
    ///     sim.add_column(&wave, sim.time() + 10_000);
    /// }
    /// wave.expect(r"
    ///     clk   |~\_/~\_/~\_/
    ///     count | 9 | a | b |");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// There is no such name.
    #[track_caller]
    pub fn blank_wave(&mut self, what: impl IntoIterator<Item = impl Into<Probe>>) -> Wave {
        self.circuit.blank_wave(0, what)
    }

    /// Adds a column with the present values to a [blank wave](Simulation::blank_wave) of this simulation. `until` is
    /// the next instant, in picoseconds.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let wave = sim.blank_wave([sim.o.count]);
    /// sim.add_column(&wave, 10_000);
    /// wave.expect(r"
    ///     clk   |___/
    ///     count | 0 |");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn add_column(&mut self, wave: &Wave, until: u64) {
        self.circuit.add_column(wave, until);
    }
}

impl Running {
    fn add_column(&mut self, wave: &Wave, until: u64) {
        let since = self.timeline.time();
        wave.data().sample(&self.program, &mut *self.engine, since, until);
    }
}
