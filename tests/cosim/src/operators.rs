//! Every operator of the language, with what it means in arithmetic on big integers.
//!
//! The meanings share no code with the simulator: they are written with `num-bigint` from the words of
//! [`tilewright_hdl::ir`].

use crate::build::compare;
use num_bigint::BigUint;
use std::fmt;
use tilewright_hdl::ir::Relation;
use tilewright_hdl::*;

/// The width of the operand `by`, a shift amount of any size.
pub const BY_WIDTH: u32 = 9;

/// The operands in the circuit: `a` and `b` of one width, `by` of [`BY_WIDTH`] bits.
#[derive(Debug, Clone, Copy)]
pub struct Operands {
    /// First operand.
    pub a: Signal,
    /// Second operand.
    pub b: Signal,
    /// An amount, or a selector.
    pub by: Signal,
}

/// The operands as numbers.
#[derive(Debug, Clone)]
pub struct Numbers {
    /// The width of `a` and `b`.
    pub width: u32,
    /// First operand.
    pub a: BigUint,
    /// Second operand.
    pub b: BigUint,
    /// An amount, or a selector.
    pub by: u32,
}

/// An operator.
pub struct Operator {
    /// Its name, for messages.
    pub name: &'static str,
    /// The circuit.
    pub circuit: fn(Operands) -> Signal,
    /// Its meaning, of any size: the circuit's result is this modulo 2 to its width.
    pub meaning: fn(&Numbers) -> BigUint,
}

impl fmt::Debug for Operator {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.name)
    }
}

fn power(exponent: u32) -> BigUint {
    BigUint::from(1u8) << exponent
}

fn flag(holds: bool) -> BigUint {
    BigUint::from(u8::from(holds))
}

impl Numbers {
    fn is_negative(&self, value: &BigUint) -> bool {
        value.bit(u64::from(self.width) - 1)
    }

    /// The value in two's complement of `to` bits, at least the width.
    fn extended(&self, value: &BigUint, to: u32) -> BigUint {
        if self.is_negative(value) { value + power(to) - power(self.width) } else { value.clone() }
    }

    /// A number in the order of two's complement.
    fn rank(&self, value: &BigUint) -> BigUint {
        (value + power(self.width - 1)) % power(self.width)
    }

    fn negative(&self, value: &BigUint) -> BigUint {
        power(self.width) - value
    }

    fn inverse(&self, value: &BigUint) -> BigUint {
        power(self.width) - 1u8 - value
    }

    fn shifted_signed(&self, by: u32) -> BigUint {
        let by = by.min(self.width);
        self.extended(&self.a, 2 * self.width) >> by
    }

    fn ordered(&self, signed: bool) -> std::cmp::Ordering {
        if signed { self.rank(&self.a).cmp(&self.rank(&self.b)) } else { self.a.cmp(&self.b) }
    }

    fn bit_of_by(&self, bit: u32) -> bool {
        self.by >> bit & 1 == 1
    }
}

macro_rules! operators {
    ($($name:literal: $circuit:expr => $meaning:expr;)*) => {
        &[$(Operator { name: $name, circuit: $circuit, meaning: $meaning }),*]
    };
}

/// All of them.
pub const OPERATORS: &[Operator] = operators! {
    "a + b": |o| o.a + o.b => |n| &n.a + &n.b;
    "a - b": |o| o.a - o.b => |n| &n.a + n.negative(&n.b);
    "a & b": |o| o.a & o.b => |n| &n.a & &n.b;
    "a | b": |o| o.a | o.b => |n| &n.a | &n.b;
    "a ^ b": |o| o.a ^ o.b => |n| &n.a ^ &n.b;
    "!a": |o| !o.a => |n| n.inverse(&n.a);
    "-a": |o| (-o.a.signed()).bits() => |n| n.negative(&n.a);
    "a.add_carry(b)": |o| o.a.add_carry(o.b) => |n| &n.a + &n.b;
    "a * b": |o| o.a * o.b => |n| &n.a * &n.b;
    "a * by": |o| o.a * o.by => |n| &n.a * n.by;
    "a * b, signed": |o| (o.a.signed() * o.b.signed()).bits()
        => |n| n.extended(&n.a, 2 * n.width) * n.extended(&n.b, 2 * n.width);
    "a * by, signed": |o| (o.a.signed() * o.by.zext(BY_WIDTH + 1).signed()).bits()
        => |n| n.extended(&n.a, n.width + BY_WIDTH + 1) * n.by;
    "a == b": |o| compare(Relation::Eq, false, o.a, o.b) => |n| flag(n.a == n.b);
    "a != b": |o| compare(Relation::Ne, false, o.a, o.b) => |n| flag(n.a != n.b);
    "a < b": |o| compare(Relation::Lt, false, o.a, o.b) => |n| flag(n.ordered(false).is_lt());
    "a <= b": |o| compare(Relation::Le, false, o.a, o.b) => |n| flag(n.ordered(false).is_le());
    "a > b": |o| compare(Relation::Gt, false, o.a, o.b) => |n| flag(n.ordered(false).is_gt());
    "a >= b": |o| compare(Relation::Ge, false, o.a, o.b) => |n| flag(n.ordered(false).is_ge());
    "a == b, signed": |o| compare(Relation::Eq, true, o.a, o.b) => |n| flag(n.a == n.b);
    "a != b, signed": |o| compare(Relation::Ne, true, o.a, o.b) => |n| flag(n.a != n.b);
    "a < b, signed": |o| compare(Relation::Lt, true, o.a, o.b) => |n| flag(n.ordered(true).is_lt());
    "a <= b, signed": |o| compare(Relation::Le, true, o.a, o.b) => |n| flag(n.ordered(true).is_le());
    "a > b, signed": |o| compare(Relation::Gt, true, o.a, o.b) => |n| flag(n.ordered(true).is_gt());
    "a >= b, signed": |o| compare(Relation::Ge, true, o.a, o.b) => |n| flag(n.ordered(true).is_ge());
    "a < 0, signed": |o| o.a.signed().lt(0) => |n| flag(n.is_negative(&n.a));
    "a << by": |o| o.a << o.by => |n| &n.a << n.by;
    "a >> by": |o| o.a >> o.by => |n| &n.a >> n.by;
    "a >> by, signed": |o| (o.a.signed() >> o.by).bits() => |n| n.shifted_signed(n.by);
    "a << b": |o| o.a << o.b => |n| if n.b < BigUint::from(n.width) { &n.a * n.b.to_bytes_le().first().map_or(power(0), |by| power(u32::from(*by))) } else { BigUint::ZERO };
    "a << 1": |o| o.a << 1 => |n| &n.a << 1;
    "a >> 1": |o| o.a >> 1 => |n| &n.a >> 1;
    "a >> 1, signed": |o| (o.a.signed() >> 1).bits() => |n| n.shifted_signed(1);
    "a >> width, signed": |o| (o.a.signed() >> o.a.width()).bits() => |n| n.shifted_signed(n.width);
    "(a + b) >> 1, signed": |o| ((o.a + o.b).signed() >> 1).bits()
        => |n| Numbers { a: (&n.a + &n.b) % power(n.width), ..n.clone() }.shifted_signed(1);
    "all ones": |o| o.a.all_ones() => |n| flag(n.a == power(n.width) - 1u8);
    "any one": |o| o.a.any_one() => |n| flag(n.a != BigUint::ZERO);
    "parity": |o| o.a.parity() => |n| flag(n.a.count_ones() % 2 == 1);
    "all ones of !a": |o| (!o.a).all_ones() => |n| flag(n.a == BigUint::ZERO);
    "any one of !a": |o| (!o.a).any_one() => |n| flag(n.a != power(n.width) - 1u8);
    "parity of !a": |o| (!o.a).parity() => |n| flag(n.inverse(&n.a).count_ones() % 2 == 1);
    "parity of a ^ b": |o| (o.a ^ o.b).parity() => |n| flag((&n.a ^ &n.b).count_ones() % 2 == 1);
    "mux": |o| mux(o.by.bit(0), o.a, o.b) => |n| if n.bit_of_by(0) { n.a.clone() } else { n.b.clone() };
    "select": |o| select([(o.by.bit(1), o.a), (o.by.bit(2), o.b)], o.a ^ o.b) => |n| match n.by >> 1 & 3 {
        1 | 3 => n.a.clone(),
        2 => n.b.clone(),
        _ => &n.a ^ &n.b,
    };
    "case": |o| case(o.by.trunc(3), [(6, o.a), (0, o.b), (1, !o.a)], o.a & o.b) => |n| match n.by & 7 {
        6 => n.a.clone(),
        0 => n.b.clone(),
        1 => n.inverse(&n.a),
        _ => &n.a & &n.b,
    };
    "slice": |o| o.a.slice(o.a.width() / 3..o.a.width()) => |n| &n.a >> (n.width / 3);
    "slice of a sum": |o| (o.a + o.b).slice(o.a.width() / 2..o.a.width())
        => |n| ((&n.a + &n.b) % power(n.width)) >> (n.width / 2);
    "sign": |o| o.a.msb() => |n| flag(n.is_negative(&n.a));
    "{a, by, b}": |o| cat![o.a, o.by, o.b]
        => |n| (&n.a << (n.width + BY_WIDTH)) + (BigUint::from(n.by) << n.width) + &n.b;
    "{a, a, a}": |o| o.a.repeat(3) => |n| (&n.a << (2 * n.width)) + (&n.a << n.width) + &n.a;
    "zext": |o| o.a.zext(o.a.width() + 67) => |n| n.a.clone();
    "sext": |o| o.a.sext(o.a.width() + 67) => |n| n.extended(&n.a, n.width + 67);
    "sext by 1": |o| o.a.sext(o.a.width() + 1) => |n| n.extended(&n.a, n.width + 1);
    "named": |o| (o.a + o.b).named("sum") => |n| &n.a + &n.b;
};
