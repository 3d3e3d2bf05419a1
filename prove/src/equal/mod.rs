//! Sequential equivalence of a design and of a module that somebody wrote by hand.

mod circuit;
mod complaint;
mod decide;
mod difference;
mod miter;
mod theirs;

use crate::prepare::prepare_for_equality;
use crate::process::temporary;
use crate::solver::{Halt, Patience};
use crate::{Error, Stage};
use circuit::{Circuit, State};
use decide::{Decided, decide};
pub use difference::{Difference, Value};
use std::path::PathBuf;
use std::time::{Duration, Instant};
use theirs::Theirs;
use tilewright_hdl::Design;

/// The clocks that are searched for a difference if nobody says otherwise.
const DEPTH: u32 = 50;
/// The seconds that a comparison may take if nobody says otherwise.
const SECONDS: u64 = 60;

/// A module written by hand, which is to do what a design does.
///
/// Ports are matched by name. If the design has a reset, a run begins with a clock in which it is active and all
/// inputs are zero. From then on, inputs have any value that the design's assumptions allow, and the reset may come
/// again. All outputs are compared in each clock in which the reset is not active. What starts without a value is zero
/// on both sides, as in the simulator; what the module computes from an `x` has any value.
///
/// ```
/// use tilewright_hdl::*;
/// use tilewright_prove::{Equivalence, Error, Verdict};
///
/// block! {
///     /// Counts to `limit - 1`.
///     struct Counter { limit: u64 }
///     in CounterIn { enable: bit() }
///     out(self) CounterOut { count: below(self.limit) }
/// }
///
/// impl Counter {
///     fn build(&self, m: Module, i: CounterIn) -> CounterOut {
///         def!(count = m.reg(below(self.limit)).reset(0));
///         count.when(i.enable & count.eq(self.limit - 1), 0).when(i.enable, count + 1);
///         CounterOut { count: *count }
///     }
/// }
///
/// let folder = tempfile::tempdir()?;
/// let file = folder.path().join("hand.v");
/// std::fs::write(&file, "
/// module hand #(parameter LIMIT = 3) (input clk, input rst, input enable, output reg [2:0] count);
///     always @(posedge clk)
///         if (rst) count <= 0;
///         else if (enable) count <= count == LIMIT ? 0 : count + 1;
/// endmodule
/// ")?;
/// let design = elaborate(&Counter { limit: 6 }).unwrap();
/// match Equivalence::to([&file]).parameter("LIMIT", 5).prove(&design) {
///     Ok(verdict) => assert!(matches!(verdict, Verdict::Equal)),
///     Err(Error::Missing(_)) => return Ok(()), // Yosys is not installed
///     Err(error) => panic!("{error}"),
/// }
/// let Ok(Verdict::Differs(run)) = Equivalence::to([&file]).prove(&design) else { panic!("it counts to 3") };
/// assert_eq!((run.clock, run.outputs[0].as_str()), (5, "count")); // 1 clock of reset, 4 in which it counts
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Equivalence {
    files: Vec<PathBuf>,
    module: Option<String>,
    parameters: Vec<(String, i64)>,
    begin: Vec<(String, u64)>,
    begin_clocks: u32,
    depth: u32,
    seconds: u64,
}

/// What was found of two modules.
///
/// ```
/// use tilewright_prove::{Stage, Verdict};
/// let open = Verdict::Open { clocks: 0, late: Some(Stage::Conversion) };
/// assert!(!matches!(open, Verdict::Equal | Verdict::Differs(_)));
/// ```
#[derive(Debug, Clone)]
pub enum Verdict {
    /// They are equal for ever.
    Equal,
    /// They differ at the end of this run.
    Differs(Box<Difference>),
    /// Neither is known.
    Open {
        /// They are equal in this number of clocks from the start.
        clocks: u32,
        /// What was at work when the time was over, if it was too short.
        late: Option<Stage>,
    },
}

impl Equivalence {
    /// The module in these files. It is the one that has the design's name, or else the one that no other contains.
    ///
    /// ```
    /// use tilewright_prove::Equivalence;
    /// let _hand = Equivalence::to(["hand.v", "parts.v"]);
    /// ```
    pub fn to<P: Into<PathBuf>>(files: impl IntoIterator<Item = P>) -> Equivalence {
        let files = files.into_iter().map(Into::into).collect();
        Equivalence {
            files,
            module: None,
            parameters: vec![],
            begin: vec![],
            begin_clocks: 1,
            depth: DEPTH,
            seconds: SECONDS,
        }
    }

    /// The module of that name.
    ///
    /// ```
    /// # use tilewright_prove::Equivalence;
    /// let _hand = Equivalence::to(["hand.v"]).module("fast_counter");
    /// ```
    pub fn module(self, name: impl Into<String>) -> Equivalence {
        Equivalence { module: Some(name.into()), ..self }
    }

    /// Gives a parameter of the module a value.
    ///
    /// ```
    /// # use tilewright_prove::Equivalence;
    /// let _hand = Equivalence::to(["hand.v"]).parameter("LIMIT", 6);
    /// ```
    pub fn parameter(mut self, name: impl Into<String>, value: i64) -> Equivalence {
        self.parameters.push((name.into(), value));
        self
    }

    /// Gives an input this value in the first clock, in which nothing is compared: for a reset that is a port like any
    /// other. The other inputs are zero in that clock.
    ///
    /// ```
    /// # use tilewright_prove::Equivalence;
    /// let _hand = Equivalence::to(["hand.v"]).begin("restart", 1);
    /// ```
    pub fn begin(mut self, input: impl Into<String>, value: u64) -> Equivalence {
        self.begin.push((input.into(), value));
        self
    }

    /// The number of clocks with which a run begins: those of the reset, and of [`begin`](Equivalence::begin). It is 1 if
    /// nobody says otherwise. A register behind one that is reset needs another clock.
    ///
    /// ```
    /// # use tilewright_prove::Equivalence;
    /// let _hand = Equivalence::to(["hand.v"]).begin_clocks(4);
    /// ```
    pub fn begin_clocks(self, clocks: u32) -> Equivalence {
        Equivalence { begin_clocks: clocks, ..self }
    }

    /// The number of clocks in which a difference is searched if there is no proof; 50 if nobody says otherwise.
    ///
    /// ```
    /// # use tilewright_prove::Equivalence;
    /// let _hand = Equivalence::to(["hand.v"]).depth(200);
    /// ```
    pub fn depth(self, depth: u32) -> Equivalence {
        Equivalence { depth, ..self }
    }

    /// The most seconds that it may take; 60 if nobody says otherwise.
    ///
    /// ```
    /// # use tilewright_prove::Equivalence;
    /// let _hand = Equivalence::to(["hand.v"]).seconds(5);
    /// ```
    pub fn seconds(self, seconds: u64) -> Equivalence {
        Equivalence { seconds, ..self }
    }

    /// Compares the module with a design.
    ///
    /// ```
    /// # use tilewright_prove::{Equivalence, Error};
    /// # let design = tilewright_sim::shown! { |m, i| in { x: tilewright_hdl::bits(4) } out { same: tilewright_hdl::bits(4) }
    /// #     ShownOut { same: i.x }
    /// # };
    /// let found = Equivalence::to(["no-such-file.v"]).prove(&design);
    /// assert!(matches!(found, Err(Error::Refused(_) | Error::Missing(_))));
    /// ```
    ///
    /// # Errors
    ///
    /// A program is missing or fails, the design is not one that can be proved, a file is no Verilog, or the ports
    /// differ.
    pub fn prove(&self, design: &Design) -> Result<Verdict, Error> {
        self.prove_watched(design, &|| false)
    }

    /// Like [`Equivalence::prove`], but asks `stop` many times a second whether to stop.
    ///
    /// ```
    /// # use tilewright_prove::{Equivalence, Error};
    /// # let design = tilewright_sim::shown! { |m, i| in { x: tilewright_hdl::bits(4) } out { same: tilewright_hdl::bits(4) }
    /// #     ShownOut { same: i.x }
    /// # };
    /// # let folder = tempfile::tempdir()?;
    /// # let file = folder.path().join("hand.v");
    /// # std::fs::write(&file, "module hand(input [3:0] x, output [3:0] same); assign same = x; endmodule")?;
    /// let stopped = Equivalence::to([&file]).prove_watched(&design, &|| true);
    /// assert!(matches!(stopped, Err(Error::Interrupted | Error::Missing(_))));
    /// # Ok::<(), std::io::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Equivalence::prove`]; [`Error::Interrupted`].
    pub fn prove_watched(&self, design: &Design, stop: &dyn Fn() -> bool) -> Result<Verdict, Error> {
        let prepared = prepare_for_equality(design)?;
        let begin = self.checked_begin(design)?;
        let patience = Patience { stop, end: Some(Instant::now() + Duration::from_secs(self.seconds)) };
        let folder = temporary()?;
        let found = Theirs::read(self, design, folder.path(), &patience).and_then(|theirs| {
            let both = Both::of(
                design,
                miter::circuit(&prepared, &begin, folder.path(), &patience)?,
                &begin,
                self.begin_clocks,
            );
            let decided = decide(&both.circuit, self.depth, folder.path(), &patience)?;
            Ok((theirs, both, decided))
        });
        match found {
            Ok((_, _, Decided::Equal)) => Ok(Verdict::Equal),
            Ok((_, _, Decided::Open { clocks, late })) => Ok(Verdict::Open { clocks, late }),
            Ok((theirs, both, Decided::Differs(inputs))) => {
                let run = Difference::of(&prepared.design, both, inputs, theirs.module)?;
                Ok(Verdict::Differs(Box::new(run)))
            }
            // ABC ends in time, so it was Yosys.
            Err(Halt::Late) => Ok(Verdict::Open { clocks: 0, late: Some(Stage::Conversion) }),
            Err(Halt::Failed(error)) => Err(error),
        }
    }

    /// The inputs with a value in the first clock.
    fn checked_begin(&self, design: &Design) -> Result<Vec<(String, u64)>, Error> {
        let top = design.top();
        for (name, value) in &self.begin {
            let refused = |why: String| Err(Error::Refused(why));
            let Some(port) = top.inputs.iter().find(|port| port.name == *name) else {
                let known: Vec<&str> = top.inputs.iter().map(|port| port.name.as_str()).collect();
                return refused(format!("{} has no input `{name}`: name one of {}", top.name, known.join(", ")));
            };
            let width = theirs::width(top, port.node);
            if width < 64 && value >> width != 0 {
                return refused(format!("{value} has no room in the {width} bits of `{name}`: give a smaller value"));
            }
        }
        Ok(self.begin.clone())
    }
}

/// Both modules, which start after the first clocks if there is something to do in them.
struct Both {
    circuit: Circuit,
    first: Vec<First>,
}

/// One of the first clocks.
struct First {
    inputs: Vec<bool>,
    state: State,
}

impl Both {
    fn of(design: &Design, mut circuit: Circuit, begin: &[(String, u64)], clocks: u32) -> Both {
        let clock = design.top().clocks.first();
        let reset = clock.and_then(|clock| Some((clock.reset.as_deref()?, u64::from(!clock.kind.is_active_low()))));
        let begin = begin.iter().map(|(name, value)| (name.as_str(), *value));
        let given: Vec<(&str, u64)> = reset.into_iter().chain(begin).collect();
        let mut first = Vec::new();
        if given.is_empty() || clock.is_none() {
            return Both { circuit, first };
        }
        let mut inputs = vec![false; circuit.inputs()];
        for (name, value) in given {
            circuit.port(name).iter().take(64).enumerate().for_each(|(bit, at)| inputs[*at] = value >> bit & 1 == 1);
        }
        for _ in 0..clocks {
            let state = circuit.state(None, &inputs);
            circuit = circuit.after(&state);
            first.push(First { inputs: inputs.clone(), state });
        }
        Both { circuit, first }
    }
}
