//! Single instructions on single vectors.

use crate::engine::compiled::builder::FunctionBuilder;
use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{ConstantData, Endianness, InstBuilder, MemFlagsData, Type, Value, types};

use super::form::Step;

/// The vector type with this element.
pub(super) fn ty(element: u32) -> Type {
    match element {
        8 => types::I8X16,
        16 => types::I16X8,
        32 => types::I32X4,
        _ => types::I64X2,
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
pub(super) fn vector_constant(b: &mut FunctionBuilder, element: u32, lane: impl Fn(u32) -> u64) -> Value {
    let bytes = element as usize / 8;
    let data: Vec<u8> = (0..128 / element).flat_map(|i| lane(i).to_le_bytes().into_iter().take(bytes)).collect();
    let data = b.func.dfg.constants.insert(ConstantData::from(data.as_slice()));
    b.ins().vconst(ty(element), data)
}

/// The same 128 bits in another type.
pub(super) fn cast(b: &mut FunctionBuilder, value: Value, to: Type) -> Value {
    match b.func.dfg.value_type(value) == to {
        true => value,
        false => b.ins().bitcast(to, MemFlagsData::new().with_endianness(Endianness::Little), value),
    }
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

pub(super) fn equal(b: &mut FunctionBuilder, x: Value, y: Value) -> Value {
    b.ins().icmp(IntCC::Equal, x, y)
}

/// Selects bytes of two vectors by number; the result has the type of `x`.
pub(super) fn shuffle(b: &mut FunctionBuilder, x: Value, y: Value, bytes: [u8; 16]) -> Value {
    let of = b.func.dfg.value_type(x);
    let same = x == y;
    let x = cast(b, x, types::I8X16);
    let y = if same { x } else { cast(b, y, types::I8X16) };
    let mask = b.func.dfg.immediates.push(ConstantData::from(bytes.as_slice()));
    let out = b.ins().shuffle(x, y, mask);
    cast(b, out, of)
}

/// The elements of the lower, or the upper, halves of two vectors, alternating.
pub(super) fn interleave(b: &mut FunctionBuilder, x: Value, y: Value, element: u32, upper: bool) -> Value {
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
pub(super) fn halves(b: &mut FunctionBuilder, x: Value, y: Value, upper: bool) -> Value {
    let start = if upper { 4 } else { 0 };
    let bytes = std::array::from_fn(|i| (i / 4 * 8 + i % 4 + start) as u8);
    let both = shuffle(b, x, y, bytes);
    cast(b, both, types::I32X4)
}

/// A step that changes the size of elements.
pub(super) fn resize(b: &mut FunctionBuilder, step: Step, parts: &[Value], element: u32) -> Vec<Value> {
    let widened = |b: &mut FunctionBuilder, part: Value, upper: bool| match (step, upper) {
        (Step::Double, _) => {
            let both = interleave(b, part, part, element, upper);
            cast(b, both, ty(element * 2))
        }
        (Step::Widen, false) => b.ins().uwiden_low(part),
        (Step::Widen, true) => b.ins().uwiden_high(part),
        (_, false) => b.ins().swiden_low(part),
        (_, true) => b.ins().swiden_high(part),
    };
    match step {
        Step::Double | Step::Widen | Step::WidenSigned => {
            parts.iter().flat_map(|&part| [false, true].map(|upper| widened(b, part, upper))).collect()
        }
        _ => parts.chunks(2).map(|pair| narrowed(b, step, pair[0], pair[1])).collect(),
    }
}

/// Two vectors to one of elements of half the size.
pub(super) fn narrowed(b: &mut FunctionBuilder, step: Step, low: Value, high: Value) -> Value {
    match step {
        Step::Cut => halves(b, low, high, false),
        Step::Narrow => b.ins().unarrow(low, high),
        _ => b.ins().snarrow(low, high),
    }
}

/// Each bit of `x` where the mask is 1, otherwise of `y`.
pub(super) fn blend(b: &mut FunctionBuilder, mask: Value, x: Value, y: Value) -> Value {
    if !cfg!(target_arch = "x86_64") {
        return b.ins().bitselect(mask, x, y);
    }
    // This is always one instruction, of SSE4.1; `bitselect` is one only if Cranelift recognises the mask.
    let of = b.func.dfg.value_type(x);
    let [mask, x, y] = [mask, x, y].map(|value| cast(b, value, types::I8X16));
    let out = b.ins().blendv(mask, x, y);
    cast(b, out, of)
}

/// Logical shift by a constant; for bytes in 16-bit lanes, so that bits of neighbours come in.
pub(super) fn shift_dirty(b: &mut FunctionBuilder, value: Value, element: u32, left: bool, by: u32) -> Value {
    let wide = cast(b, value, if element == 8 { types::I16X8 } else { ty(element) });
    let by = b.ins().iconst(types::I64, i64::from(by));
    let out = if left { b.ins().ishl(wide, by) } else { b.ins().ushr(wide, by) };
    cast(b, out, ty(element))
}

/// Converts floats that are powers of two up to 2^31, or below 2^31, to integers.
pub(super) fn truncate(b: &mut FunctionBuilder, floats: Value) -> Value {
    match cfg!(target_arch = "x86_64") {
        // Gives 0x8000_0000 for numbers that are too large.
        true => b.ins().x86_cvtt2dq(types::I32X4, floats),
        false => b.ins().fcvt_to_uint_sat(types::I32X4, floats),
    }
}

/// Selects bytes of a table by numbers, all below 16.
pub(super) fn lookup(b: &mut FunctionBuilder, table: Value, numbers: Value) -> Value {
    match cfg!(target_arch = "x86_64") {
        true => b.ins().x86_pshufb(table, numbers),
        false => b.ins().swizzle(table, numbers),
    }
}
