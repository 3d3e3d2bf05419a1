//! The observers of a simulation, and how they are attached.

use tilewright_hdl::Bundle;

use crate::engine::program::Display;
use crate::testbench::error::Error;
use crate::testbench::lookup::{self, Found};
use crate::testbench::port::Port;
use crate::testbench::running::Running;
use crate::testbench::simulation::Simulation;
use crate::testbench::trace::{
    ClockLine, Draw, Dump, Format, FstFile, Messages, Recorder, Source, Start, Trace, VcdFile, Wave, Window, header,
    watched,
};

/// An item of a wave: a port, or anything with a name.
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// sim.set(sim.i.enable, 1);
/// let ports = sim.record([sim.o.count]); // by a port, ..
/// let inside = sim.record(["late"]); // .. or by the name of any object inside
/// sim.run(3);
/// ports.expect(r"
///     clk   |___/~\_/~\_/
///     count | 0 | 1 | 2 |");
/// inside.expect(r"
///     clk  |___/~\_/~\_/
///     late | 0     | 1 |");
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone)]
pub enum Probe {
    /// A port of the top module.
    Port(Port),
    /// A hierarchical name, or several: `u_table.entry_*`.
    Path(String),
}

impl From<Port> for Probe {
    fn from(port: Port) -> Probe {
        Probe::Port(port)
    }
}

impl From<&str> for Probe {
    fn from(path: &str) -> Probe {
        Probe::Path(path.to_string())
    }
}

impl<I: Bundle, O: Bundle> Simulation<I, O> {
    /// Writes a waveform file from now on; [`Simulation::finish`] ends it.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, Vcd, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// # let folder = tempfile::tempdir().unwrap();
    /// # let path = folder.path().join("counter.vcd");
    /// sim.trace(Vcd::to(&path).only("count"))?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(3);
    /// sim.finish()?;
    /// assert!(std::fs::read_to_string(&path).unwrap().contains(" count "));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The file cannot be created, a pattern matches nothing, there are too many words, or there is no such clock.
    pub fn trace(&mut self, trace: Trace) -> Result<(), Error> {
        self.circuit.trace(0, trace)
    }

    /// The scopes and variables of the file that [`Simulation::trace`] would write, as the header of a VCD file, from
    /// `$version` to `$enddefinitions`.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, Vcd, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let header = sim.trace_header(&Vcd::to("counter.vcd").only("late"))?;
    /// assert!(String::from_utf8(header).unwrap().contains(" late ")); // and no file is created
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// A pattern matches nothing, or there are too many words.
    pub fn trace_header(&self, trace: &Trace) -> Result<Vec<u8>, Error> {
        Ok(header(&self.circuit.program, 0, trace)?.text)
    }

    /// Records inputs and outputs at every instant from now on, and the start: the memory words that were poked before
    /// the first step, and what a seed has filled.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let recorder = sim.recording();
    /// sim.set(sim.i.enable, 1);
    /// sim.run(3);
    /// // Before each edge: the count, and its square.
    /// let steps = recorder.take().steps;
    /// assert_eq!(steps[2].outputs.iter().map(|value| value.to_u64().unwrap()).collect::<Vec<_>>(), [2, 4]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// Called after the first step: a replay could not start from the same state.
    #[track_caller]
    pub fn recording(&mut self) -> Recorder {
        self.circuit.recording(0)
    }

    /// Collects what the displays of the circuit show from now on.
    ///
    /// ```
    /// use tilewright_hdl::*;
    ///
    /// # let design = tilewright_sim::shown! { |m, i| in { x: bits(8) } out { late: bits(8) }
    /// m.display(i.x.ne(0), "got {} ({:x})", &[i.x.signed(), i.x]);
    /// #     ShownOut { late: m.pipe("late", i.x) }
    /// # };
    /// let mut sim = tilewright_sim::Simulation::from_design(&design)?;
    /// let messages = sim.messages();
    /// for x in [0, 7, 254] {
    ///     sim.set(sim.port("x")?, x);
    ///     sim.step();
    /// }
    /// assert_eq!(messages.lines(), ["got 7 (7)", "got -2 (fe)"]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn messages(&mut self) -> Messages {
        self.circuit.messages(0)
    }

    /// Draws a wave of these ports and signals, given as a [`Port`] or by name, from now on. In the last part of a
    /// name, `*` stands for any characters: `entry_*` matches each field of the record `entry`, or of a stream's
    /// payload. For a signal with lanes the wave shows all lanes, or with `cells[3]` a single one.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let wave = sim.record([sim.i.enable, sim.o.count]);
    /// sim.step();
    /// sim.set(sim.i.enable, 1);
    /// sim.run(2);
    /// wave.expect(r"
    ///     clk    |___/~\_/~\_/
    ///     enable |___/~~~~~~~~
    ///     count  | 0     | 1 |");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// There is no such name.
    #[track_caller]
    pub fn record(&mut self, what: impl IntoIterator<Item = impl Into<Probe>>) -> Wave {
        self.circuit.record(0, what)
    }
}

impl Running {
    /// Writes a waveform file of one run.
    pub fn trace(&mut self, run: u32, trace: Trace) -> Result<(), Error> {
        let header = header(&self.program, run, &trace)?;
        let window = match &trace.window {
            None => 0..u64::MAX,
            Some(Window::Time(times)) => times.clone(),
            Some(Window::Cycles(clock, cycles)) => {
                let period = self.program.clocks[self.clock(clock)?].period;
                cycles.start.saturating_mul(period)..cycles.end.saturating_mul(period)
            }
        };
        let values: Vec<_> = header.variables.iter().map(|variable| variable.value).collect();
        self.engine.watch(&values);
        if !header.words.is_empty() {
            self.engine.watch(&watched(&self.program, &header.words));
        }
        // Rows have no words.
        let rows = if header.words.is_empty() { self.engine.take_in_rows(&values) } else { None };
        let Trace { format, path, file, last, .. } = trace;
        let program = &self.program;
        match format {
            Format::Vcd => {
                let file = VcdFile::new(path, file, &header);
                self.observe_by(Box::new(Dump::new(file, program, header, window, rows, last)?));
            }
            Format::Fst => {
                let file = FstFile::new(path, file, &header);
                self.observe_by(Box::new(Dump::new(file, program, header, window, rows, last)?));
            }
        }
        Ok(())
    }

    /// Records one run.
    #[track_caller]
    pub fn recording(&mut self, run: u32) -> Recorder {
        assert!(self.timeline.time() == 0, "a recording starts before the first step");
        let recorder = Recorder::of(run, Start::of(self, run));
        self.recorded.push(run);
        self.observe_by(Box::new(recorder.clone()));
        recorder
    }

    /// Collects what the displays of one run show.
    pub fn messages(&mut self, run: u32) -> Messages {
        let displays = self.program.displays.iter();
        let values = |display: &Display| {
            display.values.iter().map(|(value, _)| *value).chain([display.condition]).collect::<Vec<_>>()
        };
        let values: Vec<_> = displays.flat_map(values).collect();
        let messages = Messages::of(run);
        if !values.is_empty() {
            self.engine.watch(&values);
            self.observe_by(Box::new(messages.clone()));
        }
        messages
    }

    /// Draws a wave of one run.
    #[track_caller]
    pub fn record(&mut self, run: u32, what: impl IntoIterator<Item = impl Into<Probe>>) -> Wave {
        let wave = self.blank_wave(run, what);
        self.engine.watch(&wave.values());
        self.observe_by(Box::new(Draw(wave.clone())));
        wave
    }

    /// A wave of one run without columns.
    #[track_caller]
    pub fn blank_wave(&mut self, run: u32, what: impl IntoIterator<Item = impl Into<Probe>>) -> Wave {
        let mut sources = Vec::new();
        for probe in what {
            sources.extend(self.sources(run, probe.into()));
        }
        let clocks = self.program.clocks.iter().map(|clock| {
            let (name, period, falls) = (clock.port.clone(), clock.period, clock.falls);
            ClockLine { name, period, falls }
        });
        Wave::new(clocks.collect(), sources)
    }

    /// Of a port its path in the bundle, with the lane of its name; of anything else the name.
    fn path_of(&self, name: &str) -> String {
        let (base, lane) = name.split_at(name.find('[').unwrap_or(name.len()));
        let mut ports = self.program.inputs.iter().chain(&self.program.outputs);
        ports.find(|port| port.name == base).map_or_else(|| name.to_owned(), |port| format!("{}{lane}", port.path))
    }

    #[track_caller]
    fn sources(&self, run: u32, probe: Probe) -> Vec<Source> {
        let name = match probe {
            Probe::Port(port) => self.declared(port).name.clone(),
            Probe::Path(path) => path,
        };
        let hierarchy = &self.program.hierarchy;
        let found = match name.contains('*') {
            true => lookup::signals(hierarchy, &name, run),
            false => match lookup::signal(hierarchy, &name, run) {
                Ok(found) => Ok(vec![(name, found)]),
                Err(unknown) => lookup::signals(hierarchy, &name, run).map_err(|_| unknown),
            },
        };
        let source = |(name, Found { signal, lane }): (String, Found)| {
            let path = self.path_of(&name);
            Source { value: signal.value, lane, kind: signal.kind, name, path }
        };
        match found {
            Ok(found) => found.into_iter().map(source).collect(),
            Err(unknown) => panic!("{unknown}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::Vcd;
    use tilewright_hdl::{Module, bits, block, def};

    use super::*;

    block! {
        /// A register.
        struct Delay;
        in In { x: bits(8) }
        out Out { y: _ }
    }

    impl Delay {
        fn build(&self, m: Module, i: In) -> Out {
            def!(y = m.reg(8).reset(0));
            y.next(i.x);
            Out { y: *y }
        }
    }

    #[test]
    fn a_header_is_what_the_file_begins_with_and_needs_no_file() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("delay.vcd");
        for vcd in [Vcd::to(&file), Vcd::to(&file).only("y").times(0..5_000)] {
            let mut sim = Simulation::of(&Delay).unwrap();
            let header = String::from_utf8(sim.trace_header(&vcd).unwrap()).unwrap();
            assert!(!file.exists());
            assert!(header.starts_with("$version\n") && header.ends_with("$enddefinitions $end\n"), "{header}");
            assert_eq!(header.contains(" x [7:0] "), vcd.patterns.is_empty(), "{header}");
            sim.trace(vcd).unwrap();
            sim.step();
            sim.finish().unwrap();
            let text = std::fs::read_to_string(&file).unwrap();
            assert_eq!(text.split_once("#0\n").unwrap().0, header);
            std::fs::remove_file(&file).unwrap();
        }
    }

    #[test]
    fn a_header_has_no_signal_for_a_pattern_that_matches_nothing() {
        let sim = Simulation::of(&Delay).unwrap();
        let error = sim.trace_header(&Vcd::to("delay.vcd").only("y").only("xx")).unwrap_err().to_string();
        assert_eq!(error, "there is no signal that matches `xx`: did you mean `x`?");
    }
}
