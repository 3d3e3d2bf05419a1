//! Operations on values of up to 64 bits.

use tilewright_circuit::ir::{Binary, Relation, Shift, Unary};
use tilewright_circuit::{Bits, top_mask};

use super::{Scalar, Scalars};
use crate::engine::program::{Kind, ValueId};
use crate::engine::strips::{Builder, Comparison, Type, Value};

impl Scalars {
    /// The result of `kind` with operands and result of up to 64 bits.
    pub(super) fn narrow(&mut self, b: &mut Builder, kind: &Kind, width: u32) -> Scalar {
        match kind {
            Kind::Alias(of) => self.values[of].clone(),
            Kind::Unary(op, a) => self.unary(b, *op, *a),
            Kind::Binary(op, x, y) => self.binary(b, *op, *x, *y, width),
            Kind::Compare(relation, signed, x, y) => self.compare(b, *relation, *signed, *x, *y),
            Kind::Shift(op, x, by) => self.shift(b, *op, *x, *by, width),
            Kind::Mux { select, on_true, on_false } => {
                let select = self.flag(b, *select);
                let otherwise = self.values[on_false].clone();
                self.choose(b, select, *on_true, otherwise, width)
            }
            Kind::Select { arms, default } => {
                let start = self.values[default].clone();
                arms.iter().rev().fold(start, |otherwise, (condition, value)| {
                    let select = self.flag(b, *condition);
                    self.choose(b, select, *value, otherwise, width)
                })
            }
            Kind::Case { subject, arms, default } => self.case(b, *subject, arms, *default, width),
            Kind::Slice(of, low) => self.slice(b, *of, *low, width),
            Kind::Concat(parts) => self.concat(b, parts, width),
            Kind::Repeat(of, times) => self.repeat(b, *of, *times, width),
            Kind::Extend(of, false) => {
                let (low, from) = (self.low(b, *of), self.width(*of));
                Scalar::integer(width, low, from)
            }
            Kind::Extend(of, true) => Scalar::integer(width, self.signed(b, *of), 64),
            _ => unreachable!("not an elementwise operation: {kind:?}"),
        }
    }

    fn unary(&mut self, b: &mut Builder, op: Unary, a: ValueId) -> Scalar {
        let width = self.width(a);
        let number = |b: &mut Builder, n: u64| b.constant(Type::I64, n as i64);
        match op {
            Unary::Not if width == 1 => {
                let flag = self.flag(b, a);
                let one = b.constant(Type::I8, 1);
                Scalar::flag(b.xor(flag, one))
            }
            Unary::Not => {
                let integer = self.integer(b, a);
                Scalar::integer(width, b.not(integer), 64)
            }
            Unary::AllOnes => {
                let (low, ones) = (self.low(b, a), number(b, top_mask(width)));
                Scalars::test(b, Comparison::Equal, low, ones)
            }
            Unary::AnyOne => {
                let (low, zero) = (self.low(b, a), number(b, 0));
                Scalars::test(b, Comparison::NotEqual, low, zero)
            }
            Unary::Parity => {
                let low = self.low(b, a);
                let ones = b.count_ones(low);
                Scalar::integer(1, ones, 7)
            }
        }
    }

    fn binary(&mut self, b: &mut Builder, op: Binary, x: ValueId, y: ValueId, width: u32) -> Scalar {
        let is_flag = |scalar: &Scalar| scalar.flag.is_some();
        if width == 1 && (is_flag(&self.values[&x]) || is_flag(&self.values[&y])) {
            let (left, right) = (self.flag(b, x), self.flag(b, y));
            let flag = match op {
                Binary::And | Binary::Mul | Binary::MulSigned => b.and(left, right),
                Binary::Or => b.or(left, right),
                Binary::Xor | Binary::Add | Binary::Sub => b.xor(left, right),
            };
            return Scalar::flag(flag);
        }
        if op == Binary::MulSigned {
            let (left, right) = (self.signed(b, x), self.signed(b, y));
            return Scalar::integer(width, b.mul(left, right), 64);
        }
        if op == Binary::Mul {
            let (left, right) = (self.low(b, x), self.low(b, y));
            return Scalar::integer(width, b.mul(left, right), width);
        }
        let (left, right) = (self.integer(b, x), self.integer(b, y));
        let (least, most) = (self.bound(x).min(self.bound(y)), self.bound(x).max(self.bound(y)));
        match op {
            Binary::And => Scalar::integer(width, b.and(left, right), least),
            Binary::Or => Scalar::integer(width, b.or(left, right), most),
            Binary::Xor => Scalar::integer(width, b.xor(left, right), most),
            Binary::Add => Scalar::integer(width, b.add(left, right), most + 1),
            Binary::Sub | Binary::Mul | Binary::MulSigned => Scalar::integer(width, b.sub(left, right), 64),
        }
    }

    fn compare(&mut self, b: &mut Builder, relation: Relation, signed: bool, x: ValueId, y: ValueId) -> Scalar {
        let code = match (relation, signed) {
            (Relation::Eq, _) => Comparison::Equal,
            (Relation::Ne, _) => Comparison::NotEqual,
            (Relation::Lt, false) => Comparison::UnsignedLessThan,
            (Relation::Le, false) => Comparison::UnsignedLessThanOrEqual,
            (Relation::Gt, false) => Comparison::UnsignedGreaterThan,
            (Relation::Ge, false) => Comparison::UnsignedGreaterThanOrEqual,
            (Relation::Lt, true) => Comparison::SignedLessThan,
            (Relation::Le, true) => Comparison::SignedLessThanOrEqual,
            (Relation::Gt, true) => Comparison::SignedGreaterThan,
            (Relation::Ge, true) => Comparison::SignedGreaterThanOrEqual,
        };
        let width = self.width(x);
        let by_order = signed && !matches!(relation, Relation::Eq | Relation::Ne);
        let (left, right) = match width {
            // The machine compares these without their upper bits.
            8 | 16 | 32 => {
                let kind = Type::integer(width);
                let (left, right) = (self.integer(b, x), self.integer(b, y));
                (b.truncate(kind, left), b.truncate(kind, right))
            }
            _ if by_order => (self.signed(b, x), self.signed(b, y)),
            _ => (self.low(b, x), self.low(b, y)),
        };
        Scalars::test(b, code, left, right)
    }

    fn shift(&mut self, b: &mut Builder, op: Shift, x: ValueId, by: ValueId, width: u32) -> Scalar {
        let amount = self.low(b, by);
        let known = self.values[&by].known;
        let small = self.width(by) <= 6 || known.is_some_and(|amount| amount < 64);
        let limit = b.constant(Type::I64, 63);
        if op == Shift::RightSigned {
            let value = self.signed(b, x);
            let amount = if small { amount } else { b.min(amount, limit) };
            return Scalar::integer(width, b.sar(value, amount), 64);
        }
        let (shifted, bound) = match op {
            Shift::Left => {
                let value = self.integer(b, x);
                let bound = known.map_or(64, |amount| u64::from(self.bound(x)).saturating_add(amount).min(64) as u32);
                (b.shl(value, amount), bound)
            }
            _ => {
                let value = self.low(b, x);
                (b.shr(value, amount), width)
            }
        };
        if small {
            return Scalar::integer(width, shifted, bound);
        }
        let fits = b.compare(Comparison::UnsignedLessThanOrEqual, amount, limit);
        let zero = b.constant(Type::I64, 0);
        Scalar::integer(width, b.select(fits, shifted, zero), bound)
    }

    /// `value` if the flag is 1.
    fn choose(&mut self, b: &mut Builder, select: Value, value: ValueId, otherwise: Scalar, width: u32) -> Scalar {
        if width == 1
            && let (Some(left), Some(right)) = (self.values[&value].flag, otherwise.flag)
        {
            return Scalar::flag(b.select(select, left, right));
        }
        let (left, bound) = (self.integer(b, value), self.bound(value).max(otherwise.bound));
        let right = match (otherwise.integer, otherwise.flag) {
            (Some(integer), _) => integer,
            (None, flag) => b.zero_extend(Type::I64, flag.expect("an integer or a flag")),
        };
        Scalar::integer(width, b.select(select, left, right), bound)
    }

    fn case(
        &mut self,
        b: &mut Builder,
        subject: ValueId,
        arms: &[(Bits, ValueId)],
        default: ValueId,
        width: u32,
    ) -> Scalar {
        let subject = self.low(b, subject);
        let start = self.values[&default].clone();
        arms.iter().rev().fold(start, |otherwise, (key, value)| {
            let key = b.constant(Type::I64, key.limbs()[0] as i64);
            let select = b.compare(Comparison::Equal, subject, key);
            self.choose(b, select, *value, otherwise, width)
        })
    }

    fn slice(&mut self, b: &mut Builder, of: ValueId, low: u32, width: u32) -> Scalar {
        let integer = self.integer(b, of);
        let bound = self.bound(of).saturating_sub(low).max(1);
        if low == 0 {
            return Scalar::integer(width, integer, bound);
        }
        let low = b.constant(Type::I64, i64::from(low));
        Scalar::integer(width, b.shr(integer, low), bound)
    }

    fn concat(&mut self, b: &mut Builder, parts: &[ValueId], width: u32) -> Scalar {
        let (mut whole, mut low) = (None, 0);
        for (i, &part) in parts.iter().rev().enumerate() {
            let place = low;
            low += self.width(part);
            if self.values[&part].known == Some(0) {
                continue;
            }
            let top = i + 1 == parts.len();
            let value = if top { self.integer(b, part) } else { self.low(b, part) };
            let bound = self.bound(part) + place;
            let moved = match place {
                0 => value,
                _ => {
                    let place = b.constant(Type::I64, i64::from(place));
                    b.shl(value, place)
                }
            };
            whole = Some(match whole {
                None => (moved, bound),
                Some((whole, before)) => (b.or(whole, moved), bound.max(before)),
            });
        }
        match whole {
            Some((whole, bound)) => Scalar::integer(width, whole, bound),
            None => Scalar::integer(width, b.constant(Type::I64, 0), 1),
        }
    }

    fn repeat(&mut self, b: &mut Builder, of: ValueId, times: u32, width: u32) -> Scalar {
        let (value, each) = (self.low(b, of), self.width(of));
        if each == 1 {
            return Scalar::integer(width, b.neg(value), 64);
        }
        let ones = (0..times).fold(0u64, |ones, i| ones | 1 << (i * each));
        let ones = b.constant(Type::I64, ones as i64);
        Scalar::integer(width, b.mul(value, ones), width)
    }

    /// A value in two's complement, sign-extended to 64 bits.
    fn signed(&mut self, b: &mut Builder, of: ValueId) -> Value {
        let (integer, width) = (self.integer(b, of), self.width(of));
        match width {
            64 => integer,
            8 | 16 | 32 => {
                let kind = Type::integer(width);
                let narrow = b.truncate(kind, integer);
                b.sign_extend(Type::I64, narrow)
            }
            _ => {
                let up = b.constant(Type::I64, i64::from(64 - width));
                let top = b.shl(integer, up);
                b.sar(top, up)
            }
        }
    }
}
