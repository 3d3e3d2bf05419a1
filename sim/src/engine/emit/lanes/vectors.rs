//! Single instructions on single vectors.

use super::form::Step;
use crate::engine::strips::{Builder, Comparison, Type, Value};

/// The vector type with this element.
pub(in crate::engine::emit) fn ty(element: u32) -> Type {
    match element {
        8 => Type::I8X16,
        16 => Type::I16X8,
        32 => Type::I32X4,
        _ => Type::I64X2,
    }
}

/// A number with this many ones.
pub(super) fn low_mask(bits: u32) -> u64 {
    u64::MAX >> (64 - bits)
}

/// A clean number, sign-extended to all bits.
pub(super) fn signed_constant(constant: u64, width: u32) -> u64 {
    ((constant << (64 - width)) as i64 >> (64 - width)) as u64
}

/// A constant, by lane.
pub(super) fn vector_constant(b: &mut Builder, element: u32, lane: impl Fn(u32) -> u64) -> Value {
    let bytes = element as usize / 8;
    let all = std::array::from_fn(|i| lane((i / bytes) as u32).to_le_bytes()[i % bytes]);
    b.bytes(ty(element), all)
}

/// For each part; equal parts, as of a value that is the same in all lanes, once.
pub(super) fn map(parts: &[Value], mut emit: impl FnMut(Value) -> Value) -> Vec<Value> {
    let mut out: Vec<Value> = Vec::with_capacity(parts.len());
    for (i, part) in parts.iter().enumerate() {
        out.push(if i > 0 && parts[i - 1] == *part { out[i - 1] } else { emit(*part) });
    }
    out
}

/// For each pair of parts.
pub(super) fn map2(x: &[Value], y: &[Value], mut emit: impl FnMut(Value, Value) -> Value) -> Vec<Value> {
    let mut out: Vec<Value> = Vec::with_capacity(x.len());
    for i in 0..x.len() {
        let same = i > 0 && x[i - 1] == x[i] && y[i - 1] == y[i];
        out.push(if same { out[i - 1] } else { emit(x[i], y[i]) });
    }
    out
}

pub(super) fn equal(b: &mut Builder, x: Value, y: Value) -> Value {
    b.compare(Comparison::Equal, x, y)
}

/// Selects bytes of two vectors by number; the result has the type of `x`.
pub(super) fn shuffle(b: &mut Builder, x: Value, y: Value, bytes: [u8; 16]) -> Value {
    let of = b.type_of(x);
    let same = x == y;
    let x = b.cast(Type::I8X16, x);
    let y = if same { x } else { b.cast(Type::I8X16, y) };
    let out = b.shuffle(x, y, bytes);
    b.cast(of, out)
}

/// The elements of the lower, or the upper, halves of two vectors, alternating.
pub(super) fn interleave(b: &mut Builder, x: Value, y: Value, element: u32, upper: bool) -> Value {
    let size = element as usize / 8;
    let start = if upper { 8 } else { 0 };
    let bytes = std::array::from_fn(|i| {
        let (pair, within) = (i / (2 * size), i % (2 * size));
        let other = if within >= size { 16 } else { 0 };
        (other + start + pair * size + within % size) as u8
    });
    shuffle(b, x, y, bytes)
}

/// The lower, or the upper, 32 bits of the 64-bit elements of two vectors, one after another.
pub(super) fn halves(b: &mut Builder, x: Value, y: Value, upper: bool) -> Value {
    let start = if upper { 4 } else { 0 };
    let bytes = std::array::from_fn(|i| (i / 4 * 8 + i % 4 + start) as u8);
    let both = shuffle(b, x, y, bytes);
    b.cast(Type::I32X4, both)
}

/// A step that changes the size of elements.
pub(super) fn resize(b: &mut Builder, step: Step, parts: &[Value], element: u32) -> Vec<Value> {
    let widened = |b: &mut Builder, part: Value, upper: bool| match (step, upper) {
        (Step::Double, _) => {
            let both = interleave(b, part, part, element, upper);
            b.cast(ty(element * 2), both)
        }
        (Step::Widen, false) => b.widen_low(false, part),
        (Step::Widen, true) => b.widen_high(false, part),
        (_, false) => b.widen_low(true, part),
        (_, true) => b.widen_high(true, part),
    };
    match step {
        Step::Double | Step::Widen | Step::WidenSigned => {
            parts.iter().flat_map(|&part| [false, true].map(|upper| widened(b, part, upper))).collect()
        }
        _ => parts.chunks(2).map(|pair| narrowed(b, step, pair[0], pair[1])).collect(),
    }
}

/// Two vectors to one of elements of half the size.
pub(super) fn narrowed(b: &mut Builder, step: Step, low: Value, high: Value) -> Value {
    match step {
        Step::Cut => halves(b, low, high, false),
        Step::Narrow => b.narrow(false, low, high),
        _ => b.narrow(true, low, high),
    }
}

/// Logical shift by a constant; for bytes in 16-bit lanes, so that bits of neighbours come in.
pub(super) fn shift_dirty(b: &mut Builder, value: Value, element: u32, left: bool, by: u32) -> Value {
    let wide = b.cast(if element == 8 { Type::I16X8 } else { ty(element) }, value);
    let by = b.constant(Type::I64, i64::from(by));
    let out = if left { b.shl(wide, by) } else { b.shr(wide, by) };
    b.cast(ty(element), out)
}
