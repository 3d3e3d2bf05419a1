//! State machines: a register that holds a state, and where it goes from each.

use crate::codes::Codes;
use crate::operand::{IntoSignal, Operand, Value};
use crate::register::Reg;
use crate::select::{lit, select};
use crate::signal::Signal;
use std::marker::PhantomData;
use std::ops::Deref;

/// A register that holds a state. Made by [`Module::fsm`](crate::Module::fsm).
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
    /// The code of the present state.
    pub fn value(self) -> Signal {
        self.register.signal
    }

    /// 1 bit: the machine is in `state`.
    #[track_caller]
    pub fn is(self, state: S) -> Signal {
        self.register.signal.is(state)
    }

    /// The next state, for each present one: `match` it, and say [`goto`], [`when`] or [`hold`]. What is done at a transition says so by its name, and
    /// the condition is said once:
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
    ///         let level = m.reg("level", up_to(self.litres)).reset(0);
    ///         let filled = m.reg("filled", 8).reset(0);
    ///         let pump = m.fsm("pump", Pump::Idle);
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
        // Loops, as closures would be the callers that messages name.
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

    /// The number that `of` gives for the present state, in `width` bits.
    #[track_caller]
    pub fn constants(self, width: u32, of: impl Fn(S) -> u64) -> Signal {
        self.choose(&crate::select::constants(width, S::ALL.iter().map(|state| of(*state))))
    }

    /// The signal that `of` gives for the present state; all of one width.
    #[track_caller]
    pub fn pick(self, of: impl Fn(S) -> Signal) -> Signal {
        let values: Vec<_> = S::ALL.iter().map(|state| of(*state)).collect();
        self.choose(&values)
    }

    /// The one of `values`, in the order of [`Codes::ALL`], that belongs to the present state.
    #[track_caller]
    fn choose(self, values: &[Signal]) -> Signal {
        let (last, arms) = values.split_last().expect("a machine has a state");
        crate::case(*self, S::ALL.iter().map(|state| state.code()).zip(arms.iter().copied()), *last)
    }
}

/// Where a machine goes at the next edge: made by [`StateReg::next`], for what is to happen then.
#[derive(Debug, Clone)]
pub struct Moves<S> {
    machine: StateReg<S>,
    /// By state.
    exits: Vec<Exit<S>>,
}

#[derive(Debug, Clone)]
struct Exit<S> {
    arms: Vec<(Signal, S)>,
    last: S,
}

impl<S: Codes + Operand> Moves<S> {
    /// 1 bit: the machine is in `state`, and goes to another one.
    #[track_caller]
    pub fn leaves(&self, state: S) -> Signal {
        self.from(state, |to| to.code() != state.code()).unwrap_or_else(|| lit(1, 0))
    }

    /// 1 bit: the machine is in another state, and goes to `state`.
    #[track_caller]
    pub fn enters(&self, state: S) -> Signal {
        let mut enters = None;
        // A loop, as a closure would be the caller that messages name.
        for &other in S::ALL.iter().filter(|other| other.code() != state.code()) {
            let goes = self.from(other, |to| to.code() == state.code());
            enters = match (enters, goes) {
                (Some(enters), Some(goes)) => Some(enters | goes),
                (one, other) => one.or(other),
            };
        }
        enters.unwrap_or_else(|| lit(1, 0))
    }

    /// 1 bit: the machine is in `state`, and goes to `to`, which may be the same.
    #[track_caller]
    pub fn goes(&self, state: S, to: S) -> Signal {
        self.from(state, |next| next.code() == to.code()).unwrap_or_else(|| lit(1, 0))
    }

    /// That the machine is in `state` and goes where `counts` says; none if it never does.
    #[track_caller]
    fn from(&self, state: S, counts: impl Fn(S) -> bool) -> Option<Signal> {
        let Exit { arms, last } = &self.exits[state.code() as usize];
        let mut goes = Goes::Known(counts(*last));
        for (signal, to) in arms.iter().rev() {
            // One of another width is reported already.
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

/// Whether a machine goes somewhere.
enum Goes {
    Known(bool),
    If(Signal),
}

impl Goes {
    /// Where `condition` holds, `then`; else this.
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

/// Where a machine goes from a state.
#[must_use]
pub struct Transition<S> {
    arms: Vec<(Signal, S)>,
    last: Option<S>,
}

/// To `state` at the next edge, whatever happens.
pub fn goto<S>(state: S) -> Transition<S> {
    Transition { arms: Vec::new(), last: Some(state) }
}

/// Stay.
pub fn hold<S>() -> Transition<S> {
    Transition { arms: Vec::new(), last: None }
}

/// To `state` if `condition`, else stay; [`or_when`](Transition::or_when) and [`or_else`](Transition::or_else) go on.
pub fn when<S>(condition: impl IntoSignal, state: S) -> Transition<S> {
    Transition { arms: vec![(condition.into(), state)], last: None }
}

impl<S> Transition<S> {
    /// Else, to `state` if `condition`.
    pub fn or_when(mut self, condition: impl IntoSignal, state: S) -> Transition<S> {
        self.arms.push((condition.into(), state));
        self
    }

    /// Else, to `state`.
    pub fn or_else(self, state: S) -> Transition<S> {
        Transition { last: Some(state), ..self }
    }
}
