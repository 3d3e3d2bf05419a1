//! State machines: a register of states, and the transitions from each.

use crate::codes::Codes;
use crate::integers::Integer;
use crate::moves::{Exit, Moves};
use crate::operand::{IntoSignal, Operand, Value};
use crate::register::Reg;
use crate::select::{self, select};
use crate::signal::Signal;
use crate::width::IntoWidth;
use std::marker::PhantomData;
use std::ops::Deref;

/// A register whose value is a state. Made by [`Module::fsm`](crate::Module::fsm).
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// codes! { enum Pump { Fill, Drain } }
///
/// def!(pump = m.fsm(Pump::Fill));
/// def!(level = m.reg(4).reset(0));
/// level.when(pump.is(Pump::Fill), level + 2).otherwise(level - 1);
/// pump.next(|pump| match pump {
///     Pump::Fill => when(level.ge(2), Pump::Drain),
///     Pump::Drain => when(level.eq(2), Pump::Fill),
/// });
/// # });
/// assert_eq!(example.values("pump"), [0, 0, 1, 1, 1, 0, 0]);
/// assert_eq!(example.values("level"), [0, 2, 4, 3, 2, 1, 3]);
/// ```
#[derive(Debug)]
#[must_use]
pub struct StateReg<S> {
    pub(crate) register: Reg,
    pub(crate) states: PhantomData<S>,
}

impl<S> Clone for StateReg<S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S> Copy for StateReg<S> {}

impl<S> Deref for StateReg<S> {
    type Target = Signal;

    fn deref(&self) -> &Signal {
        &self.register.signal
    }
}

/// Reads as its value.
impl<S> Operand for StateReg<S> {
    fn operand(self) -> Value {
        Value::Signal(*self)
    }
}

impl<S: Codes + Operand> StateReg<S> {
    /// 1 bit: the machine is in `state`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// codes! { enum Pump { Fill, Drain } }
    ///
    /// def!(pump = m.fsm(Pump::Fill));
    /// pump.next(|_| goto(Pump::Drain));
    /// let valve_is_open = !pump.is(Pump::Drain);
    /// m.assert(valve_is_open.eq(pump.is(Pump::Fill)), "a condition like any other");
    /// # });
    /// ```
    #[track_caller]
    pub fn is(self, state: S) -> Signal {
        self.register.signal.is(state)
    }

    /// Gives the next state for each present one: `match` the state and return [`goto`], [`when`] or [`hold`]. The
    /// result names the transitions, so actions at a transition need not repeat its condition:
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// codes! { enum Pump { Idle, Fill, Drain } }
    ///
    /// block! {
    ///     /// Fills a tank, and empties it.
    ///     pub struct Tank { pub litres: u64 }
    ///     in TankIn { start: bit() }
    ///     out(self) TankOut { level: up_to(self.litres), filled: bits(8) }
    /// }
    ///
    /// impl Tank {
    ///     fn build(&self, m: Module, i: TankIn) -> TankOut {
    ///         def!(level = m.reg(up_to(self.litres)).reset(0));
    ///         def!(filled = m.reg(8).reset(0));
    ///         def!(pump = m.fsm(Pump::Idle));
    ///         let moves = pump.next(|state| match state {
    ///             Pump::Idle => when(i.start, Pump::Fill),
    ///             Pump::Fill => when(level.eq(self.litres), Pump::Drain),
    ///             Pump::Drain => when(level.eq(0), Pump::Idle),
    ///         });
    ///         let fills = pump.is(Pump::Fill) & !moves.leaves(Pump::Fill);
    ///         let drains = pump.is(Pump::Drain) & !moves.leaves(Pump::Drain);
    ///         level.when(fills, level + 1).when(drains, level - 1);
    ///         filled.when(moves.enters(Pump::Drain), filled + 1);
    ///         TankOut { level: *level, filled: *filled }
    ///     }
    /// }
    /// # let mut sim = tilewright_sim::Simulation::of(&Tank { litres: 3 }).unwrap();
    /// # sim.set(sim.i.start, 1);
    /// # sim.run(5);
    /// # assert_eq!((sim.get_u64(sim.o.level), sim.get_u64(sim.o.filled)), (3, 1));
    /// # sim.run(4);
    /// # assert_eq!((sim.get_u64(sim.o.level), sim.get_u64(sim.o.filled)), (0, 1));
    /// ```
    #[track_caller]
    pub fn next(self, transition: impl Fn(S) -> Transition<S>) -> Moves<S> {
        // Loops: in closures, the messages would name the closure as the caller.
        let mut values = Vec::with_capacity(S::ALL.len());
        let mut exits = Vec::with_capacity(S::ALL.len());
        for &state in S::ALL {
            let Transition { arms, last } = transition(state);
            let exit = Exit { arms: arms.clone(), last: last.unwrap_or(state) };
            let last = self.code(exit.last);
            let mut coded = Vec::with_capacity(arms.len());
            for (condition, to) in arms {
                coded.push((condition, self.code(to)));
            }
            values.push(if coded.is_empty() { last } else { select(coded, last) });
            exits.push(exit);
        }
        self.register.next(self.choose(&values));
        Moves { machine: self, exits }
    }

    #[track_caller]
    fn code(self, state: S) -> Signal {
        state.operand().with_width_of(self.register.signal, "next")
    }

    /// The number that `of` returns for the present state, as a signal of this width.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// codes! { enum Scan { Idle, Front, Back } }
    ///
    /// def!(scan = m.fsm(Scan::Idle));
    /// scan.next(|scan| match scan {
    ///     Scan::Idle => goto(Scan::Front),
    ///     Scan::Front => goto(Scan::Back),
    ///     Scan::Back => hold(),
    /// });
    /// def!(porch = scan.constants(6, |scan| match scan {
    ///     Scan::Idle => 0,
    ///     Scan::Front => 16,
    ///     Scan::Back => 48,
    /// }));
    /// # });
    /// assert_eq!(example.values("porch"), [0, 16, 48, 48]);
    /// ```
    #[track_caller]
    pub fn constants<N: Integer>(self, width: impl IntoWidth, of: impl Fn(S) -> N) -> Signal {
        self.choose(&crate::select::constants(width.into_width(), S::ALL.iter().map(|state| of(*state).integer())))
    }

    /// The signal that `of` returns for the present state; all have one width.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// codes! { enum Run { Up, Down } }
    ///
    /// def!(run = m.fsm(Run::Up));
    /// run.next(|run| match run {
    ///     Run::Up => goto(Run::Down),
    ///     Run::Down => hold(),
    /// });
    /// def!(count = m.reg(4).reset(5));
    /// count.next(run.pick(|run| match run {
    ///     Run::Up => count + 1,
    ///     Run::Down => count - 1,
    /// }));
    /// # });
    /// assert_eq!(example.values("count"), [5, 6, 5, 4]);
    /// ```
    #[track_caller]
    pub fn pick(self, of: impl Fn(S) -> Signal) -> Signal {
        let values: Vec<_> = S::ALL.iter().map(|state| of(*state)).collect();
        self.choose(&values)
    }

    /// The entry of `values`, in the sequence of [`Codes::ALL`], for the present state.
    #[track_caller]
    fn choose(self, values: &[Signal]) -> Signal {
        let (last, arms) = values.split_last().expect("a machine has a state");
        crate::case(*self, S::ALL.iter().map(|state| state.code()).zip(arms.iter().copied()), *last)
    }
}

/// The transition from a state.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// codes! { enum Door { Shut, Open, Locked } }
///
/// let (push, turn) = (lit(1, 1), lit(1, 0));
/// def!(door = m.fsm(Door::Shut));
/// // A part that several states share is a function or, as here, a value made where it is needed.
/// let shuts = || when(push, Door::Shut);
/// door.next(|door| match door {
///     Door::Shut => when(turn, Door::Locked).or_when(push, Door::Open),
///     Door::Open => shuts(),
///     Door::Locked => shuts().or_else(Door::Locked),
/// });
/// # });
/// assert_eq!(example.values("door"), [0, 1, 0, 1]);
/// ```
#[must_use]
pub struct Transition<S> {
    arms: Vec<(Signal, S)>,
    last: Option<S>,
}

/// To `state` at the next edge, unconditionally.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// codes! { enum Step { Fetch, Execute } }
///
/// def!(step = m.fsm(Step::Fetch));
/// step.next(|step| match step {
///     Step::Fetch => goto(Step::Execute),
///     Step::Execute => goto(Step::Fetch),
/// });
/// # });
/// assert_eq!(example.values("step"), [0, 1, 0, 1]);
/// ```
pub fn goto<S>(state: S) -> Transition<S> {
    Transition { arms: Vec::new(), last: Some(state) }
}

/// Stays in the state.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// codes! { enum Run { Runs, Halted } }
///
/// def!(run = m.fsm(Run::Runs));
/// run.next(|run| match run {
///     Run::Runs => goto(Run::Halted),
///     Run::Halted => hold(), // until a reset
/// });
/// # });
/// assert_eq!(example.values("run"), [0, 1, 1, 1]);
/// ```
pub fn hold<S>() -> Transition<S> {
    Transition { arms: Vec::new(), last: None }
}

/// To `state` if `condition`, else stays; [`or_when`](Transition::or_when) and [`or_else`](Transition::or_else) add
/// further cases.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// codes! { enum Start { Waits, Runs } }
///
/// def!(count = m.reg(4).reset(0));
/// count.next(count + 1);
/// def!(start = m.fsm(Start::Waits));
/// start.next(|start| match start {
///     Start::Waits => when(count.eq(2), Start::Runs),
///     Start::Runs => hold(),
/// });
/// # });
/// assert_eq!(example.values("start"), [0, 0, 0, 1, 1]);
/// ```
#[track_caller]
pub fn when<S>(condition: impl IntoSignal, state: S) -> Transition<S> {
    Transition { arms: vec![(select::condition(condition.into(), "when"), state)], last: None }
}

impl<S> Transition<S> {
    /// Otherwise to `state` if `condition`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// codes! { enum Lift { Stands, Rises, Sinks } }
    ///
    /// let (floor, wanted) = (m.reg("floor", 3).reset(2), lit(3, 4));
    /// def!(lift = m.fsm(Lift::Stands));
    /// floor.when(lift.is(Lift::Rises) & floor.ne(wanted), floor + 1);
    /// lift.next(|_| when(wanted.gt(floor), Lift::Rises).or_when(wanted.lt(floor), Lift::Sinks).or_else(Lift::Stands));
    /// # });
    /// assert_eq!(example.values("floor"), [2, 2, 3, 4, 4]);
    /// assert_eq!(example.values("lift"), [0, 1, 1, 1, 0]);
    /// ```
    #[track_caller]
    pub fn or_when(mut self, condition: impl IntoSignal, state: S) -> Transition<S> {
        self.arms.push((select::condition(condition.into(), "or_when"), state));
        self
    }

    /// Otherwise to `state`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// codes! { enum Line { Idle, Start, Data } }
    ///
    /// def!(level = m.reg(1).reset(0));
    /// level.next(1);
    /// def!(line = m.fsm(Line::Idle));
    /// line.next(|line| match line {
    ///     Line::Idle => when(!level, Line::Start),
    ///     Line::Start => when(!level, Line::Data).or_else(Line::Idle), // without it, it would stay
    ///     Line::Data => hold(),
    /// });
    /// # });
    /// assert_eq!(example.values("line"), [0, 1, 0, 0]);
    /// ```
    pub fn or_else(self, state: S) -> Transition<S> {
        Transition { last: Some(state), ..self }
    }
}
