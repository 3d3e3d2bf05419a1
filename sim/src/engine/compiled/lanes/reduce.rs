//! Lanes combined.

use crate::engine::compiled::builder::FunctionBuilder;
use cranelift_codegen::ir::{InstBuilder, Value, types};
use tilewright_hdl::ir::{Binary, Reduction};

use super::Lanes;
use super::emit::{self, cast, low_mask, ty};
use super::form::Vector;

/// The operator that combines two lanes.
pub(in crate::engine::compiled) fn operator(by: Reduction) -> Binary {
    by.operator().expect("what has no operator is lowered to comparisons")
}

impl Lanes {
    /// Combines lane by lane; both operands and the result have the form of [`Lanes::carried`].
    pub fn combine(&mut self, b: &mut FunctionBuilder, by: Reduction, x: &Vector, y: &Vector) -> Vector {
        let both = self.combined(b, operator(by), x, y);
        self.shape(x.width, both.parts)
    }

    /// The start value of [`Lanes::combine`].
    pub fn neutral(&mut self, b: &mut FunctionBuilder, by: Reduction, width: u32) -> Vector {
        let element = self.element(width);
        let part = emit::vector_constant(b, element, |_| if by == Reduction::And { low_mask(element) } else { 0 });
        self.shape(width, vec![part; self.parts(element)])
    }

    /// All lanes of a vector in the form of [`Lanes::carried`], combined into a clean I64.
    pub fn reduce(&mut self, b: &mut FunctionBuilder, by: Reduction, vector: &Vector) -> Value {
        let (width, element, op) = (vector.width, vector.element, operator(by));
        let op = if width == 1 && op == Binary::Add { Binary::Xor } else { op };
        let combine = |b: &mut FunctionBuilder, x: Value, y: Value| match op {
            Binary::And => b.ins().band(x, y),
            Binary::Or => b.ins().bor(x, y),
            Binary::Xor => b.ins().bxor(x, y),
            _ => b.ins().iadd(x, y),
        };
        let all = vector.parts.iter().copied().reduce(|x, y| combine(b, x, y)).expect("a strip has a vector");
        if width == 1 {
            // One bit of each byte is enough.
            let bytes = cast(b, all, types::I8X16);
            let bits = b.ins().vhigh_bits(types::I32, bytes);
            let flag = match op {
                Binary::Xor => {
                    let count = b.ins().popcnt(bits);
                    // Each lane has this many bytes, a power of two.
                    let by = b.ins().iconst(types::I32, i64::from((element / 8).trailing_zeros()));
                    let one = b.ins().iconst(types::I32, 1);
                    let count = b.ins().ushr(count, by);
                    b.ins().band(count, one)
                }
                _ => {
                    let (relation, number) = match op {
                        Binary::And => (cranelift_codegen::ir::condcodes::IntCC::Equal, 0xffff),
                        _ => (cranelift_codegen::ir::condcodes::IntCC::NotEqual, 0),
                    };
                    let number = b.ins().iconst(types::I32, number);
                    b.ins().icmp(relation, bits, number)
                }
            };
            return b.ins().uextend(types::I64, flag);
        }
        let mut all = all;
        let mut bytes = 8;
        while bytes >= element as usize / 8 {
            // Rotated by half of what remains; one `palignr`.
            let turned = emit::shuffle(b, all, all, std::array::from_fn(|i| ((i + bytes) % 16) as u8));
            all = combine(b, all, turned);
            bytes /= 2;
        }
        let lane = b.ins().extractlane(all, 0);
        let lane = if element == 64 { lane } else { b.ins().uextend(types::I64, lane) };
        if width == element {
            return lane;
        }
        debug_assert_eq!(b.func.dfg.value_type(all), ty(element));
        let mask = b.ins().iconst(types::I64, low_mask(width) as i64);
        b.ins().band(lane, mask)
    }
}
