//! The linear-expression tree: A x + B y + C at each pixel, a bit a clock, least significant bit first (PP5-ARCH, facts E3).
//!
//! ```text
//!                  x tree: log2 S levels                  y tree: log2 S levels
//!
//!           .--[reg]---------> left half           .--[reg]------> upper half
//! c ------->+                             ... ---->+
//!           '--[+ a][reg]----> right half          '--[+ b][reg]-> lower half
//!
//! a ---[log2 S - 1 clocks]--- to all levels of the x tree; b, log2 S clocks later, to those of the y tree
//! ```
//!
//! Each node of the x tree stands for a span of columns and has the sum at the span's first column. Its left child
//! takes that sum. Its right child adds half the span times A, which is A shifted by the level's height above the
//! leaves. Each level is one clock later than the one above it. So shift and delay add up to the same at every level.
//! One line carries a bit of A to all levels. The y tree continues in the same way with the lines of each column.
//!
//! If n bits are sent, all sums are exact modulo 2^n, so signs and fractions are those of the integers (facts E0).
//!
//! Latency: 2 log2 S clocks. Each pixel gets a bit a clock, and expressions may follow one another without a gap.

use super::SIDES;
use super::bit_serial::{beginnings, delayed, is_right, shifted, sum};
use crate::prelude::*;

block! {
    /// Evaluates a linear expression at every pixel of a square.
    pub struct LinearTree {
        /// Pixels in a line, and lines in the square.
        pub side: u32,
    }
    ranges { side: powers_of_two(SIDES) }
    latency(self) = format!("{} clocks from a coefficient's bit to the expression's bit at each pixel", self.latency());
    source = "Pixel-planes 5, section I.3.2.1 (PP5-ARCH)";
    in(self) LinearTreeIn {
        /// A bit of each coefficient, beginning with the least significant.
        coefficients: pub struct Coefficients {
            /// Coefficient A, the increase from one column to the next.
            a: bit(),
            /// Coefficient B, the increase from one line to the next.
            b: bit(),
            /// Coefficient C, the value at column 0 of line 0.
            c: bit(),
        },
        /// The coefficients' bits are the first of an expression, which has at least log2 `side` bits.
        first: bit(),
    }
    out(self) LinearTreeOut {
        /// A bit of the expression at each pixel, a row for each line.
        value: bit().of(grid(self.side, self.side)),
    }
}

impl LinearTree {
    /// Levels of each of the two trees.
    pub fn levels(&self) -> u32 {
        self.side.trailing_zeros()
    }

    /// Clocks from a coefficient's bit to the expression's bit: one per level.
    pub fn latency(&self) -> u32 {
        2 * self.levels()
    }

    fn build(&self, m: Module, i: LinearTreeIn) -> LinearTreeOut {
        let (side, levels) = (self.side, self.levels());
        let Coefficients { a, b, c } = i.coefficients;
        let first = beginnings(m, 2 * levels, i.first);
        let (x_first, y_first) = first.split_at(levels as usize);
        let x = Axis { name: "x", coefficient: delayed(m, "a", levels - 1, a), first: x_first };
        let y = Axis { name: "y", coefficient: delayed(m, "b", self.latency() - 1, b), first: y_first };
        let columns = (0..levels).fold(c.of(row(1)), |sums, level| {
            let parents = sums.take(2 << level, |column| column / 2);
            x.children(m, level, parents, is_right(2 << level))
        });
        let value = (0..levels).fold(columns.to_rows(1), |sums, level| {
            let parents = sums.rows().take(2 << level, |line| line / 2);
            y.children(m, level, parents, is_right(2 << level).to_columns(side))
        });
        LinearTreeOut { value }
    }
}

/// A coefficient on its way to the levels of a tree.
struct Axis<'a> {
    name: &'static str,
    /// The coefficient's bits, delayed until they have the weight of the lowest level, and so of every level.
    coefficient: Signal,
    /// Whether a new expression begins, at each level.
    first: &'a [Signal],
}

impl Axis<'_> {
    /// The sums of a level's nodes, a clock later: a left child takes its parent's, and a right child adds the
    /// coefficient.
    fn children(&self, m: Module, level: u32, parents: Signal, is_right: Signal) -> Signal {
        let named = |what: &str| format!("{}_{what}{level}", self.name);
        let lowest = self.first.len() as u32 - 1;
        let coefficient = shifted(m, &named("has_come"), self.first, [level, lowest], self.coefficient);
        let adds = (is_right & coefficient).named(&named("adds"));
        sum(m, [&named("sum"), &named("carry")], self.first[level as usize], parents, adds)
    }
}

#[cfg(test)]
mod tests;
