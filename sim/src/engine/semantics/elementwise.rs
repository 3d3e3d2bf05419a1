//! The result of one lane of an elementwise operation, for any widths.

use tilewright_circuit::{limbs, top_mask};

use super::Number;
use crate::engine::program::{Kind, Lowered, ValueId};

/// Computes one lane of `kind`, which is elementwise, into `out`, a value of `width` bits.
pub(super) fn evaluate<'a>(kind: &Kind, width: u32, out: &mut [u64], operand: impl Fn(ValueId) -> Number<'a>) {
    let at = |id: &ValueId| operand(*id);
    out.fill(0);
    match kind {
        Kind::Unary(op, a) => op.fill(out, at(a)),
        Kind::Binary(op, a, b) => op.fill(width, out, at(a), at(b)),
        Kind::Compare(relation, signed, a, b) => out[0] = u64::from(relation.holds_of(*signed, at(a), at(b))),
        Kind::Shift(op, a, by) => op.fill(out, at(a), at(by)),
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
        Kind::Extend(of, signed) => at(of).extend(out, *signed, width),
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
