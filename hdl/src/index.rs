//! Affine arithmetic on lane numbers, which says where each lane takes its value from.

use crate::integers::{Integer, for_integers};
use std::ops::{Add, Div, Mul, Sub};
use tilewright_circuit::ir::Affine;

/// The number of a lane, for the arithmetic of [`Signal::take`](crate::Signal::take): `|i| i / 2`, `|i| 2 * i + 1`,
/// `|i| n - 1 - i`. Quotients round towards minus infinity. A quotient cannot be multiplied.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// let x = lit(16, 0x4321).unpack(4);
/// let mirrored = x.take(4, |i| 3 - i);
/// let neighbours = x.take_or(4, |i| (i - 1) / 2, 9);
/// m.assert(mirrored.pack().eq(0x1234), "lane 0 takes lane 3");
/// m.assert(neighbours.pack().eq(0x2119), "-1 / 2 rounds down to -1, so lane 0 takes the edge");
/// # });
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Index(Option<Sum>);

/// `(mul * i + add) / div`.
#[derive(Debug, Clone, Copy)]
struct Sum {
    mul: i128,
    add: i128,
    div: i128,
}

impl Index {
    /// A lane's own number.
    pub(crate) fn lane() -> Index {
        Index(Some(Sum { mul: 1, add: 0, div: 1 }))
    }

    /// The rule, or `None` if it cannot be expressed.
    pub(crate) fn affine(self) -> Option<Affine> {
        let Sum { mul, add, div } = self.0?;
        Some(Affine { mul: mul.try_into().ok()?, add: add.try_into().ok()?, div: div.try_into().ok()? })
    }

    fn then(self, f: impl FnOnce(Sum) -> Option<Sum>) -> Index {
        Index(self.0.and_then(f))
    }

    fn plus(self, by: i128) -> Index {
        self.then(|sum| Some(Sum { add: sum.add.checked_add(by.checked_mul(sum.div)?)?, ..sum }))
    }

    fn times(self, by: i128) -> Index {
        let scaled = |sum: Sum| Some(Sum { mul: sum.mul.checked_mul(by)?, add: sum.add.checked_mul(by)?, ..sum });
        self.then(|sum| if sum.div == 1 { scaled(sum) } else { None })
    }

    fn over(self, by: i128) -> Index {
        self.then(|sum| if by > 0 { Some(Sum { div: sum.div.checked_mul(by)?, ..sum }) } else { None })
    }
}

macro_rules! with_integers {
    ($($ty:ty)*) => {$(
        impl Add<$ty> for Index {
            type Output = Index;

            fn add(self, by: $ty) -> Index {
                self.plus(by.integer())
            }
        }

        impl Sub<$ty> for Index {
            type Output = Index;

            fn sub(self, by: $ty) -> Index {
                by.integer().checked_neg().map_or(Index(None), |by| self.plus(by))
            }
        }

        impl Mul<$ty> for Index {
            type Output = Index;

            fn mul(self, by: $ty) -> Index {
                self.times(by.integer())
            }
        }

        impl Div<$ty> for Index {
            type Output = Index;

            fn div(self, by: $ty) -> Index {
                self.over(by.integer())
            }
        }

        impl Add<Index> for $ty {
            type Output = Index;

            fn add(self, right: Index) -> Index {
                right + self
            }
        }

        impl Sub<Index> for $ty {
            type Output = Index;

            fn sub(self, right: Index) -> Index {
                right.times(-1).plus(self.integer())
            }
        }

        impl Mul<Index> for $ty {
            type Output = Index;

            fn mul(self, right: Index) -> Index {
                right * self
            }
        }
    )*};
}
for_integers!(with_integers);

#[cfg(test)]
mod tests {
    use super::*;

    fn rule(index: Index) -> Option<(i32, i32, u32)> {
        index.affine().map(|Affine { mul, add, div }| (mul, add, div))
    }

    #[test]
    fn arithmetic_becomes_one_rule() {
        let (i, n) = (Index::lane(), 5u32);
        assert_eq!(rule(i), Some((1, 0, 1)));
        assert_eq!(rule((i - 1) / 2), Some((1, -1, 2)));
        assert_eq!(rule(2 * i + 1), Some((2, 1, 1)));
        assert_eq!(rule(n - 1 - i), Some((-1, 4, 1)));
        assert_eq!(rule(i / 2 / n + 3), Some((1, 30, 10)));
        assert_eq!(rule((3 - i) * 4), Some((-4, 12, 1)));
    }

    #[test]
    fn what_is_no_rule_is_none() {
        let i = Index::lane();
        for bad in [i / 2 * 2, i / 0, i / -1, i * i32::MAX * 3, i + i32::MAX + 1, 1 - i / 2] {
            assert_eq!(rule(bad), None);
        }
    }
}
