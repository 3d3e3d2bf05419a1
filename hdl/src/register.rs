//! Registers.

use crate::compare::compared_as_signal;
use crate::elaboration;
use crate::names::bits_text;
use crate::operand::{IntoSignal, Operand, Value, operators, reads_as_signal};
use crate::select::condition;
use crate::signal::Signal;
use crate::wire::{CHOOSE, is_here, report_second_driver};
use std::ops::Deref;
use tilewright_circuit::ir::{Init, NodeId, Op};
use tilewright_circuit::{Bits, Loc, Mistake, Problem};

/// A register of a signal or of a record. It reads as its present value; write `*count` where a bare signal is
/// required. Call [`next`](Reg::next) exactly once, or use one chain of [`when`](Reg::when) instead.
///
/// At an edge of its clock, the register takes its [`reset`](Reg::reset) value if it has one and the clock's reset is
/// high. Otherwise it takes the next value if it is enabled, or keeps its value if not. To clear it without the
/// reset, make the clear the first condition of its chain: `count.when(i.clear, 0).when(i.take, count + 1)`.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// def!(count = m.reg(4).reset(3));
/// let is_even = !count.bit(0); // its present value, ..
/// count.next(count + 1); // .. and its value from the next edge on
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
compared_as_signal!(Reg);
reads_as_signal!(Reg);

impl Reg {
    /// The value after a reset: an integer, a [`Bits`] or a `bool`. In a register with lanes, all lanes have it.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(level = m.reg(bits(8).signed()).reset(-2));
    /// level.next(level + 1);
    /// def!(lamps = m.reg(bit().of(row(3))).reset(true));
    /// lamps.next(lamps.previous(0));
    /// def!(lit = lamps.pack());
    /// # });
    /// assert_eq!(example.values("level"), [0xfe, 0xff, 0, 1]);
    /// assert_eq!(example.values("lit"), [0b111, 0b110, 0b100, 0b000]);
    /// ```
    #[track_caller]
    pub fn reset(self, value: impl Operand) -> Reg {
        let (loc, (bits, id)) = (Loc::caller(), self.constant(value, "reset"));
        if is_here(self.signal, id, loc) {
            self.reset_to(Init::Same(bits), loc);
        }
        self
    }

    /// The values after a reset, one for each lane; a grid is counted row by row.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(ring = m.reg(bits(4).of(row(3))).reset_each([7, 8, 9]));
    /// ring.next(ring.previous(ring.last()));
    /// # });
    /// assert_eq!(example.values("ring[0]"), [7, 9, 8, 7]);
    /// ```
    #[track_caller]
    pub fn reset_each<V: Operand>(self, values: impl IntoIterator<Item = V>) -> Reg {
        let (loc, lanes) = (Loc::caller(), self.shape.lanes() as usize);
        let mut each = Vec::new();
        for value in values {
            each.push(self.constant(value, "reset").0);
        }
        if is_here(self.signal, self.signal.node, loc) {
            if each.len() != lanes {
                elaboration::with(|e| {
                    let name = e.draft().describe(self.signal.node);
                    let message = format!("`{name}` has {}, but {} reset values", self.shape, each.len());
                    let problem = Problem::new(Mistake::ValuesForLanes, loc, message)
                        .help("`.reset(value)` gives all lanes the same value");
                    e.report_instead_of(&[self.signal.node], problem);
                });
                each.resize(lanes, Bits::zero(self.width));
            }
            let init = if self.shape.is_plain() { Init::Same(each.swap_remove(0)) } else { Init::Each(each) };
            self.reset_to(init, loc);
        }
        self
    }

    fn reset_to(self, init: Init, loc: Loc) {
        let before = elaboration::draft(|draft| draft.registers[self.index].reset.replace((init, loc)));
        let before = before.map(|(_, loc)| (self.signal.node, loc));
        report_second_driver(Mistake::GivenTwice, before, self.signal.node, "given a reset value", "give it once", loc);
    }

    /// The value at power-on: an integer, a [`Bits`] or a `bool`. In a register with lanes, all lanes have it. An
    /// FPGA loads it with its configuration, so such a register needs no reset to start. A simulation starts with it,
    /// whatever the seed. Without one, a register starts with its reset value, or with an unknown value if it has no
    /// reset.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// block! {
    ///     /// Keeps its reset high for some clocks after power-on.
    ///     pub struct PowerOn { pub clocks: u64 }
    ///     in PowerOnIn { again: bit() }
    ///     out PowerOnOut { reset: bit() }
    /// }
    ///
    /// impl PowerOn {
    ///     fn build(&self, m: Module, i: PowerOnIn) -> PowerOnOut {
    ///         def!(left = m.reg(up_to(self.clocks)).initial(self.clocks));
    ///         def!(reset = left.ne(0));
    ///         left.when(i.again, self.clocks).when(reset, left - 1);
    ///         PowerOnOut { reset }
    ///     }
    /// }
    ///
    /// let mut sim = tilewright_sim::Simulation::of(&PowerOn { clocks: 3 })?.seeded(1);
    /// sim.run(2);
    /// assert_eq!(sim.get(sim.o.reset), 1);
    /// sim.step();
    /// assert_eq!(sim.get(sim.o.reset), 0);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    #[track_caller]
    pub fn initial(self, value: impl Operand) -> Reg {
        let (loc, (bits, id)) = (Loc::caller(), self.constant(value, "initial"));
        if is_here(self.signal, id, loc) {
            let before = elaboration::draft(|draft| draft.registers[self.index].initial.replace((bits, loc)));
            let before = before.map(|(_, loc)| (self.signal.node, loc));
            report_second_driver(
                Mistake::GivenTwice,
                before,
                self.signal.node,
                "given an initial value",
                "give it once",
                loc,
            );
        }
        self
    }

    /// A value known while the block is built, for the register's `when` (its reset or power-on), and its constant.
    #[track_caller]
    fn constant(self, value: impl Operand, when: &str) -> (Bits, NodeId) {
        let loc = Loc::caller();
        let constant = match value.operand() {
            Value::Literal(literal) => literal.for_signal(self.signal, when),
            Value::Signal(signal) | Value::Low(signal) if signal.width == self.width => {
                signal.of_kind_of(self.signal, when)
            }
            Value::Signal(signal) | Value::Low(signal) => signal,
        };
        let id = constant.id();
        let bits = elaboration::with(|e| match &e.draft().node(id).op {
            Op::Const(bits) if bits.width() == self.width && constant.shape.is_plain() => bits.clone(),
            _ => {
                let name = e.draft().describe(self.signal.node);
                let message = format!("the {when} value of `{name}` is not a constant of {}", bits_text(self.width));
                let problem = Problem::new(Mistake::NotConstant, loc, message)
                    .help(format!("the {when} value is a number known while the block is built"));
                let own = Some(self.signal.node).filter(|_| e.draft().serial == self.signal.module);
                e.report_instead_of(&[Some(id), own].into_iter().flatten().collect::<Vec<_>>(), problem);
                Bits::zero(self.width)
            }
        });
        (bits, id)
    }

    /// Takes its next value only where `enable`, 1 bit, is high.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(half = m.reg(1).reset(0));
    /// half.next(!half);
    /// def!(count = m.reg(4).reset(0));
    /// count.enable(*half).next(count + 1);
    /// # });
    /// assert_eq!(example.values("count"), [0, 0, 1, 1, 2, 2]);
    /// ```
    #[track_caller]
    pub fn enable(self, enable: impl IntoSignal) -> Reg {
        let loc = Loc::caller();
        let enable = condition(enable.into(), "enable").with_lanes_of(self.signal, "enable").id();
        if is_here(self.signal, enable, loc) {
            let before = elaboration::draft(|draft| draft.registers[self.index].enable.replace((enable, loc)));
            report_second_driver(Mistake::DrivenTwice, before, self.signal.node, "enabled", CHOOSE, loc);
        }
        self
    }

    /// The value that the register takes at the next edge.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(fibonacci = m.reg(8).reset(1));
    /// let before = m.reg("last", 8).reset(0);
    /// before.next(fibonacci);
    /// fibonacci.next(before + *fibonacci); // both sample at once: `before` is still the old value
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

    /// Takes `value` where `condition`, 1 bit, is high. Elsewhere, further [`when`](Updates::when)s of the same chain
    /// decide; if none applies, the register keeps its value. The first true condition wins, as in `if`, `else if`,
    /// which is also how Verilog prints it.
    ///
    /// ```
    /// # use tilewright_hdl::{Block, Module, Width, bit, bundle, def, elaborate};
    /// # bundle! {
    /// #     /// The enable.
    /// #     pub struct CountIn<T> { pub restart: T, pub take: T }
    /// #     /// The count.
    /// #     pub struct CountOut<T> { pub used: T }
    /// # }
    /// # #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    /// # struct Count;
    /// # impl Block for Count {
    /// #     type In = CountIn;
    /// #     type Out = CountOut;
    /// #     fn inputs(&self) -> CountIn<Width> { CountIn { restart: bit(), take: bit() } }
    /// #     fn build(&self, m: Module, i: CountIn) -> CountOut {
    /// def!(used = m.reg(8).reset(0));
    /// used.when(i.restart, 0).when(i.take, used + 1);
    /// #         CountOut { used: *used }
    /// #     }
    /// # }
    /// # elaborate(&Count).unwrap();
    /// ```
    #[track_caller]
    pub fn when(self, condition: impl IntoSignal, value: impl Operand) -> Updates {
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

    /// A condition, and the value that the register takes where it is true.
    #[track_caller]
    fn arm(self, when: Signal, value: impl Operand) -> (NodeId, NodeId) {
        (
            condition(when, "when").with_lanes_of(self.signal, "when").id(),
            value.operand().like(self.signal, "when").id(),
        )
    }

    pub(crate) fn give(self, next: NodeId, loc: Loc) {
        let before = elaboration::draft(|draft| draft.registers[self.index].next.replace((next, loc)));
        let help =
            "describe all its updates in one chain: `.when(condition, value).when(..)`, or with `mux` or `select`";
        report_second_driver(Mistake::DrivenTwice, before, self.signal.node, "given a next value", help, loc);
    }
}

/// The update chain of a register, made by [`Reg::when`]. A register has one such chain, which describes it
/// completely. The chain reads as the register, so a register that does not read itself may be declared together with
/// it:
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// def!(count = m.reg(3).reset(0));
/// count.next(count + 1);
/// def!(busy = m.reg(1).reset(0).when(count.eq(2), 1).when(count.eq(4), 0));
/// def!(served = mux(busy, count + 1, 0));
/// # });
/// assert_eq!(example.values("served"), [0, 0, 0, 4, 5, 0]);
/// ```
///
/// A chain may be made in a loop:
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// def!(count = m.reg(4).reset(0));
/// let mut updates = count.when(count.eq(9), 0);
/// for (at, skip_to) in [(2, 5), (6, 8)] {
///     updates = updates.when(count.eq(at), skip_to);
/// }
/// updates.otherwise(count + 1);
/// # });
/// assert_eq!(example.values("count"), [0, 1, 2, 5, 6, 8, 9, 0]);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Updates {
    register: Reg,
    /// The choice; `None` if the register is another module's, which has been reported.
    chain: Option<NodeId>,
}

impl Deref for Updates {
    type Target = Signal;

    fn deref(&self) -> &Signal {
        &self.register.signal
    }
}

operators!(Updates);
compared_as_signal!(Updates);
reads_as_signal!(Updates);

impl Updates {
    /// Takes `value` where `condition`, 1 bit, is high and no earlier condition is.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(4).reset(0));
    /// count.when(count.eq(3), 0).when(count.le(3), count + 1);
    /// # });
    /// // At 3 both conditions are true, and the first wins.
    /// assert_eq!(example.values("count"), [0, 1, 2, 3, 0]);
    /// ```
    #[track_caller]
    pub fn when(self, condition: impl IntoSignal, value: impl Operand) -> Updates {
        let arm = self.register.arm(condition.into(), value);
        self.change(Loc::caller(), arm.1, |arms, _| arms.push(arm));
        self
    }

    /// Takes `value` where no condition is true, instead of keeping its value.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(timer = m.reg(4).reset(1));
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
        let register = self.register.signal.node;
        elaboration::with(|e| {
            let (arms, default) = match &mut e.draft().node_mut(chain).op {
                Op::Select { arms, default } => (arms, default),
                op => unreachable!("a chain is a choice, not {op:?}"),
            };
            if *default == register {
                return change(arms, default);
            }
            let last = *default;
            let (name, last) = (e.draft().describe(register), e.draft().describe(last));
            let message = format!("the chain of `{name}` continues after its end, `.otherwise({last})`");
            e.report(
                Problem::new(Mistake::EndedChain, loc, message)
                    .help("`.otherwise(value)` comes once, after all conditions"),
            );
        });
    }
}
