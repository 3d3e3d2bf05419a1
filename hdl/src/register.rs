//! Registers, and registers that hold the state of a state machine.

use crate::bits::Bits;
use crate::codes::Codes;
use crate::elaboration;
use crate::ir::{Init, NodeId, Op};
use crate::loc::Loc;
use crate::operand::{Operand, Value, operators, reads_as_signal};
use crate::problem::Problem;
use crate::select::{condition, select};
use crate::signal::{Signal, bits_text};
use crate::wire::{CHOOSE, is_here, report_second_driver};
use std::marker::PhantomData;
use std::ops::Deref;

/// A register of a signal, or of a record. It reads as its present value; [`next`](Reg::next) must be called exactly once, or a chain of [`when`](Reg::when)
/// stands in its place.
///
/// At an edge of its clock it takes the [`reset`](Reg::reset) value if its clock's reset is high and it has one; else
/// the next value if it is enabled; else it keeps what it holds.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// let count = m.reg("count", 4).reset(3);
/// let is_even = !count.bit(0); // what it holds now, ..
/// count.next(count + 1); // .. and what it holds from the next edge on
/// let _ = is_even.named("is_even");
/// # });
/// assert_eq!(example.values("count"), [3, 4, 5, 6]);
/// assert_eq!(example.values("is_even"), [0, 1, 0, 1]);
/// ```
#[derive(Debug, Clone, Copy)]
#[must_use]
pub struct Reg<V = Signal> {
    pub(crate) signal: V,
    pub(crate) index: usize,
}

impl<V> Deref for Reg<V> {
    type Target = V;

    fn deref(&self) -> &V {
        &self.signal
    }
}

operators!(Reg);
reads_as_signal!(Reg);

impl Reg {
    /// The present value.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let count = m.reg("count", 4).reset(0);
    /// count.next(count + 1);
    /// let digits: [Signal; 2] = [count.value(), *count];
    /// m.assert(digits[0].eq(digits[1]), "a bare signal; `*count` says the same");
    /// # });
    /// ```
    pub fn value(self) -> Signal {
        self.signal
    }

    /// The value after a reset: an integer, a [`Bits`], a `bool`; of a register with lanes the same in each.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// let level = m.reg("level", bits(8).signed()).reset(-2);
    /// level.next(level + 1);
    /// let lamps = m.reg("lamps", bit().of(row(3))).reset(true);
    /// lamps.next(lamps.previous(0));
    /// net!(lit = lamps.pack());
    /// # });
    /// assert_eq!(example.values("level"), [0xfe, 0xff, 0, 1]);
    /// assert_eq!(example.values("lit"), [0b111, 0b110, 0b100, 0b000]);
    /// ```
    #[track_caller]
    pub fn reset(self, value: impl Operand) -> Reg {
        let (loc, (bits, id)) = (Loc::caller(), self.reset_value(value));
        if is_here(self.signal, id, loc) {
            elaboration::draft(|draft| draft.registers[self.index].reset = Some((Init::Same(bits), loc)));
        }
        self
    }

    /// The values after a reset, one for each lane, a grid row by row.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// let ring = m.reg("ring", bits(4).of(row(3))).reset_each([7, 8, 9]);
    /// ring.next(ring.previous(ring.last()));
    /// # });
    /// assert_eq!(example.values("ring[0]"), [7, 9, 8, 7]);
    /// ```
    #[track_caller]
    pub fn reset_each<V: Operand>(self, values: impl IntoIterator<Item = V>) -> Reg {
        let (loc, lanes) = (Loc::caller(), self.shape.lanes() as usize);
        let mut each = Vec::new();
        for value in values {
            each.push(self.reset_value(value).0);
        }
        if is_here(self.signal, self.signal.node, loc) {
            if each.len() != lanes {
                elaboration::with(|e| {
                    let name = e.draft().describe(self.signal.node);
                    let message = format!("`{name}` has {}, but {} reset values", self.shape, each.len());
                    e.report(Problem::new(loc, message).help("`.reset(value)` gives all lanes the same"));
                });
                each.resize(lanes, Bits::zero(self.width));
            }
            let init = if self.shape.is_plain() { Init::Same(each.swap_remove(0)) } else { Init::Each(each) };
            elaboration::draft(|draft| draft.registers[self.index].reset = Some((init, loc)));
        }
        self
    }

    /// A reset value, and the constant that it was.
    #[track_caller]
    fn reset_value(self, value: impl Operand) -> (Bits, NodeId) {
        let loc = Loc::caller();
        let constant = match value.operand() {
            Value::Literal(literal) => literal.for_signal(self.signal, "reset"),
            Value::Signal(signal) => signal,
        };
        let id = constant.id();
        let bits = elaboration::with(|e| match &e.draft().node(id).op {
            Op::Const(bits) if bits.width() == self.width => bits.clone(),
            _ => {
                let name = e.draft().describe(self.signal.node);
                let message = format!("the reset value of `{name}` is not a constant of {}", bits_text(self.width));
                let problem =
                    Problem::new(loc, message).help("a reset value is a number known while the block is built");
                e.report_instead_of(&[id], problem);
                Bits::zero(self.width)
            }
        });
        (bits, id)
    }

    /// Takes its next value only where `condition`, 1 bit, is high.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// let half = m.reg("half", 1).reset(0);
    /// half.next(!*half);
    /// let count = m.reg("count", 4).reset(0);
    /// count.enable(*half).next(count + 1);
    /// # });
    /// assert_eq!(example.values("count"), [0, 0, 1, 1, 2, 2]);
    /// ```
    #[track_caller]
    pub fn enable(self, enable: impl Into<Signal>) -> Reg {
        let loc = Loc::caller();
        let enable = condition(enable.into(), "enable").with_lanes_of(self.signal, "enable").id();
        if is_here(self.signal, enable, loc) {
            let before = elaboration::draft(|draft| draft.registers[self.index].enable.replace((enable, loc)));
            report_second_driver(before, self.signal.node, "enabled", CHOOSE, loc);
        }
        self
    }

    /// The value that the register takes at the next edge.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// let fibonacci = m.reg("fibonacci", 8).reset(1);
    /// let before = m.reg("last", 8).reset(0);
    /// before.next(fibonacci);
    /// fibonacci.next(before + *fibonacci); // both sample at once: `before` is still what it was
    /// # });
    /// assert_eq!(example.values("fibonacci"), [1, 1, 2, 3, 5, 8]);
    /// ```
    #[track_caller]
    pub fn next(self, value: impl Operand) {
        let loc = Loc::caller();
        let next = value.operand().like(self.signal, "next").id();
        if is_here(self.signal, next, loc) {
            self.give(next, loc);
        }
    }

    /// Takes `value` where `condition`, 1 bit, is high; else what a further [`when`](Updates::when) of the same chain says;
    /// else it keeps what it holds. The first condition that holds wins, as in `if`, `else if`, which is what Verilog has.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// let used = m.reg("used", 8).reset(7);
    /// let (restart, take) = (used.eq(9), lit(1, 1));
    /// used.when(restart, 0).when(take, used + 1);
    /// # });
    /// assert_eq!(example.values("used"), [7, 8, 9, 0, 1]); // at 9 both hold
    /// ```
    #[track_caller]
    pub fn when(self, condition: impl Into<Signal>, value: impl Operand) -> Updates {
        let loc = Loc::caller();
        let arm = self.arm(condition.into(), value);
        let chain = is_here(self.signal, arm.1, loc).then(|| {
            let keeps = Op::Select { arms: vec![arm], default: self.signal.node };
            let chain = elaboration::draft(|draft| draft.add(keeps, self.width, self.shape, loc));
            self.give(chain, loc);
            chain
        });
        Updates { register: self, chain }
    }

    /// A condition, and what the register takes where it holds.
    #[track_caller]
    fn arm(self, when: Signal, value: impl Operand) -> (NodeId, NodeId) {
        (
            condition(when, "when").with_lanes_of(self.signal, "when").id(),
            value.operand().like(self.signal, "when").id(),
        )
    }

    fn give(self, next: NodeId, loc: Loc) {
        let before = elaboration::draft(|draft| draft.registers[self.index].next.replace((next, loc)));
        let help = "say all that it takes in one chain: `.when(condition, value).when(..)`, or with `mux` or `select`";
        report_second_driver(before, self.signal.node, "given a next value", help, loc);
    }
}

/// What a register takes, and when: made by [`Reg::when`]. It says all, so a register has one such chain.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// let count = m.reg("count", 4).reset(0);
/// let mut updates = count.when(count.eq(9), 0);
/// for (at, skip_to) in [(2, 5), (6, 8)] {
///     updates = updates.when(count.eq(at), skip_to); // a chain may be made in a loop
/// }
/// updates.otherwise(count + 1);
/// # });
/// assert_eq!(example.values("count"), [0, 1, 2, 5, 6, 8, 9, 0]);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Updates {
    register: Reg,
    /// The choice; none if the register is another module's, which is a problem already.
    chain: Option<NodeId>,
}

impl Updates {
    /// Takes `value` where `condition`, 1 bit, is high and no condition before it is.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// let count = m.reg("count", 4).reset(0);
    /// count.when(count.eq(3), 0).when(count.le(3), count + 1);
    /// # });
    /// // At 3 both conditions hold, and the first wins.
    /// assert_eq!(example.values("count"), [0, 1, 2, 3, 0]);
    /// ```
    #[track_caller]
    pub fn when(self, condition: impl Into<Signal>, value: impl Operand) -> Updates {
        let arm = self.register.arm(condition.into(), value);
        self.change(Loc::caller(), arm.1, |arms, _| arms.push(arm));
        self
    }

    /// Takes `value` where no condition holds, instead of keeping what it holds.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// let timer = m.reg("timer", 4).reset(1);
    /// timer.when(timer.eq(0), 3).otherwise(timer - 1);
    /// # });
    /// assert_eq!(example.values("timer"), [1, 0, 3, 2, 1, 0]);
    /// ```
    #[track_caller]
    pub fn otherwise(self, value: impl Operand) {
        let value = value.operand().like(self.register.signal, "otherwise").id();
        self.change(Loc::caller(), value, |_, default| *default = value);
    }

    fn change(self, loc: Loc, value: NodeId, change: impl FnOnce(&mut Vec<(NodeId, NodeId)>, &mut NodeId)) {
        let Some(chain) = self.chain.filter(|_| is_here(self.register.signal, value, loc)) else { return };
        elaboration::draft(|draft| match &mut draft.node_mut(chain).op {
            Op::Select { arms, default } => change(arms, default),
            op => unreachable!("a chain is a choice, not {op:?}"),
        });
    }
}

/// A register that holds a state. Made by [`Module::fsm`](crate::Module::fsm).
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// codes! { enum Pump { Fill, Drain } }
///
/// let pump = m.fsm("pump", Pump::Fill);
/// let level = m.reg("level", 4).reset(0);
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
    /// The code of the present state.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// codes! { enum Pump { Fill, Drain } }
    ///
    /// let pump = m.fsm("pump", Pump::Fill);
    /// pump.next(|_| goto(Pump::Drain));
    /// let state: Signal = pump.value(); // for an output, or a record
    /// m.assert(state.eq(Pump::Fill) | state.eq(Pump::Drain), "one of its codes");
    /// # });
    /// ```
    pub fn value(self) -> Signal {
        self.register.signal
    }

    /// 1 bit: the machine is in `state`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// codes! { enum Pump { Fill, Drain } }
    ///
    /// let pump = m.fsm("pump", Pump::Fill);
    /// pump.next(|_| goto(Pump::Drain));
    /// let valve_is_open = !pump.is(Pump::Drain);
    /// m.assert(valve_is_open.eq(pump.is(Pump::Fill)), "a condition like any other");
    /// # });
    /// ```
    #[track_caller]
    pub fn is(self, state: S) -> Signal {
        self.register.signal.is(state)
    }

    /// The next state, for each present one: `match` it, and say [`goto`], [`when`] or [`hold`].
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// codes! { enum Light { Red, Green, Amber } }
    ///
    /// let light = m.fsm("light", Light::Red);
    /// let timer = m.reg("timer", 2).reset(0);
    /// timer.next(timer + 1);
    /// light.next(|light| match light {
    ///     Light::Red => when(timer.eq(1), Light::Green),
    ///     Light::Green => when(timer.eq(3), Light::Amber),
    ///     Light::Amber => goto(Light::Red),
    /// });
    /// # });
    /// assert_eq!(example.values("light"), [0, 0, 1, 1, 2, 0, 1]);
    /// ```
    #[track_caller]
    pub fn next(self, transition: impl Fn(S) -> Transition<S>) {
        // Loops, as closures would be the callers that messages name.
        let mut values = Vec::with_capacity(S::ALL.len());
        for &state in S::ALL {
            let Transition { arms, last } = transition(state);
            let last = self.code(last.unwrap_or(state));
            let mut coded = Vec::with_capacity(arms.len());
            for (condition, to) in arms {
                coded.push((condition, self.code(to)));
            }
            values.push(if coded.is_empty() { last } else { select(coded, last) });
        }
        self.register.next(self.choose(&values));
    }

    #[track_caller]
    fn code(self, state: S) -> Signal {
        state.operand().with_width_of(self.register.signal, "next")
    }

    /// The number that `of` gives for the present state, in `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// codes! { enum Scan { Idle, Front, Back } }
    ///
    /// let scan = m.fsm("scan", Scan::Idle);
    /// scan.next(|scan| match scan {
    ///     Scan::Idle => goto(Scan::Front),
    ///     Scan::Front => goto(Scan::Back),
    ///     Scan::Back => hold(),
    /// });
    /// net!(porch = scan.constants(6, |scan| match scan {
    ///     Scan::Idle => 0,
    ///     Scan::Front => 16,
    ///     Scan::Back => 48,
    /// }));
    /// # });
    /// assert_eq!(example.values("porch"), [0, 16, 48, 48]);
    /// ```
    #[track_caller]
    pub fn constants(self, width: u32, of: impl Fn(S) -> u64) -> Signal {
        self.choose(&crate::select::constants(width, S::ALL.iter().map(|state| of(*state))))
    }

    /// The signal that `of` gives for the present state; all of one width.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// codes! { enum Run { Up, Down } }
    ///
    /// let run = m.fsm("run", Run::Up);
    /// run.next(|run| match run {
    ///     Run::Up => goto(Run::Down),
    ///     Run::Down => hold(),
    /// });
    /// let count = m.reg("count", 4).reset(5);
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

    /// The one of `values`, in the order of [`Codes::ALL`], that belongs to the present state.
    #[track_caller]
    fn choose(self, values: &[Signal]) -> Signal {
        let (last, arms) = values.split_last().expect("a machine has a state");
        crate::case(*self, S::ALL.iter().map(|state| state.code()).zip(arms.iter().copied()), *last)
    }
}

/// Where a machine goes from a state.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// codes! { enum Door { Shut, Open, Locked } }
///
/// let (push, turn) = (lit(1, 1), lit(1, 0));
/// let door = m.fsm("door", Door::Shut);
/// // What several states share is a function or, as here, a value that is made where it is wanted.
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

/// To `state` at the next edge, whatever happens.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// codes! { enum Step { Fetch, Execute } }
///
/// let step = m.fsm("step", Step::Fetch);
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

/// Stay.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// codes! { enum Run { Runs, Halted } }
///
/// let run = m.fsm("run", Run::Runs);
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

/// To `state` if `condition`, else stay; [`or_when`](Transition::or_when) and [`or_else`](Transition::or_else) go on.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// codes! { enum Start { Waits, Runs } }
///
/// let count = m.reg("count", 4).reset(0);
/// count.next(count + 1);
/// let start = m.fsm("start", Start::Waits);
/// start.next(|start| match start {
///     Start::Waits => when(count.eq(2), Start::Runs),
///     Start::Runs => hold(),
/// });
/// # });
/// assert_eq!(example.values("start"), [0, 0, 0, 1, 1]);
/// ```
pub fn when<S>(condition: impl Into<Signal>, state: S) -> Transition<S> {
    Transition { arms: vec![(condition.into(), state)], last: None }
}

impl<S> Transition<S> {
    /// Else, to `state` if `condition`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// codes! { enum Lift { Stands, Rises, Sinks } }
    ///
    /// let (floor, wanted) = (m.reg("floor", 3).reset(2), lit(3, 4));
    /// let lift = m.fsm("lift", Lift::Stands);
    /// floor.when(lift.is(Lift::Rises) & floor.ne(wanted), floor + 1);
    /// lift.next(|_| when(wanted.gt(floor), Lift::Rises).or_when(wanted.lt(floor), Lift::Sinks).or_else(Lift::Stands));
    /// # });
    /// assert_eq!(example.values("floor"), [2, 2, 3, 4, 4]);
    /// assert_eq!(example.values("lift"), [0, 1, 1, 1, 0]);
    /// ```
    pub fn or_when(mut self, condition: impl Into<Signal>, state: S) -> Transition<S> {
        self.arms.push((condition.into(), state));
        self
    }

    /// Else, to `state`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// codes! { enum Line { Idle, Start, Data } }
    ///
    /// let level = m.reg("level", 1).reset(0);
    /// level.next(1);
    /// let line = m.fsm("line", Line::Idle);
    /// line.next(|line| match line {
    ///     Line::Idle => when(!*level, Line::Start),
    ///     Line::Start => when(!*level, Line::Data).or_else(Line::Idle), // without it, it would stay
    ///     Line::Data => hold(),
    /// });
    /// # });
    /// assert_eq!(example.values("line"), [0, 1, 0, 0]);
    /// ```
    pub fn or_else(self, state: S) -> Transition<S> {
        Transition { last: Some(state), ..self }
    }
}
