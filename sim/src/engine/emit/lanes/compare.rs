//! Comparisons, which result in masks.

use tilewright_circuit::ir::{Binary, Relation, Unary};

use super::form::{Form, Need, Vector};
use super::vectors::{self, signed_constant};
use super::{ELEMENTS, Lanes};
use crate::engine::program::ValueId;
use crate::engine::strips::{Builder, Comparison};

impl Lanes {
    pub(super) fn compare(
        &mut self,
        b: &mut Builder,
        relation: Relation,
        signed: bool,
        x: ValueId,
        y: ValueId,
    ) -> Vector {
        if self.width(x) == 1 {
            return self.compare_bits(b, relation, signed, x, y);
        }
        let (mask, inverted) = match relation {
            Relation::Eq => (self.equals(b, x, y), false),
            Relation::Ne if self.known(y) == Some(0) => (self.unary(b, Unary::AnyOne, x), false),
            Relation::Ne => (self.equals(b, x, y), true),
            Relation::Lt => (self.greater(b, signed, y, x), false),
            Relation::Le => (self.greater(b, signed, x, y), true),
            Relation::Gt => (self.greater(b, signed, x, y), false),
            Relation::Ge => (self.greater(b, signed, y, x), true),
        };
        if inverted { self.not(b, mask) } else { mask }
    }

    /// As signed numbers, masks are 0 and -1; as unsigned ones, 1 is the larger.
    fn compare_bits(&mut self, b: &mut Builder, relation: Relation, signed: bool, x: ValueId, y: ValueId) -> Vector {
        let element = self.pick(8, &[(x, Need::Signed), (y, Need::Signed)], 1);
        let [x, y] = [x, y].map(|id| self.number(b, id, element, Need::Signed));
        let (x, y) = if signed { (y, x) } else { (x, y) };
        let (op, p, q, inverted) = match relation {
            Relation::Ne => (Binary::Xor, x, y, false),
            Relation::Eq => (Binary::Xor, x, y, true),
            Relation::Gt => (Binary::And, x, self.not(b, y), false),
            Relation::Le => (Binary::And, x, self.not(b, y), true),
            Relation::Lt => (Binary::And, self.not(b, x), y, false),
            Relation::Ge => (Binary::And, self.not(b, x), y, true),
        };
        let mask = self.combined(b, op, &p, &q);
        if inverted { self.not(b, mask) } else { mask }
    }

    fn equals(&mut self, b: &mut Builder, x: ValueId, y: ValueId) -> Vector {
        let (vectors, _) = self.exact(b, &[x, y]);
        let parts = vectors::map2(&vectors[0].parts, &vectors[1].parts, |x, y| vectors::equal(b, x, y));
        self.mask_of(vectors[0].element, parts)
    }

    /// `x > y`: one instruction if it can be a signed comparison.
    fn greater(&mut self, b: &mut Builder, signed: bool, x: ValueId, y: ValueId) -> Vector {
        let width = self.width(x);
        let least = self.element(width);
        if signed {
            if self.known(x) == Some(0) {
                return self.bit(b, y, width - 1);
            }
            let candidates = ELEMENTS.into_iter().filter(|&element| element >= least);
            let ways = candidates.flat_map(|element| [(element, false), (element, true)]);
            let cost = |&(element, top): &(u32, bool)| {
                let cost = |id| if top { self.top_cost(id, element) } else { self.cost(id, element, Need::Signed) };
                cost(x) + cost(y) + self.parts(element) as u32
            };
            let (element, top) = ways.min_by_key(cost).expect("64 bits are enough");
            let [x, y] = [x, y].map(|id| match top {
                true => self.top(b, id, element),
                false => self.number(b, id, element, Need::Signed),
            });
            let parts = vectors::map2(&x.parts, &y.parts, |x, y| b.compare(Comparison::SignedGreaterThan, x, y));
            return self.mask_of(element, parts);
        }
        let element = self.pick(least, &[(x, Need::Clean), (y, Need::Clean)], 1);
        let [x, y] = [x, y].map(|id| self.number(b, id, element, Need::Clean));
        let (p, q) = (&x.parts, &y.parts);
        if x.form.bits(element).max(y.form.bits(element)) < element {
            let parts = vectors::map2(p, q, |x, y| b.compare(Comparison::SignedGreaterThan, x, y));
            return self.mask_of(element, parts);
        }
        if element == 64 {
            let parts = vectors::map2(p, q, |x, y| b.compare(Comparison::UnsignedGreaterThan, x, y));
            return self.mask_of(element, parts);
        }
        // A minimum and a comparison; the other way round would need an inversion too.
        let parts = vectors::map2(p, q, |x, y| b.compare(Comparison::UnsignedLessThanOrEqual, x, y));
        let less = self.mask_of(element, parts);
        self.not(b, less)
    }

    /// The lanes in which a bit is 1.
    pub(super) fn bit(&mut self, b: &mut Builder, of: ValueId, index: u32) -> Vector {
        let entry = &self.values[&of];
        let (width, smallest) = (entry.width, self.element(1));
        if let Some(constant) = entry.constant {
            return self.known_vector(b, 1, constant >> index & 1, smallest, Need::Signed);
        }
        if let Some(top) = entry.tops.iter().find(|_| index == width - 1).cloned() {
            let parts = self.top_bits(b, top.element, &top.parts);
            return self.mask_of(top.element, parts);
        }
        let from = entry.forms.iter().min_by_key(|form| form.element).expect("a value has a form").clone();
        let (element, parts) = (from.element, &from.parts);
        if from.form.signed_bits(element) <= index + 1 || index + 1 == element {
            let parts = match from.form {
                Form::Mask => parts.clone(),
                _ => self.top_bits(b, element, parts),
            };
            return self.mask_of(element, parts);
        }
        if from.form.bits(element) <= index + 1 {
            let most = self.bits(b, element, vectors::low_mask(index + 1) >> 1);
            let parts = vectors::map(parts, |part| b.compare(Comparison::SignedGreaterThan, part, most));
            return self.mask_of(element, parts);
        }
        if matches!(element, 16 | 32) {
            let up = vectors::map(parts, |part| vectors::shift_dirty(b, part, element, true, element - 1 - index));
            let parts = self.top_bits(b, element, &up);
            return self.mask_of(element, parts);
        }
        let bit = self.bits(b, element, 1 << index);
        let parts = vectors::map(parts, |part| {
            let alone = b.and(part, bit);
            vectors::equal(b, alone, bit)
        });
        self.mask_of(element, parts)
    }

    /// A known number as the operand of a comparison for equality.
    pub(super) fn key(&mut self, b: &mut Builder, of: &Vector, key: u64, signed: bool) -> Vector {
        let key = if signed { signed_constant(key, of.width) } else { key };
        let key = self.bits(b, of.element, key);
        let parts = vectors::map(&of.parts, |part| vectors::equal(b, part, key));
        self.mask_of(of.element, parts)
    }
}
