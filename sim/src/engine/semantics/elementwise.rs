//! The result of one lane of an elementwise operation, for any widths.

use std::cmp::Ordering;

use tilewright_circuit::ir::{Binary, Relation, Shift, Unary};
use tilewright_circuit::top_mask;

use super::Number;
use crate::engine::program::{Kind, Lowered, ValueId};
use crate::limbs;

impl Number<'_> {
    fn is_one(&self) -> bool {
        self.limbs[0] & 1 == 1
    }

    fn sign(&self) -> bool {
        limbs::bit(self.limbs, self.width - 1)
    }

    /// The value, or `limit` if it is that or more.
    pub(super) fn at_most(&self, limit: u32) -> u32 {
        match self.limbs[1..].iter().all(|&limb| limb == 0) {
            true => self.limbs[0].min(u64::from(limit)) as u32,
            false => limit,
        }
    }
}

/// Computes one lane of `kind`, which is elementwise, into `out`, a value of `width` bits.
pub(super) fn evaluate<'a>(kind: &Kind, width: u32, out: &mut [u64], operand: impl Fn(ValueId) -> Number<'a>) {
    let at = |id: &ValueId| operand(*id);
    out.fill(0);
    match kind {
        Kind::Unary(op, a) => unary(*op, out, at(a)),
        Kind::Binary(op, a, b) => binary(*op, width, out, at(a), at(b)),
        Kind::Compare(relation, signed, a, b) => out[0] = u64::from(holds(*relation, order(*signed, at(a), at(b)))),
        Kind::Shift(op, a, by) => shift(*op, out, at(a), at(by)),
        Kind::Mux { select, on_true, on_false } => {
            out.copy_from_slice(if at(select).is_one() { at(on_true) } else { at(on_false) }.limbs);
        }
        Kind::Select { arms, default } => {
            let taken = arms.iter().find(|(condition, _)| at(condition).is_one());
            out.copy_from_slice(at(taken.map_or(default, |(_, value)| value)).limbs);
        }
        Kind::Case { subject, arms, default } => {
            let subject = at(subject);
            let taken = arms.iter().find(|(key, _)| key.limbs() == subject.limbs);
            out.copy_from_slice(at(taken.map_or(default, |(_, value)| value)).limbs);
        }
        Kind::Slice(of, low) => limbs::copy(out, 0, at(of).limbs, *low, width),
        Kind::Concat(parts) => {
            let mut low = 0;
            for part in parts.iter().rev().map(at) {
                limbs::copy(out, low, part.limbs, 0, part.width);
                low += part.width;
            }
        }
        Kind::Repeat(of, times) => {
            let of = at(of);
            (0..*times).for_each(|i| limbs::copy(out, i * of.width, of.limbs, 0, of.width));
        }
        Kind::Extend(of, signed) => extend(out, at(of), *signed, width),
        Kind::Lowered(Lowered::Assemble { of, pieces }) => {
            let (of, mut low) = (of.iter().map(at).collect::<Vec<_>>(), 0);
            for piece in pieces {
                limbs::copy(out, low, of[piece.of as usize].limbs, piece.low, piece.width);
                low += piece.width;
            }
        }
        Kind::Lowered(Lowered::Rotate { of, left }) => {
            let (of, left) = (at(of), left % width);
            limbs::copy(out, left, of.limbs, 0, width - left);
            limbs::copy(out, 0, of.limbs, width - left, left);
        }
        _ => unreachable!("not an elementwise operation: {kind:?}"),
    }
    *out.last_mut().expect("a value has a limb") &= top_mask(width);
}

fn unary(op: Unary, out: &mut [u64], a: Number) {
    let ones = || a.limbs.iter().map(|limb| limb.count_ones()).sum::<u32>();
    match op {
        Unary::Not => out.iter_mut().zip(a.limbs).for_each(|(out, a)| *out = !a),
        Unary::AllOnes => out[0] = u64::from(ones() == a.width),
        Unary::AnyOne => out[0] = u64::from(ones() > 0),
        Unary::Parity => out[0] = u64::from(ones() % 2),
    }
}

fn binary(op: Binary, width: u32, out: &mut [u64], a: Number, b: Number) {
    let bitwise = |out: &mut [u64], combine: fn(u64, u64) -> u64| {
        out.iter_mut().zip(a.limbs.iter().zip(b.limbs)).for_each(|(out, (a, b))| *out = combine(*a, *b));
    };
    match op {
        Binary::And => bitwise(out, |a, b| a & b),
        Binary::Or => bitwise(out, |a, b| a | b),
        Binary::Xor => bitwise(out, |a, b| a ^ b),
        Binary::Add => limbs::add(out, a.limbs, b.limbs, false),
        Binary::Sub => limbs::add(out, a.limbs, b.limbs, true),
        Binary::Mul => limbs::multiply(out, a.limbs, b.limbs),
        Binary::MulSigned => {
            let extended = |number| {
                let mut wide = vec![0; out.len()];
                extend(&mut wide, number, true, width);
                wide
            };
            let (a, b) = (extended(a), extended(b));
            limbs::multiply(out, &a, &b);
        }
    }
}

fn order(signed: bool, a: Number, b: Number) -> Ordering {
    match signed && a.sign() != b.sign() {
        true => b.sign().cmp(&a.sign()),
        false => limbs::compare(a.limbs, b.limbs),
    }
}

/// Whether operands that compare in this way are in that relation.
fn holds(relation: Relation, order: Ordering) -> bool {
    match relation {
        Relation::Eq => order.is_eq(),
        Relation::Ne => order.is_ne(),
        Relation::Lt => order.is_lt(),
        Relation::Le => order.is_le(),
        Relation::Gt => order.is_gt(),
        Relation::Ge => order.is_ge(),
    }
}

fn shift(op: Shift, out: &mut [u64], a: Number, by: Number) {
    let by = by.at_most(a.width);
    let kept = a.width - by;
    match op {
        Shift::Left => limbs::copy(out, by, a.limbs, 0, kept),
        Shift::Right | Shift::RightSigned => limbs::copy(out, 0, a.limbs, by, kept),
    }
    if op == Shift::RightSigned && a.sign() {
        limbs::set(out, kept, a.width);
    }
}

fn extend(out: &mut [u64], a: Number, signed: bool, width: u32) {
    limbs::copy(out, 0, a.limbs, 0, a.width);
    if signed && a.sign() {
        limbs::set(out, a.width, width);
    }
}
