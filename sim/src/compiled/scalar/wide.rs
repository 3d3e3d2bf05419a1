//! Operations on values of more than 64 bits: bits and choices limb by limb, the rest by calls of the general path.

use std::cell::RefCell;
use std::sync::Arc;

use cranelift_codegen::ir::{AbiParam, InstBuilder, Signature, StackSlotData, StackSlotKind, Value, types};
use cranelift_codegen::isa::CallConv;
use cranelift_frontend::FunctionBuilder;
use tilewright_hdl::ir::Binary;
use tilewright_hdl::limbs_for;

use super::{Scalar, Scalars};
use crate::lane::{Number, evaluate};
use crate::program::{Kind, ValueId};

thread_local! {
    /// Calls of the function that is being emitted. Emitters of lanes have values of their own, but all of them work on
    /// one function in one thread.
    static CALLS: RefCell<Vec<Arc<Call>>> = const { RefCell::new(Vec::new()) };
}

/// What the calls in the functions emitted in this thread since the last time refer to: has to live as long as they.
pub(in crate::compiled) fn take_calls() -> Vec<Arc<Call>> {
    CALLS.take()
}

/// What a call computes.
#[derive(Debug)]
pub(in crate::compiled) struct Call {
    kind: Kind,
    width: u32,
    operands: Vec<(ValueId, u32, usize)>,
}

#[allow(unsafe_code, reason = "called by generated code")]
unsafe extern "C" fn run(call: *const Call, operands: *const u64, out: *mut u64) {
    // SAFETY: generated code passes what `Scalars::call` laid out; who owns the code keeps the call.
    let (call, out) = unsafe { (&*call, std::slice::from_raw_parts_mut(out, limbs_for((*call).width))) };
    evaluate(&call.kind, call.width, out, |id| {
        let (_, width, at) = call.operands.iter().find(|(of, ..)| *of == id).expect("an operand");
        // SAFETY: as above.
        Number { limbs: unsafe { std::slice::from_raw_parts(operands.add(*at), limbs_for(*width)) }, width: *width }
    });
}

impl Scalars {
    /// The result of `kind`, which has an operand or a result of more than 64 bits.
    pub(super) fn wide(&mut self, b: &mut FunctionBuilder, kind: &Kind, width: u32) -> Scalar {
        match kind {
            Kind::Alias(of) => self.values[of].clone(),
            Kind::Slice(of, low) if width <= 64 => {
                let limbs = self.clean(b, *of);
                let (first, within) = ((low / 64) as usize, low % 64);
                let by = b.ins().iconst(types::I64, i64::from(within));
                let lower = if within == 0 { limbs[first] } else { b.ins().ushr(limbs[first], by) };
                if within + width <= 64 {
                    return Scalar::integer(width, lower, 64 - within);
                }
                let up = b.ins().iconst(types::I64, i64::from(64 - within));
                let upper = b.ins().ishl(limbs[first + 1], up);
                Scalar::integer(width, b.ins().bor(lower, upper), 64)
            }
            Kind::Mux { select, on_true, on_false } => {
                let select = self.flag(b, *select);
                let (left, right) = (self.clean(b, *on_true), self.clean(b, *on_false));
                let pairs = left.into_iter().zip(right);
                Scalar::limbs(width, pairs.map(|(left, right)| b.ins().select(select, left, right)).collect())
            }
            Kind::Binary(op @ (Binary::And | Binary::Or | Binary::Xor), x, y) => {
                let (left, right) = (self.clean(b, *x), self.clean(b, *y));
                let combined = left.into_iter().zip(right).map(|(left, right)| match op {
                    Binary::And => b.ins().band(left, right),
                    Binary::Or => b.ins().bor(left, right),
                    _ => b.ins().bxor(left, right),
                });
                Scalar::limbs(width, combined.collect())
            }
            _ => self.call(b, kind, width),
        }
    }

    /// Calls the general path with operands and result on the stack.
    fn call(&mut self, b: &mut FunctionBuilder, kind: &Kind, width: u32) -> Scalar {
        let mut operands: Vec<(ValueId, u32, usize)> = Vec::new();
        let mut size = 0;
        kind.for_each_operand(|id| {
            if !operands.iter().any(|(of, ..)| *of == id) {
                operands.push((id, self.width(id), size));
                size += limbs_for(self.width(id));
            }
        });
        let slot = |b: &mut FunctionBuilder, limbs: usize| {
            b.create_sized_stack_slot(StackSlotData::new(StackSlotKind::ExplicitSlot, limbs as u32 * 8, 3))
        };
        let (input, output) = (slot(b, size.max(1)), slot(b, limbs_for(width)));
        for (id, _, at) in &operands {
            for (i, limb) in self.clean(b, *id).into_iter().enumerate() {
                b.ins().stack_store(types::I64, limb, input, (at + i) as i32 * 8);
            }
        }
        let call = Arc::new(Call { kind: kind.clone(), width, operands });
        let address = Arc::as_ptr(&call);
        CALLS.with_borrow_mut(|calls| calls.push(call));
        let mut signature = Signature::new(CallConv::SystemV);
        signature.params.extend([AbiParam::new(types::I64); 3]);
        let signature = b.import_signature(signature);
        let callee = b.ins().iconst(types::I64, run as *const () as i64);
        let arguments = [
            b.ins().iconst(types::I64, address as i64),
            b.ins().stack_addr(types::I64, input, 0),
            b.ins().stack_addr(types::I64, output, 0),
        ];
        b.ins().call_indirect(signature, callee, &arguments);
        let limbs: Vec<Value> =
            (0..limbs_for(width)).map(|i| b.ins().stack_load(types::I64, types::I64, output, i as i32 * 8)).collect();
        match limbs.as_slice() {
            [limb] => Scalar::integer(width, *limb, width),
            _ => Scalar::limbs(width, limbs),
        }
    }
}
