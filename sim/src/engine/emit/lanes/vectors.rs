//! Single instructions on single vectors.

use super::form::Step;
use crate::engine::strips::{Builder, Comparison, Type, Value};

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
    b.numbers(b.vector(element), lane)
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

/// Selects bytes of two vectors, one after the other: `byte` gives the number of each. The result has the type of `x`.
pub(super) fn shuffle(b: &mut Builder, x: Value, y: Value, byte: impl Fn(usize) -> usize) -> Value {
    let of = b.type_of(x);
    let (bytes, same) = (b.vector(8), x == y);
    let x = b.cast(bytes, x);
    let y = if same { x } else { b.cast(bytes, y) };
    let out = b.shuffle(x, y, byte);
    b.cast(of, out)
}

/// The elements of the lower, or the upper, halves of two vectors, alternating.
pub(super) fn interleave(b: &mut Builder, x: Value, y: Value, element: u32, upper: bool) -> Value {
    let (size, all) = (element as usize / 8, b.vector_bits() as usize / 8);
    let start = if upper { all / 2 } else { 0 };
    shuffle(b, x, y, |i| {
        let (pair, within) = (i / (2 * size), i % (2 * size));
        let other = if within >= size { all } else { 0 };
        other + start + pair * size + within % size
    })
}

/// The lower halves of two vectors, one after the other.
pub(super) fn lower_halves(b: &mut Builder, x: Value, y: Value) -> Value {
    let half = b.vector_bits() as usize / 16;
    shuffle(b, x, y, |i| if i < half { i } else { half + i })
}

/// The lower, or the upper, 32 bits of the 64-bit elements of two vectors, one after another.
pub(super) fn halves(b: &mut Builder, x: Value, y: Value, upper: bool) -> Value {
    let start = if upper { 4 } else { 0 };
    let both = shuffle(b, x, y, |i| i / 4 * 8 + i % 4 + start);
    b.cast(b.vector(32), both)
}

/// So many of the lowest bits of a vector, to be stored. A float is stored by one instruction; an integer would have to
/// be extracted.
pub(super) fn lowest(b: &mut Builder, vector: Value, bits: u32) -> Value {
    if bits >= 128 {
        return b.cast(Type::vector(64, bits), vector);
    }
    let integers = b.vector(bits);
    let numbers = b.cast(if bits >= 32 { integers.floats() } else { integers }, vector);
    b.lane(numbers, 0)
}

/// A step that changes the size of elements.
pub(super) fn resize(b: &mut Builder, step: Step, parts: &[Value], element: u32) -> Vec<Value> {
    let widened = |b: &mut Builder, part: Value, upper: bool| match (step, upper) {
        (Step::Double, _) => {
            let both = interleave(b, part, part, element, upper);
            b.cast(b.vector(element * 2), both)
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
    let wide = b.cast(b.vector(element.max(16)), value);
    let by = b.constant(Type::I64, i64::from(by));
    let out = if left { b.shl(wide, by) } else { b.shr(wide, by) };
    b.cast(b.vector(element), out)
}
