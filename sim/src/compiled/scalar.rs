//! Elementwise operations on one lane, in general registers.

use std::collections::HashMap;

use cranelift_codegen::ir::{
    AbiParam, InstBuilder, MemFlagsData, Signature, StackSlotData, StackSlotKind, Type, Value, types,
};
use cranelift_codegen::isa::CallConv;
use cranelift_frontend::FunctionBuilder;
use tilewright_hdl::{Bits, limbs_for};

use crate::lane::{Number, evaluate};
use crate::program::{Kind, ValueId};

/// A value of one lane in general registers.
#[derive(Debug, Clone)]
pub(super) struct Scalar {
    pub width: u32,
    pub limbs: Vec<Value>,
}

#[derive(Debug, Default)]
pub(super) struct Scalars {
    values: HashMap<ValueId, Scalar>,
}

struct Call {
    kind: Kind,
    width: u32,
    operands: Vec<(ValueId, u32, usize)>,
}

#[allow(unsafe_code, reason = "called by generated code")]
unsafe extern "C" fn run(call: *const Call, operands: *const u64, out: *mut u64) {
    // SAFETY: generated code passes what `evaluate` below laid out.
    let (call, out) = unsafe { (&*call, std::slice::from_raw_parts_mut(out, limbs_for((*call).width))) };
    evaluate(&call.kind, call.width, out, |id| {
        let (_, width, at) = call.operands.iter().find(|(of, ..)| *of == id).expect("an operand");
        // SAFETY: as above.
        Number { limbs: unsafe { std::slice::from_raw_parts(operands.add(*at), limbs_for(*width)) }, width: *width }
    });
}

impl Scalars {
    pub fn define(&mut self, id: ValueId, scalar: Scalar) {
        self.values.insert(id, scalar);
    }

    pub fn define_flag(&mut self, b: &mut FunctionBuilder, id: ValueId, flag: Value) {
        let limb = b.ins().uextend(types::I64, flag);
        self.define(id, Scalar { width: 1, limbs: vec![limb] });
    }

    pub fn get(&self, id: ValueId) -> Option<&Scalar> {
        self.values.get(&id)
    }

    pub fn constant(&mut self, b: &mut FunctionBuilder, id: ValueId, bits: &Bits) {
        let limbs = bits.limbs().iter().map(|&limb| b.ins().iconst(types::I64, limb as i64)).collect();
        self.define(id, Scalar { width: bits.width(), limbs });
    }

    pub fn evaluate(&mut self, b: &mut FunctionBuilder, result: ValueId, kind: &Kind, width: u32) {
        if let Kind::Alias(of) = kind {
            let same = self.values[of].clone();
            return self.define(result, same);
        }
        let mut operands: Vec<(ValueId, u32, usize)> = Vec::new();
        let mut size = 0;
        kind.for_each_operand(|id| {
            if !operands.iter().any(|(of, ..)| *of == id) {
                operands.push((id, self.values[&id].width, size));
                size += self.values[&id].limbs.len();
            }
        });
        let slot = |b: &mut FunctionBuilder, limbs: usize| {
            b.create_sized_stack_slot(StackSlotData::new(StackSlotKind::ExplicitSlot, limbs as u32 * 8, 3))
        };
        let (input, output) = (slot(b, size.max(1)), slot(b, limbs_for(width)));
        for (id, _, at) in &operands {
            for (i, limb) in self.values[id].limbs.iter().enumerate() {
                b.ins().stack_store(types::I64, *limb, input, (at + i) as i32 * 8);
            }
        }
        let call: &'static Call = Box::leak(Box::new(Call { kind: kind.clone(), width, operands }));
        let mut signature = Signature::new(CallConv::SystemV);
        signature.params.extend([AbiParam::new(types::I64); 3]);
        let signature = b.import_signature(signature);
        let callee = b.ins().iconst(types::I64, run as *const () as i64);
        let arguments = [
            b.ins().iconst(types::I64, std::ptr::from_ref(call) as i64),
            b.ins().stack_addr(types::I64, input, 0),
            b.ins().stack_addr(types::I64, output, 0),
        ];
        b.ins().call_indirect(signature, callee, &arguments);
        let limbs =
            (0..limbs_for(width)).map(|i| b.ins().stack_load(types::I64, types::I64, output, i as i32 * 8)).collect();
        self.define(result, Scalar { width, limbs });
    }

    pub fn flag(&mut self, b: &mut FunctionBuilder, id: ValueId) -> Value {
        b.ins().ireduce(types::I8, self.values[&id].limbs[0])
    }

    pub fn clean(&mut self, _: &mut FunctionBuilder, id: ValueId) -> Vec<Value> {
        self.values[&id].limbs.clone()
    }

    pub fn load(&mut self, b: &mut FunctionBuilder, id: ValueId, width: u32, element: u32, at: Value, offset: i32) {
        let flags = MemFlagsData::trusted();
        let limbs = (0..limbs_for(width) as i32)
            .map(|i| {
                let kind = Type::int(element as u16).expect("an element");
                let limb = b.ins().load(kind, flags, at, offset + i * 8);
                if element < 64 { b.ins().uextend(types::I64, limb) } else { limb }
            })
            .collect();
        self.define(id, Scalar { width, limbs });
    }

    pub fn store(&mut self, b: &mut FunctionBuilder, id: ValueId, element: u32, at: Value, offset: i32) {
        let flags = MemFlagsData::trusted();
        for (i, limb) in self.values[&id].limbs.clone().into_iter().enumerate() {
            let kind = Type::int(element as u16).expect("an element");
            let limb = if element < 64 { b.ins().ireduce(kind, limb) } else { limb };
            b.ins().store(flags, limb, at, offset + i as i32 * 8);
        }
    }
}
