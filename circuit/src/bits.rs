//! A value of a known width: the value of a signal at one moment.

use crate::limbs;
use crate::radix::Radix;
use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};

/// A bit vector of a fixed width, from 1 bit to thousands. A signed number is stored in two's complement.
///
/// Bits above the width are always zero, so equal values compare equal.
///
/// ```
/// use tilewright_hdl::Bits;
/// let a = Bits::new(8, 0xa5);
/// assert_eq!(a.slice(4..8), Bits::new(4, 0xa));
/// assert_eq!(a, 0xa5);
/// assert_eq!(a.to_string(), "8'ha5");
/// ```
#[derive(Clone)]
pub struct Bits {
    width: u32,
    pub(crate) radix: Radix,
    limbs: Limbs,
}

impl PartialEq for Bits {
    fn eq(&self, other: &Bits) -> bool {
        (self.width, &self.limbs) == (other.width, &other.limbs)
    }
}

impl Eq for Bits {}

impl Hash for Bits {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (self.width, &self.limbs).hash(state);
    }
}

/// Ordered by width, then by value from the lowest limb up.
impl Ord for Bits {
    fn cmp(&self, other: &Bits) -> Ordering {
        (self.width, &self.limbs).cmp(&(other.width, &other.limbs))
    }
}

impl PartialOrd for Bits {
    fn partial_cmp(&self, other: &Bits) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Up to 64 bits are stored in place, so that a testbench does not allocate for each value.
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
enum Limbs {
    One(u64),
    Many(Box<[u64]>),
}

/// The number of 64-bit limbs that `width` bits need.
///
/// ```
/// # use tilewright_hdl::*;
/// assert_eq!((limbs_for(64), limbs_for(65)), (1, 2));
/// ```
pub const fn limbs_for(width: u32) -> usize {
    width.div_ceil(64) as usize
}

/// The mask of the used bits of the highest limb.
///
/// ```
/// # use tilewright_hdl::*;
/// assert_eq!(top_mask(12), 0xfff);
/// // 64 bits use all of one limb; 65 bits use one bit of the second.
/// assert_eq!((top_mask(64), top_mask(65)), (u64::MAX, 1));
/// ```
pub const fn top_mask(width: u32) -> u64 {
    u64::MAX >> (width.wrapping_neg() % 64)
}

/// The width of an index into `count` things, enough for every number below `count`; at least 1.
///
/// ```
/// # use tilewright_hdl::*;
/// const PAGE: u32 = index_width(12);
/// assert_eq!(PAGE, 4);
/// // One thing needs no index, but no signal has 0 bits.
/// assert_eq!((index_width(1), index_width(2), index_width(3)), (1, 1, 2));
/// ```
pub const fn index_width(count: u64) -> u32 {
    width_below(count as u128)
}

#[doc(hidden)]
pub const fn width_below(count: u128) -> u32 {
    match count {
        0..=2 => 1,
        _ => 128 - (count - 1).leading_zeros(),
    }
}

impl Bits {
    /// The low `width` bits of `value`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(Bits::new(4, 0xabc), 0xc);
    /// assert_eq!(Bits::new(100, 7).width(), 100);
    /// ```
    #[inline]
    pub fn new(width: u32, value: u64) -> Bits {
        match width {
            1..=64 => Bits { width, radix: Radix::Any, limbs: Limbs::One(value & top_mask(width)) },
            _ => Bits::from_limbs(width, &[value]),
        }
    }

    /// The low `width` bits of `value`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let colour_and_depth = Bits::from_u128(72, 0xff_8000 << 48 | 5);
    /// assert_eq!(colour_and_depth.slice(48..72), 0xff_8000);
    /// ```
    pub fn from_u128(width: u32, value: u128) -> Bits {
        Bits::from_limbs(width, &[value as u64, (value >> 64) as u64])
    }

    /// `value` in two's complement, sign-extended or cut to `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(Bits::from_i128(8, -1), Bits::ones(8));
    /// assert_eq!(Bits::from_i128(100, -1).to_i128(), Some(-1));
    /// ```
    pub fn from_i128(width: u32, value: i128) -> Bits {
        let low = [value as u64, (value >> 64) as u64];
        let sign = if value < 0 { u64::MAX } else { 0 };
        Bits::of(width, |i| low.get(i).copied().unwrap_or(sign))
    }

    /// The value with these limbs, lowest first. Missing limbs are zero; bits above the width are dropped.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let wide = Bits::from_limbs(70, &[1, u64::MAX]);
    /// assert_eq!(wide.limbs(), [1, 0x3f]);
    /// ```
    pub fn from_limbs(width: u32, limbs: &[u64]) -> Bits {
        Bits::of(width, |i| limbs.get(i).copied().unwrap_or(0))
    }

    /// The value whose limb `i` is `limb(i)`; bits above the width are dropped.
    fn of(width: u32, limb: impl Fn(usize) -> u64) -> Bits {
        assert!(width > 0, "a value has at least 1 bit");
        let limbs = match limbs_for(width) {
            1 => Limbs::One(limb(0) & top_mask(width)),
            n => {
                let mut all: Box<[u64]> = (0..n).map(limb).collect();
                all[n - 1] &= top_mask(width);
                Limbs::Many(all)
            }
        };
        Bits { width, radix: Radix::Any, limbs }
    }

    /// The value that `fill` makes of zeros, as [`Bits::from_limbs`] takes it.
    pub(crate) fn filled(width: u32, fill: impl FnOnce(&mut [u64])) -> Bits {
        let (mut one, mut many) = ([0], Vec::new());
        let limbs: &mut [u64] = if width <= 64 {
            &mut one
        } else {
            many.resize(limbs_for(width), 0);
            &mut many
        };
        fill(limbs);
        Bits::from_limbs(width, limbs)
    }

    /// All bits zero.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert!(Bits::zero(1000).is_zero());
    /// ```
    pub fn zero(width: u32) -> Bits {
        Bits::new(width, 0)
    }

    /// All bits one.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(Bits::ones(12), 0xfff);
    /// assert_eq!(Bits::ones(1000).not(), Bits::zero(1000));
    /// ```
    pub fn ones(width: u32) -> Bits {
        Bits::of(width, |_| u64::MAX)
    }

    /// The number of bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// // Equal numbers of different widths are different values.
    /// let (a, b) = (Bits::new(8, 5), Bits::new(9, 5));
    /// assert!(a != b && a.width() + 1 == b.width());
    /// ```
    pub fn width(&self) -> u32 {
        self.width
    }

    /// The limbs, lowest first: [`limbs_for`]`(width)` of them.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(Bits::from_u128(65, 1 << 64).limbs(), [0, 1]);
    /// ```
    pub fn limbs(&self) -> &[u64] {
        match &self.limbs {
            Limbs::One(limb) => std::slice::from_ref(limb),
            Limbs::Many(limbs) => limbs,
        }
    }

    /// Bit `index`, counted from the least significant.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let a = Bits::new(8, 0b0000_0100);
    /// assert!(a.bit(2) && !a.bit(7));
    /// ```
    pub fn bit(&self, index: u32) -> bool {
        assert!(index < self.width, "bit {index} of a value of {} bits", self.width);
        limbs::bit(self.limbs(), index)
    }

    /// Whether every bit is zero.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert!(Bits::new(4, 0x10).is_zero(), "the one bit was above the width");
    /// ```
    pub fn is_zero(&self) -> bool {
        self.limbs().iter().all(|&limb| limb == 0)
    }

    /// The value as an unsigned number, or `None` if it needs more than 64 bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(Bits::new(100, 5).to_u64(), Some(5));
    /// assert_eq!(Bits::ones(100).to_u64(), None);
    /// ```
    pub fn to_u64(&self) -> Option<u64> {
        let (low, rest) = self.limbs().split_first()?;
        rest.iter().all(|&limb| limb == 0).then_some(*low)
    }

    /// The value as an unsigned number, or `None` if it needs more than 128 bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(Bits::ones(65).to_u128(), Some((1 << 65) - 1));
    /// ```
    pub fn to_u128(&self) -> Option<u128> {
        let limbs = self.limbs();
        let high = limbs.get(1).copied().unwrap_or(0);
        (limbs.iter().skip(2).all(|&limb| limb == 0)).then(|| u128::from(high) << 64 | u128::from(limbs[0]))
    }

    /// The value read as two's complement, or `None` if it does not fit.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(Bits::new(4, 0b1110).to_i128(), Some(-2));
    /// assert_eq!(Bits::new(5, 0b01110).to_i128(), Some(14));
    /// ```
    pub fn to_i128(&self) -> Option<i128> {
        let high = self.limbs().get(1).copied().unwrap_or(0);
        let low = u128::from(high) << 64 | u128::from(self.limbs()[0]);
        let above = 128 - self.width.min(128);
        let value = (low << above) as i128 >> above;
        (Bits::from_i128(self.width, value) == *self).then_some(value)
    }

    /// The bits of `range`, lowest first, as in `z.slice(0..12)`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let word = Bits::new(12, 0xabc);
    /// assert_eq!(word.slice(4..12), Bits::new(8, 0xab));
    /// ```
    pub fn slice(&self, range: std::ops::Range<u32>) -> Bits {
        assert!(range.start < range.end && range.end <= self.width, "slice {range:?} of {} bits", self.width);
        let width = range.end - range.start;
        Bits::filled(width, |limbs| limbs::copy(limbs, 0, self.limbs(), range.start, width))
    }

    /// The concatenation of `self` above `low`, as wide as both together.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(Bits::new(4, 0xa).concat(&Bits::new(8, 0xbc)), Bits::new(12, 0xabc));
    /// ```
    pub fn concat(&self, low: &Bits) -> Bits {
        Bits::filled(self.width + low.width, |limbs| {
            limbs::copy(limbs, 0, low.limbs(), 0, low.width);
            limbs::copy(limbs, low.width, self.limbs(), 0, self.width);
        })
    }

    /// All parts side by side, the first one lowest, in time linear in their bits.
    ///
    /// # Panics
    ///
    /// There are no parts.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(Bits::join(&[Bits::new(4, 0xa), Bits::new(8, 0xbc), Bits::new(4, 0xd)]), Bits::new(16, 0xdbca));
    /// ```
    #[track_caller]
    pub fn join(parts: &[Bits]) -> Bits {
        assert!(!parts.is_empty(), "a value has at least one part");
        if let [part] = parts {
            // As it was written.
            return part.clone();
        }
        Bits::filled(parts.iter().map(Bits::width).sum(), |limbs| {
            parts.iter().fold(0, |at, part| {
                limbs::copy(limbs, at, part.limbs(), 0, part.width);
                at + part.width
            });
        })
    }

    /// Truncated, or zero-extended, to `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(Bits::new(12, 0xabc).resize(8), Bits::new(8, 0xbc));
    /// assert_eq!(Bits::new(4, 0xe).resize(8), Bits::new(8, 0x0e));
    /// ```
    pub fn resize(&self, width: u32) -> Bits {
        Bits::from_limbs(width, self.limbs()).shown_in(self.radix)
    }

    /// Truncated, or sign-extended, to `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(Bits::new(4, 0xe).sext(8), Bits::new(8, 0xfe));
    /// ```
    pub fn sext(&self, width: u32) -> Bits {
        if !self.bit(self.width - 1) {
            return self.resize(width);
        }
        let mut limbs = self.limbs().to_vec();
        *limbs.last_mut().expect("a value has a limb") |= !top_mask(self.width);
        limbs.resize(limbs_for(width).max(limbs.len()), u64::MAX);
        Bits::from_limbs(width, &limbs)
    }

    /// Every bit inverted.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// // Bits above the width stay zero.
    /// assert_eq!(Bits::new(4, 0b0101).not(), Bits::new(4, 0b1010));
    /// ```
    pub fn not(&self) -> Bits {
        Bits::of(self.width, |i| !self.limbs()[i])
    }
}

impl fmt::LowerHex for Bits {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let digits = self.width.div_ceil(4) as usize;
        let text: String = self.limbs().iter().rev().map(|limb| format!("{limb:016x}")).collect();
        f.write_str(&text[text.len() - digits..])
    }
}

impl fmt::Binary for Bits {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        (0..self.width).rev().try_for_each(|i| f.write_str(if self.bit(i) { "1" } else { "0" }))
    }
}

/// As a sized Verilog literal, `12'h0a5`.
impl fmt::Display for Bits {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}'h{self:x}", self.width)
    }
}

impl fmt::Debug for Bits {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// A one-bit value.
impl From<bool> for Bits {
    fn from(value: bool) -> Bits {
        Bits::new(1, u64::from(value))
    }
}

macro_rules! equals_integer {
    ($($ty:ty)*) => {$(
        /// Equal as an unsigned number; a negative number is compared in two's complement of the width.
        impl PartialEq<$ty> for Bits {
            fn eq(&self, other: &$ty) -> bool {
                let other = *other as i128;
                if other >= 0 {
                    return self.to_u128() == Some(other as u128);
                }
                let fits = self.width > 127 || other >= -(1 << (self.width - 1));
                fits && *self == Bits::from_i128(self.width, other)
            }
        }
    )*};
}
equals_integer! { i8 i16 i32 i64 i128 isize u8 u16 u32 u64 usize }

/// Equal to 0 or 1.
impl PartialEq<bool> for Bits {
    fn eq(&self, other: &bool) -> bool {
        *self == u8::from(*other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_negative_number_that_has_no_room_equals_none() {
        let minus_one = Bits::new(4, 15);
        assert!(minus_one == -1 && minus_one != -17 && Bits::new(4, 8) == -8 && Bits::new(4, 7) != -9);
        assert!(Bits::new(1, 1) == -1 && Bits::new(1, 1) != -3);
        assert!(Bits::ones(128) == -1 && Bits::ones(127) == -1 && Bits::ones(200) != i64::MIN);
    }

    #[test]
    fn bits_above_the_width_are_dropped() {
        assert_eq!(Bits::new(4, 0xff), Bits::new(4, 0xf));
        assert_eq!(Bits::ones(65).limbs(), [u64::MAX, 1]);
    }

    #[test]
    fn slices_and_concatenations_cross_limbs() {
        let high = Bits::new(40, 0xab_cdef_0123);
        let low = Bits::new(50, 0x2_4567_89ab_cdef);
        let both = high.concat(&low);
        assert_eq!(both.width(), 90);
        assert_eq!(both.slice(50..90), high);
        assert_eq!(both.slice(0..50), low);
        assert_eq!(Bits::join(&[low.clone(), high.clone(), Bits::new(3, 5)]), Bits::new(3, 5).concat(&both));
        assert_eq!(Bits::join(std::slice::from_ref(&low)), low);
        assert_eq!(format!("{:x}", Bits::new(9, 0x1a5)), "1a5");
    }

    #[test]
    fn signs_extend_over_limbs() {
        assert_eq!(Bits::new(4, 0b1000).sext(130), Bits::from_i128(130, -8));
        assert_eq!(Bits::from_i128(200, -5).to_i128(), Some(-5));
        assert_eq!(Bits::from_u128(128, 1 << 127).to_i128(), Some(i128::MIN));
        assert_eq!(Bits::from_u128(129, 1 << 127).to_i128(), None, "the sign is bit 128");
        assert_eq!(Bits::new(7, 0x7f), -1);
        assert_eq!(Bits::ones(129).to_u128(), None);
    }
}
