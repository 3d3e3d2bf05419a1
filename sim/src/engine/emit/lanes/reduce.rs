//! Lanes combined.

use tilewright_circuit::ir::{Binary, Reduction};

use super::Lanes;
use super::form::Vector;
use super::vectors::{self, low_mask};
use crate::engine::strips::{Builder, Comparison, Type, Value};

/// The operator that combines two lanes.
pub(in crate::engine::emit) fn operator(by: Reduction) -> Binary {
    by.operator().expect("what has no operator is lowered to comparisons")
}

impl Lanes {
    /// Combines lane by lane; both operands and the result have the form of [`Lanes::carried`].
    pub fn combine(&mut self, b: &mut Builder, by: Reduction, x: &Vector, y: &Vector) -> Vector {
        let both = self.combined(b, operator(by), x, y);
        self.shape(x.width, both.parts)
    }

    /// The start value of [`Lanes::combine`].
    pub fn neutral(&mut self, b: &mut Builder, by: Reduction, width: u32) -> Vector {
        let element = self.element(width);
        let part = vectors::vector_constant(b, element, |_| if by == Reduction::And { low_mask(element) } else { 0 });
        self.shape(width, vec![part; self.parts(element)])
    }

    /// All lanes of a vector in the form of [`Lanes::carried`], combined into a clean I64.
    pub fn reduce(&mut self, b: &mut Builder, by: Reduction, vector: &Vector) -> Value {
        let (width, element, op) = (vector.width, vector.element, operator(by));
        let op = if width == 1 && op == Binary::Add { Binary::Xor } else { op };
        let combine = |b: &mut Builder, x: Value, y: Value| match op {
            Binary::And => b.and(x, y),
            Binary::Or => b.or(x, y),
            Binary::Xor => b.xor(x, y),
            _ => b.add(x, y),
        };
        let all = vector.parts.iter().copied().reduce(|x, y| combine(b, x, y)).expect("a strip has a vector");
        if width == 1 {
            // One bit of each byte is enough.
            let bytes = b.cast(b.vector(8), all);
            let bits = b.high_bits(Type::I32, bytes);
            let flag = match op {
                Binary::Xor => {
                    let count = b.count_ones(bits);
                    // Each lane has this many bytes, a power of two.
                    let by = b.constant(Type::I32, i64::from((element / 8).trailing_zeros()));
                    let one = b.constant(Type::I32, 1);
                    let count = b.shr(count, by);
                    b.and(count, one)
                }
                _ => {
                    let (relation, number) = match op {
                        Binary::And => (Comparison::Equal, low_mask(self.vector / 8) as i64),
                        _ => (Comparison::NotEqual, 0),
                    };
                    let number = b.constant(Type::I32, number);
                    b.compare(relation, bits, number)
                }
            };
            return b.zero_extend(Type::I64, flag);
        }
        let (mut all, size) = (all, self.vector as usize / 8);
        let mut bytes = size / 2;
        while bytes >= element as usize / 8 {
            // Rotated by half of what remains; one `palignr`.
            let turned = vectors::shuffle(b, all, all, |i| (i + bytes) % size);
            all = combine(b, all, turned);
            bytes /= 2;
        }
        let lane = b.lane(all, 0);
        let lane = if element == 64 { lane } else { b.zero_extend(Type::I64, lane) };
        if width == element {
            return lane;
        }
        debug_assert_eq!(b.type_of(all), b.vector(element));
        let mask = b.constant(Type::I64, low_mask(width) as i64);
        b.and(lane, mask)
    }
}
