//! Handles of ports, and the values that can be assigned to them.

use tilewright_circuit::{Bits, limbs_for};
use tilewright_hdl::Leaf;

/// An input or output port of a simulation; the leaf of the bundles `sim.i` and `sim.o`.
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// let enable = sim.i.enable;
/// assert_eq!(enable, sim.port("enable")?);
/// sim.set(enable, 1);
/// sim.step();
/// assert_eq!(sim.get(sim.o.count), 1);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Port {
    /// Inputs first, in the sequence of declaration, then outputs.
    pub(crate) index: u32,
}

impl Leaf for Port {}

/// A value for a signal of some width: an integer, a `bool`, [`Bits`], or the limbs of a value.
///
/// A negative integer is converted to two's complement. Nothing is truncated: a value that does not fit is an error.
///
/// ```
/// use tilewright_hdl::Bits;
/// use tilewright_sim::IntoValue;
///
/// assert_eq!((-1).into_value(4), Ok(Bits::new(4, 15)));
/// assert_eq!(16.into_value(4), Err("cannot hold 16".to_owned()));
/// // 64 bits each, the lowest first.
/// assert_eq!([5_u64, 1][..].into_value(65), Ok(Bits::from_u128(65, 1 << 64 | 5)));
/// ```
pub trait IntoValue {
    /// The value in `width` bits, or the end of a sentence such as `cannot hold 300`.
    ///
    /// ```
    /// use tilewright_hdl::Bits;
    /// use tilewright_sim::IntoValue;
    ///
    /// assert_eq!(true.into_value(8), Ok(Bits::new(8, 1)));
    /// assert!(Bits::new(5, 1).into_value(8).is_err()); // it has a width of its own
    /// ```
    ///
    /// # Errors
    ///
    /// The value needs more bits, or it is [`Bits`] of another width.
    fn into_value(self, width: u32) -> Result<Bits, String>;

    /// The value as a non-negative number of at most 64 bits, if it is one and has no width of its own.
    #[doc(hidden)]
    fn to_limb(&self) -> Option<u64> {
        None
    }

    /// A reference to the limbs of the value, if it has that width and is stored as limbs.
    #[doc(hidden)]
    fn limbs_of(&self, width: u32) -> Option<&[u64]> {
        let _ = width;
        None
    }
}

macro_rules! unsigned {
    ($($ty:ty)*) => {$(
        impl IntoValue for $ty {
            fn into_value(self, width: u32) -> Result<Bits, String> {
                match width >= <$ty>::BITS || self >> width == 0 {
                    true => Ok(Bits::from_u128(width, self as u128)),
                    false => Err(format!("cannot hold {self}")),
                }
            }

            #[inline]
            fn to_limb(&self) -> Option<u64> {
                u64::try_from(*self).ok()
            }
        }
    )*};
}
unsigned!(u8 u16 u32 usize u128);

impl IntoValue for u64 {
    fn into_value(self, width: u32) -> Result<Bits, String> {
        match width >= 64 || self >> width == 0 {
            true => Ok(Bits::new(width, self)),
            false => Err(cannot_hold(self, width)),
        }
    }

    #[inline]
    fn to_limb(&self) -> Option<u64> {
        Some(*self)
    }
}

/// What is wrong with a number that is too large for this width, which is less than 64.
fn cannot_hold(number: u64, width: u32) -> String {
    let negative = number as i64;
    match negative >> (width - 1) {
        -1 => format!("cannot hold {number}: give it {negative}, as a signed integer"),
        _ => format!("cannot hold {number}"),
    }
}

macro_rules! signed {
    ($($ty:ty)*) => {$(
        impl IntoValue for $ty {
            fn into_value(self, width: u32) -> Result<Bits, String> {
                let fits = match self >= 0 {
                    true => width >= <$ty>::BITS || self >> width == 0,
                    false => width >= <$ty>::BITS || self >> (width - 1) == -1,
                };
                match fits {
                    true => Ok(Bits::from_i128(width, self as i128)),
                    false => Err(format!("cannot hold {self}")),
                }
            }

            #[inline]
            fn to_limb(&self) -> Option<u64> {
                u64::try_from(*self).ok()
            }
        }
    )*};
}
signed!(i8 i16 i32 i64 isize i128);

impl IntoValue for bool {
    fn into_value(self, width: u32) -> Result<Bits, String> {
        Ok(Bits::new(width, u64::from(self)))
    }

    #[inline]
    fn to_limb(&self) -> Option<u64> {
        Some(u64::from(*self))
    }
}

impl IntoValue for Bits {
    fn into_value(self, width: u32) -> Result<Bits, String> {
        match self.width() == width {
            true => Ok(self),
            false => Err(format!("is set to {self}, of {} bits: resize the value", self.width())),
        }
    }

    fn limbs_of(&self, width: u32) -> Option<&[u64]> {
        (self.width() == width).then(|| self.limbs())
    }
}

impl IntoValue for &Bits {
    fn into_value(self, width: u32) -> Result<Bits, String> {
        self.clone().into_value(width)
    }

    fn limbs_of(&self, width: u32) -> Option<&[u64]> {
        (**self).limbs_of(width)
    }
}

impl IntoValue for &[u64] {
    fn into_value(self, width: u32) -> Result<Bits, String> {
        let bits = Bits::from_limbs(width, self);
        match bits.limbs() == self {
            true => Ok(bits),
            false => Err(format!("is set to limbs {self:x?}: it takes {} of 64 bits", bits.limbs().len())),
        }
    }

    fn limbs_of(&self, width: u32) -> Option<&[u64]> {
        let unused = (64 - width % 64) % 64;
        let is_whole = self.len() == limbs_for(width) && self.last().is_some_and(|top| top.leading_zeros() >= unused);
        is_whole.then_some(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_fit_or_are_refused() {
        assert_eq!(255u8.into_value(8), Ok(Bits::new(8, 255)));
        assert_eq!((-1i32).into_value(4), Ok(Bits::ones(4)));
        assert_eq!((-8i32).into_value(4), Ok(Bits::new(4, 8)));
        assert_eq!((-9i32).into_value(4), Err("cannot hold -9".to_string()));
        assert_eq!(16u64.into_value(4), Err("cannot hold 16".to_string()));
        assert_eq!((-1i64).into_value(100), Ok(Bits::ones(100)));
        let unsigned = (-3i64 as u64).into_value(4).unwrap_err();
        assert_eq!(unsigned, "cannot hold 18446744073709551613: give it -3, as a signed integer");
        assert_eq!((-9i64 as u64).into_value(4), Err("cannot hold 18446744073709551607".to_string()));
        assert!(Bits::new(5, 1).into_value(4).unwrap_err().contains("of 5 bits"));
    }
}
