//! Choices between values.

use tilewright_circuit::Bits;

use super::Lanes;
use super::form::{Form, Need, Vector};
use super::vectors;
use crate::engine::program::ValueId;
use crate::engine::strips::{Builder, Type};

impl Lanes {
    /// The value of the first arm whose condition is true, else the default.
    pub(super) fn select(&mut self, b: &mut Builder, arms: &[(ValueId, ValueId)], default: ValueId) -> Vector {
        let width = self.width(default);
        let need = Need::of(width);
        let mut operands = vec![(default, need)];
        arms.iter().for_each(|&(condition, value)| operands.extend([(condition, Need::Signed), (value, need)]));
        let element = self.pick(self.element(width), &operands, arms.len() as u32);
        let mut taken = self.number(b, default, element, need);
        for &(condition, value) in arms.iter().rev() {
            let condition = self.number(b, condition, element, Need::Signed);
            let value = self.number(b, value, element, need);
            taken = self.mux(b, &condition, &value, &taken);
        }
        taken
    }

    /// All have one element.
    pub(super) fn mux(&mut self, b: &mut Builder, select: &Vector, x: &Vector, y: &Vector) -> Vector {
        if let Some(inverse) = &select.inverse {
            let select = self.mask_of(select.element, inverse.clone());
            return self.mux(b, &select, y, x);
        }
        let (width, element, select) = (x.width, x.element, &select.parts);
        let ones = self.constants.get(&(element, vectors::low_mask(element))).copied();
        let is_ones = |vector: &Vector| ones.is_some_and(|ones| vector.parts[0] == ones);
        let is_zero = |vector: &Vector| {
            let zero = self.constants.get(&(element, 0));
            vector.is_zero() || zero.is_some_and(|zero| vector.parts[0] == *zero)
        };
        if x.parts == y.parts {
            return x.clone();
        }
        let parts = if is_zero(y) && is_ones(x) {
            select.clone()
        } else if is_zero(y) {
            vectors::map2(select, &x.parts, |select, x| b.and(x, select))
        } else if is_zero(x) {
            let not = vectors::map(select, |select| b.not(select));
            vectors::map2(&not, &y.parts, |not, y| b.and(y, not))
        } else if is_ones(x) {
            vectors::map2(select, &y.parts, |select, y| b.or(select, y))
        } else {
            let parts = select.iter().zip(x.parts.iter().zip(&y.parts));
            parts.map(|(&select, (&x, &y))| b.blend(select, x, y)).collect()
        };
        Vector { width, element, form: x.form.or(y.form, element), parts, inverse: None }
    }

    pub(super) fn case(
        &mut self,
        b: &mut Builder,
        subject: ValueId,
        arms: &[(Bits, ValueId)],
        default: ValueId,
        width: u32,
    ) -> Vector {
        if let Some(vector) = self.table(b, subject, arms, default, width) {
            return vector;
        }
        let need = Need::of(width);
        if self.width(subject) == 1 {
            let mut operands = vec![(default, need), (subject, Need::Signed)];
            operands.extend(arms.iter().map(|(_, value)| (*value, need)));
            let element = self.pick(self.element(width), &operands, 1);
            let condition = self.number(b, subject, element, Need::Signed);
            let mut taken = self.number(b, default, element, need);
            for (key, value) in arms.iter().rev() {
                let value = self.number(b, *value, element, need);
                taken = match key.bit(0) {
                    true => self.mux(b, &condition, &value, &taken),
                    false => self.mux(b, &condition, &taken, &value),
                };
            }
            return taken;
        }
        // Compared in the element of the values, so that masks need no conversion; one of the subject is cheaper.
        let mut operands = vec![(default, need)];
        operands.extend(arms.iter().map(|(_, value)| (*value, need)));
        let element = self.pick(self.element(width), &operands, 2 * arms.len() as u32);
        let at = element.max(self.element(self.width(subject)));
        let (of, signed) = [Need::Clean, Need::Signed]
            .into_iter()
            .min_by_key(|&need| self.cost(subject, at, need))
            .map(|need| (self.number(b, subject, at, need), need == Need::Signed))
            .expect("there are two");
        let mut taken = self.number(b, default, element, need);
        for (key, value) in arms.iter().rev().filter(|(_, value)| *value != default) {
            let value = self.number(b, *value, element, need);
            let mut condition = self.key(b, &of, key.limbs()[0], signed);
            while let Some((step, form, to)) = super::next(condition.form, 1, condition.element, element, Need::Signed)
            {
                condition = self.step(b, step, &condition, form, to);
            }
            taken = self.mux(b, &condition, &value, &taken);
        }
        taken
    }

    /// At most 16 known bytes: one `pshufb`.
    fn table(
        &mut self,
        b: &mut Builder,
        subject: ValueId,
        arms: &[(Bits, ValueId)],
        default: ValueId,
        width: u32,
    ) -> Option<Vector> {
        if !(2..=8).contains(&width) || self.width(subject) > 4 || arms.len() < 3 {
            return None;
        }
        let mut table = [self.known(default)? as u8; 16];
        for (key, value) in arms {
            table[key.limbs()[0] as usize] = self.known(*value)? as u8;
        }
        let element = self.pick(self.element(width), &[(subject, Need::Clean)], 1);
        let numbers = self.number(b, subject, element, Need::Clean);
        let table = b.numbers(Type::TABLE, |i| u64::from(table[i as usize]));
        let parts = vectors::map(&numbers.parts, |part| {
            let part = b.cast(b.vector(8), part);
            let found = b.look_up(table, part);
            b.cast(b.vector(element), found)
        });
        // Above the lowest byte is the entry of zero.
        Some(Vector { width, element, form: Form::Bits(element), parts, inverse: None })
    }
}
