//! Elementwise operations on one lane, in general registers.
//!
//! A value of up to 64 bits is one integer with undefined upper bits, which are cleared only when needed. `bound` is
//! the number of bits that may be set. Comparisons result in flags, and choices and branches take flags.
//!
//! A value of more than 64 bits is its limbs. Above [`LONGEST`] bits these are in the engine's scratch memory; in
//! registers they would spill to a stack that may be small.

mod narrow;
mod wide;

use rustc_hash::FxHashMap;
use tilewright_circuit::{Bits, limbs_for};

use crate::engine::layout::store::is_mask;
use crate::engine::program::{Kind, ValueId};
use crate::engine::strips::{Builder, Comparison, Type, Value};
use wide::emit_copy;

/// The widest value whose limbs are in registers.
pub(super) const LONGEST: u32 = 256;

/// A value of one lane in general registers, in the forms that have been needed.
#[derive(Debug, Clone)]
pub(crate) struct Scalar {
    pub width: u32,
    /// Up to 64 bits: an integer below 2 to the `bound`.
    integer: Option<Value>,
    bound: u32,
    /// 1 bit: 0 or 1, as 8 bits.
    flag: Option<Value>,
    /// Above 64 bits, or on request: limbs, with zeros above the width.
    limbs: Option<Vec<Value>>,
    /// Above [`LONGEST`] bits: the first of its limbs in the scratch memory, with zeros above the width.
    scratch: Option<usize>,
    /// The value, if it is a constant of up to 64 bits.
    known: Option<u64>,
}

impl Scalar {
    fn integer(width: u32, integer: Value, bound: u32) -> Scalar {
        Scalar {
            width,
            integer: Some(integer),
            bound: bound.min(64),
            flag: None,
            limbs: None,
            scratch: None,
            known: None,
        }
    }

    /// An integer of up to 64 bits with zeros above its width.
    pub fn clean(width: u32, integer: Value) -> Scalar {
        Scalar::integer(width, integer, width)
    }

    /// Loads the limbs of a value of more than 64 bits.
    pub fn load(b: &mut Builder, width: u32, at: Value, offset: i32) -> Scalar {
        let count = limbs_for(width);
        if width > LONGEST {
            let first = b.take(count);
            let from = b.add_constant(at, i64::from(offset));
            let to = wide::address(b, first);
            emit_copy(b, from, to, count);
            return Scalar::scratch(width, first);
        }
        let limb = |i: i32| b.load(Type::I64, at, offset + i * 8);
        Scalar::limbs(width, (0..count as i32).map(limb).collect())
    }

    fn flag(flag: Value) -> Scalar {
        Scalar { width: 1, integer: None, bound: 1, flag: Some(flag), limbs: None, scratch: None, known: None }
    }

    fn limbs(width: u32, limbs: Vec<Value>) -> Scalar {
        Scalar { width, integer: None, bound: 64, flag: None, limbs: Some(limbs), scratch: None, known: None }
    }

    fn scratch(width: u32, first: usize) -> Scalar {
        Scalar { width, integer: None, bound: 64, flag: None, limbs: None, scratch: Some(first), known: None }
    }
}

/// The values of a block and of those that it dominates.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scalars {
    values: FxHashMap<ValueId, Scalar>,
}

impl Scalars {
    /// Defines a value that exists already.
    pub fn define(&mut self, id: ValueId, scalar: Scalar) {
        self.values.insert(id, scalar);
    }

    /// A value of 1 bit, 0 or 1 in 8 bits.
    pub fn define_flag(&mut self, id: ValueId, flag: Value) {
        self.define(id, Scalar::flag(flag));
    }

    /// The value, if it is defined.
    pub fn get(&self, id: ValueId) -> Option<&Scalar> {
        self.values.get(&id)
    }

    /// A constant.
    pub fn constant(&mut self, b: &mut Builder, id: ValueId, bits: &Bits) {
        if bits.width() > LONGEST {
            let scalar = self.call(b, &Kind::Const(bits.clone()), bits.width());
            return self.define(id, scalar);
        }
        let limbs: Vec<Value> = bits.limbs().iter().map(|&limb| b.constant(Type::I64, limb as i64)).collect();
        let scalar = match (bits.width(), limbs.as_slice()) {
            (width, [limb]) => Scalar { known: Some(bits.limbs()[0]), ..Scalar::integer(width, *limb, width) },
            (width, _) => Scalar::limbs(width, limbs),
        };
        self.define(id, scalar);
    }

    /// Computes `kind`, whose operands are all defined.
    pub fn evaluate(&mut self, b: &mut Builder, result: ValueId, kind: &Kind, width: u32) {
        let mut is_narrow = width <= 64;
        kind.for_each_operand(|operand| is_narrow &= self.values[&operand].width <= 64);
        let scalar = match is_narrow {
            true => self.narrow(b, kind, width),
            false => self.wide(b, kind, width),
        };
        self.define(result, scalar);
    }

    /// A value of 8, 16, 32 or 64 bits rotated to the left.
    pub fn rotate(&mut self, b: &mut Builder, result: ValueId, of: ValueId, left: u32) {
        let width = self.width(of);
        let kind = Type::integer(width);
        let mut value = self.integer(b, of);
        if width < 64 {
            value = b.truncate(kind, value);
        }
        let mut rotated = b.rotate_left(value, i64::from(left));
        if width < 64 {
            rotated = b.zero_extend(Type::I64, rotated);
        }
        self.define(result, Scalar::clean(width, rotated));
    }

    fn width(&self, id: ValueId) -> u32 {
        self.values[&id].width
    }

    fn bound(&self, id: ValueId) -> u32 {
        self.values[&id].bound
    }

    /// A value of up to 64 bits, perhaps with ones above its width.
    fn integer(&mut self, b: &mut Builder, id: ValueId) -> Value {
        let scalar = self.values.get_mut(&id).expect("operands are defined before results");
        if let Some(integer) = scalar.integer {
            return integer;
        }
        let flag = scalar.flag.expect("a value of up to 64 bits is an integer or a flag");
        let integer = b.zero_extend(Type::I64, flag);
        scalar.integer = Some(integer);
        integer
    }

    /// A value of up to 64 bits with zeros above its width.
    pub fn low(&mut self, b: &mut Builder, id: ValueId) -> Value {
        let integer = self.integer(b, id);
        let scalar = self.values.get_mut(&id).expect("operands are defined before results");
        if scalar.bound <= scalar.width {
            return integer;
        }
        let mask = b.constant(Type::I64, tilewright_circuit::top_mask(scalar.width) as i64);
        let clean = b.and(integer, mask);
        (scalar.integer, scalar.bound) = (Some(clean), scalar.width);
        clean
    }

    /// The limbs of a value of up to [`LONGEST`] bits, with zeros above the width.
    pub fn clean(&mut self, b: &mut Builder, id: ValueId) -> Vec<Value> {
        match &self.values[&id].limbs {
            Some(limbs) => limbs.clone(),
            None => vec![self.low(b, id)],
        }
    }

    /// A value of 1 bit as 0 or 1 in 8 bits.
    pub fn flag(&mut self, b: &mut Builder, id: ValueId) -> Value {
        if let Some(flag) = self.values[&id].flag {
            return flag;
        }
        let low = self.low(b, id);
        let flag = b.truncate(Type::I8, low);
        self.values.get_mut(&id).expect("it is defined").flag = Some(flag);
        flag
    }

    /// Loads a value stored as integers of `element` bits, with zeros above its width; 1 bit in fewer than 64 is a
    /// mask.
    pub fn load(&mut self, b: &mut Builder, id: ValueId, width: u32, element: u32, at: Value, offset: i32) {
        let kind = Type::integer(element);
        if is_mask(element as usize / 8, width) {
            let mask = b.load(Type::I8, at, offset);
            let flag = b.and_constant(mask, 1);
            return self.define_flag(id, flag);
        }
        if width > 64 {
            let scalar = Scalar::load(b, width, at, offset);
            return self.define(id, scalar);
        }
        let limb = b.load(kind, at, offset);
        let limb = if element < 64 { b.zero_extend(Type::I64, limb) } else { limb };
        self.define(id, Scalar::clean(width, limb));
    }

    /// Stores a value in the form that [`Scalars::load`] reads.
    pub fn store(&mut self, b: &mut Builder, id: ValueId, element: u32, at: Value, offset: i32) {
        if is_mask(element as usize / 8, self.width(id)) {
            let flag = self.flag(b, id);
            let mask = b.neg(flag);
            let kind = Type::integer(element);
            let mask = if element > 8 { b.sign_extend(kind, mask) } else { mask };
            b.store(mask, at, offset);
            return;
        }
        if self.width(id) == element && element < 64 {
            let integer = self.integer(b, id);
            let kind = Type::integer(element);
            let integer = b.truncate(kind, integer);
            b.store(integer, at, offset);
            return;
        }
        if let Some(first) = self.values[&id].scratch {
            let from = wide::address(b, first);
            let to = b.add_constant(at, i64::from(offset));
            return emit_copy(b, from, to, limbs_for(self.width(id)));
        }
        for (i, limb) in self.clean(b, id).into_iter().enumerate() {
            let kind = Type::integer(element);
            let limb = if element < 64 { b.truncate(kind, limb) } else { limb };
            b.store(limb, at, offset + i as i32 * 8);
        }
    }

    /// 1 if two numbers are in a relation.
    fn test(b: &mut Builder, relation: Comparison, left: Value, right: Value) -> Scalar {
        Scalar::flag(b.compare(relation, left, right))
    }
}
