//! The operands that decide some bits of an operation's result: the rules for single lanes.
//!
//! A choice counts its condition and its chosen side; an AND only its zeros, where it has one, and an OR only its
//! ones. As long as what counts stays, these bits stay, whatever else changes.

use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Binary, Relation, Shift, Unary};

use super::{lanes, mask};
use crate::engine::program::{Cell, Circuit, Kind, ValueId};

/// A part of the circuit that has a value: one computed or stored, or a word of a memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Place {
    /// A word of a memory: its index and the address.
    Word(u32, u32),
    /// A value.
    Value(ValueId),
}

/// Some bits in one lane, on which others depend.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Demand {
    pub place: Place,
    pub lane: u32,
    pub bits: Bits,
    /// They choose what happens, rather than being part of it.
    pub is_control: bool,
}

impl Demand {
    pub fn data(id: ValueId, lane: u32, bits: Bits) -> Demand {
        Demand { place: Place::Value(id), lane, bits, is_control: false }
    }

    pub fn control(id: ValueId, lane: u32, bits: Bits) -> Demand {
        Demand { is_control: true, ..Demand::data(id, lane, bits) }
    }
}

/// An operation in one lane, with the bits of its result that are asked about.
pub(super) struct Asked<'a> {
    pub circuit: &'a Circuit,
    pub cell: &'a Cell,
    pub lane: u32,
    pub bits: &'a Bits,
}

/// What decides these bits. `value` gives a lane of a value. Demands may be for no bits.
pub(super) fn demands(asked: &Asked, value: &mut dyn FnMut(ValueId, u32) -> Bits) -> Vec<Demand> {
    let &Asked { circuit, cell, lane, bits } = asked;
    let width = |id: ValueId| circuit[id].width;
    let data = |id: ValueId, bits: Bits| Demand::data(id, lane, bits);
    let control = |id: ValueId| Demand::control(id, lane, mask::all(width(id)));
    match &cell.kind {
        Kind::Unary(op, a) => vec![data(*a, unary(*op, bits, &value(*a, lane)))],
        Kind::Binary(op, a, b) => binary(*op, asked, [*a, *b], value),
        Kind::Compare(relation, _, a, b) => {
            let counts = compared(*relation, &value(*a, lane), &value(*b, lane));
            vec![data(*a, counts.clone()), data(*b, counts)]
        }
        Kind::Shift(op, a, by) => {
            let of = shifted(*op, bits, at_most(&value(*by, lane), width(*a)));
            vec![data(*a, of), data(*by, mask::all(width(*by)))]
        }
        Kind::Mux { select, on_true, on_false } => {
            let chosen = if value(*select, lane).bit(0) { on_true } else { on_false };
            vec![control(*select), data(*chosen, bits.clone())]
        }
        Kind::Select { arms, default } => {
            let taken = arms.iter().position(|(condition, _)| value(*condition, lane).bit(0));
            let tried = &arms[..taken.map_or(arms.len(), |taken| taken + 1)];
            let chosen = taken.map_or(*default, |taken| arms[taken].1);
            tried.iter().map(|(condition, _)| control(*condition)).chain([data(chosen, bits.clone())]).collect()
        }
        Kind::Case { subject, arms, default } => {
            let number = value(*subject, lane);
            let taken = arms.iter().find(|(key, _)| key.limbs() == number.limbs());
            let chosen = taken.map_or(*default, |(_, value)| *value);
            vec![control(*subject), data(chosen, bits.clone())]
        }
        Kind::Slice(of, low) => vec![data(*of, mask::placed(bits, width(*of), *low))],
        Kind::Concat(parts) => {
            let mut low = 0;
            let part = |part: &ValueId| {
                low += width(*part);
                data(*part, bits.slice(low - width(*part)..low))
            };
            parts.iter().rev().map(part).collect()
        }
        Kind::Repeat(of, times) => {
            let copies = (0..*times).map(|copy| bits.slice(copy * width(*of)..(copy + 1) * width(*of)));
            vec![data(*of, copies.reduce(|a, b| mask::or(&a, &b)).expect("there is a copy"))]
        }
        Kind::Extend(of, is_signed) => {
            let own = width(*of);
            let above = *is_signed && mask::highest(bits).is_some_and(|highest| highest >= own);
            let sign = if above { mask::one(own, own - 1) } else { mask::none(own) };
            vec![data(*of, mask::or(&mask::placed(bits, own, 0), &sign))]
        }
        Kind::State | Kind::Const(_) => Vec::new(),
        _ => lanes::demands(asked, value),
    }
}

/// A number, or `limit` if it is that or more.
pub(super) fn at_most(number: &Bits, limit: u32) -> u32 {
    number.to_u64().map_or(limit, |number| number.min(limit.into()) as u32)
}

fn unary(op: Unary, bits: &Bits, a: &Bits) -> Bits {
    let all = mask::all(a.width());
    match op {
        Unary::Not => bits.clone(),
        Unary::AllOnes if a.limbs() != all.limbs() => mask::first(&a.not()),
        Unary::AnyOne if !a.is_zero() => mask::first(a),
        Unary::AllOnes | Unary::AnyOne | Unary::Parity => all,
    }
}

fn binary(op: Binary, asked: &Asked, [a, b]: [ValueId; 2], value: &mut dyn FnMut(ValueId, u32) -> Bits) -> Vec<Demand> {
    let &Asked { circuit, lane, bits, .. } = asked;
    let widths = [circuit[a].width, circuit[b].width];
    let both = |of_a: Bits, of_b: Bits| vec![Demand::data(a, lane, of_a), Demand::data(b, lane, of_b)];
    match op {
        // Where one has the value that decides and the other has not, only the one counts.
        Binary::And | Binary::Or => {
            let [x, y] = [a, b].map(|id| value(id, lane));
            let [x, y] = if op == Binary::And { [x, y] } else { [x.not(), y.not()] };
            both(mask::and(bits, &mask::or(&x.not(), &y)), mask::and(bits, &mask::or(&y.not(), &x)))
        }
        Binary::Xor => both(bits.clone(), bits.clone()),
        Binary::Mul | Binary::MulSigned if value(a, lane).is_zero() => {
            both(mask::up_to_highest(bits, widths[0]), mask::none(widths[1]))
        }
        Binary::Mul | Binary::MulSigned if value(b, lane).is_zero() => {
            both(mask::none(widths[0]), mask::up_to_highest(bits, widths[1]))
        }
        // Carries go up.
        Binary::Add | Binary::Sub | Binary::Mul | Binary::MulSigned => {
            both(mask::up_to_highest(bits, widths[0]), mask::up_to_highest(bits, widths[1]))
        }
    }
}

/// The bits of both operands of a comparison that count: for equality one that differs, for an order those from the
/// highest that differs up, and all if none does.
fn compared(relation: Relation, a: &Bits, b: &Bits) -> Bits {
    let (width, differ) = (a.width(), mask::xor(a, b));
    match (relation, mask::highest(&differ)) {
        (_, None) => mask::all(width),
        (Relation::Eq | Relation::Ne, Some(_)) => mask::first(&differ),
        (_, Some(highest)) => mask::between(width, highest, width),
    }
}

/// The bits of a shifted value that these bits of the result are.
fn shifted(op: Shift, bits: &Bits, by: u32) -> Bits {
    let width = bits.width();
    if op == Shift::Left {
        return if by < width { bits.slice(by..width).resize(width) } else { mask::none(width) };
    }
    let of = mask::placed(bits, width, by);
    let is_sign = op == Shift::RightSigned && mask::highest(bits).is_some_and(|highest| highest + by >= width);
    if is_sign { mask::or(&of, &mask::one(width, width - 1)) } else { of }
}
