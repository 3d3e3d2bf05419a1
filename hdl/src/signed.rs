//! Signed values: signals in two's complement, which do not mix with unsigned ones.

use crate::elaboration;
use crate::names::bits_text;
use crate::operand::Literal;
use crate::signal::Signal;
use crate::{Bits, Width};
use tilewright_circuit::ir::{Binary, Kind, NodeId, Op, Shape};
use tilewright_circuit::{Loc, Mistake, Problem, Radix};

/// The conversions between the two kinds.
pub(crate) const READ_AS: &str =
    "`.signed()` reads bits in two's complement, `.code::<Enum>()` as a code, `.bits()` as a number";

impl Width {
    /// A signed width, in two's complement: `m.reg("x", bits(12).signed())`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// def!(height = m.reg(bits(8).signed()).reset(-3));
    /// height.next(height + 1);
    /// m.assert(height.lt(-3).implies(height.is_negative()), "compared in two's complement");
    /// # });
    /// ```
    pub fn signed(self) -> Width {
        Width { kind: Kind::Signed, ..self }
    }
}

impl Signal {
    /// The same bits read in two's complement. `+ - *`, comparisons, `>>` and integers are signed then, and so are
    /// the results. Either both operands of an operator are signed or neither is.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let ones = lit(8, 0xff);
    /// m.assert(ones.gt(0), "255, ..");
    /// m.assert(ones.signed().lt(0), ".. and -1 in two's complement");
    /// m.assert((ones.signed() >> 4).eq(-1), "shifted with its sign");
    /// # });
    /// ```
    pub fn signed(self) -> Signal {
        Signal { kind: Kind::Signed, ..self }
    }

    /// Whether the bits are read in two's complement, which is known while the block is built.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// /// One bit more, with the same value.
    /// fn wider(number: Signal) -> Signal {
    ///     let width = number.width() + 1;
    ///     if number.is_signed() { number.sext(width) } else { number.zext(width) }
    /// }
    ///
    /// m.assert(wider(lit(4, 0xf)).eq(15), "unsigned, ..");
    /// m.assert(wider(lit(4, 0xf).signed()).eq(-1), ".. and signed");
    /// # });
    /// ```
    pub fn is_signed(self) -> bool {
        self.kind == Kind::Signed
    }

    /// The same bits read as an unsigned number.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let depth = lit(8, 0x80).signed();
    /// m.assert(depth.bits().zext(12).eq(0x80), "only an unsigned number is extended with zeros");
    /// m.assert(depth.sext(12).bits().eq(0xf80), "a signed one is extended with its sign");
    /// # });
    /// ```
    pub fn bits(self) -> Signal {
        Signal { kind: Kind::Number, ..self }
    }

    /// The sign bit of a signed value: 1 if it is negative.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let difference = lit(8, 3).signed() - lit(8, 5).signed();
    /// m.assert(difference.is_negative() & !(-difference).is_negative(), "-2, and 2");
    /// # });
    /// ```
    #[track_caller]
    pub fn is_negative(self) -> Signal {
        self.msb()
    }

    #[track_caller]
    pub(crate) fn negative(self) -> Signal {
        if self.kind != Kind::Signed {
            let (loc, id) = (Loc::caller(), self.id());
            return elaboration::with(|e| {
                let text = e.draft().describe(id);
                let problem = Problem::new(
                    Mistake::UnsignedMinus,
                    loc,
                    format!("`-` makes a negative number, but `{text}` is not signed"),
                );
                e.report_instead_of(&[id], problem.help("`.signed()` reads it in two's complement"));
                Signal::zero_in(e, self.width, self.shape, Kind::Signed, loc)
            });
        }
        Literal::Integer(0, Radix::Any).for_signal(self, "-").binary(Binary::Sub, self)
    }

    /// The signal, which must have the kind of `left` in `operator`; otherwise a problem.
    #[track_caller]
    pub(crate) fn of_kind_of(self, left: Signal, operator: &str) -> Signal {
        if self.kind == left.kind {
            return self;
        }
        let (loc, left_id, right_id) = (Loc::caller(), left.id(), self.id());
        elaboration::with(|e| {
            let draft = e.draft();
            let (left_text, right_text) = (draft.describe(left_id), draft.describe(right_id));
            let message = format!("`{operator}` mixes `{left_text}`, {}, and `{right_text}`, {}", left.kind, self.kind);
            let problem = Problem::new(Mistake::MixedKinds, loc, message)
                .note(format!("`{left_text}` is made"), draft.node(left_id).loc)
                .note(format!("`{right_text}` is made"), draft.node(right_id).loc)
                .help(READ_AS);
            e.report_instead_of(&[left_id, right_id], problem);
            Signal::zero_in(e, self.width, self.shape, left.kind, loc)
        })
    }
}

impl Literal {
    /// The literal as wide as `left`, for `operator`; a problem if it is not of the kind of `left`.
    #[track_caller]
    pub(crate) fn for_signal(self, left: Signal, operator: &str) -> Signal {
        let fits = match (&self, left.kind) {
            (Literal::Code { names, .. }, kind) => kind == Kind::Code(*names),
            (Literal::Integer(..), Kind::Code(_)) => false,
            _ => true,
        };
        if fits {
            return self.sized_beside(Some(left), left.width, left.kind);
        }
        let (loc, id) = (Loc::caller(), left.id());
        elaboration::with(|e| {
            let text = e.draft().describe(id);
            let message = format!("`{operator}` mixes `{text}`, {}, and `{self}`", left.kind);
            let problem = Problem::new(Mistake::MixedKinds, loc, message).help(match left.kind {
                Kind::Code(_) => "name one of its codes, or read its bits as a number, by `.bits()`",
                _ => "`.code::<Enum>()` reads bits as a code of an enum",
            });
            e.report_instead_of(&[id], problem);
            Signal::zero_in(e, left.width, Shape::Plain, left.kind, loc)
        })
    }

    /// Its bits, truncated to `width`, and whether that loses nothing.
    pub(crate) fn bits(&self, width: u32, kind: Kind) -> (Bits, bool) {
        match self {
            Literal::Exact(bits) => (bits.resize(width), bits.width() == width),
            Literal::Code { code, .. } => (Bits::new(width, *code), true),
            Literal::Integer(value, radix) => {
                let bits = Bits::from_i128(width, *value).shown_in(*radix);
                let signed = kind == Kind::Signed;
                let back = if signed { bits.to_i128() } else { bits.to_u128().and_then(|v| v.try_into().ok()) };
                (bits, back == Some(*value))
            }
        }
    }

    /// The literal in `width` bits; a problem if it does not fit.
    #[track_caller]
    pub(crate) fn sized(self, width: u32, kind: Kind) -> Signal {
        self.sized_beside(None, width, kind)
    }

    /// Like [`Literal::sized`], with the operand that gives the width.
    #[track_caller]
    fn sized_beside(self, left: Option<Signal>, width: u32, kind: Kind) -> Signal {
        let loc = Loc::caller();
        let (bits, fits) = self.bits(width, kind);
        if fits {
            return elaboration::with(|e| {
                Signal::make_in(e, Op::Const(bits), width, Shape::Plain, loc).kept_in(e, kind)
            });
        }
        let operands: Vec<NodeId> = left.into_iter().map(|left| left.id_at(loc)).collect();
        let sign = if kind == Kind::Signed { "signed" } else { "unsigned" };
        let problem =
            Problem::new(Mistake::TooLarge, loc, format!("`{self}` does not fit in {}, {sign}", bits_text(width)));
        let help = match self {
            Literal::Integer(..=-1, _) if kind != Kind::Signed => {
                "subtract a positive number, or read the signal as signed, by `.signed()`"
            }
            _ => "an integer takes the width of the signal it meets",
        };
        elaboration::with(|e| {
            e.report_instead_of(&operands, problem.help(help));
            Signal::zero_in(e, width, Shape::Plain, kind, loc)
        })
    }
}
