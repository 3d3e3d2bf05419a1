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
    pub fn value(self) -> Signal {
        self.signal
    }

    /// The value after a reset: an integer, a [`Bits`], a `bool`; of a register with lanes the same in each.
    #[track_caller]
    pub fn reset(self, value: impl Operand) -> Reg {
        let (loc, (bits, id)) = (Loc::caller(), self.reset_value(value));
        if is_here(self.signal, id, loc) {
            elaboration::draft(|draft| draft.registers[self.index].reset = Some((Init::Same(bits), loc)));
        }
        self
    }

    /// The values after a reset, one for each lane, a grid row by row.
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
    /// # use tilewright_hdl::{Block, Module, Width, bit, bundle, elaborate};
    /// # bundle! {
    /// #     /// When it counts.
    /// #     pub struct CountIn<T> { pub restart: T, pub take: T }
    /// #     /// What it has counted.
    /// #     pub struct CountOut<T> { pub used: T }
    /// # }
    /// # #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    /// # struct Count;
    /// # impl Block for Count {
    /// #     type In = CountIn;
    /// #     type Out = CountOut;
    /// #     fn inputs(&self) -> CountIn<Width> { CountIn { restart: bit(), take: bit() } }
    /// #     fn build(&self, m: Module, i: CountIn) -> CountOut {
    /// let used = m.reg("used", 8).reset(0);
    /// used.when(i.restart, 0).when(i.take, used + 1);
    /// #         CountOut { used: used.value() }
    /// #     }
    /// # }
    /// # elaborate(&Count).unwrap();
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

    pub(crate) fn give(self, next: NodeId, loc: Loc) {
        let before = elaboration::draft(|draft| draft.registers[self.index].next.replace((next, loc)));
        let help = "say all that it takes in one chain: `.when(condition, value).when(..)`, or with `mux` or `select`";
        report_second_driver(before, self.signal.node, "given a next value", help, loc);
    }
}

/// What a register takes, and when: made by [`Reg::when`]. It says all, so a register has one such chain.
#[derive(Debug, Clone, Copy)]
pub struct Updates {
    register: Reg,
    /// The choice; none if the register is another module's, which is a problem already.
    chain: Option<NodeId>,
}

impl Updates {
    /// Takes `value` where `condition`, 1 bit, is high and no condition before it is.
    #[track_caller]
    pub fn when(self, condition: impl Into<Signal>, value: impl Operand) -> Updates {
        let arm = self.register.arm(condition.into(), value);
        self.change(Loc::caller(), arm.1, |arms, _| arms.push(arm));
        self
    }

    /// Takes `value` where no condition holds, instead of keeping what it holds.
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

    /// The next state, for each present one: `match` it, and say [`goto`], [`when`] or [`hold`].
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
pub fn when<S>(condition: impl Into<Signal>, state: S) -> Transition<S> {
    Transition { arms: vec![(condition.into(), state)], last: None }
}

impl<S> Transition<S> {
    /// Else, to `state` if `condition`.
    pub fn or_when(mut self, condition: impl Into<Signal>, state: S) -> Transition<S> {
        self.arms.push((condition.into(), state));
        self
    }

    /// Else, to `state`.
    pub fn or_else(self, state: S) -> Transition<S> {
        Transition { last: Some(state), ..self }
    }
}
