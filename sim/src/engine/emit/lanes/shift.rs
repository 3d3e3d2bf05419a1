//! Shifts by a variable amount. Cranelift has none with an amount for each lane.

use tilewright_circuit::ir::{Binary, Shift};

use super::form::{Form, Need, Vector};
use super::vectors::{self, low_mask};
use super::{Done, Lanes};
use crate::engine::program::ValueId;
use crate::engine::strips::{Builder, Comparison, Type, Value};

/// The largest number with this many bits.
fn most(bits: u32) -> u64 {
    low_mask(bits)
}

impl Lanes {
    pub(super) fn shift(&mut self, b: &mut Builder, op: Shift, a: ValueId, by: ValueId) -> Vector {
        if let Some(by) = self.known(by) {
            return self.shift_known(b, op, a, by);
        }
        let width = self.width(a);
        if width == 1 {
            return self.shift_bit(b, op, a, by);
        }
        if let Some(scalar) = self.values[&by].scalar {
            return self.shift_uniform(b, op, a, scalar, self.width(by));
        }
        let need = match op {
            Shift::Left => Need::Any,
            Shift::Right => Need::Clean,
            Shift::RightSigned => Need::Signed,
        };
        let least = self.element(width).max(self.element(self.width(by)));
        let element = self.pick(least, &[(a, need), (by, Need::Clean)], 8);
        if element == 64 {
            return self.shift_lanes(b, op, a, by);
        }
        let value = self.number(b, a, element, need);
        if self.width(by) == 1 || op != Shift::Left && self.width(by) == 2 && (element != 32 || width > 24) {
            return self.shift_steps(b, op, value, by);
        }
        match op {
            Shift::Left => {
                let powers = self.powers(b, by, element, false);
                let form = Form::Bits(element);
                if self.known(a) == Some(1) {
                    return Vector { width, element, form, parts: powers, inverse: None };
                }
                let powers = Vector { width, element, form, parts: powers, inverse: None };
                let parts = self.multiplied(b, &value, &powers);
                Vector { width, element, form, parts, inverse: None }
            }
            // It is clean, but only a mask shows that a number stored in a place is within its width.
            _ if op == Shift::Right || value.form.bits(element) < element => {
                Vector { form: Form::Bits(element), ..self.shifted_down(b, &value, by) }
            }
            Shift::Right | Shift::RightSigned => {
                // Shifted without a sign, with negative numbers inverted before and after.
                let signs = match element {
                    8 => {
                        let zero = self.bits(b, 8, 0);
                        vectors::map(&value.parts, |part| b.compare(Comparison::SignedGreaterThan, zero, part))
                    }
                    _ => self.top_bits(b, element, &value.parts),
                };
                let positive = vectors::map2(&value.parts, &signs, |part, sign| b.xor(part, sign));
                let bits = value.form.signed_bits(element) - 1;
                let positive = Vector { form: Form::Bits(bits), parts: positive, ..value.clone() };
                let down = self.shifted_down(b, &positive, by);
                let parts = vectors::map2(&down.parts, &signs, |part, sign| b.xor(part, sign));
                Vector { form: value.form, parts, ..value }
            }
        }
    }

    fn shift_known(&mut self, b: &mut Builder, op: Shift, a: ValueId, by: u64) -> Vector {
        let width = self.width(a);
        let element = self.element(width);
        let by = by.min(u64::from(if op == Shift::RightSigned { width - 1 } else { width })) as u32;
        if by == width {
            return self.known_vector(b, width, 0, element, Need::of(width));
        }
        let need = if width == 1 { Need::Signed } else { Need::Any };
        if by == 0 {
            let element = self.pick(element, &[(a, need)], 0);
            return self.number(b, a, element, need);
        }
        match op {
            Shift::Left => {
                let element = self.pick(element, &[(a, need)], 1);
                let value = self.number(b, a, element, need);
                self.shifted_left(b, &value, by)
            }
            Shift::Right => {
                let element = self.pick(element, &[(a, Need::Clean)], 1);
                if element != 8 {
                    let value = self.number(b, a, element, Need::Clean);
                    return self.shifted_right(b, &value, by);
                }
                let value = self.number(b, a, element, Need::Any);
                let left = self.bits(b, 8, low_mask(width - by));
                let down = self.shifted_right(b, &value, by);
                let parts = vectors::map(&down.parts, |part| b.and(part, left));
                Vector { form: Form::Bits(width - by), parts, ..down }
            }
            Shift::RightSigned => {
                let element = self.pick(element, &[(a, Need::Signed)], 1);
                if element == 8 {
                    let value = self.number(b, a, element, Need::Any);
                    let (left, sign) = (self.bits(b, 8, low_mask(width - by)), self.bits(b, 8, 1 << (width - by - 1)));
                    let down = self.shifted_right(b, &value, by);
                    let parts = vectors::map(&down.parts, |part| {
                        let part = b.and(part, left);
                        let part = b.xor(part, sign);
                        b.sub(part, sign)
                    });
                    return Vector { form: Form::signed(width - by, 8), parts, ..down };
                }
                let parts = self.parts(element) as u32;
                let (from, by) = match self.top_cost(a, element) < self.cost(a, element, Need::Signed).max(parts) {
                    true => (self.top(b, a, element), element - width + by),
                    false => (self.number(b, a, element, Need::Signed), by),
                };
                let form = Form::signed(from.form.signed_bits(element).saturating_sub(by).max(1), element);
                let by = b.constant(Type::I64, i64::from(by));
                let parts = vectors::map(&from.parts, |part| b.sar(part, by));
                Vector { width, element, form, parts, inverse: None }
            }
        }
    }

    /// One bit remains if the amount is zero; with a sign it always remains.
    fn shift_bit(&mut self, b: &mut Builder, op: Shift, a: ValueId, by: ValueId) -> Vector {
        let element = self.pick(8, &[(a, Need::Signed)], 0);
        if op == Shift::RightSigned {
            return self.number(b, a, element, Need::Signed);
        }
        let kept = match self.width(by) {
            1 => {
                let element = self.pick(8, &[(by, Need::Signed)], 0);
                let mask = self.number(b, by, element, Need::Signed);
                self.not(b, mask)
            }
            _ => {
                let (of, signed) = self.exact(b, &[by]);
                self.key(b, &of[0], 0, signed)
            }
        };
        let value = self.number(b, a, kept.element, Need::Signed);
        self.combined(b, Binary::And, &value, &kept)
    }

    /// Shifts all lanes by one amount.
    fn shift_uniform(&mut self, b: &mut Builder, op: Shift, a: ValueId, by: Value, bits: u32) -> Vector {
        let width = self.width(a);
        let need = match op {
            Shift::Left => Need::Any,
            Shift::Right => Need::Clean,
            Shift::RightSigned => Need::Signed,
        };
        let element = self.pick(self.element(width), &[(a, need)], 1);
        let value = self.number(b, a, element, need);
        let at_most = |b: &mut Builder, limit: u32| match most(bits) > u64::from(limit) {
            true => {
                let limit = b.constant(Type::I64, i64::from(limit));
                b.min(by, limit)
            }
            false => by,
        };
        let amounts = match op {
            // If the value is narrower than the element, the result is correct; an element as wide as the value
            // interprets the amount modulo its width.
            _ if op == Shift::RightSigned || width < element || most(bits) < u64::from(element) => {
                vec![at_most(b, element - 1)]
            }
            _ => {
                let all = at_most(b, element);
                let one = b.constant(Type::I64, 1);
                let half = b.shr(all, one);
                vec![half, b.sub(all, half)]
            }
        };
        let mut parts = value.parts.clone();
        for by in amounts {
            parts = vectors::map(&parts, |part| match op {
                Shift::Left => b.shl(part, by),
                Shift::Right => b.shr(part, by),
                Shift::RightSigned => b.sar(part, by),
            });
        }
        let form = match op {
            Shift::Left => Form::Bits(element),
            Shift::Right => Form::Bits(value.form.bits(element)),
            Shift::RightSigned => value.form,
        };
        Vector { width, element, form, parts, inverse: None }
    }

    /// Shifts lane by lane.
    fn shift_lanes(&mut self, b: &mut Builder, op: Shift, a: ValueId, by: ValueId) -> Vector {
        let (width, bits) = (self.width(a), self.width(by));
        let need = if op == Shift::RightSigned { Need::Signed } else { Need::Clean };
        // Both from the vectors at once, so that conversions are made of whole vectors.
        let element = self.element(width);
        let value = self.number(b, a, element, need);
        let mut lanes = Vec::new();
        for lane in 0..self.strip {
            let x = self.lane(b, &value, lane, op == Shift::RightSigned);
            let n = self.extract(b, by, lane);
            let limit = b.constant(Type::I64, 63);
            let shifted = match op {
                Shift::RightSigned => {
                    let n = if most(bits) > 63 { b.min(n, limit) } else { n };
                    b.sar(x, n)
                }
                Shift::Left => b.shl(x, n),
                Shift::Right => b.shr(x, n),
            };
            lanes.push(if op == Shift::RightSigned || most(bits) <= 63 {
                shifted
            } else {
                let inside = b.compare(Comparison::UnsignedLessThanOrEqual, n, limit);
                let zero = b.constant(Type::I64, 0);
                b.select(inside, shifted, zero)
            });
        }
        let parts = self.gathered(b, element, &lanes);
        let form = match op {
            Shift::Left => Form::Bits(element),
            Shift::Right => Form::Bits(width),
            Shift::RightSigned => Form::signed(width, element),
        };
        Vector { width, element, form, parts, inverse: None }
    }

    /// Shifts by each bit of the amount in turn.
    fn shift_steps(&mut self, b: &mut Builder, op: Shift, value: Vector, by: ValueId) -> Vector {
        let Vector { width, element, .. } = value;
        let mut value = value;
        for i in 0..self.width(by) {
            let mut taken = match self.width(by) {
                1 => self.number(b, by, element, Need::Signed),
                _ => self.bit(b, by, i),
            };
            while let Some((step, form, to)) = super::next(taken.form, 1, taken.element, element, Need::Signed) {
                taken = self.step(b, step, &taken, form, to);
            }
            let shifted = match op {
                Shift::Left if 1 << i < element => self.shifted_left(b, &value, 1 << i),
                Shift::Right if 1 << i < element => {
                    let down = self.shifted_right(b, &value, 1 << i);
                    match element {
                        8 => {
                            let left = self.bits(b, 8, 0xff >> (1 << i));
                            let parts = vectors::map(&down.parts, |part| b.and(part, left));
                            Vector { form: Form::Bits(8 - (1 << i)), parts, ..down }
                        }
                        _ => down,
                    }
                }
                Shift::Left | Shift::Right => self.known_vector(b, width, 0, element, Need::Any),
                Shift::RightSigned => {
                    let by = b.constant(Type::I64, (1 << i).min(i64::from(element) - 1));
                    let parts = vectors::map(&value.parts, |part| b.sar(part, by));
                    Vector { parts, inverse: None, ..value.clone() }
                }
            };
            value = self.mux(b, &taken, &shifted, &value);
        }
        value
    }

    /// Two to the power of the amount or, if `falling`, of the element's highest bit minus the amount; zero if the
    /// amount is the element's width or more.
    fn powers(&mut self, b: &mut Builder, by: ValueId, element: u32, falling: bool) -> Vec<Value> {
        if let Some(powers) = self.powers.get(&(by, element, falling)) {
            return powers.clone();
        }
        let amount = self.number(b, by, element, Need::Clean);
        let largest = most(self.width(by));
        let parts = match element {
            // As the exponent of a float.
            32 => {
                let (bias, up) = (self.bits(b, 32, if falling { 158 } else { 127 }), b.constant(Type::I64, 23));
                let limit = if largest > 31 { Some(self.bits(b, 32, 32)) } else { None };
                vectors::map(&amount.parts, |part| {
                    let exponent = if falling { b.sub(bias, part) } else { b.add(part, bias) };
                    let float = b.shl(exponent, up);
                    let float = b.cast(b.vector(32).floats(), float);
                    let power = b.integers(b.vector(32), float);
                    match limit {
                        None => power,
                        Some(limit) if largest < 1 << 31 => {
                            let inside = b.compare(Comparison::SignedGreaterThan, limit, part);
                            b.and(power, inside)
                        }
                        Some(limit) => {
                            let inside = b.compare(Comparison::UnsignedLessThan, part, limit);
                            b.and(power, inside)
                        }
                    }
                })
            }
            // From a table of bytes, which gives zero beyond its end.
            16 => {
                let (each, ends) = (self.bits(b, 16, 0x0101), self.bits(b, 16, if falling { 0x0800 } else { 0xf800 }));
                let table = b.numbers(Type::TABLE, |i| match falling {
                    true => u64::from(i >= 8) * (1 << (15 - i)) % 256,
                    false => u64::from(i < 8) * (1 << i) % 256,
                });
                let limit = if largest > 255 { Some(self.bits(b, 16, 128)) } else { None };
                vectors::map(&amount.parts, |part| {
                    let part = limit.map_or(part, |limit| b.min(part, limit));
                    let twice = b.mul(part, each);
                    let numbers = b.add(twice, ends);
                    let numbers = b.cast(b.vector(8), numbers);
                    let powers = b.swizzle(table, numbers);
                    b.cast(b.vector(16), powers)
                })
            }
            _ => {
                let table = b.numbers(Type::TABLE, |i| match falling {
                    true => 0x80 >> i,
                    false => u64::from(i < 8) * (1 << i) % 256,
                });
                vectors::map(&amount.parts, |part| b.swizzle(table, part))
            }
        };
        self.powers.insert((by, element, falling), parts.clone());
        self.done.push(Done::Power(by, element, falling));
        parts
    }

    /// Clean numbers, with zeros shifted in.
    fn shifted_down(&mut self, b: &mut Builder, value: &Vector, by: ValueId) -> Vector {
        let Vector { width, element, form, .. } = *value;
        if element == 32 && form.bits(32) <= 24 {
            return self.shifted_down_float(b, value, by);
        }
        let powers = self.powers(b, by, element, true);
        let down = b.constant(Type::I64, i64::from(element - 1));
        let parts = match element {
            32 => {
                let long = self.long_product(b, false, &value.parts, &powers);
                let long = vectors::map(&long, |part| b.shr(part, down));
                vectors::resize(b, super::Step::Cut, &long, 64)
            }
            16 => {
                let long = self.long_product(b, false, &value.parts, &powers);
                let long = vectors::map(&long, |part| b.shr(part, down));
                vectors::resize(b, super::Step::Narrow, &long, 32)
            }
            _ => {
                let (even, odd) = (self.bits(b, 16, 0x00ff), self.bits(b, 16, 0xff00));
                let one = b.constant(Type::I64, 1);
                vectors::map2(&value.parts, &powers, |x, power| {
                    let [x, power] = [x, power].map(|part| b.cast(b.vector(16), part));
                    let [x0, power0] = [x, power].map(|part| b.and(part, even));
                    let [x1, power1] = [x, power].map(|part| vectors::shift_dirty(b, part, 16, false, 8));
                    let low = b.mul(x0, power0);
                    let low = b.shr(low, down);
                    let high = b.mul(x1, power1);
                    let high = b.shl(high, one);
                    let high = b.and(high, odd);
                    let both = b.or(low, high);
                    b.cast(b.vector(8), both)
                })
            }
        };
        Vector { width, element, form: Form::Bits(form.bits(element)), parts, inverse: None }
    }

    /// Multiplied by a negative power of two, which is exact, and truncated.
    fn shifted_down_float(&mut self, b: &mut Builder, value: &Vector, by: ValueId) -> Vector {
        let amount = self.number(b, by, 32, Need::Clean);
        let largest = most(self.width(by));
        let limit = if largest > 126 { Some(self.bits(b, 32, 126)) } else { None };
        let (bias, up) = (self.bits(b, 32, 127), b.constant(Type::I64, 23));
        let parts = vectors::map2(&value.parts, &amount.parts, |part, by| {
            let by = limit.map_or(by, |limit| b.min(by, limit));
            let exponent = b.sub(bias, by);
            let factor = b.shl(exponent, up);
            let factor = b.cast(b.vector(32).floats(), factor);
            let float = b.floats(b.vector(32).floats(), part);
            let float = b.mul_float(float, factor);
            b.integers(b.vector(32), float)
        });
        Vector { parts, inverse: None, ..value.clone() }
    }
}
