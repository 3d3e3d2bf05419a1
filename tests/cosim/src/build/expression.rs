//! Steps that are expressions.

use super::{Builder, narrow};
use crate::spec::*;
use tilewright_hdl::ir::{Relation, Shift};
use tilewright_hdl::*;

impl Builder<'_> {
    pub fn expression(&mut self, d: usize, number: usize, make: &Make) -> Signal {
        match make {
            Make::Constant(width, pattern) => match pattern.bits(*width).to_u64() {
                Some(number) => lit(*width, number),
                None => lit(*width, 0) | pattern.bits(*width),
            },
            Make::Unary(op, a) => {
                let a = self.pick(d, *a);
                match op {
                    Unary::Not => !a,
                    Unary::Negative => (-a.signed()).bits(),
                    Unary::AllOnes => a.all_ones(),
                    Unary::AnyOne => a.any_one(),
                    Unary::Parity => a.parity(),
                }
            }
            Make::Binary(op, a, b) => {
                let a = self.pick(d, *a);
                let b = self.pick_fit(d, *b, a.width());
                narrow(binary(*op, a, b))
            }
            Make::Alu { subject, bits, arms, default } => {
                let (subject, default) = (self.pick_fit(d, *subject, *bits), self.pick(d, *default));
                let width = default.width();
                let arm = |arm: &Arm| {
                    let [a, b, c] = arm.operands.map(|pick| self.pick_fit(d, pick, width));
                    binary(arm.op, a, b).trunc(width) + (c - a)
                };
                let arms: Vec<Signal> = arms.iter().take(1 << bits).map(arm).collect();
                case(subject, (0..).zip(arms), default)
            }
            Make::Is(of, value) => {
                let of = self.pick(d, *of);
                of.eq(Bits::new(of.width(), *value))
            }
            Make::Product { signed, operands } => {
                let [a, b] = operands.map(|pick| self.pick(d, pick));
                let [a, b] = [a, b].map(|s| s.trunc(s.width().min(WIDEST / 2)));
                if *signed { (a.signed() * b.signed()).bits() } else { a * b }
            }
            Make::Compare { relation, signed, operands: [a, b] } => {
                let a = self.pick(d, *a);
                let b = self.pick_fit(d, *b, a.width());
                compare(*relation, *signed, a, b)
            }
            Make::Shift { shift, of, by } => {
                let (of, by) = (self.pick(d, *of), self.pick(d, *by));
                match shift {
                    Shift::Left => of << by,
                    Shift::Right => of >> by,
                    Shift::RightSigned => (of.signed() >> by).bits(),
                }
            }
            Make::ShiftBy { shift, of, by, literal: true } => {
                let (of, by) = (self.pick(d, *of), lit(7, u64::from(*by)));
                match shift {
                    Shift::Left => of << by,
                    Shift::Right => of >> by,
                    Shift::RightSigned => (of.signed() >> by).bits(),
                }
            }
            Make::Rotate { of, size, by } => {
                let width = 8 << size;
                let (of, by) = (self.pick_fit(d, *of, width), 1 + by % (width - 1));
                cat!(of.slice(0..width - by), of.slice(width - by..width))
            }
            Make::Lookup { subject, bits, width, words } => {
                let subject = self.pick_fit(d, *subject, *bits);
                let word = |word: &Pattern| lit(*width, 0) | word.bits(*width);
                let words: Vec<Signal> = words.iter().take(1 << bits).map(word).collect();
                case(subject, (0..).zip(words), lit(*width, 1))
            }
            Make::ShiftBy { shift, of, by, .. } => {
                let of = self.pick(d, *of);
                match shift {
                    Shift::Left => of << *by,
                    Shift::Right => of >> *by,
                    Shift::RightSigned => (of.signed() >> *by).bits(),
                }
            }
            Make::Mux { select, on_true, on_false } => {
                let select = self.pick_fit(d, *select, 1);
                let on_true = self.pick(d, *on_true);
                mux(select, on_true, self.pick_fit(d, *on_false, on_true.width()))
            }
            Make::Select { arms, default } => {
                let default = self.pick(d, *default);
                let arm = |(condition, value): &(Pick, Pick)| {
                    (self.pick_fit(d, *condition, 1), self.pick_fit(d, *value, default.width()))
                };
                let arms: Vec<_> = arms.iter().map(arm).collect();
                select(arms, default)
            }
            Make::Case { subject, arms, default } => {
                let (subject, default) = (self.pick(d, *subject), self.pick(d, *default));
                let mut known: Vec<(u64, Signal)> = Vec::new();
                for (key, value) in arms {
                    let key = Bits::new(subject.width(), *key).limbs()[0];
                    if known.iter().all(|(other, _)| *other != key) {
                        known.push((key, self.pick_fit(d, *value, default.width())));
                    }
                }
                case(subject, known, default)
            }
            Make::Slice { of, low, width } => {
                let of = self.pick(d, *of);
                let low = low % of.width();
                of.slice(low..(low + width).min(of.width()))
            }
            Make::Extend { of, by, signed } => {
                let of = self.pick(d, *of);
                let width = (of.width() + by).min(WIDEST).max(of.width());
                if *signed { of.sext(width) } else { of.zext(width) }
            }
            Make::Concat(parts) => {
                let parts: Vec<_> = parts.iter().map(|part| self.pick(d, *part)).collect();
                let mut width = 0;
                let fitting = parts.iter().take_while(|part| {
                    width += part.width();
                    width <= WIDEST
                });
                let fitting: Vec<_> = fitting.copied().collect();
                if fitting.is_empty() { lit(3, 5) } else { concat(&fitting) }
            }
            Make::Repeat(of, times) => {
                let of = self.pick(d, *of);
                of.repeat((*times).min(WIDEST / of.width()).max(1))
            }
            Make::Name(of) => {
                let name = self.inner_name(&format!("n{number}"));
                self.pick(d, *of).named(&name)
            }
            Make::Wire(of) => {
                let of = self.pick(d, *of);
                let name = self.inner_name(&format!("w{number}"));
                let wire = self.on(d).wire(&name, of.width());
                let read = !*wire;
                wire.drive(of);
                read
            }
            _ => unreachable!("the other steps are objects"),
        }
    }
}

/// An operator, with the carry if it has one.
pub fn binary(op: Binary, a: Signal, b: Signal) -> Signal {
    match op {
        Binary::And => a & b,
        Binary::Or => a | b,
        Binary::Xor => a ^ b,
        Binary::Add => a + b,
        Binary::Sub => a - b,
        Binary::AddCarry => a.add_carry(b),
    }
}

/// A comparison of two values of one width.
pub fn compare(relation: Relation, signed: bool, a: Signal, b: Signal) -> Signal {
    let (x, y) = (a.signed(), b.signed());
    match (relation, signed) {
        (Relation::Eq, false) => a.eq(b),
        (Relation::Ne, false) => a.ne(b),
        (Relation::Lt, false) => a.lt(b),
        (Relation::Le, false) => a.le(b),
        (Relation::Gt, false) => a.gt(b),
        (Relation::Ge, false) => a.ge(b),
        (Relation::Eq, true) => x.eq(y),
        (Relation::Ne, true) => x.ne(y),
        (Relation::Lt, true) => x.lt(y),
        (Relation::Le, true) => x.le(y),
        (Relation::Gt, true) => x.gt(y),
        (Relation::Ge, true) => x.ge(y),
    }
}
