//! Steps that are expressions.

use super::{Builder, narrow};
use crate::features::Feature;
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
                    Unary::Negative => -a.signed(),
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
                let arm = |arm: &Operation| {
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
                if *signed { a.signed() * b.signed() } else { a * b }
            }
            Make::Compare { relation, signed, operands: [a, b] } => {
                let a = self.pick(d, *a);
                let b = self.pick_fit(d, *b, a.width());
                compare(*relation, *signed, a, b)
            }
            Make::Shift { shift, of, by } => {
                let (of, by) = (self.pick(d, *of), self.pick(d, *by));
                shifted(*shift, of, by)
            }
            Make::ShiftBy { shift, of, by, literal } => {
                let of = self.pick(d, *of);
                if *literal { shifted(*shift, of, lit(7, u64::from(*by))) } else { shifted(*shift, of, *by) }
            }
            Make::Rotate { of, size, by, right } => {
                let of = if *size < 4 { self.pick_fit(d, *of, 8 << size) } else { self.pick(d, *of) };
                if *right {
                    Feature::RotateRight.used();
                    of.rotate_right(*by)
                } else {
                    Feature::RotateLeft.used();
                    of.rotate_left(*by)
                }
            }
            Make::WithNumber(with) => self.with_number(d, with),
            Make::Assigned(of, with) => {
                let mut value = self.pick(d, *of);
                for (op, pick) in with {
                    let with = self.pick_fit(d, *pick, value.width());
                    assign(*op, &mut value, with);
                }
                value
            }
            Make::Implies(operands) => {
                Feature::Implies.used();
                let [condition, other] = operands.map(|pick| self.pick_fit(d, pick, 1));
                condition.implies(other)
            }
            Make::Lookup { subject, bits, width, words } => {
                let subject = self.pick_fit(d, *subject, *bits);
                let word = |word: &Pattern| lit(*width, 0) | word.bits(*width);
                let words: Vec<Signal> = words.iter().take(1 << bits).map(word).collect();
                case(subject, (0..).zip(words), lit(*width, 1))
            }
            Make::Mux { meaning, select, on_true, on_false } => {
                meaning.used(Feature::SignedArm, Feature::CodeArm);
                let select = self.pick_fit(d, *select, 1);
                let on_true = self.pick_as(d, *on_true, *meaning);
                mux(select, on_true, self.arm(d, *on_false, *meaning, on_true.width()))
            }
            Make::Select { meaning, arms, default } => {
                meaning.used(Feature::SignedArm, Feature::CodeArm);
                let default = self.pick_as(d, *default, *meaning);
                let arm = |(condition, value): &(Pick, Arm)| {
                    (self.pick_fit(d, *condition, 1), self.arm(d, *value, *meaning, default.width()))
                };
                let values: Vec<_> = arms.iter().map(arm).collect();
                if is_mixed(arms.iter().map(|(_, arm)| arm)) {
                    Feature::MixedArmsOfSelect.used();
                }
                select(values.into_iter().flat_map(|(condition, value)| arms![condition => value]), default)
            }
            Make::Case { meaning, subject, arms, default } => {
                meaning.used(Feature::SignedArm, Feature::CodeArm);
                let (subject, default) = (self.pick(d, *subject), self.pick_as(d, *default, *meaning));
                let mut known: Vec<(u64, Value)> = Vec::new();
                for (key, value) in arms {
                    let key = Bits::new(subject.width(), *key).limbs()[0];
                    if known.iter().all(|(other, _)| *other != key) {
                        known.push((key, self.arm(d, *value, *meaning, default.width())));
                    }
                }
                if is_mixed(arms.iter().map(|(_, arm)| arm)) {
                    Feature::MixedArmsOfCase.used();
                }
                case(subject, known.into_iter().flat_map(|(key, value)| arms![key => value]), default)
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
            Make::Wire(meaning, of) => {
                meaning.used(Feature::SignedWire, Feature::CodeWire);
                let of = self.pick_as(d, *of, *meaning);
                let name = self.inner_name(&format!("w{number}"));
                let wire = self.on(d).wire(&name, meaning.layout(of.width()));
                let read = match meaning {
                    Meaning::Number => !*wire,
                    Meaning::Signed => -*wire,
                    Meaning::Code => meaning.changed(*wire),
                };
                wire.drive(of);
                read
            }
            _ => unreachable!("the other steps are objects"),
        }
    }
}

impl Builder<'_> {
    /// What an arm of a choice gives.
    fn arm(&mut self, d: usize, arm: Arm, meaning: Meaning, width: u32) -> Value {
        match arm {
            Arm::Value(pick) => self.pick_fit_as(d, pick, meaning, width).operand(),
            Arm::Number(pattern) => meaning.constant(pattern, width),
        }
    }
}

/// Whether some are values and some are numbers.
fn is_mixed<'a>(arms: impl Iterator<Item = &'a Arm> + Clone) -> bool {
    let is_number = |arm: &Arm| matches!(arm, Arm::Number(_));
    arms.clone().any(is_number) && !arms.clone().all(is_number)
}

/// A shift; one to the right with the sign is of a signed value, and gives one.
fn shifted(shift: Shift, of: Signal, by: impl ShiftAmount) -> Signal {
    match shift {
        Shift::Left => of << by,
        Shift::Right => of >> by,
        Shift::RightSigned => {
            Feature::SignedShift.used();
            of.signed() >> by
        }
    }
}

/// `value op= with`.
fn assign(op: Binary, value: &mut Signal, with: Signal) {
    Feature::Assigned.used();
    match op {
        Binary::And => *value &= with,
        Binary::Or => *value |= with,
        Binary::Xor => *value ^= with,
        Binary::Add | Binary::AddCarry => *value += with,
        Binary::Sub => *value -= with,
    }
}

/// An operator, with the carry if it has one.
pub fn binary(op: Binary, a: Signal, b: impl Operand) -> Signal {
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
    if signed { related(relation, a.signed(), b.signed()) } else { related(relation, a, b) }
}

/// A comparison.
pub fn related(relation: Relation, a: Signal, b: impl Operand) -> Signal {
    match relation {
        Relation::Eq => a.eq(b),
        Relation::Ne => a.ne(b),
        Relation::Lt => a.lt(b),
        Relation::Le => a.le(b),
        Relation::Gt => a.gt(b),
        Relation::Ge => a.ge(b),
    }
}
