//! Operations on all bits of one or two operands.

use tilewright_circuit::ir::{Binary, Unary};

use super::Lanes;
use super::form::{Form, Need, Vector};
use super::vectors::{self, low_mask};
use crate::engine::program::ValueId;
use crate::engine::strips::{Builder, Comparison, Type, Value};

impl Lanes {
    pub(super) fn unary(&mut self, b: &mut Builder, op: Unary, a: ValueId) -> Vector {
        let width = self.width(a);
        match op {
            Unary::Not if width == 1 => {
                let element = self.pick(8, &[(a, Need::Signed)], 0);
                let mask = self.number(b, a, element, Need::Signed);
                self.not(b, mask)
            }
            Unary::Not => {
                let element = self.pick(self.element(width), &[(a, Need::Any)], 1);
                let vector = self.number(b, a, element, Need::Any);
                let parts = vectors::map(&vector.parts, |part| b.not(part));
                let form = Form::signed(vector.form.signed_bits(element), element);
                Vector { width, element, form, parts, inverse: None }
            }
            Unary::AllOnes => {
                let (vector, signed) = self.exact(b, &[a]);
                let element = vector[0].element;
                let ones = self.bits(b, element, if signed { u64::MAX } else { low_mask(width) });
                self.mask_of(element, vectors::map(&vector[0].parts, |part| vectors::equal(b, part, ones)))
            }
            Unary::AnyOne => {
                let (vector, _) = self.exact(b, &[a]);
                let element = vector[0].element;
                let zero = self.bits(b, element, 0);
                if vector[0].form.bits(element) < element {
                    let more = |part| b.compare(Comparison::SignedGreaterThan, part, zero);
                    return self.mask_of(element, vectors::map(&vector[0].parts, more));
                }
                let equal = self.mask_of(element, vectors::map(&vector[0].parts, |part| vectors::equal(b, part, zero)));
                self.not(b, equal)
            }
            Unary::Parity => self.parity(b, a),
        }
    }

    /// Operands of one width in one element, so that equal numbers have equal bits; returns whether the sign fills
    /// the upper bits.
    pub(super) fn exact(&mut self, b: &mut Builder, operands: &[ValueId]) -> (Vec<Vector>, bool) {
        let least = self.element(self.width(operands[0]));
        let ways = super::ELEMENTS.into_iter().filter(|&element| element >= least);
        let ways = ways.flat_map(|element| [(element, Need::Clean), (element, Need::Signed)]);
        let cost = |&(element, need): &(u32, Need)| {
            let conversions: u32 = operands.iter().map(|&id| self.cost(id, element, need)).sum();
            conversions + self.parts(element) as u32
        };
        let (element, need) = ways.min_by_key(cost).expect("64 bits are enough");
        let vectors = operands.iter().map(|&id| self.number(b, id, element, need)).collect();
        (vectors, need == Need::Signed)
    }

    pub(super) fn mask_of(&self, element: u32, parts: Vec<Value>) -> Vector {
        Vector { width: 1, element, form: Form::Mask, parts, inverse: None }
    }

    /// The inverse of a mask; the original is remembered.
    pub(super) fn not(&mut self, b: &mut Builder, mask: Vector) -> Vector {
        if let Some(inverse) = mask.inverse {
            return Vector { parts: inverse, inverse: None, ..mask };
        }
        let parts = vectors::map(&mask.parts, |part| b.not(part));
        Vector { parts, inverse: Some(mask.parts), ..mask }
    }

    /// Bits are folded onto the topmost one by left shifts, which needs no mask. Bytes, whose shifts cross into
    /// neighbours, are folded onto the lowest one.
    fn parity(&mut self, b: &mut Builder, a: ValueId) -> Vector {
        let width = self.width(a);
        let folds: Vec<u32> = (0..).map(|i| 1 << i).take_while(|&by| by < width).collect();
        let need = if width.is_power_of_two() { Need::Any } else { Need::Clean };
        let element = self.pick(self.element(width), &[(a, need)], 2 * folds.len() as u32);
        if element == 8 {
            let vector = self.number(b, a, element, need);
            let (one, mut parts) = (self.bits(b, 8, 1), vector.parts);
            for &by in folds.iter().rev() {
                parts = vectors::map(&parts, |part| {
                    let moved = vectors::shift_dirty(b, part, element, false, by);
                    b.xor(part, moved)
                });
            }
            let parts = vectors::map(&parts, |part| {
                let lowest = b.and(part, one);
                vectors::equal(b, lowest, one)
            });
            return self.mask_of(element, parts);
        }
        let mut parts = self.top(b, a, element).parts;
        for by in folds {
            parts = vectors::map(&parts, |part| {
                let moved = vectors::shift_dirty(b, part, element, true, by);
                b.xor(part, moved)
            });
        }
        let parts = self.top_bits(b, element, &parts);
        self.mask_of(element, parts)
    }

    /// Masks of the topmost bits.
    pub(super) fn top_bits(&mut self, b: &mut Builder, element: u32, parts: &[Value]) -> Vec<Value> {
        if matches!(element, 16 | 32) {
            let down = b.constant(Type::I64, i64::from(element - 1));
            return vectors::map(parts, |part| b.sar(part, down));
        }
        let zero = self.bits(b, element, 0);
        vectors::map(parts, |part| b.compare(Comparison::SignedGreaterThan, zero, part))
    }

    pub(super) fn binary(&mut self, b: &mut Builder, op: Binary, x: ValueId, y: ValueId, width: u32) -> Vector {
        if matches!(op, Binary::Mul | Binary::MulSigned) {
            return self.product(b, op == Binary::MulSigned, x, y, width);
        }
        let need = Need::of(width);
        let element = self.pick(self.element(width), &[(x, need), (y, need)], 1);
        let [x, y] = [x, y].map(|id| self.number(b, id, element, need));
        self.combined(b, op, &x, &y)
    }

    /// Combines two vectors of one width and element, masks for 1 bit.
    pub(super) fn combined(&mut self, b: &mut Builder, op: Binary, x: &Vector, y: &Vector) -> Vector {
        let (width, element) = (x.width, x.element);
        if width == 1 {
            return self.logic(b, op, x, y);
        }
        let (p, q) = (&x.parts, &y.parts);
        let signed = || x.form.signed_bits(element).max(y.form.signed_bits(element));
        let (parts, form) = match op {
            Binary::And => (vectors::map2(p, q, |p, q| b.and(p, q)), x.form.and(y.form, element)),
            Binary::Or => (vectors::map2(p, q, |p, q| b.or(p, q)), x.form.or(y.form, element)),
            Binary::Xor => (vectors::map2(p, q, |p, q| b.xor(p, q)), x.form.or(y.form, element)),
            Binary::Add => {
                let form = match (x.form, y.form) {
                    (Form::Bits(p), Form::Bits(q)) => Form::Bits((p.max(q) + 1).min(element)),
                    _ => Form::signed(signed() + 1, element),
                };
                (vectors::map2(p, q, |p, q| b.add(p, q)), form)
            }
            _ => (vectors::map2(p, q, |p, q| b.sub(p, q)), Form::signed(signed() + 1, element)),
        };
        Vector { width, element, form, parts, inverse: None }
    }

    /// Combines masks. If both are inverses, the result is computed from the originals.
    fn logic(&mut self, b: &mut Builder, op: Binary, x: &Vector, y: &Vector) -> Vector {
        let element = x.element;
        let opposite = match op {
            Binary::And => Binary::Or,
            Binary::Or => Binary::And,
            _ => Binary::Xor,
        };
        let mut emit = |op: Binary, p: &[Value], q: &[Value]| {
            vectors::map2(p, q, |p, q| match op {
                Binary::And => b.and(p, q),
                Binary::Or => b.or(p, q),
                _ => b.xor(p, q),
            })
        };
        let (parts, inverted) = match (&x.inverse, &y.inverse) {
            (Some(p), Some(q)) => (emit(opposite, p, q), opposite != Binary::Xor),
            (Some(p), None) if opposite == Binary::Xor => (emit(op, p, &y.parts), true),
            (None, Some(q)) if opposite == Binary::Xor => (emit(op, &x.parts, q), true),
            // The inverse of an or with an inverse is one instruction, `pandn`.
            (Some(p), None) if op == Binary::Or => {
                let not: Vec<Value> = vectors::map(&y.parts, |part| b.not(part));
                (vectors::map2(p, &not, |p, q| b.and(p, q)), true)
            }
            (None, Some(q)) if op == Binary::Or => {
                let not: Vec<Value> = vectors::map(&x.parts, |part| b.not(part));
                (vectors::map2(q, &not, |p, q| b.and(p, q)), true)
            }
            _ => (emit(op, &x.parts, &y.parts), false),
        };
        let mask = self.mask_of(element, parts);
        if inverted { self.not(b, mask) } else { mask }
    }

    fn product(&mut self, b: &mut Builder, signed: bool, x: ValueId, y: ValueId, width: u32) -> Vector {
        let need = if signed { Need::Signed } else { Need::Clean };
        let element = self.element(width);
        let narrow = self.width(x).max(self.width(y)) <= 32;
        if element == 64 && narrow {
            // `pmuludq` and `pmuldq`.
            let [x, y] = [x, y].map(|id| self.number(b, id, 32, need));
            let parts = self.long_product(b, signed, &x.parts, &y.parts);
            return Vector { width, element, form: product_form(signed, &x, &y, 64), parts, inverse: None };
        }
        let each = if element == 8 { 6 } else { 1 };
        let element = match element {
            8 => self.pick(element, &[(x, need), (y, need)], each).min(32),
            _ => element,
        };
        let [x, y] = [x, y].map(|id| self.number(b, id, element, need));
        let form = product_form(signed, &x, &y, element);
        let parts = self.multiplied(b, &x, &y);
        Vector { width, element, form, parts, inverse: None }
    }

    /// 64-bit products of all 32-bit elements.
    pub(super) fn long_product(&mut self, b: &mut Builder, signed: bool, x: &[Value], y: &[Value]) -> Vec<Value> {
        let mut parts = Vec::new();
        for (&x, &y) in x.iter().zip(y) {
            // These pairs are one pattern; the widened values are never materialised.
            let low = [x, y].map(|part| b.widen_low(signed, part));
            let high = [x, y].map(|part| b.widen_high(signed, part));
            parts.push(b.mul(low[0], low[1]));
            parts.push(b.mul(high[0], high[1]));
        }
        parts
    }

    /// Products modulo the element size.
    pub(super) fn multiplied(&mut self, b: &mut Builder, x: &Vector, y: &Vector) -> Vec<Value> {
        let element = x.element;
        if element != 8 {
            return vectors::map2(&x.parts, &y.parts, |x, y| b.mul(x, y));
        }
        // Even and odd bytes separately, in 16-bit lanes.
        let (even, odd) = (self.bits(b, 16, 0x00ff), self.bits(b, 16, 0xff00));
        vectors::map2(&x.parts, &y.parts, |x, y| {
            let [x, y] = [x, y].map(|part| b.cast(b.vector(16), part));
            let low = b.mul(x, y);
            let low = b.and(low, even);
            let down = vectors::shift_dirty(b, x, 16, false, 8);
            let up = b.and(y, odd);
            let high = b.mul(down, up);
            let both = b.or(low, high);
            b.cast(b.vector(8), both)
        })
    }
}

/// What is known of a product, as numbers of the operands' elements or, if `signed`, in two's complement.
fn product_form(signed: bool, x: &Vector, y: &Vector, element: u32) -> Form {
    let unsigned = |vector: &Vector| match vector.form {
        Form::Bits(bits) if !signed || bits < vector.element => Some(bits),
        _ => (!signed).then_some(vector.element),
    };
    match (unsigned(x), unsigned(y)) {
        (Some(p), Some(q)) => Form::Bits((p + q).min(element)),
        _ => Form::signed(x.form.signed_bits(x.element) + y.form.signed_bits(y.element), element),
    }
}
