//! What a waveform file shows, and of which part of a run.
//!
//! Scopes and names are those of the Verilog: the top module, its instances, and for an array the scopes `u_cell[3]`
//! with the instance `lane` in each. A module's own lanes are `NAME[3]`, or `NAME[1][2]` in a grid. A state machine's
//! register has a `string` twin, `NAME_state`. Times are those of the clocks, in picoseconds; values that a testbench
//! sets after an edge appear from that edge on.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::words::MOST_WORDS;

/// The contents of a waveform file, from [`Vcd::to`] or [`Fst::to`]. Attach it with
/// [`Simulation::trace`](crate::Simulation::trace).
///
/// ```
/// # use tilewright_sim::{Simulation, Vcd, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// # let folder = tempfile::tempdir().unwrap();
/// # let path = folder.path().join("counter.vcd");
/// sim.trace(Vcd::to(&path).only("count").cycles("clk", 100..110))?;
/// sim.set(sim.i.enable, 1);
/// sim.run(150);
/// sim.finish()?;
/// let text = std::fs::read_to_string(&path).unwrap();
/// assert!(text.contains("#1000000") && !text.contains("#1200000"));
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Trace {
    pub(crate) format: Format,
    pub(crate) path: PathBuf,
    /// A file that is open already.
    pub(crate) file: Option<Arc<File>>,
    pub(crate) patterns: Vec<String>,
    /// Patterns of memories, each with addresses.
    pub(crate) words: Vec<(String, std::ops::Range<u32>)>,
    pub(crate) window: Option<Window>,
    pub(crate) last: Option<usize>,
}

/// The format of a waveform file.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Format {
    Vcd,
    Fst,
}

/// The part of a run that is written.
#[derive(Debug, Clone)]
pub(crate) enum Window {
    Time(std::ops::Range<u64>),
    Cycles(String, std::ops::Range<u64>),
}

/// A waveform file in the Value Change Dump format: text that every viewer reads.
///
/// ```no_run
/// # use tilewright_sim::{Simulation, Vcd, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// sim.trace(Vcd::to("counter.vcd").only("count").cycles("clk", 100..200))?;
/// sim.run(1000);
/// sim.finish()?;
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug)]
pub enum Vcd {}

/// A waveform file in the Fast Signal Trace format of GTKWave: the same signals, values and times as in a VCD file, in
/// a fraction of the size.
///
/// ```no_run
/// # use tilewright_sim::{Fst, Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// sim.trace(Fst::to("counter.fst"))?;
/// sim.run(1_000_000);
/// sim.finish()?;
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug)]
pub enum Fst {}

impl Vcd {
    /// Everything, for the whole run, into this file.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, Vcd, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// # let folder = tempfile::tempdir().unwrap();
    /// # let path = folder.path().join("counter.vcd");
    /// sim.trace(Vcd::to(&path))?;
    /// sim.step();
    /// sim.finish()?;
    /// assert!(std::fs::read_to_string(&path).unwrap().contains("late")); // includes registers inside
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn to(path: impl AsRef<Path>) -> Trace {
        Trace::to(Format::Vcd, path.as_ref(), None)
    }

    /// Like [`Vcd::to`], for a file that is open for writing, from its present position. Errors call it by this name.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, Vcd, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// # let folder = tempfile::tempdir().unwrap();
    /// # let path = folder.path().join("counter.vcd");
    /// # let file = std::fs::File::create(&path).unwrap();
    /// sim.trace(Vcd::into("the counter's waves", file))?;
    /// sim.step();
    /// sim.finish()?;
    /// assert!(std::fs::metadata(&path).unwrap().len() > 0);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn into(name: impl AsRef<Path>, file: File) -> Trace {
        Trace::to(Format::Vcd, name.as_ref(), Some(file))
    }
}

impl Fst {
    /// Everything, for the whole run, into this file.
    ///
    /// ```
    /// # use tilewright_sim::{Fst, Simulation, Vcd, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// # let folder = tempfile::tempdir().unwrap();
    /// # let path = folder.path().join("counter.fst");
    /// # let other = folder.path().join("counter.vcd");
    /// sim.trace(Fst::to(&path))?;
    /// sim.trace(Vcd::to(&other))?; // the same again, as text
    /// for clock in 0..10_000 {
    ///     sim.set(sim.i.enable, clock % 64 == 0);
    ///     sim.step();
    /// }
    /// sim.finish()?;
    /// let bytes = |path| std::fs::metadata(path).unwrap().len();
    /// assert!(bytes(&other) > 5 * bytes(&path));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn to(path: impl AsRef<Path>) -> Trace {
        Trace::to(Format::Fst, path.as_ref(), None)
    }

    /// Like [`Fst::to`], for a file that is open for writing, but not for appending. Errors call it by this name. A pipe
    /// gets all of it when the run ends, because the header has the time of the end.
    ///
    /// ```
    /// # use tilewright_sim::{Fst, Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// # let folder = tempfile::tempdir().unwrap();
    /// # let path = folder.path().join("counter.fst");
    /// let file = std::fs::File::create(&path).unwrap();
    /// sim.trace(Fst::into("the counter's waves", file))?;
    /// sim.step();
    /// sim.finish()?;
    /// assert!(std::fs::metadata(&path).unwrap().len() > 0);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn into(name: impl AsRef<Path>, file: File) -> Trace {
        Trace::to(Format::Fst, name.as_ref(), Some(file))
    }
}

impl Trace {
    /// The most words of memories in a file.
    ///
    /// ```
    /// assert_eq!(tilewright_sim::Trace::MOST_WORDS, 4096);
    /// ```
    pub const MOST_WORDS: u64 = MOST_WORDS;

    fn to(format: Format, path: &Path, file: Option<File>) -> Trace {
        let (path, file) = (path.to_path_buf(), file.map(Arc::new));
        Trace { format, path, file, patterns: Vec::new(), words: Vec::new(), window: None, last: None }
    }

    /// Only the signals whose hierarchical name matches this pattern, or another given one. `*` stands for any
    /// characters but a dot, `**` for any characters, as in `u_cell[*].value` or `u_cell[3].**`.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, Vcd, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let vcd = Vcd::to("counter.vcd").only("c*").only("square");
    /// let header = String::from_utf8(sim.trace_header(&vcd)?).unwrap();
    /// assert!(header.contains(" count ") && header.contains(" square ") && !header.contains(" late "));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn only(mut self, pattern: &str) -> Trace {
        self.patterns.push(pattern.to_string());
        self
    }

    /// Also the words at these addresses of memories whose hierarchical name matches this pattern. Addresses beyond the
    /// last one are left out. A word has the name that `why` takes, such as `squares[5]`. A file has at most 4096 words.
    /// Without this method it has none, and pays nothing for them.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, Vcd, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// # let folder = tempfile::tempdir().unwrap();
    /// # let path = folder.path().join("counter.vcd");
    /// let vcd = Vcd::to(&path).only("count").words("squares", 4..6);
    /// let header = String::from_utf8(sim.trace_header(&vcd)?).unwrap();
    /// assert!(header.contains(" squares[4] [7:0] ") && header.contains(" squares[5] [7:0] "));
    /// sim.trace(vcd)?;
    /// sim.step();
    /// sim.finish()?;
    /// assert!(std::fs::read_to_string(&path).unwrap().contains("b11001 ")); // 25
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn words(mut self, pattern: &str, addresses: std::ops::Range<u32>) -> Trace {
        self.words.push((pattern.to_string(), addresses));
        self
    }

    /// Only the changes in this range of picoseconds; the file begins with the values at its start. Before and after it
    /// a run is as fast as without a waveform.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, Vcd, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// # let folder = tempfile::tempdir().unwrap();
    /// # let path = folder.path().join("counter.vcd");
    /// sim.trace(Vcd::to(&path).only("count").times(30_000..50_000))?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(10);
    /// sim.finish()?;
    /// let text = std::fs::read_to_string(&path).unwrap();
    /// assert!(text.contains("#40000") && !text.contains("#60000"));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn times(mut self, picoseconds: std::ops::Range<u64>) -> Trace {
        self.window = Some(Window::Time(picoseconds));
        self
    }

    /// Only the changes in these cycles of a clock, the first being 0.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, Vcd, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// # let folder = tempfile::tempdir().unwrap();
    /// # let path = folder.path().join("counter.vcd");
    /// sim.trace(Vcd::to(&path).only("count").cycles("clk", 3..5))?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(10);
    /// sim.finish()?;
    /// let text = std::fs::read_to_string(&path).unwrap();
    /// assert!(text.contains("#40000") && !text.contains("#60000"));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn cycles(mut self, clock: impl AsRef<str>, cycles: std::ops::Range<u64>) -> Trace {
        self.window = Some(Window::Cycles(clock.as_ref().to_string(), cycles));
        self
    }

    /// A flight recorder: keeps the last `n` instants in memory, and writes the file only if an assertion fails.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, Vcd, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// # let folder = tempfile::tempdir().unwrap();
    /// # let path = folder.path().join("counter.vcd");
    /// sim.trace(Vcd::to(&path).only("count").last(20))?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(150);
    /// assert!(!path.exists());
    /// assert!(sim.try_run(100).is_err()); // now it is written: the last 20 instants before the failure
    /// assert!(std::fs::read_to_string(&path).unwrap().contains("#2000000"));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn last(mut self, n: usize) -> Trace {
        self.last = Some(n.max(1));
        self
    }
}
