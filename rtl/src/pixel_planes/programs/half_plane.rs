//! The least half-plane: of all that have the same pixels of a region inside, one whose values there need the fewest bits (facts E3).
//!
//! ```text
//! . . . .      30 x + 70 y - 100 >= 0 and x + 3 y - 4 >= 0 are the same in a region of 4 x 4. What is sent of an edge is its
//! . # # #      sign, which comes after all bits of its value: the first takes 9 clocks, the second 5.
//! # # # #
//! # # # #
//! ```
//!
//! The slopes of all half-planes with the same pixels inside form an interval. The simplest fraction in it has the least numerator and the least
//! denominator of all, so its values need the fewest bits. The edge's own slope is in the interval, so the way to it through the tree of Stern and Brocot
//! meets that fraction first. Where that way goes on in one direction, it is taken in few steps: each goes as far as is needed to divide the two pixels that
//! the last slope has not divided. That nothing needs fewer bits is tested with all half-planes of small regions.

use super::Expression;

/// A pixel.
type Pixel = [i64; 2];

/// The least half-plane that has the same pixels of a region of `side` x `side` inside as an edge has: everything or nothing of it, if the edge
/// does not cross it. At a side of 128 its values have at most 15 bits with their sign. `side` is at least 2; the edge's values fit 48 bits.
///
/// It takes one pass over the region's columns, and a few over the corners of their hull.
///
/// ```
/// use tilewright_rtl::pixel_planes::programs::{Expression, half_plane::least};
///
/// let edge = Expression { a: 30, b: 70, c: -100 };
/// assert_eq!(least(4, &edge), Expression { a: 1, b: 3, c: -4 });
/// // All of the region is inside, or nothing.
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
    // The nearest pixel outside then is at -1: the simplest slope leaves no choice.
    let [inside, _] = border.nearest(slope);
    let c = -dot(slope, inside);
    upright.back(Expression { a: slope[0], b: slope[1], c }, last)
}

/// An edge whose values rise to the right and downward, and downward at least as fast.
struct Upright {
    edge: Expression,
    /// Left and right are swapped for that, or top and bottom.
    flips: [bool; 2],
    /// Then x and y.
    swaps: bool,
}

impl Upright {
    fn of(edge: &Expression, last: i64) -> Upright {
        let flips = [edge.a < 0, edge.b < 0];
        let Expression { a, b, c } = flip(*edge, flips, last);
        let swaps = a > b;
        Upright { edge: if swaps { Expression { a: b, b: a, c } } else { Expression { a, b, c } }, flips, swaps }
    }

    /// Another one, as it is for the edge that this was made of.
    fn back(&self, Expression { a, b, c }: Expression, last: i64) -> Expression {
        let edge = if self.swaps { Expression { a: b, b: a, c } } else { Expression { a, b, c } };
        flip(edge, self.flips, last)
    }
}

/// The edge of a region whose columns, or lines, are in reverse order.
fn flip(Expression { a, b, c }: Expression, [x, y]: [bool; 2], last: i64) -> Expression {
    let (a, c) = if x { (-a, c + a * last) } else { (a, c) };
    let (b, c) = if y { (-b, c + b * last) } else { (b, c) };
    Expression { a, b, c }
}

/// Of each column the first pixel inside and the last one outside, where there are such: a half-plane that divides them divides all. Of these the
/// corners of their convex hulls that face each other: one of them is the nearest, whatever the slope.
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

    /// The least pixel inside, and the greatest outside, in the order of a slope.
    fn nearest(&self, slope: [i64; 2]) -> [Pixel; 2] {
        let value = |pixel: &Pixel| dot(slope, *pixel);
        let inside = self.inside.iter().copied().min_by_key(value);
        let outside = self.outside.iter().copied().max_by_key(value);
        [inside, outside].map(|pixel| pixel.expect("the edge crosses the region"))
    }

    /// From one of them to the other.
    fn step(&self, slope: [i64; 2]) -> [i64; 2] {
        let [[x, y], [x0, y0]] = self.nearest(slope);
        [x - x0, y - y0]
    }
}

/// The simplest slope that divides the border, on the way to one that does.
fn simplest(border: &Border, target: [i64; 2]) -> [i64; 2] {
    let [mut flat, mut steep] = [[0, 1], [1, 0]];
    if dot(flat, border.step(flat)) > 0 {
        return flat;
    }
    // Between the two is the target: when either comes to it, it divides.
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

/// The first of the slopes `from + by`, `from + 2 by` up to `from + most by` that divides the border, or the last, which does not.
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
        // To the first that divides at least these two.
        times += -apart / dot(by, step) + 1;
    }
    Err(at(most))
}

/// Adds the point to the right of a hull that bends to the side, which is 1 or -1, at each of its corners.
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

/// Above 0 where the first is steeper.
fn cross([a, b]: [i64; 2], [c, d]: [i64; 2]) -> i64 {
    a * d - b * c
}

#[cfg(test)]
mod tests;
