//! The least half-plane: among all half-planes with the same pixels of a region inside, one whose values there need the
//! fewest bits (facts E3).
//!
//! ```text
//! . . . .      30 x + 70 y - 100 >= 0 and x + 3 y - 4 >= 0 are the same in a region of 4 x 4. The pixels need only the
//! . # # #      sign, which follows all other bits of the value: the first takes 9 clocks, the second 5.
//! # # # #
//! # # # #
//! ```
//!
//! The slopes of all half-planes with the same pixels inside form an interval. The simplest fraction in it has both the
//! least numerator and the least denominator. So its values need the fewest bits. The edge's own slope is in the
//! interval, so the path to it through the Stern-Brocot tree meets that fraction first. Where the path continues in one
//! direction, the search skips ahead. Each step goes just far enough to separate the two pixels that the last slope did
//! not separate. A test compares the result with all half-planes of small regions: none needs fewer bits.

use super::Expression;

/// A pixel.
type Pixel = [i64; 2];

/// The least half-plane with the same pixels inside as an edge, in a region of `side` x `side`. If the edge does not
/// cross the region, the result covers all pixels or none. At a side of 128 its values have at most 15 bits, including
/// the sign. `side` is at least 2, and the edge's values fit in 48 bits.
///
/// The search takes one pass over the region's columns, and a few passes over the corners of the hulls.
///
/// ```
/// use tilewright_rtl::pixel_planes::programs::{Expression, half_plane::least};
///
/// let edge = Expression { a: 30, b: 70, c: -100 };
/// assert_eq!(least(4, &edge), Expression { a: 1, b: 3, c: -4 });
/// // All pixels are inside, or none.
/// assert_eq!(least(8, &Expression { a: 5, b: 5, c: 0 }), Expression { a: 0, b: 0, c: 0 });
/// assert_eq!(least(8, &Expression { a: 5, b: 5, c: -71 }), Expression { a: 0, b: 0, c: -1 });
/// ```
pub fn least(side: u32, edge: &Expression) -> Expression {
    let last = i64::from(side) - 1;
    let upright = Upright::of(edge, last);
    let Expression { a, b, c } = upright.edge;
    if c >= 0 {
        return Expression { a: 0, b: 0, c: 0 };
    }
    if c + (a + b) * last < 0 {
        return Expression { a: 0, b: 0, c: -1 };
    }
    let border = Border::of(&upright.edge, last);
    let slope = simplest(&border, [a, b]);
    // With the simplest slope, the value at the nearest pixel outside is then -1.
    let [inside, _] = border.nearest(slope);
    let c = -dot(slope, inside);
    upright.back(Expression { a: slope[0], b: slope[1], c }, last)
}

/// An edge whose values rise to the right and downward, and downward at least as fast.
struct Upright {
    edge: Expression,
    /// Whether left and right, or top and bottom, are swapped first.
    flips: [bool; 2],
    /// Whether x and y are swapped next.
    swaps: bool,
}

impl Upright {
    fn of(edge: &Expression, last: i64) -> Upright {
        let flips = [edge.a < 0, edge.b < 0];
        let Expression { a, b, c } = flip(*edge, flips, last);
        let swaps = a > b;
        Upright { edge: if swaps { Expression { a: b, b: a, c } } else { Expression { a, b, c } }, flips, swaps }
    }

    /// Another edge, mapped back to the frame of the original one.
    fn back(&self, Expression { a, b, c }: Expression, last: i64) -> Expression {
        let edge = if self.swaps { Expression { a: b, b: a, c } } else { Expression { a, b, c } };
        flip(edge, self.flips, last)
    }
}

/// The edge in a region whose columns, or lines, are reversed.
fn flip(Expression { a, b, c }: Expression, [x, y]: [bool; 2], last: i64) -> Expression {
    let (a, c) = if x { (-a, c + a * last) } else { (a, c) };
    let (b, c) = if y { (-b, c + b * last) } else { (b, c) };
    Expression { a, b, c }
}

/// The border: the first pixel inside and the last one outside of each column, where they exist. A half-plane that
/// separates these separates all pixels. Only the facing corners of their two convex hulls are kept: one of them is
/// nearest, whatever the slope.
struct Border {
    inside: Vec<Pixel>,
    outside: Vec<Pixel>,
}

impl Border {
    fn of(&Expression { a, b, c }: &Expression, last: i64) -> Border {
        let mut border = Border { inside: Vec::new(), outside: Vec::new() };
        for x in 0..=last {
            // The least y with a x + b y + c >= 0.
            let first = (-(a * x + c).div_euclid(b)).clamp(0, last + 1);
            if first <= last {
                add_to_hull(&mut border.inside, [x, first], 1);
            }
            if first > 0 {
                add_to_hull(&mut border.outside, [x, first - 1], -1);
            }
        }
        border
    }

    /// The least pixel inside, and the greatest outside, in the direction of a slope.
    fn nearest(&self, slope: [i64; 2]) -> [Pixel; 2] {
        let value = |pixel: &Pixel| dot(slope, *pixel);
        let inside = self.inside.iter().copied().min_by_key(value);
        let outside = self.outside.iter().copied().max_by_key(value);
        [inside, outside].map(|pixel| pixel.expect("the edge crosses the region"))
    }

    /// The step from the nearest pixel outside to the nearest one inside.
    fn step(&self, slope: [i64; 2]) -> [i64; 2] {
        let [[x, y], [x0, y0]] = self.nearest(slope);
        [x - x0, y - y0]
    }
}

/// The simplest slope that separates the border. It is on the path to `target`, which separates the border, too.
fn simplest(border: &Border, target: [i64; 2]) -> [i64; 2] {
    let [mut flat, mut steep] = [[0, 1], [1, 0]];
    if dot(flat, border.step(flat)) > 0 {
        return flat;
    }
    // The target lies between the two slopes. A slope that reaches it separates the border.
    loop {
        let (below, above) = (cross(target, flat), cross(steep, target));
        match first_to_divide(border, flat, steep, below / above) {
            Ok(slope) => return slope,
            Err(last) => flat = last,
        }
        let below = cross(target, flat);
        match first_to_divide(border, steep, flat, above / below) {
            Ok(slope) => return slope,
            Err(last) => steep = last,
        }
    }
}

/// The first of the slopes `from + by`, `from + 2 by` up to `from + most by` that separates the border. If none does,
/// the last of them is the error.
fn first_to_divide(border: &Border, from: [i64; 2], by: [i64; 2], most: i64) -> Result<[i64; 2], [i64; 2]> {
    let at = |times: i64| [from[0] + times * by[0], from[1] + times * by[1]];
    let mut times = 1;
    while times <= most {
        let slope = at(times);
        let step = border.step(slope);
        let apart = dot(slope, step);
        if apart > 0 {
            return Ok(slope);
        }
        // Go to the first slope that separates at least these two.
        times += -apart / dot(by, step) + 1;
    }
    Err(at(most))
}

/// Adds the point at the right end of a hull that bends to the side (1 or -1) at each of its corners.
fn add_to_hull(hull: &mut Vec<Pixel>, [x, y]: Pixel, side: i64) {
    while let [.., [x0, y0], [x1, y1]] = hull[..] {
        if cross([x1 - x0, y1 - y0], [x - x0, y - y0]) * side > 0 {
            break;
        }
        hull.pop();
    }
    hull.push([x, y]);
}

fn dot([a, b]: [i64; 2], [x, y]: [i64; 2]) -> i64 {
    a * x + b * y
}

/// Positive where the first is steeper.
fn cross([a, b]: [i64; 2], [c, d]: [i64; 2]) -> i64 {
    a * d - b * c
}

#[cfg(test)]
mod tests;
