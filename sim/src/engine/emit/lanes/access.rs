//! Loads and stores of lanes, together and one by one.

use std::cmp::Ordering;

use super::form::{Form, Need, Step, Vector};
use super::vectors::{self, low_mask};
use super::{Done, Lanes};
use crate::engine::program::ValueId;
use crate::engine::strips::{Builder, Load, Type, Value};

/// A place with the lanes of a strip side by side: clean numbers; masks if they have 1 bit.
#[derive(Debug, Clone, Copy)]
pub(in crate::engine::emit) struct Span {
    /// Bits of a lane: 8, 16, 32 or 64, at least the width.
    pub storage: u32,
    /// The address of the first lane, together with the offset.
    pub address: Value,
    pub offset: i32,
    /// Aligned to the size of a vector.
    pub aligned: bool,
}

impl Lanes {
    /// Loads the lanes of a strip.
    pub fn load(&mut self, b: &mut Builder, id: ValueId, width: u32, from: Span) {
        let Span { storage, address, offset, aligned } = from;
        let form = if width == 1 { Form::Mask } else { Form::Bits(width) };
        // A vector has room for so many strips.
        let parts = match self.vector / (self.strip * storage) {
            0 | 1 => {
                let place = |i| offset + i * self.vector as i32 / 8;
                let parts = (0..self.parts(storage) as i32).map(place);
                parts.map(|place| b.load_as(Load::Whole, b.vector(storage), aligned, address, place)).collect()
            }
            2 => {
                let load = if width == 1 { Load::SignExtended } else { Load::ZeroExtended };
                vec![b.load_as(load, b.vector(2 * storage), aligned, address, offset)]
            }
            _ => {
                let quarter = self.vector / 4;
                let lanes = b.load_as(Load::Whole, Type::integer(quarter), aligned, address, offset);
                let lanes = b.lowest(b.vector(quarter), lanes);
                let bytes = b.cast(b.vector(8), lanes);
                let step = if width == 1 { Step::WidenSigned } else { Step::Widen };
                let words = vectors::resize(b, step, &[bytes], 8);
                vec![vectors::resize(b, step, &words[..1], 16)[0]]
            }
        };
        let element = storage.max(self.smallest());
        self.define(id, Vector { width, element, form, parts, inverse: None });
    }

    /// Loads the vectors of a strip from any address, with numbers in the smallest elements.
    pub fn load_parts(&mut self, b: &mut Builder, id: ValueId, width: u32, address: Value, offsets: &[i32]) {
        let element = self.element(width);
        let form = if width == 1 { Form::Mask } else { Form::Bits(width) };
        let parts =
            offsets.iter().map(|&offset| b.load_as(Load::Whole, b.vector(element), false, address, offset)).collect();
        self.define(id, Vector { width, element, form, parts, inverse: None });
    }

    /// Stores the lanes of a strip.
    pub fn store(&mut self, b: &mut Builder, id: ValueId, to: Span) {
        let need = stored(self.width(id));
        let vector = self.number(b, id, to.storage.max(self.smallest()), need);
        self.store_vector(b, &vector, to);
    }

    /// Stores the lanes where the 1-bit value `select` is 1, and elsewhere `old`, the present contents.
    pub fn store_where(&mut self, b: &mut Builder, select: ValueId, id: ValueId, old: ValueId, to: Span) {
        let need = stored(self.width(id));
        let element = to.storage.max(self.smallest());
        let select = self.number(b, select, element, Need::Signed);
        let [id, old] = [id, old].map(|id| self.number(b, id, element, need));
        let vector = self.mux(b, &select, &id, &old);
        self.store_vector(b, &vector, to);
    }

    fn store_vector(&mut self, b: &mut Builder, vector: &Vector, to: Span) {
        let Span { storage, address, offset, aligned } = to;
        if vector.element == storage {
            for (i, &part) in vector.parts.iter().enumerate() {
                b.store_as(aligned, part, address, offset + i as i32 * self.vector as i32 / 8);
            }
            return;
        }
        // Less than a vector.
        let step = if vector.width == 1 { Step::NarrowSigned } else { Step::Narrow };
        let (mut lanes, mut element) = (vector.parts[0], vector.element);
        while element > storage {
            lanes = vectors::narrowed(b, step, lanes, lanes);
            element /= 2;
        }
        let lanes = vectors::lowest(b, lanes, self.strip * storage);
        b.store_as(aligned, lanes, address, offset);
    }

    /// One lane as a clean I64.
    pub fn extract(&mut self, b: &mut Builder, id: ValueId, lane: u32) -> Value {
        let entry = &self.values[&id];
        if let Some(scalar) = entry.scalar {
            return scalar;
        }
        if let Some(constant) = entry.constant {
            return b.constant(Type::I64, constant as i64);
        }
        // A mask in general registers costs no more than the extension.
        let element = self.pick(self.element(entry.width), &[(id, Need::Any)], 1);
        let need = if element == 64 || self.cost(id, element, Need::Clean) == 0 { Need::Clean } else { Need::Any };
        let vector = self.number(b, id, element, need);
        self.lane(b, &vector, lane, false)
    }

    /// One lane, clean or sign-extended. It uses halves of vectors, because extracting each lane takes longer.
    pub(super) fn lane(&mut self, b: &mut Builder, vector: &Vector, lane: u32, signed: bool) -> Value {
        let Vector { width, element, .. } = *vector;
        let (part, at) = (vector.parts[(lane * element / self.vector) as usize], lane * element % self.vector);
        let half = self.half(b, part, (at / 64) as u8);
        let low = at % 64;
        let number = match low {
            0 => half,
            _ => {
                let by = b.constant(Type::I64, i64::from(low));
                b.shr(half, by)
            }
        };
        if element == 64 {
            return number;
        }
        if !signed && !Need::Clean.met(vector.form, width, element) {
            let mask = b.constant(Type::I64, low_mask(width) as i64);
            return b.and(number, mask);
        }
        if !signed && low + element == 64 {
            return number;
        }
        let number = b.truncate(Type::integer(element), number);
        if signed { b.sign_extend(Type::I64, number) } else { b.zero_extend(Type::I64, number) }
    }

    fn half(&mut self, b: &mut Builder, part: Value, index: u8) -> Value {
        if let Some(half) = self.halves.get(&(part, index)) {
            return *half;
        }
        let both = b.cast(b.vector(64), part);
        let half = b.lane(both, index);
        self.halves.insert((part, index), half);
        self.done.push(Done::Half(part, index));
        half
    }

    /// A value of clean numbers, one a lane, of any integer type. A load with the type of the value's element and no
    /// other use becomes part of the insertion. A load of a narrower element that extends to I64 needs no further
    /// instruction.
    pub fn gather(&mut self, b: &mut Builder, id: ValueId, width: u32, lanes: &[Value]) {
        let element = self.element(width);
        let parts = self.gathered(b, element, lanes);
        self.define(id, Vector { width, element, form: Form::Bits(width), parts, inverse: None });
    }

    pub(super) fn gathered(&mut self, b: &mut Builder, element: u32, lanes: &[Value]) -> Vec<Value> {
        debug_assert_eq!(lanes.len(), self.strip as usize);
        let single = Type::integer(element);
        let parts = lanes.chunks((self.vector / element) as usize).map(|lanes| {
            let mut fill = |lanes: &[Value]| {
                let mut vector = None;
                let are_equal = lanes.iter().all(|lane| *lane == lanes[0]);
                let different = if are_equal { &lanes[..1] } else { lanes };
                for (i, &lane) in different.iter().enumerate() {
                    let number = match b.type_of(lane).element().cmp(&element) {
                        Ordering::Less => b.zero_extend(single, lane),
                        Ordering::Equal => lane,
                        Ordering::Greater => b.truncate(single, lane),
                    };
                    vector = Some(match vector {
                        // The pattern of two moves for 64 bits; `movd` for others.
                        None if element == 64 || are_equal => b.splat(b.vector(element), number),
                        None if element == 32 => b.lowest(b.vector(element), number),
                        None => {
                            // The bits above are overwritten.
                            let wide = match b.type_of(lane) {
                                Type::I64 => b.truncate(Type::I32, lane),
                                Type::I32 => lane,
                                _ => b.zero_extend(Type::I32, lane),
                            };
                            let wide = b.lowest(b.vector(32), wide);
                            b.cast(b.vector(element), wide)
                        }
                        Some(vector) => b.with_lane(vector, number, i as u8),
                    });
                }
                vector.expect("there are lanes")
            };
            if element > 16 {
                return fill(lanes);
            }
            // Two chains of half the length.
            let (low, high) = lanes.split_at(lanes.len() / 2);
            let (low, high) = (fill(low), fill(high));
            vectors::lower_halves(b, low, high)
        });
        parts.collect()
    }

    /// Whether a 1-bit value is 1 in any lane, as an I8.
    pub fn any(&mut self, b: &mut Builder, id: ValueId) -> Value {
        let element = self.pick(8, &[(id, Need::Signed)], 1);
        let mask = self.number(b, id, element, Need::Signed);
        if let Some(constant) = self.known(id) {
            return b.constant(Type::I8, (constant & low_mask(1)) as i64);
        }
        let parts = mask.parts.iter().copied().reduce(|x, y| b.or(x, y));
        b.any_bit(parts.expect("a strip has a vector"))
    }
}

/// The form in which state is stored.
fn stored(width: u32) -> Need {
    if width == 1 { Need::Signed } else { Need::Clean }
}
