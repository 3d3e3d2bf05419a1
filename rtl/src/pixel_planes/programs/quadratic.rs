//! Quadratic expressions, and the test for spheres (facts C).

use super::super::instruction::{Instruction, Operation};
use super::edges::{bits, sign};
use super::{Expression, alone, modular};

/// A x + B y + C + D x² + E x y + F y² over the pixels of a region, with (0, 0) at its upper left. As a test, a pixel
/// is inside where the value is at least 0. As a plane it is modulo the same power of two as an [`Expression`].
///
/// ```
/// use tilewright_rtl::pixel_planes::programs::Quadratic;
///
/// let sphere = Quadratic { a: 0, b: 0, c: 100, d: -1, e: 0, f: -1 };
/// assert_eq!([sphere.at(6, 8), sphere.at(7, 8)], [0, -13]);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Quadratic {
    /// The coefficient of x.
    pub a: i64,
    /// The coefficient of y.
    pub b: i64,
    /// The value at the upper left pixel.
    pub c: i64,
    /// The coefficient of x².
    pub d: i64,
    /// The coefficient of x y.
    pub e: i64,
    /// The coefficient of y².
    pub f: i64,
}

impl From<Expression> for Quadratic {
    fn from(Expression { a, b, c }: Expression) -> Quadratic {
        Quadratic { a, b, c, ..Quadratic::default() }
    }
}

impl Quadratic {
    /// The value at a pixel, modulo 2^64.
    pub fn at(&self, x: i64, y: i64) -> i64 {
        let along =
            |square: i64, slope: i64, place: i64| square.wrapping_mul(place).wrapping_add(slope).wrapping_mul(place);
        let across = self.a.wrapping_add(self.e.wrapping_mul(y));
        along(self.d, across, x).wrapping_add(along(self.f, self.b, y)).wrapping_add(self.c)
    }

    /// The same expression, relative to a region with this upper left pixel; exact modulo 2^64.
    ///
    /// ```
    /// # use tilewright_rtl::pixel_planes::programs::Quadratic;
    /// let any = Quadratic { a: 3, b: -4, c: 5, d: 7, e: -2, f: 1 };
    /// assert_eq!(any.moved([128, 64]).at(1, 2), any.at(129, 66));
    /// ```
    #[must_use]
    pub fn moved(&self, [x, y]: [i64; 2]) -> Quadratic {
        let &Quadratic { a, b, d, e, f, .. } = self;
        let grown = |slope: i64, square: i64, place: i64, other: i64| {
            slope.wrapping_add(square.wrapping_mul(2).wrapping_mul(place)).wrapping_add(e.wrapping_mul(other))
        };
        Quadratic { a: grown(a, d, x, y), b: grown(b, f, y, x), c: self.at(x, y), d, e, f }
    }

    /// The expression times a number, modulo 2^64.
    #[must_use]
    pub fn times(&self, factor: i64) -> Quadratic {
        let &Quadratic { a, b, c, d, e, f } = self;
        let [a, b, c, d, e, f] = [a, b, c, d, e, f].map(|coefficient| coefficient.wrapping_mul(factor));
        Quadratic { a, b, c, d, e, f }
    }

    /// The least and the greatest value at the pixels of a region of `side` x `side`. This takes a pass over the region's lines.
    ///
    /// ```
    /// # use tilewright_rtl::pixel_planes::programs::Quadratic;
    /// let valley = Quadratic { a: -5, b: 0, c: 0, d: 1, e: 0, f: 0 };
    /// assert_eq!(valley.range(8), [-6, 14]);
    /// ```
    pub fn range(&self, side: u32) -> [i64; 2] {
        let last = i64::from(side) - 1;
        let values = (0..=last).flat_map(|y| {
            let slope = self.a.wrapping_add(self.e.wrapping_mul(y));
            // For each line, the ends and the pixels around the vertex.
            let vertex = slope.wrapping_neg().checked_div_euclid(self.d.wrapping_mul(2)).unwrap_or(0);
            let near = [-1, 0, 1].map(|by| vertex.saturating_add(by).clamp(0, last));
            near.into_iter().chain([0, last]).map(move |x| self.at(x, y))
        });
        values.fold([i64::MAX, i64::MIN], |[least, greatest], value| [least.min(value), greatest.max(value)])
    }

    /// The number of bits that carry the sign to a region of `side` x `side` pixels. It is 0 unless some pixels are
    /// inside and some outside. The test takes one more clock, for the curve.
    ///
    /// ```
    /// # use tilewright_rtl::pixel_planes::programs::Quadratic;
    /// let sphere = Quadratic { a: 0, b: 0, c: 100, d: -1, e: 0, f: -1 };
    /// assert_eq!([8, 128].map(|side| sphere.bits(side)), [0, 16]);
    /// ```
    pub fn bits(&self, side: u32) -> u32 {
        let [least, greatest] = self.range(side);
        if least < 0 && greatest >= 0 { bits(least).max(bits(greatest)).max(side.trailing_zeros()) } else { 0 }
    }

    /// The instructions that enable the pixels inside; `None` if there are none.
    pub(super) fn test(&self, side: u32) -> Option<Vec<Instruction<u64>>> {
        match self.bits(side) {
            0 if self.c < 0 => None,
            0 => Some(vec![alone(Operation::Enable)]),
            bits => Some(self.curve().into_iter().chain([sign(Operation::TestFirst, &self.linear(), bits)]).collect()),
        }
    }

    /// The expression without its quadratic terms.
    pub(super) fn linear(&self) -> Expression {
        let &Quadratic { a, b, c, .. } = self;
        Expression { a, b, c }
    }

    /// The instruction that must precede one with this expression, if the expression is not linear.
    pub(super) fn curve(&self) -> Option<Instruction<u64>> {
        let &Quadratic { d, e, f, .. } = self;
        let curve = Expression { a: d, b: e, c: f };
        let is_linear = [d, e, f] == [0; 3];
        (!is_linear).then(|| Instruction { coefficients: modular(&curve), ..alone(Operation::Curve) })
    }
}
