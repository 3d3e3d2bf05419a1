//! The transitions of a state machine: which one it takes at an edge.

use crate::codes::Codes;
use crate::machine::StateReg;
use crate::operand::Operand;
use crate::select::lit;
use crate::signal::Signal;

/// The transitions of a machine at the next edge, as signals that trigger actions. Made by [`StateReg::next`].
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// codes! { enum Step { Fetch, Execute } }
///
/// def!(step = m.fsm(Step::Fetch));
/// let moves = step.next(|step| match step {
///     Step::Fetch => goto(Step::Execute),
///     Step::Execute => goto(Step::Fetch),
/// });
/// def!(executed = m.reg(4).reset(0));
/// executed.when(moves.leaves(Step::Execute), executed + 1);
/// # });
/// assert_eq!(example.values("executed"), [0, 0, 1, 1, 2]);
/// ```
#[derive(Debug, Clone)]
pub struct Moves<S> {
    pub(crate) machine: StateReg<S>,
    /// The exits of each state, in the sequence of [`Codes::ALL`].
    pub(crate) exits: Vec<Exit<S>>,
}

#[derive(Debug, Clone)]
pub(crate) struct Exit<S> {
    pub arms: Vec<(Signal, S)>,
    pub last: S,
}

impl<S: Codes + Operand> Moves<S> {
    /// 1 bit: the machine is in `state` and goes to another one.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// codes! { enum Start { Waits, Runs } }
    ///
    /// def!(count = m.reg(4).reset(0));
    /// count.next(count + 1);
    /// def!(start = m.fsm(Start::Waits));
    /// let moves = start.next(|start| match start {
    ///     Start::Waits => when(count.eq(2), Start::Runs),
    ///     Start::Runs => hold(),
    /// });
    /// def!(begins = moves.leaves(Start::Waits));
    /// # });
    /// assert_eq!(example.values("begins"), [0, 0, 1, 0, 0]); // in the clock before it runs
    /// ```
    #[track_caller]
    pub fn leaves(&self, state: S) -> Signal {
        self.from(state, |to| to.code() != state.code()).unwrap_or_else(|| lit(1, 0))
    }

    /// 1 bit: the machine is in another state and goes to `state`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// codes! { enum Light { Red, Green, Amber } }
    ///
    /// def!(light = m.fsm(Light::Red));
    /// let moves = light.next(|light| match light {
    ///     Light::Red => goto(Light::Green),
    ///     Light::Green => goto(Light::Amber),
    ///     Light::Amber => goto(Light::Red),
    /// });
    /// def!(stops = moves.enters(Light::Red));
    /// # });
    /// assert_eq!(example.values("stops"), [0, 0, 1, 0, 0, 1]);
    /// ```
    #[track_caller]
    pub fn enters(&self, state: S) -> Signal {
        let mut enters = None;
        // A loop: in a closure, the message would name the closure as the caller.
        for &other in S::ALL.iter().filter(|other| other.code() != state.code()) {
            let goes = self.from(other, |to| to.code() == state.code());
            enters = match (enters, goes) {
                (Some(enters), Some(goes)) => Some(enters | goes),
                (one, other) => one.or(other),
            };
        }
        enters.unwrap_or_else(|| lit(1, 0))
    }

    /// 1 bit: the machine is in `state` and goes to `to`, which may be the same state.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// codes! { enum Run { Runs, Halted } }
    ///
    /// def!(run = m.fsm(Run::Runs));
    /// let moves = run.next(|run| match run {
    ///     Run::Runs => goto(Run::Halted),
    ///     Run::Halted => hold(),
    /// });
    /// def!(stays = moves.goes(Run::Halted, Run::Halted));
    /// # });
    /// assert_eq!(example.values("stays"), [0, 1, 1]);
    /// ```
    #[track_caller]
    pub fn goes(&self, state: S, to: S) -> Signal {
        self.from(state, |next| next.code() == to.code()).unwrap_or_else(|| lit(1, 0))
    }

    /// Whether the machine is in `state` and goes to a state that `counts`; `None` if it never does.
    #[track_caller]
    fn from(&self, state: S, counts: impl Fn(S) -> bool) -> Option<Signal> {
        let Exit { arms, last } = &self.exits[S::NAMES.place(state.code()).expect("a state is a code")];
        let mut goes = Goes::Known(counts(*last));
        for (signal, to) in arms.iter().rev() {
            // A wrong width has been reported already.
            let condition = if signal.width() == 1 { *signal } else { lit(1, 0) };
            goes = goes.unless(condition, counts(*to));
        }
        match goes {
            Goes::Known(false) => None,
            Goes::Known(true) => Some(self.machine.is(state)),
            Goes::If(goes) => Some(self.machine.is(state) & goes),
        }
    }
}

/// Whether a machine takes a set of transitions.
enum Goes {
    Known(bool),
    If(Signal),
}

impl Goes {
    /// `then` where `condition` is true; else this.
    #[track_caller]
    fn unless(self, condition: Signal, then: bool) -> Goes {
        match (self, then) {
            (Goes::Known(goes), then) if goes == then => Goes::Known(goes),
            (Goes::Known(_), true) => Goes::If(condition),
            (Goes::Known(_), false) => Goes::If(!condition),
            (Goes::If(goes), true) => Goes::If(condition | goes),
            (Goes::If(goes), false) => Goes::If(!condition & goes),
        }
    }
}
