//! Enums in hardware: values from a fixed list, which waves and Verilog show by name.

use crate::data::{Data, Fits};
use crate::draft::Draft;
use crate::elaboration;
use crate::names::bits_text;
use crate::operand::{Literal, Operand, Value};
use crate::select::by_code;
use crate::signal::Signal;
use crate::width::{Width, bits};
use tilewright_circuit::ir::{Binary, Kind, Names, Node, NodeId, Op, Relation};
use tilewright_circuit::{Bits, Loc, Mistake, Problem};

/// An enum whose variants are values of signals. [`codes!`](crate::codes!) implements it.
///
/// ```
/// # use tilewright_hdl::*;
/// codes! { enum Phase { Idle, Fill, Drain } }
///
/// /// The code after this one, cyclically, for any enum whose codes count from 0.
/// fn following<C: Codes>(code: C) -> C {
///     C::ALL[(code.code() as usize + 1) % C::ALL.len()]
/// }
///
/// assert_eq!(following(Phase::Drain), Phase::Idle);
/// ```
pub trait Codes: Copy + 'static {
    /// The names of the enum and of its codes.
    const NAMES: Names;
    /// Every code, in the sequence of declaration.
    const ALL: &'static [Self];

    /// The number that represents it in hardware.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// codes! { enum Phase { Idle, Fill, Drain } }
    ///
    /// assert_eq!(Phase::ALL[Phase::Fill.code() as usize], Phase::Fill);
    /// ```
    fn code(self) -> u64;

    /// The code that this number represents; `None` if it represents none.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// codes! { enum Response { Okay = 0, Slverr = 2 } }
    ///
    /// assert_eq!([1, 2].map(Response::from_number), [None, Some(Response::Slverr)]);
    /// ```
    fn from_number(number: u64) -> Option<Self> {
        Self::NAMES.place(number).map(|place| Self::ALL[place])
    }

    /// Its name, as waves and Verilog show it.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// codes! { enum Phase { Idle, Fill, Drain } }
    ///
    /// assert_eq!(Phase::ALL.iter().map(|phase| phase.name()).collect::<Vec<_>>(), Phase::NAMES.codes);
    /// ```
    fn name(self) -> &'static str {
        Self::NAMES.name(self.code()).expect("a code has a name")
    }
}

/// Declares an enum whose variants are values of signals, such as the states of a machine or the operations of an
/// instruction. It is a plain enum whose codes count from 0 in the sequence of declaration. Where a protocol gives
/// the numbers, the codes have values: constant expressions of type `u64`, all different, or else rustc says which two
/// are equal. A code without a value is one more than the code before it.
///
/// ```
/// use tilewright_hdl::{Codes, codes, one_of};
///
/// codes! {
///     /// What the pump does.
///     pub enum Phase { Idle, Fill, Drain }
///     /// The answer of an AXI4-Lite slave.
///     pub enum Response { Okay = 0b00, Slverr = 0b10, Decerr }
/// }
///
/// assert_eq!((Phase::Drain.code(), Response::Decerr.code()), (2, 3));
/// assert_eq!(Phase::Fill.name(), "Fill");
/// assert_eq!(one_of::<Response>().bits(), 2); // wide enough for the greatest
/// ```
#[macro_export]
macro_rules! codes {
    ($($(#[$attribute:meta])* $vis:vis enum $name:ident {
        $($(#[$code_attribute:meta])* $code:ident $(= $value:expr)?),+ $(,)?
    })+) => {$(
        $(#[$attribute])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        #[repr(u64)]
        $vis enum $name { $($(#[$code_attribute])* $code $(= $value)?),+ }

        impl $crate::Codes for $name {
            const NAMES: $crate::ir::Names = $crate::ir::Names {
                of: stringify!($name),
                codes: &[$($crate::unraw(stringify!($code))),+],
                values: &[$($name::$code as u64),+],
            };
            const ALL: &'static [Self] = &[$($name::$code),+];

            fn code(self) -> u64 {
                self as u64
            }
        }

        impl $crate::Operand for $name {
            fn operand(self) -> $crate::Value {
                $crate::Value::code(self)
            }
        }

        /// A constant: the code.
        impl From<$name> for $crate::Signal {
            #[track_caller]
            fn from(code: $name) -> $crate::Signal {
                $crate::Signal::of_code(code)
            }
        }
    )+};
}

impl Value {
    /// A code, which only meets signals of its own enum.
    pub fn code<C: Codes>(code: C) -> Value {
        Value::Literal(Literal::Code { names: C::NAMES, code: code.code() })
    }
}

/// The node that says whether a node's value is one of these codes.
pub(crate) fn add_is_code(draft: &mut Draft, of: NodeId, names: Names, loc: Loc) -> NodeId {
    let &Node { width, shape, kind, .. } = draft.node(of);
    if !has_spare_codes(names, width) {
        return draft.add(Op::Const(Bits::new(1, 1)), 1, shape, loc);
    }
    let compare = |draft: &mut Draft, relation, number| {
        let number = draft.add(Op::Const(Bits::new(width, number)), width, shape, loc);
        draft.node_mut(number).kind = kind;
        draft.add(Op::Compare { relation, signed: false, operands: [of, number] }, 1, shape, loc)
    };
    let most = u64::MAX >> 64u32.saturating_sub(width);
    let runs = runs(names.values).into_iter().map(|run| match run {
        (first, last) if first == last => compare(draft, Relation::Eq, first),
        (0, last) => compare(draft, Relation::Le, last),
        (first, last) if last == most => compare(draft, Relation::Ge, first),
        (first, last) => {
            let bounds = [(Relation::Ge, first), (Relation::Le, last)];
            let [least, most] = bounds.map(|(relation, number)| compare(draft, relation, number));
            draft.add(Op::Binary(Binary::And, least, most), 1, shape, loc)
        }
    });
    let runs: Vec<NodeId> = runs.collect();
    runs.into_iter().reduce(|a, b| draft.add(Op::Binary(Binary::Or, a, b), 1, shape, loc)).expect("an enum has a code")
}

/// The first and the last number of each run of successive numbers.
fn runs(values: &[u64]) -> Vec<(u64, u64)> {
    let mut values = values.to_vec();
    values.sort_unstable();
    let mut runs: Vec<(u64, u64)> = Vec::new();
    for value in values {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == value => *last = value,
            _ => runs.push((value, value)),
        }
    }
    runs
}

/// Whether a signal of `width` bits has more values than there are codes.
pub(crate) fn has_spare_codes(names: Names, width: u32) -> bool {
    width >= u64::BITS || (names.codes.len() as u64) < 1 << width
}

/// The width of a signal that takes the codes of an enum: `m.reg("operation", one_of::<Operation>())`.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// codes! { enum Alu { Load, Add, Double } }
///
/// def!(operation = m.reg(one_of::<Alu>()).reset(Alu::Add));
/// operation.next(mux(operation.is(Alu::Add), Alu::Double, Alu::Load));
/// # });
/// assert_eq!(example.values("operation"), [1, 2, 0, 0]); // 2 bits wide, for 3 codes
/// ```
#[track_caller]
pub fn one_of<C: Codes>() -> Width {
    Width { kind: Kind::Code(C::NAMES), ..bits(C::NAMES.width()) }
}

impl Signal {
    /// 1 bit: the signal equals that code.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// codes! { enum Phase { Idle, Fill, Drain } }
    ///
    /// def!(phase = m.reg(one_of::<Phase>()).reset(Phase::Idle));
    /// phase.when(phase.is(Phase::Idle), Phase::Drain);
    /// m.assert(phase.is(Phase::Idle) | phase.is(Phase::Drain), "a code of another enum would be a mistake, as would a number");
    /// # });
    /// ```
    #[track_caller]
    pub fn is<C: Codes + Operand>(self, code: C) -> Signal {
        let code = code.operand().with_width_of(self, "is");
        self.compare(Relation::Eq, code)
    }

    /// Chooses by code: `of` gives a signal, a number or a record for each code, as in
    /// `step.source.choose(|source| match source { .. })`. If the bits have more values than the enum has codes, the
    /// spare values give what most codes give; in a tie, what the last of the tied codes gives.
    ///
    /// The choice asserts by itself that no spare value occurs, if that is certain from the first edge on. It is
    /// certain if every source of the signal is a code of the description or has a reset or power-on value. It is not
    /// certain for a register without one, for the data of a memory read, or for an input, which means nothing while
    /// its `valid` is low. For those, state with [`is_code`](Signal::is_code) when the value is a code:
    /// `m.assert(i.valid.implies(i.opcode.is_code()), ..)`.
    ///
    /// [`choose!`](crate::choose!) is shorter where each arm is a value: it names each code without its enum. Use the
    /// method where the arms are computed, as by a function of the code.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// codes! { enum Alu { Load, Add, Double } }
    ///
    /// let operation = lit(2, 1).code::<Alu>();
    /// let (sum, operand) = (lit(8, 40), lit(8, 2));
    /// let result = operation.choose(|operation| match operation {
    ///     Alu::Load => operand,
    ///     Alu::Add => sum + operand,
    ///     Alu::Double => sum << 1,
    /// });
    /// m.assert(result.eq(42), "rustc reports a missing code");
    /// # });
    /// ```
    #[track_caller]
    pub fn choose<C: Codes, V: Data, A: Fits<V>>(self, of: impl Fn(C) -> A) -> V {
        let subject = self.read_as(Kind::Code(C::NAMES), "choose");
        let (loc, node) = (Loc::caller(), subject.id());
        elaboration::draft(|draft| draft.chosen.push((node, draft.part, loc)));
        by_code(subject, C::NAMES, C::ALL.iter().map(|code| of(*code).given()).collect())
    }

    /// 1 bit: the value is one of the enum's codes. It may not be if the bits have spare values.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// codes! { enum Alu { Load, Add, Double } }
    ///
    /// block! {
    ///     /// Counts the additions.
    ///     pub struct Additions;
    ///     in AdditionsIn { valid: bit(), operation: one_of::<Alu>() }
    ///     out AdditionsOut { additions: bits(8) }
    /// }
    ///
    /// impl Additions {
    ///     fn build(&self, m: Module, i: AdditionsIn) -> AdditionsOut {
    ///         m.assume(i.valid.implies(i.operation.is_code()), "a valid code is an operation");
    ///         def!(additions = m.reg(8).reset(0));
    ///         additions.when(i.valid & i.operation.is(Alu::Add), additions + 1);
    ///         AdditionsOut { additions: *additions }
    ///     }
    /// }
    /// # assert!(tilewright_gen::verilog(&elaborate(&Additions).unwrap())[0].text.contains("operation <= ALU_DOUBLE"));
    /// ```
    #[track_caller]
    pub fn is_code(self) -> Signal {
        let (loc, id) = (Loc::caller(), self.id());
        let Kind::Code(names) = self.kind else {
            return elaboration::with(|e| {
                let text = e.draft().describe(id);
                let problem = Problem::new(
                    Mistake::NoCode,
                    loc,
                    format!("`is_code` needs a code, but `{text}` is {}", self.kind),
                );
                e.report_instead_of(&[id], problem.help("`.code::<Enum>()` reads bits as a code of an enum"));
                Signal::zero_in(e, 1, self.shape, Kind::Number, loc)
            });
        };
        let node = elaboration::draft(|draft| add_is_code(draft, id, names, loc));
        elaboration::with(|e| Signal::at(e, node))
    }

    /// A constant: the code.
    #[doc(hidden)]
    #[track_caller]
    pub fn of_code<C: Codes>(code: C) -> Signal {
        let literal = Literal::Code { names: C::NAMES, code: code.code() };
        literal.sized(C::NAMES.width(), Kind::Code(C::NAMES))
    }

    /// The bits read as a code of that enum.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// codes! { enum Alu { Load, Add, Double } }
    ///
    /// let instruction = lit(10, 0b10_0010_1010);
    /// let operation = instruction.part(8, 2).code::<Alu>();
    /// m.assert(operation.is(Alu::Double), "two bits of an instruction, and from here on its operation");
    /// # });
    /// ```
    #[track_caller]
    pub fn code<C: Codes>(self) -> Signal {
        let (loc, width, kind) = (Loc::caller(), C::NAMES.width(), Kind::Code(C::NAMES));
        let id = self.id();
        elaboration::with(|e| {
            if self.width == width {
                let node = e.draft().seen_as(id, kind, loc);
                return Signal::at(e, node);
            }
            let (text, needs, has) = (e.draft().describe(id), bits_text(width), bits_text(self.width));
            let problem = Problem::new(
                Mistake::CodeWidth,
                loc,
                format!("a `{}` has {needs}, but `{text}` has {has}", C::NAMES.of),
            );
            e.report_instead_of(&[id], problem.help("take the bits of the code, as in `.part(low, width)`"));
            Signal::zero_in(e, width, self.shape, kind, loc)
        })
    }

    /// The signal, for arithmetic; arithmetic on codes is a problem.
    #[track_caller]
    pub(crate) fn computable(self, operator: &str) -> Signal {
        let Kind::Code(names) = self.kind else { return self };
        let (loc, id) = (Loc::caller(), self.id());
        elaboration::with(|e| {
            let text = e.draft().describe(id);
            let problem = Problem::new(
                Mistake::ArithmeticOnCode,
                loc,
                format!("`{operator}` computes with `{text}`, a code of `{}`", names.of),
            );
            let help = "a code is compared, by `.is(..)` and `.eq(..)`, and chosen by; `.bits()` reads it as a number";
            e.report_instead_of(&[id], problem.help(help));
            Signal::zero_in(e, self.width, self.shape, Kind::Number, loc)
        })
    }

    /// The signal if it has that kind; otherwise a problem.
    #[track_caller]
    fn read_as(self, kind: Kind, method: &str) -> Signal {
        if self.kind == kind {
            return self;
        }
        let (loc, id) = (Loc::caller(), self.id());
        elaboration::with(|e| {
            let text = e.draft().describe(id);
            let problem =
                Problem::new(Mistake::NoCode, loc, format!("`{method}` needs {kind}, but `{text}` is {}", self.kind));
            e.report_instead_of(&[id], problem.help("`.code::<Enum>()` reads bits as a code of an enum"));
            Signal::zero_in(e, self.width, self.shape, kind, loc)
        })
    }
}
