//! Operators one of whose operands is a number of the description.

use super::expression::{binary, related};
use super::{Builder, narrow};
use crate::features::Feature;
use crate::spec::*;
use std::ops::{Add, BitAnd, BitOr, BitXor, Mul, Sub};
use tilewright_hdl::*;

/// The bits of a factor: a product with it is not much wider than the value.
const FACTOR: u32 = 12;

impl Builder<'_> {
    pub fn with_number(&mut self, d: usize, with: &WithNumber) -> Signal {
        let of = self.pick(d, with.of);
        let of = if with.op == NumberOp::Product { of.trunc(of.width().min(WIDEST - FACTOR)) } else { of };
        let width = if with.op == NumberOp::Product { FACTOR } else { of.width() };
        if with.signed {
            Feature::SignedNumber.used();
            // As many bits as an `i32` has, which stands on the left, too.
            let spare = 32 - width.min(32);
            let number = (with.number as i32) << spare >> spare;
            return with.put(of.signed(), number);
        }
        let number = Bits::new(width, with.number).limbs()[0];
        match with.radix {
            _ if with.on_left => with.put(of, number),
            Radix::Any => with.right(of, number),
            Radix::Hex => {
                Feature::Hex.used();
                with.right(of, hex(number))
            }
            Radix::Binary => {
                Feature::Binary.used();
                with.right(of, tilewright_hdl::binary(number))
            }
        }
    }
}

impl WithNumber {
    /// The number on the side that is drawn.
    fn put<N: Left>(&self, of: Signal, number: N) -> Signal {
        if self.on_left { self.left(of, number) } else { self.right(of, number) }
    }

    fn right(&self, of: Signal, number: impl Operand) -> Signal {
        match self.op {
            NumberOp::Binary(op) => narrow(binary(op, of, number)),
            NumberOp::Product => {
                Feature::ProductWithANumber.used();
                of * number
            }
            NumberOp::Compare(relation) => related(relation, of, number),
        }
    }

    fn left<N: Left>(&self, of: Signal, number: N) -> Signal {
        let result = match self.op {
            NumberOp::Binary(Binary::And) => number & of,
            NumberOp::Binary(Binary::Or) => number | of,
            NumberOp::Binary(Binary::Xor) => number ^ of,
            NumberOp::Binary(Binary::Add) => number + of,
            NumberOp::Binary(Binary::Sub) => number - of,
            NumberOp::Product => number * of,
            NumberOp::Binary(Binary::AddCarry) | NumberOp::Compare(_) => return self.right(of, number),
        };
        Feature::NumberOnTheLeft.used();
        result
    }
}

/// A number that the language takes as the operand on the left.
trait Left:
    Operand
    + Add<Signal, Output = Signal>
    + Sub<Signal, Output = Signal>
    + Mul<Signal, Output = Signal>
    + BitAnd<Signal, Output = Signal>
    + BitOr<Signal, Output = Signal>
    + BitXor<Signal, Output = Signal>
{
}

impl Left for i32 {}
impl Left for u64 {}
