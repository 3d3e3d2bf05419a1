//! The forms of a value, and the steps from one to another.

use crate::engine::strips::Value;

/// What is known of the bits of an element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::engine::emit) enum Form {
    /// All bits are equal.
    Mask,
    /// A number of this many bits in two's complement: the bits above equal its sign.
    Signed(u32),
    /// The bits from this one up are zero.
    Bits(u32),
}

impl Form {
    /// The form of a two's complement number, if it says anything.
    pub(super) fn signed(bits: u32, element: u32) -> Form {
        match bits {
            1 => Form::Mask,
            _ if bits < element => Form::Signed(bits),
            _ => Form::Bits(element),
        }
    }

    /// Bits that may be set.
    pub(super) fn bits(self, element: u32) -> u32 {
        match self {
            Form::Bits(bits) => bits.min(element),
            _ => element,
        }
    }

    /// Bits of the number in two's complement.
    pub(super) fn signed_bits(self, element: u32) -> u32 {
        match self {
            Form::Mask => 1,
            Form::Signed(bits) => bits.min(element),
            Form::Bits(bits) => (bits + 1).min(element),
        }
    }

    /// What is known of bits taken from either.
    pub(super) fn or(self, other: Form, element: u32) -> Form {
        match (self, other) {
            (Form::Bits(a), Form::Bits(b)) => Form::Bits(a.max(b)),
            _ => Form::signed(self.signed_bits(element).max(other.signed_bits(element)), element),
        }
    }

    /// What is known of bits that are set in both.
    pub(super) fn and(self, other: Form, element: u32) -> Form {
        match (self, other) {
            (Form::Bits(a), Form::Bits(b)) => Form::Bits(a.min(b)),
            (Form::Bits(a), _) | (_, Form::Bits(a)) => Form::Bits(a),
            _ => self.or(other, element),
        }
    }

    /// The same bits, shifted up.
    pub(super) fn up(self, by: u32, element: u32) -> Form {
        match self {
            Form::Bits(0) => self,
            Form::Bits(bits) => Form::Bits((bits + by).min(element)),
            _ => Form::signed(self.signed_bits(element) + by, element),
        }
    }
}

/// A value in all lanes of a strip.
#[derive(Debug, Clone)]
pub(in crate::engine::emit) struct Vector {
    /// The significant bits.
    pub width: u32,
    /// Bits of a lane: 8, 16, 32 or 64.
    pub element: u32,
    /// What is known of their bits.
    pub form: Form,
    /// The vectors, the lowest lanes first.
    pub parts: Vec<Value>,
    /// For a mask: `parts` are `bnot` of these.
    pub inverse: Option<Vec<Value>>,
}

impl Vector {
    /// Whether it is the constant zero.
    pub(super) fn is_zero(&self) -> bool {
        self.form == Form::Bits(0)
    }
}

/// The requirement of an operation on the bits above the width.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Need {
    /// None.
    Any,
    /// They are zero.
    Clean,
    /// They equal the sign; 1-bit values become masks.
    Signed,
}

impl Need {
    /// The requirement of bitwise operations: masks for 1 bit.
    pub(super) fn of(width: u32) -> Need {
        if width == 1 { Need::Signed } else { Need::Any }
    }

    pub(super) fn met(self, form: Form, width: u32, element: u32) -> bool {
        match self {
            Need::Any => true,
            Need::Clean => form.bits(element) <= width,
            Need::Signed => form.signed_bits(element) <= width,
        }
    }
}

/// A step of a conversion between forms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    /// To the element of twice the size: each element doubled.
    Double,
    /// With zeros above.
    Widen,
    /// With the sign above.
    WidenSigned,
    /// From 64 to 32 bits, whatever the upper bits are.
    Cut,
    /// To half the size; zeros above.
    Narrow,
    /// To half the size; the sign above.
    NarrowSigned,
    /// Zeros the bits above the width.
    Clean,
    /// Repeats the sign above the width.
    SignExtend,
}

impl Step {
    /// The number of instructions for this number of parts of the larger element.
    pub(super) fn cost(self, parts: u32, element: u32) -> u32 {
        match self {
            Step::Double | Step::Widen | Step::Clean => parts,
            Step::WidenSigned => parts + parts / 2,
            Step::Cut | Step::Narrow | Step::NarrowSigned => parts / 2,
            Step::SignExtend if matches!(element, 16 | 32) => 2 * parts,
            Step::SignExtend => 3 * parts,
        }
    }
}

/// The next step to an element and a need, and the form after it.
pub(super) fn next(form: Form, width: u32, at: u32, to: u32, need: Need) -> Option<(Step, Form, u32)> {
    let clean = (Step::Clean, Form::Bits(width.min(form.bits(at))), at);
    let extend = (Step::SignExtend, Form::signed(width, at), at);
    if at < to {
        return Some(match (need, form) {
            (Need::Clean, _) if !need.met(form, width, at) => clean,
            (Need::Signed, _) if !need.met(form, width, at) => extend,
            (Need::Any | Need::Signed, Form::Mask) => (Step::Double, form, at * 2),
            (Need::Signed, Form::Signed(_)) => (Step::WidenSigned, form, at * 2),
            // At the full width of the element it was both clean and signed; it cannot be both in the next.
            (Need::Signed, Form::Bits(bits)) if bits >= width => {
                (Step::WidenSigned, Form::signed(width, at * 2), at * 2)
            }
            _ => (Step::Widen, Form::Bits(form.bits(at)), at * 2),
        });
    }
    if at > to {
        let half = at / 2;
        return Some(match form {
            Form::Mask => (if at == 64 { Step::Cut } else { Step::NarrowSigned }, form, half),
            _ if at == 64 => {
                let cut = match form {
                    Form::Bits(bits) => Form::Bits(bits.min(half)),
                    _ => Form::signed(form.signed_bits(at), half),
                };
                (Step::Cut, cut, half)
            }
            Form::Signed(bits) if bits <= half => (Step::NarrowSigned, Form::signed(bits, half), half),
            Form::Bits(bits) if bits <= half => (Step::Narrow, form, half),
            _ => clean,
        });
    }
    match need {
        _ if need.met(form, width, at) => None,
        Need::Signed => Some(extend),
        _ => Some(clean),
    }
}
