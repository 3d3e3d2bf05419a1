//! Operations on values of up to 64 bits: one limb a lane, with the loop over lanes inside the choice of the
//! operation.

use tilewright_circuit::ir::{Binary, Reduction, Relation, Shift, Unary};
use tilewright_circuit::{Bits, top_mask};

use crate::engine::program::{Axis, Cell, Kind, Program, ValueId};
use crate::engine::semantics::{self, Number};

/// Computes `result` in all lanes.
pub(super) fn evaluate(program: &Program, cell: &Cell, result: ValueId, storage: &mut [u64]) {
    let kind = &cell.kind;
    let value = program.value(result);
    let (before, rest) = storage.split_at_mut(value.offset);
    let out = &mut rest[..value.lanes as usize];
    let before = &*before;
    let at = |id: &ValueId| &before[program.value(*id).range()];
    let width = |id: &ValueId| program.value(*id).width;
    let mask = top_mask(value.width);
    match kind {
        Kind::Alias(of) => out.copy_from_slice(at(of)),
        Kind::Unary(op, a) => unary(*op, out, at(a), top_mask(width(a))),
        Kind::Binary(Binary::MulSigned, a, b) => {
            let (wide_a, wide_b) = (width(a), width(b));
            map2(out, at(a), at(b), |a, b| (signed(a, wide_a).wrapping_mul(signed(b, wide_b)) as u64) & mask);
        }
        Kind::Binary(op, a, b) => binary(*op, out, at(a), at(b), mask),
        Kind::Compare(relation, is_signed, a, b) => {
            let flip = if *is_signed { 1 << (width(a) - 1) } else { 0 };
            compare(*relation, out, at(a), at(b), flip);
        }
        Kind::Shift(op, a, by) => shift(*op, out, at(a), at(by), value.width),
        Kind::Mux { select, on_true, on_false } => {
            let values = at(on_true).iter().zip(at(on_false));
            for ((out, select), (on_true, on_false)) in out.iter_mut().zip(at(select)).zip(values) {
                *out = choose(*select, *on_true, *on_false);
            }
        }
        Kind::Select { arms, default } => {
            out.copy_from_slice(at(default));
            for (condition, value) in arms.iter().rev() {
                for ((out, condition), value) in out.iter_mut().zip(at(condition)).zip(at(value)) {
                    *out = choose(*condition, *value, *out);
                }
            }
        }
        Kind::Case { subject, arms, default } => case(out, at(subject), arms, at(default), at),
        Kind::Slice(of, low) => map(out, at(of), |a| (a >> low) & mask),
        Kind::Concat(parts) => {
            out.fill(0);
            for part in parts {
                let width = width(part) % 64;
                out.iter_mut().zip(at(part)).for_each(|(out, part)| *out = *out << width | part);
            }
        }
        Kind::Repeat(of, times) => {
            let (of, width) = (at(of), width(of) % 64);
            out.copy_from_slice(of);
            (1..*times).for_each(|_| out.iter_mut().zip(of).for_each(|(out, of)| *out = *out << width | of));
        }
        Kind::Extend(of, false) => out.copy_from_slice(at(of)),
        Kind::Extend(of, true) => {
            let from = width(of);
            map(out, at(of), |a| signed(a, from) as u64 & mask);
        }
        Kind::Broadcast { of, axis: Axis { count, inner: 1 } } => {
            out.chunks_exact_mut(*count as usize).zip(at(of)).for_each(|(group, of)| group.fill(*of));
        }
        Kind::Broadcast { of, axis } if axis.lanes() == value.lanes => {
            let of = at(of);
            out.chunks_exact_mut(of.len()).for_each(|group| group.copy_from_slice(of));
        }
        Kind::Stack { parts, inner: 1 } => {
            for (i, part) in parts.iter().enumerate() {
                out.iter_mut().skip(i).step_by(parts.len()).zip(at(part)).for_each(|(out, part)| *out = *part);
            }
        }
        Kind::Lane { of, axis: Axis { count, inner: 1 }, index } => {
            let from = at(of).iter().skip(*index as usize).step_by(*count as usize);
            out.iter_mut().zip(from).for_each(|(out, of)| *out = *of);
        }
        Kind::Reduce { by, of, axis: Axis { count, inner: 1 } } => {
            reduce(*by, out, at(of), *count as usize, mask);
        }
        _ => {
            for (lane, out) in (0..).zip(out) {
                semantics::lane(cell, lane, std::slice::from_mut(out), |id, lane| {
                    let value = program.value(id);
                    Number { limbs: std::slice::from_ref(&before[value.offset + lane as usize]), width: value.width }
                });
            }
        }
    }
}

fn map(out: &mut [u64], a: &[u64], f: impl Fn(u64) -> u64) {
    out.iter_mut().zip(a).for_each(|(out, a)| *out = f(*a));
}

fn map2(out: &mut [u64], a: &[u64], b: &[u64], f: impl Fn(u64, u64) -> u64) {
    out.iter_mut().zip(a.iter().zip(b)).for_each(|(out, (a, b))| *out = f(*a, *b));
}

/// `on_true` where `select` is 1, `on_false` where it is 0, without a branch.
fn choose(select: u64, on_true: u64, on_false: u64) -> u64 {
    on_false ^ ((on_true ^ on_false) & select.wrapping_neg())
}

/// The number that `width` bits mean in two's complement.
fn signed(a: u64, width: u32) -> i64 {
    ((a << (64 - width)) as i64) >> (64 - width)
}

fn unary(op: Unary, out: &mut [u64], a: &[u64], ones: u64) {
    match op {
        Unary::Not => map(out, a, |a| !a & ones),
        Unary::AllOnes => map(out, a, |a| u64::from(a == ones)),
        Unary::AnyOne => map(out, a, |a| u64::from(a != 0)),
        Unary::Parity => map(out, a, |a| u64::from(a.count_ones() % 2)),
    }
}

fn binary(op: Binary, out: &mut [u64], a: &[u64], b: &[u64], mask: u64) {
    match op {
        Binary::And => map2(out, a, b, |a, b| a & b),
        Binary::Or => map2(out, a, b, |a, b| a | b),
        Binary::Xor => map2(out, a, b, |a, b| a ^ b),
        Binary::Add => map2(out, a, b, |a, b| a.wrapping_add(b) & mask),
        Binary::Sub => map2(out, a, b, |a, b| a.wrapping_sub(b) & mask),
        Binary::Mul | Binary::MulSigned => map2(out, a, b, |a, b| a.wrapping_mul(b) & mask),
    }
}

/// Flipping the sign bits makes signed comparisons unsigned ones.
fn compare(relation: Relation, out: &mut [u64], a: &[u64], b: &[u64], flip: u64) {
    match relation {
        Relation::Eq => map2(out, a, b, |a, b| u64::from(a == b)),
        Relation::Ne => map2(out, a, b, |a, b| u64::from(a != b)),
        Relation::Lt => map2(out, a, b, |a, b| u64::from(a ^ flip < b ^ flip)),
        Relation::Le => map2(out, a, b, |a, b| u64::from(a ^ flip <= b ^ flip)),
        Relation::Gt => map2(out, a, b, |a, b| u64::from(a ^ flip > b ^ flip)),
        Relation::Ge => map2(out, a, b, |a, b| u64::from(a ^ flip >= b ^ flip)),
    }
}

fn shift(op: Shift, out: &mut [u64], a: &[u64], by: &[u64], width: u32) {
    let (mask, limit) = (top_mask(width), u64::from(width));
    match op {
        Shift::Left => map2(out, a, by, |a, by| if by < limit { (a << by) & mask } else { 0 }),
        Shift::Right => map2(out, a, by, |a, by| if by < limit { a >> by } else { 0 }),
        Shift::RightSigned => map2(out, a, by, |a, by| (signed(a, width) >> by.min(63)) as u64 & mask),
    }
}

fn case<'a>(
    out: &mut [u64],
    subject: &[u64],
    arms: &[(Bits, ValueId)],
    default: &[u64],
    at: impl Fn(&ValueId) -> &'a [u64],
) {
    if let [out] = out {
        let arm = arms.iter().find(|(key, _)| key.limbs()[0] == subject[0]);
        *out = arm.map_or(default[0], |(_, value)| at(value)[0]);
        return;
    }
    out.copy_from_slice(default);
    for (key, value) in arms {
        let key = key.limbs()[0];
        for ((out, subject), value) in out.iter_mut().zip(subject).zip(at(value)) {
            *out = choose(u64::from(*subject == key), *value, *out);
        }
    }
}

fn reduce(by: Reduction, out: &mut [u64], of: &[u64], group: usize, mask: u64) {
    let mut fold = |f: fn(u64, u64) -> u64| {
        for (out, group) in out.iter_mut().zip(of.chunks_exact(group)) {
            *out = group.iter().copied().reduce(f).expect("a group has a lane") & mask;
        }
    };
    match by {
        Reduction::And => fold(|a, b| a & b),
        Reduction::Or => fold(|a, b| a | b),
        Reduction::Xor => fold(|a, b| a ^ b),
        Reduction::Add => fold(u64::wrapping_add),
        Reduction::Min => fold(u64::min),
        Reduction::Max => fold(u64::max),
    }
}
