//! What an operation gives: the one definition. The printer folds constants by it. The simulator's reference engine and
//! its folding use it, and other engines are compared with it.
//!
//! Methods that fill limbs are for values of any width; bits above the width of `out` are left to the caller.

use std::cmp::Ordering;

use super::{Binary, Reduction, Relation, Shift, Unary};
use crate::Bits;
use crate::bits::top_mask;
use crate::limbs::{self, Number};

impl Unary {
    /// The result for a value.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use ir::Unary;
    ///
    /// let word = Bits::new(4, 0b0111);
    /// assert_eq!(Unary::Not.apply(&word), Bits::new(4, 0b1000));
    /// assert_eq!((Unary::AllOnes.apply(&word), Unary::Parity.apply(&word)), (Bits::zero(1), Bits::ones(1)));
    /// ```
    pub fn apply(self, a: &Bits) -> Bits {
        let width = if self == Unary::Not { a.width() } else { 1 };
        Bits::filled(width, |out| self.fill(out, a.into()))
    }

    #[doc(hidden)]
    pub fn fill(self, out: &mut [u64], a: Number) {
        let ones = || a.limbs.iter().map(|limb| limb.count_ones()).sum::<u32>();
        match self {
            Unary::Not => out.iter_mut().zip(a.limbs).for_each(|(out, a)| *out = !a),
            Unary::AllOnes => out[0] = u64::from(ones() == a.width),
            Unary::AnyOne => out[0] = u64::from(ones() > 0),
            Unary::Parity => out[0] = u64::from(ones() % 2),
        }
    }
}

impl Binary {
    /// The result for two values: of the width of the first one, or a product of the width of both together.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use ir::Binary;
    ///
    /// let (a, b) = (Bits::new(4, 3), Bits::new(4, 14));
    /// assert_eq!((Binary::Add.apply(&a, &b), Binary::Sub.apply(&a, &b)), (Bits::new(4, 1), Bits::new(4, 5)));
    /// assert_eq!((Binary::Mul.apply(&a, &b), Binary::MulSigned.apply(&a, &b)), (Bits::new(8, 42), Bits::new(8, 250)));
    /// ```
    pub fn apply(self, a: &Bits, b: &Bits) -> Bits {
        let is_product = matches!(self, Binary::Mul | Binary::MulSigned);
        let width = if is_product { a.width() + b.width() } else { a.width() };
        Bits::filled(width, |out| self.fill(width, out, a.into(), b.into()))
    }

    #[doc(hidden)]
    pub fn fill(self, width: u32, out: &mut [u64], a: Number, b: Number) {
        let bitwise = |out: &mut [u64], combine: fn(u64, u64) -> u64| {
            out.iter_mut().zip(a.limbs.iter().zip(b.limbs)).for_each(|(out, (a, b))| *out = combine(*a, *b));
        };
        match self {
            Binary::And => bitwise(out, |a, b| a & b),
            Binary::Or => bitwise(out, |a, b| a | b),
            Binary::Xor => bitwise(out, |a, b| a ^ b),
            Binary::Add => limbs::add(out, a.limbs, b.limbs, false),
            Binary::Sub => limbs::add(out, a.limbs, b.limbs, true),
            Binary::Mul => limbs::multiply(out, a.limbs, b.limbs),
            Binary::MulSigned => {
                let extended = |number: Number| {
                    let mut wide = vec![0; out.len()];
                    number.extend(&mut wide, true, width);
                    wide
                };
                let (a, b) = (extended(a), extended(b));
                limbs::multiply(out, &a, &b);
            }
        }
    }
}

impl Relation {
    /// Whether two values of one width are in this relation, with or without signs.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use ir::Relation;
    ///
    /// let (one, ones) = (Bits::new(8, 1), Bits::ones(8));
    /// assert!(Relation::Lt.holds(false, &one, &ones) && Relation::Gt.holds(true, &one, &ones));
    /// ```
    pub fn holds(self, signed: bool, a: &Bits, b: &Bits) -> bool {
        self.holds_of(signed, a.into(), b.into())
    }

    #[doc(hidden)]
    pub fn holds_of(self, signed: bool, a: Number, b: Number) -> bool {
        let order = match signed && a.sign() != b.sign() {
            true => b.sign().cmp(&a.sign()),
            false => limbs::compare(a.limbs, b.limbs),
        };
        match self {
            Relation::Eq => order.is_eq(),
            Relation::Ne => order.is_ne(),
            Relation::Lt => order.is_lt(),
            Relation::Le => order.is_le(),
            Relation::Gt => order.is_gt(),
            Relation::Ge => order.is_ge(),
        }
    }
}

impl Shift {
    /// The result for a value and the amount, of the width of the value.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use ir::Shift;
    ///
    /// let word = Bits::new(4, 0b1010);
    /// let by = Bits::new(8, 1);
    /// assert_eq!([Shift::Left, Shift::Right, Shift::RightSigned].map(|it| it.apply(&word, &by).to_u64()), [4, 5, 13].map(Some));
    /// assert_eq!(Shift::RightSigned.apply(&word, &Bits::new(8, 200)), Bits::ones(4));
    /// ```
    pub fn apply(self, a: &Bits, by: &Bits) -> Bits {
        Bits::filled(a.width(), |out| self.fill(out, a.into(), by.into()))
    }

    #[doc(hidden)]
    pub fn fill(self, out: &mut [u64], a: Number, by: Number) {
        let by = by.at_most(a.width);
        let kept = a.width - by;
        match self {
            Shift::Left => limbs::copy(out, by, a.limbs, 0, kept),
            Shift::Right | Shift::RightSigned => limbs::copy(out, 0, a.limbs, by, kept),
        }
        if self == Shift::RightSigned && a.sign() {
            limbs::set(out, kept, a.width);
        }
    }
}

impl Reduction {
    /// Combines `out`, a value of this width, with another one.
    #[doc(hidden)]
    pub fn combine(self, width: u32, out: &mut [u64], other: &[u64]) {
        let bitwise = |combine: fn(u64, u64) -> u64, out: &mut [u64]| {
            out.iter_mut().zip(other).for_each(|(out, other)| *out = combine(*out, *other));
        };
        match self {
            Reduction::And => bitwise(|a, b| a & b, out),
            Reduction::Or => bitwise(|a, b| a | b, out),
            Reduction::Xor => bitwise(|a, b| a ^ b, out),
            Reduction::Min if limbs::compare(other, out) == Ordering::Less => out.copy_from_slice(other),
            Reduction::Max if limbs::compare(other, out) == Ordering::Greater => out.copy_from_slice(other),
            Reduction::Min | Reduction::Max => {}
            Reduction::Add => {
                let sum = out.to_vec();
                limbs::add(out, &sum, other, false);
                *out.last_mut().expect("a value has a limb") &= top_mask(width);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wide_values_compare_from_the_top() {
        let low = Bits::new(1, 1).concat(&Bits::zero(129));
        let high = low.not();
        assert!(Relation::Lt.holds(true, &low, &high));
        assert!(Relation::Gt.holds(false, &low, &high));
        assert!(Relation::Ge.holds(true, &Bits::zero(130), &Bits::ones(130)));
        assert!(!Relation::Gt.holds(true, &low, &high));
        assert!(!Relation::Le.holds(false, &low, &high));
        assert!(!Relation::Eq.holds(true, &Bits::zero(130), &Bits::ones(130)));
        // The highest limb decides, whatever the lower ones are.
        let (less, more) = (Bits::from_limbs(130, &[u64::MAX, 5, 0]), Bits::from_limbs(130, &[0, 5, 1]));
        assert!(Relation::Lt.holds(false, &less, &more) && !Relation::Ge.holds(false, &less, &more));
        assert!(Relation::Ne.holds(true, &less, &more) && Relation::Le.holds(true, &more, &more));
    }
}
