//! Right operands: signals, registers, wires and integers.

use crate::draft::Draft;
use crate::elaboration;
use crate::integers::{Integer, for_integers};
use crate::names::bits_text;
use crate::signal::Signal;
use std::fmt;
use tilewright_circuit::ir::{Names, NodeId, Shift};
use tilewright_circuit::{Bits, Loc, Mistake, Problem, Radix};

/// Anything that can be read as an unsigned value.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// fn twice(value: Signal, more: impl Operand) -> Signal {
///     (value << 1) + more
/// }
///
/// def!(count = m.reg(8).reset(20));
/// count.next(count);
/// m.assert(twice(*count, 2).eq(42), "a number, which takes the width of the other operand");
/// m.assert(twice(*count, count).eq(60), "a register, a wire or a signal");
/// m.assert(twice(*count, true).eq(41) & twice(*count, Bits::new(8, 1)).eq(41), "a `bool`, a value of that width");
/// # });
/// ```
#[diagnostic::on_unimplemented(
    message = "a `{Self}` is neither a signal nor a number",
    note = "a signal, a register, an integer, a `bool`, a `Bits` or a code of an enum is accepted here; for a record, name a field"
)]
pub trait Operand {
    #[doc(hidden)]
    fn operand(self) -> Value;
}

/// Anything that is read as a signal, not as a number: a signal, a register, a wire.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// fn both(a: impl IntoSignal, b: impl IntoSignal) -> Signal {
///     let (a, b): (Signal, Signal) = (a.into(), b.into());
///     a & b
/// }
///
/// def!(half = m.reg(1).reset(0));
/// half.next(!half);
/// m.assert(!both(half, !half), "a register and a signal");
/// # });
/// ```
#[diagnostic::on_unimplemented(
    message = "a `{Self}` is not a signal",
    label = "a signal is expected here",
    note = "a condition that is always true is `lit(1, 1)`, one that never is `lit(1, 0)`; a number of a given width is `lit(width, number)`"
)]
pub trait IntoSignal: Into<Signal> {}

impl IntoSignal for Signal {}

#[doc(hidden)]
#[derive(Debug, Clone)]
pub enum Value {
    /// A signal, with its width.
    Signal(Signal),
    /// A number, which takes its width from the context.
    Literal(Literal),
    /// A signal's low bits, as many as the context needs.
    Low(Signal),
}

#[doc(hidden)]
#[derive(Debug, Clone)]
pub enum Literal {
    /// A number that must fit its context.
    Integer(i128, Radix),
    /// A value that must have exactly the width of its context.
    Exact(Bits),
    /// A code of an enum, which only meets signals of that enum.
    Code { names: Names, code: u64 },
}

impl fmt::Display for Literal {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Literal::Integer(value, Radix::Any) => write!(f, "{value}"),
            Literal::Integer(value, Radix::Hex) => write!(f, "{value:#x}"),
            Literal::Integer(value, Radix::Binary) => write!(f, "{value:#b}"),
            Literal::Exact(bits) => write!(f, "{bits}"),
            Literal::Code { names, code } => write!(f, "{}::{}", names.of, names.name(*code).unwrap_or("?")),
        }
    }
}

impl Value {
    /// The operand with the width and the lanes of `left`, for `operator`.
    #[track_caller]
    pub(crate) fn like(self, left: Signal, operator: &str) -> Signal {
        self.with_width_of(left, operator).with_lanes_of(left, operator)
    }

    /// The operand with the width of `left`, for `operator`.
    #[track_caller]
    pub(crate) fn with_width_of(self, left: Signal, operator: &str) -> Signal {
        let loc = Loc::caller();
        let right = match self.cut_to(left.width) {
            Value::Literal(literal) => return literal.for_signal(left, operator),
            Value::Signal(right) | Value::Low(right) if right.width == left.width => {
                return right.of_kind_of(left, operator);
            }
            Value::Signal(right) | Value::Low(right) => right,
        };
        let (left_id, right_id) = (left.id(), right.id());
        elaboration::with(|e| {
            let problem = width_mismatch(e.draft(), operator, left_id, right_id, loc);
            e.report_instead_of(&[left_id, right_id], problem);
            Signal::zero_in(e, left.width, right.shape, left.kind, loc)
        })
    }
}

fn width_mismatch(draft: &Draft, operator: &str, left: NodeId, right: NodeId, loc: Loc) -> Problem {
    let (l, r) = (draft.node(left), draft.node(right));
    let (left_text, right_text) = (draft.describe(left), draft.describe(right));
    let (wide, narrow) = (l.width.max(r.width), l.width.min(r.width));
    Problem::new(
        Mistake::UnequalWidths,
        loc,
        format!(
            "`{operator}` needs equal widths: `{left_text}` has {}, `{right_text}` has {}",
            bits_text(l.width),
            bits_text(r.width)
        ),
    )
    .note(format!("`{left_text}` is made"), l.loc)
    .note(format!("`{right_text}` is made"), r.loc)
    .help(format!(
        "widen the narrow side with `.zext({wide})` or `.sext({wide})`, or cut the wide one with `.trunc({narrow})`"
    ))
}

macro_rules! integers {
    ($($ty:ty)*) => {$(
        impl Operand for $ty {
            fn operand(self) -> Value {
                Value::Literal(Literal::Integer(self as i128, Radix::Any))
            }
        }
    )*};
}
for_integers!(integers);
integers!(bool);

macro_rules! binary_operators {
    ($ty:ty: $($trait:ident $method:ident $op:ident),*) => {$(
        impl<R: $crate::operand::Operand> std::ops::$trait<R> for $ty {
            type Output = $crate::Signal;
            #[track_caller]
            fn $method(self, right: R) -> $crate::Signal {
                $crate::Signal::from(self).binary($crate::ir::Binary::$op, right)
            }
        }
    )*};
}

/// The right operand of `<<` and `>>`: a constant, which costs nothing, or a signal, which makes a shifter.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// let mask = lit(8, 0b0000_0011);
/// m.assert((mask << 4).eq(0b0011_0000), "by a constant, which is wiring");
/// m.assert((mask << lit(4, 9)).eq(0), "by a signal of any width; a shift by the width or more leaves nothing");
/// # });
/// ```
pub trait ShiftAmount {
    #[doc(hidden)]
    fn shift(self, operand: Signal, shift: Shift) -> Signal;
}

macro_rules! constant_shift_amounts {
    ($($ty:ty)*) => {$(
        impl ShiftAmount for $ty {
            #[track_caller]
            fn shift(self, operand: Signal, shift: Shift) -> $crate::Signal {
                let amount = self.integer();
                if amount < 0 {
                    let message = format!("a shift by {amount} bits");
                    elaboration::mistake(Mistake::NegativeShift, message, "an amount must be 0 or more");
                }
                operand.shift_by(shift, u32::try_from(amount).unwrap_or(u32::MAX))
            }
        }
    )*};
}
for_integers!(constant_shift_amounts);

macro_rules! operators {
    ($ty:ty) => {
        $crate::operand::binary_operators!($ty: Add add Add, Sub sub Sub, BitAnd bitand And, BitOr bitor Or, BitXor bitxor Xor);

        /// Every bit inverted.
        impl std::ops::Not for $ty {
            type Output = $crate::Signal;
            #[track_caller]
            fn not(self) -> $crate::Signal {
                $crate::Signal::from(self).inverted()
            }
        }

        /// The product, in two's complement if both are signed. Its width is the sum of the operands' widths; an
        /// integer has the fewest bits that can represent it.
        impl<R: $crate::operand::Operand> std::ops::Mul<R> for $ty {
            type Output = $crate::Signal;
            #[track_caller]
            fn mul(self, right: R) -> $crate::Signal {
                $crate::Signal::from(self).times_any(right)
            }
        }

        /// Shifts towards the most significant bit and fills with zeros.
        impl<R: $crate::operand::ShiftAmount> std::ops::Shl<R> for $ty {
            type Output = $crate::Signal;
            #[track_caller]
            fn shl(self, amount: R) -> $crate::Signal {
                amount.shift($crate::Signal::from(self), $crate::ir::Shift::Left)
            }
        }

        /// Shifts towards the least significant bit; fills with zeros, or with the sign bit if the signal is signed.
        impl<R: $crate::operand::ShiftAmount> std::ops::Shr<R> for $ty {
            type Output = $crate::Signal;
            #[track_caller]
            fn shr(self, amount: R) -> $crate::Signal {
                let signal = $crate::Signal::from(self);
                amount.shift(signal, signal.kind.right_shift())
            }
        }

        /// The negative of a signed value, modulo 2 to the width.
        impl std::ops::Neg for $ty {
            type Output = $crate::Signal;
            #[track_caller]
            fn neg(self) -> $crate::Signal {
                $crate::Signal::from(self).negative()
            }
        }
    };
}

macro_rules! reads_as_signal {
    ($ty:ty) => {
        impl From<$ty> for $crate::Signal {
            fn from(handle: $ty) -> $crate::Signal {
                *handle
            }
        }

        impl $crate::operand::IntoSignal for $ty {}

        impl $crate::operand::Operand for $ty {
            fn operand(self) -> $crate::operand::Value {
                $crate::operand::Value::Signal(*self)
            }
        }

        impl $crate::operand::ShiftAmount for $ty {
            #[track_caller]
            fn shift(self, operand: $crate::Signal, shift: $crate::ir::Shift) -> $crate::Signal {
                operand.shift(shift, *self)
            }
        }
    };
}

pub(crate) use {binary_operators, operators, reads_as_signal};

impl Operand for Bits {
    fn operand(self) -> Value {
        Value::Literal(Literal::Exact(self))
    }
}
