//! What a proof found.

use std::time::Duration;
use tilewright_hdl::ir::Directive;
use tilewright_hdl::{Loc, Recording};

/// What was found of each statement of a design.
///
/// ```
/// let nothing = tilewright_prove::Proof::default();
/// assert!(nothing.statements.is_empty());
/// ```
#[derive(Debug, Clone, Default)]
pub struct Proof {
    /// The assertions and covers, in the sequence of the modules, each as described.
    pub statements: Vec<Statement>,
    /// The clocks after which the assumptions allow no further one, if there are; what comes later is not searched.
    pub ends_after: Option<u32>,
    /// What was at work when the time was over, if that is why a statement is open.
    pub late: Option<Stage>,
}

/// A part of a proof, for which the time may be too short.
///
/// ```
/// use tilewright_prove::Stage;
/// assert_ne!(Stage::Conversion, Stage::Search);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Yosys reads Verilog, and makes formulas or gates of it. Nothing has been searched.
    Conversion,
    /// Clock after clock is searched for a run, and induction is tried.
    Search,
    /// ABC searches an invariant.
    Invariant,
}

/// An assertion or a cover, in all instances and lanes of its module.
///
/// ```
/// # use tilewright_prove::{Outcome, Statement};
/// # use tilewright_hdl::{Loc, ir::Directive};
/// # let statement = Statement {
/// #     directive: Directive::Assert, message: "it counts".to_owned(), module: "counter".to_owned(),
/// #     loc: Loc::caller(), outcome: Outcome::Proved { depth: Some(1), needs_periods: false }, time: std::time::Duration::ZERO,
/// # };
/// assert!(statement.outcome.is_settled() && !statement.fails());
/// ```
#[derive(Debug, Clone)]
pub struct Statement {
    /// An assertion or a cover.
    pub directive: Directive,
    /// Its message.
    pub message: String,
    /// The module.
    pub module: String,
    /// The place in the description.
    pub loc: Loc,
    /// What was found.
    pub outcome: Outcome,
    /// The time from the begin of the proof to this result.
    pub time: Duration,
}

impl Statement {
    /// Whether an assertion fails, or a cover is never reached.
    ///
    /// ```
    /// # use tilewright_prove::{Outcome, Statement};
    /// # use tilewright_hdl::{Loc, ir::Directive};
    /// # let statement = Statement {
    /// #     directive: Directive::Cover, message: "it is full".to_owned(), module: "queue".to_owned(),
    /// #     loc: Loc::caller(), outcome: Outcome::Proved { depth: Some(1), needs_periods: false }, time: std::time::Duration::ZERO,
    /// # };
    /// // It is proved of the cover that its event never happens.
    /// assert!(statement.fails());
    /// ```
    pub fn fails(&self) -> bool {
        let is_cover = self.directive == Directive::Cover;
        match self.outcome {
            Outcome::Fails(_) => !is_cover,
            Outcome::Proved { .. } => is_cover,
            Outcome::Holds { .. } => false,
        }
    }
}

/// What was found of an assertion, or of the negation of a cover's condition.
///
/// ```
/// use tilewright_prove::Outcome;
/// assert!(!Outcome::Holds { clocks: 20 }.is_settled());
/// ```
#[derive(Debug, Clone)]
pub enum Outcome {
    /// It holds for ever.
    Proved {
        /// The number of clocks of the induction, 0 if it is constant; `None` if an invariant was found instead.
        depth: Option<u32>,
        /// Whether it is proved for edges at the times of the clocks' periods alone. Otherwise it holds for all
        /// sequences of edges.
        needs_periods: bool,
    },
    /// It does not hold at the end of this run: the assertion fails, or the cover is reached.
    Fails(Run),
    /// It holds in this number of clocks from the start; no more is known.
    Holds {
        /// The number of clocks.
        clocks: u32,
    },
}

impl Outcome {
    /// Whether it is known for all time.
    ///
    /// ```
    /// assert!(tilewright_prove::Outcome::Proved { depth: Some(2), needs_periods: false }.is_settled());
    /// ```
    pub fn is_settled(&self) -> bool {
        !matches!(self, Outcome::Holds { .. })
    }
}

/// A run that the simulator has replayed.
///
/// ```
/// let run = tilewright_prove::Run { clock: 3, instance: "u_queue".to_owned(), recording: Default::default() };
/// assert!(run.recording.steps.is_empty());
/// ```
#[derive(Debug, Clone)]
pub struct Run {
    /// The clock at whose end it happens, from 0: the run has one more. With several clocks, it is an instant at which
    /// one or more of them have an edge.
    pub clock: u32,
    /// The instance's path below the top; the top module's name for the top itself.
    pub instance: String,
    /// The run, from time 0.
    pub recording: Recording,
}
