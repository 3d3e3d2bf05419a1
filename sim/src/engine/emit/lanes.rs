//! Elementwise operations on a strip of lanes, in vectors.
//!
//! A value may exist in several forms at once: in elements of different sizes, with or without undefined bits above
//! its width, 1-bit values as masks. Conversions are made where an operation needs them, and remembered. Unused forms
//! cost nothing, because `strips/unused.rs` drops them.

mod access;
mod arithmetic;
mod compare;
mod concat;
mod convert;
mod form;
mod reduce;
mod select;
mod shift;
#[cfg(test)]
mod tests;
mod vectors;

use rustc_hash::FxHashMap;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::Unary;

use crate::engine::program::{Kind, ValueId};
use crate::engine::strips::{Builder, Type, Value};
pub(super) use access::Span;
pub(super) use form::Vector;
use form::{Form, Need, Step, next};
pub(super) use reduce::operator;
use vectors::{low_mask, signed_constant, vector_constant};

/// Everything known of a value.
#[derive(Debug, Clone, Default)]
struct Entry {
    width: u32,
    /// The same in every lane, and known at compile time.
    constant: Option<u64>,
    /// The same in every lane: a clean number.
    scalar: Option<Value>,
    forms: Vec<Vector>,
    /// Shifted so that the most significant bit is the element's, zeros below.
    tops: Vec<Vector>,
}

/// A change that [`Lanes::forget`] undoes, newest last.
#[derive(Debug)]
enum Done {
    Value(ValueId, Option<Box<Entry>>),
    Form(ValueId),
    Top(ValueId),
    Constant(u32, u64),
    Power(ValueId, u32, bool),
    Half(Value, u8),
}

/// A moment to which [`Lanes::forget`] returns.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mark(usize);

/// The values of a strip.
#[derive(Debug)]
pub(super) struct Lanes {
    strip: u32,
    /// Bits of a vector.
    vector: u32,
    values: FxHashMap<ValueId, Entry>,
    constants: FxHashMap<(u32, u64), Value>,
    /// Powers of two by amount, element, and whether they decrease with the amount.
    powers: FxHashMap<(ValueId, u32, bool), Vec<Value>>,
    /// Halves of vectors in general registers.
    halves: FxHashMap<(Value, u8), Value>,
    done: Vec<Done>,
}

const ELEMENTS: [u32; 4] = [8, 16, 32, 64];

impl Lanes {
    /// Strips of as many lanes as a vector of so many bits has integers of 8, 16 or 32 bits.
    pub fn new(strip: u32, vector: u32) -> Lanes {
        assert!([8, 16, 32].contains(&(vector / strip)), "a strip of {strip} lanes in vectors of {vector} bits");
        Lanes {
            strip,
            vector,
            values: FxHashMap::default(),
            constants: FxHashMap::default(),
            powers: FxHashMap::default(),
            halves: FxHashMap::default(),
            done: Vec::new(),
        }
    }

    /// The element with which a strip fills a vector.
    fn smallest(&self) -> u32 {
        self.vector / self.strip
    }

    /// The smallest element for a width.
    pub fn element(&self, width: u32) -> u32 {
        debug_assert!((1..=64).contains(&width), "{width} bits a lane");
        width.next_power_of_two().max(self.smallest())
    }

    /// The number of vectors of a value with this element.
    pub fn parts(&self, element: u32) -> usize {
        (self.strip * element / self.vector) as usize
    }

    /// Defines a value.
    pub fn define(&mut self, id: ValueId, vector: Vector) {
        debug_assert!(vector.element >= vector.width && vector.parts.len() == self.parts(vector.element));
        self.insert(id, Entry { width: vector.width, forms: vec![vector], ..Entry::default() });
    }

    /// The same known number in every lane.
    pub fn constant(&mut self, id: ValueId, bits: &Bits) {
        let constant = Some(bits.limbs()[0]);
        self.insert(id, Entry { width: bits.width(), constant, ..Entry::default() });
    }

    /// The same in every lane: `scalar` is a clean I64. Emits a vector for each element size; unused ones become no
    /// code. It is best called before the loop.
    pub fn splat(&mut self, b: &mut Builder, id: ValueId, width: u32, scalar: Value) {
        let mut forms = Vec::new();
        let smallest = self.element(width);
        for element in ELEMENTS.into_iter().filter(|&element| element >= smallest) {
            let (number, form) = match width {
                1 => (b.neg(scalar), Form::Mask),
                _ => (scalar, Form::Bits(width)),
            };
            let number = match element {
                64 => number,
                _ => b.truncate(Type::integer(element), number),
            };
            let part = b.splat(b.vector(element), number);
            forms.push(Vector { width, element, form, parts: vec![part; self.parts(element)], inverse: None });
        }
        self.insert(id, Entry { width, scalar: Some(scalar), forms, ..Entry::default() });
    }

    /// Whether it has a value.
    pub fn has(&self, id: ValueId) -> bool {
        self.values.contains_key(&id)
    }

    /// Whether a value is known to be the same in every lane.
    pub fn is_uniform(&self, id: ValueId) -> bool {
        let Entry { constant, scalar, .. } = &self.values[&id];
        constant.is_some() || scalar.is_some()
    }

    /// The width of a value.
    pub fn width(&self, id: ValueId) -> u32 {
        self.values[&id].width
    }

    /// Emits `kind`, whose operands all have values.
    pub fn evaluate(&mut self, b: &mut Builder, result: ValueId, kind: &Kind, width: u32) {
        let vector = match kind {
            Kind::Const(bits) => return self.constant(result, bits),
            Kind::Alias(of) => return self.copy(result, *of),
            Kind::Slice(of, 0) if width > 1 || self.width(*of) == 1 => return self.lower_part(result, *of, width),
            Kind::Extend(of, signed) => return self.extend(b, result, *of, *signed, width),
            Kind::Unary(op, a) => match (op, self.width(*a)) {
                (Unary::AllOnes | Unary::AnyOne | Unary::Parity, 1) => return self.copy(result, *a),
                _ => self.unary(b, *op, *a),
            },
            Kind::Shift(op, a, by) => self.shift(b, *op, *a, *by),
            Kind::Binary(op, x, y) => self.binary(b, *op, *x, *y, width),
            Kind::Compare(relation, signed, x, y) => self.compare(b, *relation, *signed, *x, *y),
            Kind::Mux { select, on_true, on_false } => self.select(b, &[(*select, *on_true)], *on_false),
            Kind::Select { arms, default } => self.select(b, arms, *default),
            Kind::Case { subject, arms, default } => self.case(b, *subject, arms, *default, width),
            Kind::Slice(of, low) => self.slice(b, *of, *low, width),
            Kind::Concat(parts) => self.concat(b, parts, width),
            Kind::Repeat(of, times) => self.repeat(b, *of, *times, width),
            _ => unreachable!("not an elementwise operation: {kind:?}"),
        };
        debug_assert_eq!(vector.width, width, "{kind:?}");
        self.define(result, vector);
    }

    /// A value in the canonical form of its width: a mask for 1 bit, otherwise numbers in the smallest element, with
    /// undefined bits above the width. For parameters of blocks, as around a loop.
    pub fn carried(&mut self, b: &mut Builder, id: ValueId) -> Vector {
        let width = self.width(id);
        let vector = self.number(b, id, self.element(width), Need::of(width));
        self.shape(width, vector.parts)
    }

    /// The form of [`Lanes::carried`] for these vectors.
    pub fn shape(&self, width: u32, parts: Vec<Value>) -> Vector {
        let element = self.element(width);
        let form = if width == 1 { Form::Mask } else { Form::Bits(element) };
        Vector { width, element, form, parts, inverse: None }
    }

    /// The present moment.
    pub fn mark(&self) -> Mark {
        Mark(self.done.len())
    }

    /// Drops all values and conversions made since. They are not valid in blocks after the branch in which they were
    /// made.
    pub fn forget(&mut self, mark: Mark) {
        while self.done.len() > mark.0 {
            match self.done.pop().expect("there are more") {
                Done::Value(id, Some(before)) => {
                    self.values.insert(id, *before);
                }
                Done::Value(id, None) => {
                    self.values.remove(&id);
                }
                Done::Form(id) => {
                    self.values.get_mut(&id).expect("it is younger").forms.pop();
                }
                Done::Top(id) => {
                    self.values.get_mut(&id).expect("it is younger").tops.pop();
                }
                Done::Constant(element, bits) => {
                    self.constants.remove(&(element, bits));
                }
                Done::Power(by, element, falling) => {
                    self.powers.remove(&(by, element, falling));
                }
                Done::Half(vector, half) => {
                    self.halves.remove(&(vector, half));
                }
            }
        }
    }

    fn insert(&mut self, id: ValueId, entry: Entry) {
        let before = self.values.insert(id, entry);
        self.done.push(Done::Value(id, before.map(Box::new)));
    }

    fn copy(&mut self, result: ValueId, of: ValueId) {
        let same = self.values[&of].clone();
        self.insert(result, same);
    }

    /// The lowest bits: the same vectors.
    fn lower_part(&mut self, result: ValueId, of: ValueId, width: u32) {
        let Entry { constant, forms, .. } = self.values[&of].clone();
        let constant = constant.map(|constant| constant & low_mask(width));
        let forms = forms.into_iter().map(|form| Vector { width, ..form }).collect();
        self.insert(result, Entry { width, constant, forms, ..Entry::default() });
    }

    fn extend(&mut self, b: &mut Builder, result: ValueId, of: ValueId, signed: bool, width: u32) {
        let Entry { width: before, constant, scalar, .. } = self.values[&of];
        if let Some(constant) = constant {
            let constant = if signed { signed_constant(constant, before) & low_mask(width) } else { constant };
            return self.insert(result, Entry { width, constant: Some(constant), ..Entry::default() });
        }
        let need = if signed { Need::Signed } else { Need::Clean };
        let element = self.pick(self.element(width), &[(of, need)], 0);
        self.number(b, of, element, need);
        let forms = self.values[&of].forms.iter();
        let forms = forms.filter(|form| form.element >= width && need.met(form.form, before, form.element));
        let forms = forms.map(|form| Vector { width, ..form.clone() }).collect();
        let scalar = scalar.filter(|_| !signed);
        self.insert(result, Entry { width, scalar, forms, ..Entry::default() });
    }

    /// The same bits in every lane; loaded from the constant pool once.
    fn bits(&mut self, b: &mut Builder, element: u32, bits: u64) -> Value {
        let bits = bits & low_mask(element);
        if let Some(value) = self.constants.get(&(element, bits)) {
            return *value;
        }
        let value = vector_constant(b, element, |_| bits);
        self.constants.insert((element, bits), value);
        self.done.push(Done::Constant(element, bits));
        value
    }

    fn known(&self, id: ValueId) -> Option<u64> {
        self.values[&id].constant
    }

    /// A known value as a vector.
    fn known_vector(&mut self, b: &mut Builder, width: u32, constant: u64, element: u32, need: Need) -> Vector {
        let (bits, form) = match need {
            Need::Signed if constant >> (width - 1) & 1 == 1 => {
                let bits = signed_constant(constant, width);
                (bits, Form::signed(64 - bits.leading_ones() + 1, element))
            }
            Need::Signed if width == 1 => (0, Form::Mask),
            _ => (constant, Form::Bits(64 - constant.leading_zeros())),
        };
        let part = self.bits(b, element, bits);
        Vector { width, element, form, parts: vec![part; self.parts(element)], inverse: None }
    }
}
