//! The packet of a sphere: the interface between set-up and a rasterizer that evaluates quadratics.

use crate::packet::PixelBox;

/// A quadratic expression over whole pixels: `d x^2 + e x y + f y^2 + a x + b y + c` at pixel (x, y).
///
/// ```
/// use tilewright_scenes::sphere::Quadratic;
///
/// let bowl = Quadratic { d: 1, e: -3, f: 2, a: 4, b: 0, c: 7 };
/// assert_eq!(bowl.at(2, 5), 4 - 30 + 50 + 8 + 7);
/// // The same values, two columns and five rows farther.
/// assert_eq!(bowl.seen_from(2, 5).at(4, 10), bowl.at(2, 5));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Quadratic {
    /// The coefficient of x^2.
    pub d: i64,
    /// The coefficient of x y.
    pub e: i64,
    /// The coefficient of y^2.
    pub f: i64,
    /// The coefficient of x.
    pub a: i64,
    /// The coefficient of y.
    pub b: i64,
    /// The value at pixel (0, 0).
    pub c: i64,
}

impl Quadratic {
    /// Its value at pixel (x, y), modulo 2^64: products may wrap, like those of depth.
    pub fn at(&self, x: i64, y: i64) -> i64 {
        let &Quadratic { d, e, f, a, b, c } = self;
        let terms = [(d, x * x), (e, x * y), (f, y * y), (a, x), (b, y), (c, 1)];
        terms.iter().fold(0, |sum: i64, (factor, by)| sum.wrapping_add(factor.wrapping_mul(*by)))
    }

    /// Converts an expression over pixels counted from pixel (x, y) to one over pixels counted from (0, 0), modulo
    /// 2^64.
    pub fn seen_from(&self, x: i64, y: i64) -> Quadratic {
        let &Quadratic { d, e, f, a, b, .. } = self;
        let less = |from: i64, terms: [(i64, i64); 2]| {
            terms.iter().fold(from, |sum, (factor, by)| sum.wrapping_sub(factor.wrapping_mul(*by)))
        };
        Quadratic { d, e, f, a: less(a, [(d, 2 * x), (e, y)]), b: less(b, [(f, 2 * y), (e, x)]), c: self.at(-x, -y) }
    }

    /// All numbers modulo 2^`bits`, as the representatives nearest to 0.
    pub(super) fn modulo(&self, bits: u32) -> Quadratic {
        let above = i64::BITS - bits;
        let nearest = |number: i64| number << above >> above;
        let &Quadratic { d, e, f, a, b, c } = self;
        let [d, e, f, a, b, c] = [d, e, f, a, b, c].map(nearest);
        Quadratic { d, e, f, a, b, c }
    }
}

/// The packet of a sphere. Made by [`project_polygons`](crate::project_polygons); the rule is in [the module's page](crate::sphere).
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct SpherePacket {
    /// A pixel is inside iff this is at least 0. It is below 2^38 in magnitude at each pixel that is less than 256 columns and
    /// less than 256 rows away from `bounds`.
    pub inside: Quadratic,
    /// Depth, modulo 2^40 with 16 fraction bits: the numbers nearest to 0.
    pub z: Quadratic,
    /// Red, green, blue, modulo 2^24 with 16 fraction bits each: the numbers nearest to 0.
    pub rgb: [Quadratic; 3],
    /// The columns and rows that the ellipse meets, cut to the screen; no pixel inside is elsewhere.
    pub bounds: PixelBox,
    /// The number of the polygon in the scene: spheres come after the lines.
    pub polygon: u32,
}
