//! What is known of a value before a program runs, and what operations make of it.

use super::super::operation::{Binary, Load, Unary};
use super::super::value::{Bytes, Type};
use super::possible::{Possible, lane, lanes};
use super::{Base, Extent};

/// What is known of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::engine) enum Fact {
    /// An integer that is at least the first number and at most the second one, without a sign.
    Number(u64, u64),
    /// An address: where it begins, and at least and at most how many bytes further it is.
    Address(Base, i64, i64),
    /// A vector, or an integer, in which only these bits may be 1.
    Vector(Possible),
}

use Fact::{Address, Number, Vector};

/// The largest number of so many bits.
pub(super) fn ones(bits: u32) -> u64 {
    u64::MAX >> (64 - bits)
}

/// All bits up to the highest one of a number.
pub(super) fn smear(number: u64) -> u64 {
    if number == 0 { 0 } else { ones(number.ilog2() + 1) }
}

impl Fact {
    /// Nothing but its type.
    pub fn any(ty: Type) -> Fact {
        if ty.is_vector() { Vector(Possible::ALL) } else { Number(0, ones(ty.element())) }
    }

    pub fn constant(ty: Type, number: i64) -> Fact {
        let number = number as u64 & ones(ty.element());
        Number(number, number)
    }

    /// The least and the greatest number.
    pub fn range(self, ty: Type) -> (u64, u64) {
        match self {
            Number(least, most) => (least, most),
            Vector(bits) if !ty.is_vector() => (0, bits.number()),
            _ => (0, ones(ty.element())),
        }
    }

    /// The bits of a vector that may be 1, or of a number.
    pub fn bits(self, ty: Type) -> Possible {
        match self {
            Vector(bits) => bits,
            _ => Possible::of(smear(self.range(ty).1)),
        }
    }

    /// Whether a value may be these bytes; `base` has the address of a base, if that is known.
    pub fn admits(self, ty: Type, bytes: &Bytes, base: impl Fn(Base) -> Option<u64>) -> bool {
        let bits = Possible::of_bytes(bytes);
        match self {
            Number(least, most) => (least..=most).contains(&bits.number()),
            Address(from, least, most) => {
                base(from).is_none_or(|address| (least..=most).contains(&(bits.number().wrapping_sub(address) as i64)))
            }
            Vector(possible) => (0..ty.lanes()).all(|i| lane(ty, bits, i) & !lane(ty, possible, i) == 0),
        }
    }

    /// What is known of one of two values.
    pub fn or(self, other: Fact, ty: Type) -> Fact {
        match (self, other) {
            (Number(a, b), Number(c, d)) => Number(a.min(c), b.max(d)),
            (Address(base, a, b), Address(other, c, d)) if base == other => Address(base, a.min(c), b.max(d)),
            (Vector(a), Vector(b)) => Vector(a.or(b)),
            _ => Fact::any(ty),
        }
    }

    /// What is known of numbers that are loaded, each at most `most` and of `integer` bits where they are.
    pub fn loaded(load: Load, ty: Type, integer: u32, most: u64) -> Fact {
        let stored = if load == Load::Whole { ty.element() } else { ty.element() / 2 };
        let each = match integer {
            _ if integer == stored => smear(most),
            // Several bytes at once.
            8 => (0..stored / 8).fold(0, |all, byte| all | smear(most) << (8 * byte)),
            _ => ones(stored),
        };
        match load {
            Load::SignExtended if each >> (stored - 1) != 0 => Fact::any(ty),
            _ if ty.is_vector() => Vector(lanes(ty, |_| each)),
            _ if integer == stored => Number(0, most.min(ones(stored))),
            _ => Vector(Possible::of(each)),
        }
    }

    /// Whether numbers that are stored are at most the greatest one of an allocation.
    pub fn fits(self, ty: Type, extent: Extent) -> bool {
        let Extent { integer, most, .. } = extent;
        match self {
            _ if integer == 0 || most >= ones(integer) => true,
            _ if ty.element() != integer => false,
            Vector(bits) => (0..ty.lanes()).all(|i| lane(ty, bits, i) <= most),
            _ => self.range(ty).1 <= most,
        }
    }

    pub fn unary(unary: Unary, ty: Type, from: Type, of: Fact) -> Fact {
        let (least, most) = of.range(from);
        let bits = of.bits(from);
        let top = |bits: u64| bits >> (from.element() - 1) != 0;
        let extended = |signed: bool, bits: u64| if signed && top(bits) { u64::MAX } else { bits };
        match unary {
            Unary::Not if !ty.is_vector() => Number(ones(ty.element()) - most, ones(ty.element()) - least),
            Unary::CountOnes => Number(0, ty.element().into()),
            Unary::ZeroExtend => of,
            Unary::SignExtend if !top(most) => of,
            Unary::Truncate if most <= ones(ty.element()) => of,
            Unary::Cast => of,
            Unary::Splat => Vector(lanes(ty, |_| bits.number())),
            Unary::Lowest => Vector(lanes(ty, |i| if i == 0 { bits.number() } else { 0 })),
            Unary::WidenLow { signed } => Vector(lanes(ty, |i| extended(signed, lane(from, bits, i)))),
            Unary::WidenHigh { signed } => Vector(lanes(ty, |i| extended(signed, lane(from, bits, i + ty.lanes())))),
            Unary::HighBits => Number(0, ones(from.lanes())),
            Unary::AnyBit => Number(0, 1),
            Unary::Not | Unary::Neg | Unary::SignExtend | Unary::Truncate | Unary::ToFloat | Unary::ToInteger => {
                Fact::any(ty)
            }
        }
    }

    pub fn binary(binary: Binary, ty: Type, (left, x): (Type, Fact), (right, y): (Type, Fact)) -> Fact {
        match (binary, x, y) {
            (Binary::Add, Address(base, a, b), Number(c, d)) | (Binary::Add, Number(c, d), Address(base, a, b)) => {
                moved(base, (a, b), (c, d)).unwrap_or(Fact::any(ty))
            }
            _ if ty.is_vector() => Vector(of_vectors(binary, ty, (left, x.bits(left)), (y, y.bits(right)))),
            _ => {
                let (a, b) = of_numbers(binary, ty, x.range(left), y.range(right)).unwrap_or((0, ones(ty.element())));
                Number(a, b)
            }
        }
    }

    /// The bits of a vector that may be 1.
    fn vector(self) -> Possible {
        if let Vector(bits) = self { bits } else { Possible::ALL }
    }

    /// Each bit of `x` where the mask is 1, else of `y`.
    pub fn blend(mask: Fact, x: Fact, y: Fact) -> Fact {
        Vector(x.vector().and(mask.vector()).or(y.vector()))
    }

    /// Bytes chosen of two vectors.
    pub fn shuffle(ty: Type, x: Fact, y: Fact, bytes: &Bytes) -> Fact {
        let of = |byte: u32| match byte.checked_sub(ty.lanes()) {
            None => lane(ty, x.vector(), byte),
            Some(byte) => lane(ty, y.vector(), byte),
        };
        Vector(lanes(ty, |i| of(bytes[i as usize].into())))
    }

    /// A number of a vector of this type.
    pub fn lane(self, ty: Type, at: u8) -> Fact {
        Number(0, lane(ty, self.vector(), at.into()))
    }

    /// A vector of this type with another number in a lane.
    pub fn with_lane(self, ty: Type, number: Fact, lane: u8) -> Fact {
        Vector(self.vector().with_lane(ty, lane.into(), smear(number.range(ty.of_lane()).1)))
    }
}

/// An address and a number without a sign, which may mean one below zero.
fn moved(base: Base, (a, b): (i64, i64), (c, d): (u64, u64)) -> Option<Fact> {
    let [c, d] = [c, d].map(|number| number as i64);
    (c <= d).then_some(())?;
    Some(Address(base, a.checked_add(c)?, b.checked_add(d)?))
}

/// The range of an operation on numbers of these ranges; `None` if it may be any number.
fn of_numbers(binary: Binary, ty: Type, (a, b): (u64, u64), (c, d): (u64, u64)) -> Option<(u64, u64)> {
    let all = ones(ty.element());
    let fits = |range: (u64, u64)| (range.1 <= all).then_some(range);
    let by = (c == d).then_some((c % u64::from(ty.element())) as u32);
    match binary {
        Binary::Add => {
            let (least, most) = (u128::from(a) + u128::from(c), u128::from(b) + u128::from(d));
            let wraps = |number: u128| number > all.into();
            (wraps(least) == wraps(most)).then_some((least as u64 & all, most as u64 & all))
        }
        Binary::Sub if a >= d => Some((a - d, b - c)),
        Binary::Mul => fits((a.checked_mul(c)?, b.checked_mul(d)?)),
        Binary::Div => Some((a.checked_div(d)?, b.checked_div(c)?)),
        Binary::And => Some((0, b.min(d))),
        Binary::Or | Binary::Xor => Some((0, smear(b | d))),
        Binary::Shl => {
            let by = by?;
            (b.leading_zeros() >= by).then_some(()).and_then(|()| fits((a << by, b << by)))
        }
        Binary::Shr => Some(by.map_or((0, b), |by| (a >> by, b >> by))),
        Binary::Sar if b <= all / 2 => of_numbers(Binary::Shr, ty, (a, b), (c, d)),
        Binary::Min => Some((a.min(c), b.min(d))),
        Binary::Sub
        | Binary::Sar
        | Binary::RotateLeft
        | Binary::Narrow { .. }
        | Binary::Swizzle
        | Binary::LookUp
        | Binary::MulFloat => None,
    }
}

/// The bits that may be 1 in a product of numbers with such bits.
fn product(x: u64, y: u64, bits: u32) -> u64 {
    let all = ones(bits);
    let smeared = match x.checked_mul(y) {
        Some(most) if most <= all => smear(most),
        // The lower half is that of a product of the lower halves.
        _ if bits > 1 => {
            let low = ones(bits / 2);
            all & !low | product(x & low, y & low, bits / 2)
        }
        _ => all,
    };
    match x.trailing_zeros() + y.trailing_zeros() {
        0 => smeared,
        zeros => smeared & !ones(zeros.min(bits)),
    }
}

/// The bits that may be 1 in a result of vectors with such bits.
fn of_vectors(binary: Binary, ty: Type, (from, x): (Type, Possible), (right, y): (Fact, Possible)) -> Possible {
    let all = ones(ty.element());
    let sized = |most: Option<u64>| most.filter(|most| *most <= all).map_or(all, smear);
    let each = |of: &dyn Fn(u64, u64) -> u64| lanes(ty, |i| of(lane(ty, x, i), lane(ty, y, i)));
    let by = match right {
        Number(c, d) if c == d => Some((c % u64::from(ty.element())) as u32),
        _ => None,
    };
    let shifted = |any: &dyn Fn(u64) -> u64, of: &dyn Fn(u64, u32) -> u64| {
        lanes(ty, |i| by.map_or_else(|| any(lane(ty, x, i)), |by| of(lane(ty, x, i), by)))
    };
    let signed = |x: u64, other: u64| if x > all / 2 { all } else { other };
    match binary {
        Binary::Add => each(&|x, y| sized(x.checked_add(y))),
        Binary::Mul => each(&|x, y| product(x, y, ty.element())),
        Binary::And => x.and(y),
        Binary::Or | Binary::Xor => x.or(y),
        Binary::Min => each(&|x, y| smear(x.min(y))),
        Binary::Shl => shifted(&|_| all, &|x, by| x << by),
        Binary::Shr => shifted(&smear, &|x, by| x >> by),
        Binary::Sar => shifted(&|x| signed(x, smear(x)), &|x, by| signed(x, x >> by)),
        Binary::Narrow { signed } => lanes(ty, |i| {
            let of = |bits, i| lane(from, bits, i);
            let bits = if i < from.lanes() { of(x, i) } else { of(y, i - from.lanes()) };
            if bits <= if signed { all / 2 } else { all } { bits } else { all }
        }),
        // Any byte of the first one.
        Binary::Swizzle | Binary::LookUp => lanes(ty, |i| {
            let numbers = lane(ty, y, i);
            (0..16).filter(|byte| u64::from(*byte) & !numbers == 0).fold(0, |all, byte| all | lane(from, x, byte))
        }),
        Binary::Sub | Binary::Div | Binary::RotateLeft | Binary::MulFloat => Possible::ALL,
    }
}
