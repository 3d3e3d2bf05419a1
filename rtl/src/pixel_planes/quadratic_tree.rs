//! The quadratic-expression tree: A x + B y + C + D x² + E x y + F y² at each pixel, a bit a clock, least significant bit first (PP5-ARCH, facts C).
//!
//! ```text
//!             a node of the x tree with a span of 2h columns, and its right child; the left child gets c, a and b unchanged
//!
//!   c ---[reg]------------------------------(+)[reg]---> c + h (a + h d)      the value at the first column of the span, on line 0
//!                                            ^
//!   a ---+--(+)[reg]---- a + h d ----[ h ]---'
//!        |   ^
//!        |   +--[ h ]--- d
//!        '--(+)[reg]---------------------------------> a + 2 h d              its increment to the right there
//!            ^
//!            '--[2 h]--- d
//!   b ------(+)[reg]---------------------------------> b + h e                its increment downward
//!            ^
//!            '--[ h ]--- e
//! ```
//!
//! A node stores the expression over its span, relative to the span's first column: c + a t + d t². Half a span further
//! on, this is an expression of the same form with other coefficients; the right child takes those. The y tree
//! continues in the same way with the c and b of each column, and with F instead of D.
//!
//! Half a span is a power of two, so `[h]` is a shift, and a shift is a delay. A level takes 2 clocks for c, and 1 each
//! for a and b. One line each carries D, E and F to all levels. So each stream reaches each level with the delay that its
//! shift needs, as in the [linear tree](super::linear_tree). The only other delays are those before the roots.
//!
//! | with L = log2 S | clock of the first bit at level j of its tree, from 0 |
//! |---|---|
//! | c | 2 j in the x tree, 2 L + 2 j in the y tree |
//! | a | L - 1 + j |
//! | b | 2 L - 1 + j in the x tree, 3 L - 1 + j in the y tree |
//! | D, E, F | 2 L - 2, 3 L - 2, 4 L - 2: at all levels |
//!
//! If n bits are sent, all sums are exact modulo 2^n, so signs and fractions are those of the integers (facts E0).
//!
//! Latency: 4 log2 S clocks. Each pixel gets a bit a clock, and expressions may follow one another without a gap.

use super::SIDES;
use super::bit_serial::{beginnings, delayed, doubled, is_right, shifted, sum};
use super::linear_tree::Coefficients;
use crate::prelude::*;

block! {
    /// Evaluates a quadratic expression at every pixel of a square.
    pub struct QuadraticTree {
        /// Pixels in a line, and lines in the square.
        pub side: u32,
    }
    ranges { side: powers_of_two(SIDES) }
    latency(self) = format!("{} clocks from a coefficient's bit to the expression's bit at each pixel", self.latency());
    source = "Pixel-planes 5, section I.3.2.1 (PP5-ARCH)";
    in(self) QuadraticTreeIn {
        /// A bit of each linear coefficient, beginning with the least significant.
        coefficients: Coefficients = Coefficients { a: bit(), b: bit(), c: bit() },
        /// A bit of each quadratic coefficient; all are 0 for a linear expression.
        curve: pub struct Curve {
            /// Coefficient D, of the square of x.
            d: bit(),
            /// Coefficient E, of x times y.
            e: bit(),
            /// Coefficient F, of the square of y.
            f: bit(),
        },
        /// The coefficients' bits are the first of an expression, which has at least log2 `side` bits.
        first: bit(),
    }
    out(self) QuadraticTreeOut {
        /// A bit of the expression at each pixel, a row for each line.
        value: bit().of(grid(self.side, self.side)),
    }
}

impl QuadraticTree {
    /// Levels of each of the two trees.
    pub fn levels(&self) -> u32 {
        self.side.trailing_zeros()
    }

    /// Clocks from a coefficient's bit to the expression's bit: two per level.
    pub fn latency(&self) -> u32 {
        4 * self.levels()
    }

    fn build(&self, m: Module, i: QuadraticTreeIn) -> QuadraticTreeOut {
        let (side, levels) = (self.side, self.levels());
        let Coefficients { a, b, c } = i.coefficients;
        let Curve { d, e, f } = i.curve;
        let first = beginnings(m, self.latency(), i.first);
        let later = |name, clocks, bit| delayed(m, name, clocks, bit);
        let x = Axis { name: "x", levels, curve: later("d", 2 * levels - 2, d), first: &first };
        let y_first = &first[2 * levels as usize..];
        let y = Axis { name: "y", levels, curve: later("f", 4 * levels - 2, f), first: y_first };

        let a = later("a", levels - 1, a);
        let root = Span { value: c.of(row(1)), growth: a.of(row(1)) };
        let columns = (0..levels).fold(root, |parents, level| {
            x.children(m, level, parents, is_right(2 << level), |all| all.take(2 << level, |column| column / 2))
        });

        let b = later("b", 2 * levels - 1, b).of(row(1));
        let e = later("e", 3 * levels - 2, e);
        let downward = (0..levels).fold(b, |parents, level| {
            let from = 2 * levels - 1 + level;
            let parents = parents.take(2 << level, |column| column / 2);
            let has_come = format!("e_has_come{level}");
            let adds = is_right(2 << level) & shifted(m, &has_come, &first, [from, 3 * levels - 2], e);
            let adds = adds.named(&format!("x_downward_adds{level}"));
            sum(
                m,
                [&format!("x_downward{level}"), &format!("x_downward_carry{level}")],
                first[from as usize],
                parents,
                adds,
            )
        });

        let root = Span { value: columns.value.to_rows(1), growth: downward.to_rows(1) };
        let pixels = (0..levels).fold(root, |parents, level| {
            let is_right = is_right(2 << level).to_columns(side);
            y.children(m, level, parents, is_right, |all| all.rows().take(2 << level, |line| line / 2))
        });
        QuadraticTreeOut { value: pixels.value }
    }
}

/// The nodes of a level: the expression at the beginning of their spans, and its increment from there to the next place
/// along the axis, without the curve.
struct Span {
    value: Signal,
    growth: Signal,
}

/// A direction: the coefficient of its square on its way to the levels of a tree.
struct Axis<'a> {
    name: &'static str,
    levels: u32,
    /// The coefficient's bits, with the delay that the lowest level needs; all levels need the same.
    curve: Signal,
    /// Whether a new expression begins, in each clock from the one in which it reaches the root.
    first: &'a [Signal],
}

impl Axis<'_> {
    /// The nodes of a level; `by_child` gives each child the signal of its parent. The lowest level computes no
    /// increment, because nothing uses it.
    fn children(
        &self,
        m: Module,
        level: u32,
        Span { value, growth }: Span,
        is_right: Signal,
        by_child: impl Fn(Signal) -> Signal,
    ) -> Span {
        let named = |what: &str| format!("{}_{what}{level}", self.name);
        let first = |place: u32| self.first[place as usize];
        let shifted = |what: &str, places, number| shifted(m, &named(what), self.first, places, number);
        let [grows, steps] = [self.levels - 1 + level, 2 * level + 1];

        let bends = shifted("curve_has_come", [grows, 2 * self.levels - 2], self.curve);
        let middle = sum(m, [&named("middle"), &named("middle_carry")], first(grows), growth, bends);
        let step = shifted("middle_has_come", [steps, grows + 1], middle);
        let value = by_child(m.pipe(&named("waiting"), value));
        let adds = (is_right & by_child(step)).named(&named("adds"));
        let value = sum(m, [&named("sum"), &named("carry")], first(steps), value, adds);
        if level + 1 == self.levels {
            return Span { value, growth };
        }
        let bends = (is_right & doubled(m, &named("bent"), first(grows), bends)).named(&named("bends"));
        let names = [&*named("growth"), &named("growth_carry")];
        Span { value, growth: sum(m, names, first(grows), by_child(growth), bends) }
    }
}

#[cfg(test)]
mod tests;
