//! Operations on values of more than 64 bits: bitwise operations and choices limb by limb; everything else, and all
//! operations above [`LONGEST`] bits, by calls of the semantics.

use std::sync::Arc;

use rustc_hash::FxHashSet;
use tilewright_circuit::ir::Binary;
use tilewright_circuit::limbs_for;

use super::{LONGEST, Scalar, Scalars};
use crate::engine::emit::offset;
use crate::engine::program::{Cell, Kind, ValueId};
use crate::engine::semantics::{self, Number};
use crate::engine::strips::{Builder, Type, Value};

/// An operation computed by a call, in scratch memory.
#[derive(Debug)]
struct Call {
    cell: Cell,
    /// Each operand once, sorted by id, with its width and its first limb.
    operands: Vec<(ValueId, u32, usize)>,
    /// The first limb of the result.
    out: usize,
}

#[allow(unsafe_code, reason = "called by generated code")]
unsafe extern "C" fn run(call: *const Call, scratch: *mut u64) {
    // SAFETY: generated code passes what `Scalars::call` laid out: the `Jit` that owns the code keeps the call, and
    // the scratch memory has all limbs that the call names. The result does not overlap the operands.
    let (call, out) = unsafe {
        let call = &*call;
        (call, std::slice::from_raw_parts_mut(scratch.add(call.out), limbs_for(call.cell.width)))
    };
    semantics::lane(&call.cell, 0, out, |id, _| {
        let operand = call.operands.binary_search_by_key(&id, |(of, ..)| *of).expect("an operand");
        let (_, width, at) = &call.operands[operand];
        // SAFETY: as above.
        Number { limbs: unsafe { std::slice::from_raw_parts(scratch.add(*at), limbs_for(*width)) }, width: *width }
    });
}

#[allow(unsafe_code, reason = "called by generated code")]
unsafe extern "C" fn copy(from: *const u64, to: *mut u64, limbs: usize) {
    // SAFETY: generated code passes the limbs of one value, and a place for them; exactly one of them is scratch
    // memory.
    unsafe { std::ptr::copy_nonoverlapping(from, to, limbs) }
}

/// Emits a copy of limbs from or to the scratch memory.
pub(super) fn emit_copy(b: &mut Builder, from: Value, to: Value, limbs: usize) {
    let limbs = b.constant(Type::I64, limbs as i64);
    b.call_only(copy as *const () as usize, &[from, to, limbs]);
}

/// The address of a limb of the scratch memory.
pub(super) fn address(b: &mut Builder, limb: usize) -> Value {
    let scratch = b.scratch();
    b.add_constant(scratch, limb as i64 * 8)
}

impl Scalars {
    /// The result of `kind`, which has an operand or a result of more than 64 bits.
    pub(super) fn wide(&mut self, b: &mut Builder, kind: &Kind, width: u32) -> Scalar {
        let mut is_long = width > LONGEST;
        kind.for_each_operand(|operand| is_long |= self.width(operand) > LONGEST);
        match kind {
            Kind::Alias(of) => self.values[of].clone(),
            Kind::Slice(of, low) if width <= 64 => {
                let (first, within) = ((low / 64) as usize, low % 64);
                let limb = self.limb(b, *of, first);
                let by = b.constant(Type::I64, i64::from(within));
                let lower = if within == 0 { limb } else { b.shr(limb, by) };
                if within + width <= 64 {
                    return Scalar::integer(width, lower, 64 - within);
                }
                let up = b.constant(Type::I64, i64::from(64 - within));
                let next = self.limb(b, *of, first + 1);
                let upper = b.shl(next, up);
                Scalar::integer(width, b.or(lower, upper), 64)
            }
            _ if is_long => self.call(b, kind, width),
            Kind::Mux { select, on_true, on_false } => {
                let select = self.flag(b, *select);
                let (left, right) = (self.clean(b, *on_true), self.clean(b, *on_false));
                let pairs = left.into_iter().zip(right);
                Scalar::limbs(width, pairs.map(|(left, right)| b.select(select, left, right)).collect())
            }
            Kind::Binary(op @ (Binary::And | Binary::Or | Binary::Xor), x, y) => {
                let (left, right) = (self.clean(b, *x), self.clean(b, *y));
                let combined = left.into_iter().zip(right).map(|(left, right)| match op {
                    Binary::And => b.and(left, right),
                    Binary::Or => b.or(left, right),
                    _ => b.xor(left, right),
                });
                Scalar::limbs(width, combined.collect())
            }
            Kind::Concat(parts) => self.side_by_side(b, parts, width),
            _ => self.call(b, kind, width),
        }
    }

    /// Values side by side, the last one lowest.
    fn side_by_side(&mut self, b: &mut Builder, parts: &[ValueId], width: u32) -> Scalar {
        let mut whole: Vec<Option<Value>> = vec![None; limbs_for(width)];
        let mut low = 0;
        for &part in parts.iter().rev() {
            let place = low;
            low += self.width(part);
            for (number, limb) in (0..).zip(self.clean(b, part)) {
                let at = place + 64 * number;
                let (first, within) = ((at / 64) as usize, i64::from(at % 64));
                let mut put = |b: &mut Builder, to: usize, value: Value| {
                    whole[to] = Some(whole[to].map_or(value, |other| b.or(other, value)));
                };
                if within == 0 {
                    put(b, first, limb);
                    continue;
                }
                let up = b.constant(Type::I64, within);
                let lower = b.shl(limb, up);
                put(b, first, lower);
                if at / 64 < (low.min(at + 64) - 1) / 64 {
                    let down = b.constant(Type::I64, 64 - within);
                    let upper = b.shr(limb, down);
                    put(b, first + 1, upper);
                }
            }
        }
        let mut limb = |limb: Option<Value>| limb.unwrap_or_else(|| b.constant(Type::I64, 0));
        Scalar::limbs(width, whole.into_iter().map(&mut limb).collect())
    }

    /// A limb of a value of more than 64 bits.
    fn limb(&self, b: &mut Builder, id: ValueId, limb: usize) -> Value {
        let scalar = &self.values[&id];
        match scalar.scratch {
            Some(first) => {
                let scratch = b.scratch();
                b.load(Type::I64, scratch, offset(8 * (first + limb)))
            }
            None => scalar.limbs.as_ref().expect("a wide value has limbs")[limb],
        }
    }

    /// Calls the semantics, with operands and result in scratch memory; for constants too.
    pub(super) fn call(&mut self, b: &mut Builder, kind: &Kind, width: u32) -> Scalar {
        let out = b.take(limbs_for(width));
        let taken = b.taken();
        let mut operands: Vec<(ValueId, u32, usize)> = Vec::new();
        // A concatenation may have a million operands.
        let mut seen = FxHashSet::default();
        kind.for_each_operand(|id| {
            if seen.insert(id) {
                let first = self.in_scratch(b, id);
                operands.push((id, self.width(id), first));
            }
        });
        operands.sort_unstable_by_key(|(id, ..)| *id);
        let call = Arc::new(Call { cell: Cell::new(kind.clone(), 1, width), operands, out });
        let arguments = [b.keep(call), b.scratch()];
        b.call_only(run as *const () as usize, &arguments);
        if width > LONGEST {
            b.give_back(taken);
            return Scalar::scratch(width, out);
        }
        let scratch = b.scratch();
        let limb = |i: usize| b.load(Type::I64, scratch, offset(8 * (out + i)));
        let limbs: Vec<Value> = (0..limbs_for(width)).map(limb).collect();
        b.give_back(out);
        match limbs.as_slice() {
            // The bits above the width are zero, but only a mask shows that an address made of it is within bounds.
            [limb] => Scalar::integer(width, *limb, 64),
            _ => Scalar::limbs(width, limbs),
        }
    }

    /// The place of a value in scratch memory; it is copied there if necessary.
    fn in_scratch(&mut self, b: &mut Builder, id: ValueId) -> usize {
        if let Some(first) = self.values[&id].scratch {
            return first;
        }
        let limbs = self.clean(b, id);
        let first = b.take(limbs.len());
        let scratch = b.scratch();
        for (i, limb) in limbs.into_iter().enumerate() {
            b.store(limb, scratch, offset(8 * (first + i)));
        }
        first
    }
}
