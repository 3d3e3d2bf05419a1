//! The forms of values: the cost of conversions, and their instructions.

use super::form::{Form, Need, Step, Vector, next};
use super::vectors::{self, low_mask};
use super::{Done, ELEMENTS, Lanes};
use crate::engine::program::ValueId;
use crate::engine::strips::{Builder, Type, Value};

impl Lanes {
    /// The number of instructions that convert a value to an element as needed.
    pub(super) fn cost(&self, id: ValueId, element: u32, need: Need) -> u32 {
        let entry = &self.values[&id];
        if entry.constant.is_some() {
            return 0;
        }
        let costs = entry.forms.iter().map(|form| self.steps(form, element, need));
        costs.min().expect("a value has a form")
    }

    fn steps(&self, from: &Vector, element: u32, need: Need) -> u32 {
        let (mut form, mut at, mut cost) = (from.form, from.element, 0);
        while let Some((step, then, to)) = next(form, from.width, at, element, need) {
            cost += step.cost(self.parts(at.max(to)) as u32, at);
            (form, at) = (then, to);
        }
        cost
    }

    /// The element, not below `least`, with the lowest total cost, if the operands must be converted and each part
    /// takes `each` instructions.
    pub(super) fn pick(&self, least: u32, operands: &[(ValueId, Need)], each: u32) -> u32 {
        let least = least.max(self.smallest());
        let cost = |element: u32| {
            let conversions: u32 = operands.iter().map(|&(id, need)| self.cost(id, element, need)).sum();
            conversions + each * self.parts(element) as u32
        };
        let elements = ELEMENTS.into_iter().filter(|&element| element >= least);
        elements.min_by_key(|&element| cost(element)).expect("64 bits are enough")
    }

    /// A value in an element, as needed.
    pub(super) fn number(&mut self, b: &mut Builder, id: ValueId, element: u32, need: Need) -> Vector {
        let entry = &self.values[&id];
        debug_assert!(element >= entry.width, "{id:?} has {} bits", entry.width);
        if let Some(constant) = entry.constant {
            return self.known_vector(b, entry.width, constant, element, need);
        }
        let best = entry.forms.iter().min_by_key(|form| self.steps(form, element, need));
        let mut vector = best.expect("a value has a form").clone();
        while let Some((step, form, to)) = next(vector.form, vector.width, vector.element, element, need) {
            vector = self.step(b, step, &vector, form, to);
            self.values.get_mut(&id).expect("it has a value").forms.push(vector.clone());
            self.done.push(Done::Form(id));
        }
        vector
    }

    /// A value shifted to the top of its elements.
    pub(super) fn top(&mut self, b: &mut Builder, id: ValueId, element: u32) -> Vector {
        let entry = &self.values[&id];
        if let Some(top) = entry.tops.iter().find(|top| top.element == element) {
            return top.clone();
        }
        let (width, up) = (entry.width, element - entry.width);
        if let Some(constant) = entry.constant {
            let part = self.bits(b, element, constant << up);
            let parts = vec![part; self.parts(element)];
            return Vector { width: element, element, form: Form::Bits(element), parts, inverse: None };
        }
        let vector = self.number(b, id, element, Need::Any);
        if width == element {
            return vector;
        }
        let parts = self.shifted_left(b, &vector, up).parts;
        let top = Vector { width: element, element, form: Form::Bits(element), parts, inverse: None };
        self.values.get_mut(&id).expect("it has a value").tops.push(top.clone());
        self.done.push(Done::Top(id));
        top
    }

    pub(super) fn top_cost(&self, id: ValueId, element: u32) -> u32 {
        let entry = &self.values[&id];
        if entry.constant.is_some() || entry.tops.iter().any(|top| top.element == element) {
            return 0;
        }
        let shift = match element {
            _ if entry.width == element => 0,
            8 => 2,
            _ => 1,
        };
        self.cost(id, element, Need::Any) + shift * self.parts(element) as u32
    }

    pub(super) fn step(&mut self, b: &mut Builder, step: Step, from: &Vector, form: Form, to: u32) -> Vector {
        let (width, at) = (from.width, from.element);
        let (parts, inverse) = match (step, &from.inverse) {
            (Step::Clean, _) => {
                let mask = self.bits(b, at, low_mask(width));
                (vectors::map(&from.parts, |part| b.and(part, mask)), None)
            }
            (Step::SignExtend, _) => (self.sign_extended(b, from), None),
            // Only the inverse exists in registers.
            (_, Some(inverse)) if form == Form::Mask => {
                let inverse = vectors::resize(b, step, inverse, at);
                (vectors::map(&inverse, |part| b.not(part)), Some(inverse))
            }
            _ => (vectors::resize(b, step, &from.parts, at), None),
        };
        Vector { width, element: to, form, parts, inverse }
    }

    fn sign_extended(&mut self, b: &mut Builder, from: &Vector) -> Vec<Value> {
        let (width, element) = (from.width, from.element);
        let clean = from.form.bits(element) <= width;
        if width == 1 && clean {
            let one = self.bits(b, element, 1);
            return vectors::map(&from.parts, |part| vectors::equal(b, part, one));
        }
        if matches!(element, 16 | 32) {
            let up = b.constant(Type::I64, i64::from(element - width));
            return vectors::map(&from.parts, |part| {
                let top = b.shl(part, up);
                b.sar(top, up)
            });
        }
        let (mask, sign) = (self.bits(b, element, low_mask(width)), self.bits(b, element, 1 << (width - 1)));
        vectors::map(&from.parts, |part| {
            let part = if clean { part } else { b.and(part, mask) };
            if width == 1 {
                return vectors::equal(b, part, sign);
            }
            let flipped = b.xor(part, sign);
            b.sub(flipped, sign)
        })
    }
}
