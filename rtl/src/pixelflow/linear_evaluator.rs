//! The linear evaluator: A x + B y + C at each pixel, a byte per clock, the lowest byte first (PFL-NODE, facts E4).
//!
//! ```text
//!            tree of a chip's pixels: 1 + log2 W levels         a sum for each of its pixels
//!
//!           .--[reg]-------> first line  ---> left half  ...
//! c ------->+                                                --> c + b line + a x --.
//!           '--[+ b][reg]--> second line ---> right half ...                        v
//!                                                                   for each pixel (+)[reg]--> value
//!           .--[reg]-------> upper half                                             ^
//! 0 ------->+                            ...                 --> 2 b chip ----------'
//!           '--[+ b][reg]--> lower half
//!            tree of chips: log2 H - 1 levels                   a sum for each chip
//! ```
//!
//! A chip has two lines of the region. Each node of a tree stands for a span of pixels, or of chips, and has the sum at
//! the first one. Its left child takes that sum. Its right child adds half the span times a coefficient, which is the
//! coefficient shifted by a few places. The shift is less than a byte, so a level adds a byte of the coefficient joined
//! with the top bits of the previous byte. Each pixel adds two sums: that of its position in the chip, and that of its
//! chip. So there is one adder per pixel, and few others.
//!
//! Nodes without a byte of an expression keep their values. A flag goes down the trees with the bytes, and enables the
//! registers.
//!
//! All sums are exact modulo 2^n for n bits sent, so signs and fractions are those of the integers (facts E0).
//!
//! Latency: 1 clock more than the larger tree has levels. Each pixel gets a byte in every clock, and expressions may
//! follow one another without a gap.

use super::SIDES;
use crate::delays::{delays, mark_delays};
use crate::prelude::*;

block! {
    /// Evaluates a linear expression at every pixel of a region.
    pub struct LinearEvaluator {
        /// The number of pixels in a line.
        pub width: u32,
        /// The number of lines.
        pub height: u32,
    }
    ranges { width: powers_of_two(SIDES), height: powers_of_two(SIDES) }
    latency(self) = format!("{} clocks from a byte of the coefficients to the expression's byte at each pixel", self.latency());
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NODE)";
    in(self) LinearEvaluatorIn {
        /// A byte of each coefficient, least significant byte first.
        coefficients: pub struct Coefficients {
            /// A byte of coefficient A, the increment from each column to the next.
            a: bits(8),
            /// A byte of coefficient B, the increment from each line to the next.
            b: bits(8),
            /// A byte of coefficient C, the value at column 0 of line 0.
            c: bits(8),
        },
        /// The bytes of the coefficients are the first of an expression.
        first: bit(),
        /// The bytes of the coefficients belong to an expression. The bytes of an expression come without a pause.
        sends: bit(),
    }
    out(self) LinearEvaluatorOut {
        /// A byte of the expression at each pixel: a row for each chip, with its upper line before its lower one.
        value: bits(8).of(grid(self.height / 2, 2 * self.width)),
    }
}

impl LinearEvaluator {
    /// Clocks from a byte of the coefficients to the expression's byte: one for each level, and one for the sum.
    pub fn latency(&self) -> u32 {
        self.levels() + 1
    }

    /// Levels of the larger tree. The other tree begins later, so both end in the same clock.
    fn levels(&self) -> u32 {
        (self.width.trailing_zeros() + 1).max(self.height.trailing_zeros() - 1)
    }

    fn build(&self, m: Module, i: LinearEvaluatorIn) -> LinearEvaluatorOut {
        let (chips, pixels, levels) = (self.height / 2, 2 * self.width, self.levels());
        let Coefficients { a, b, c } = i.coefficients;
        let sent = Sent {
            first: mark_delays(m, "first", levels, i.first),
            sends: mark_delays(m, "sends", levels, i.sends),
            a: delays(m, "a", levels + 1, a),
            b: delays(m, "b", levels + 1, b),
        };
        // The number of bits by which each level shifts its coefficient.
        let of_columns = (0..self.width.trailing_zeros()).rev().map(|places| (&sent.a, places));
        let in_chip: Vec<_> = std::iter::once((&sent.b, 0)).chain(of_columns).collect();
        let of_chips: Vec<_> = (1..self.height.trailing_zeros()).rev().map(|places| (&sent.b, places)).collect();
        let tree = |name, root, added: &[(&Vec<Signal>, u32)]| {
            let begins = levels - added.len() as u32;
            let root = m.within(name, || delays(m, "root", begins, root))[begins as usize];
            added.iter().zip(0..).fold(root.of(row(1)), |parents, (&(coefficient, places), level)| {
                let at = (begins + level) as usize;
                let weighted = sent.weighted(coefficient, places, at);
                m.within(&format!("{name}{level}"), || children(m, parents, weighted, sent.marks(at)))
            })
        };
        let (places, chip) = (tree("pixel", c, &in_chip), tree("chip", lit(8, 0), &of_chips));
        let (rows, columns) = (places.to_rows(chips), chip.to_columns(pixels));
        let value = m.within("value", || sum(m, rows, columns, sent.marks(levels as usize)));
        LinearEvaluatorOut { value }
    }
}

/// A signal and its delayed copies.
struct Sent {
    first: Vec<Signal>,
    sends: Vec<Signal>,
    a: Vec<Signal>,
    b: Vec<Signal>,
}

/// What a byte is: the first one of an expression, or any one.
#[derive(Clone, Copy)]
struct Marks {
    first: Signal,
    sends: Signal,
}

impl Sent {
    /// What the bytes sent `clocks` clocks ago are.
    fn marks(&self, clocks: usize) -> Marks {
        Marks { first: self.first[clocks], sends: self.sends[clocks] }
    }

    /// A byte of a shifted coefficient, `clocks` clocks after it was sent, with the top bits of the previous byte.
    fn weighted(&self, coefficient: &[Signal], places: u32, clocks: usize) -> Signal {
        let (byte, before) = (coefficient[clocks], coefficient[clocks + 1]);
        if places == 0 {
            return byte;
        }
        cat![byte.slice(0..8 - places), mux(self.first[clocks], 0, before.slice(8 - places..8))]
    }
}

/// The sums of a level, a clock later: a left child takes its parent's sum, and a right child adds the coefficient.
fn children(m: Module, parents: Signal, weighted: Signal, marks: Marks) -> Signal {
    let nodes = 2 * parents.count();
    let is_right = constants(bits(8).of(row(nodes)), |node| node % 2 * 0xff);
    def!(adds = is_right & weighted);
    sum(m, parents.take(nodes, |node| node / 2), adds, marks)
}

/// The sum of words that come byte by byte, a clock later.
fn sum(m: Module, left: Signal, right: Signal, marks: Marks) -> Signal {
    def!(sum = m.reg(bits(8).of(left.shape())));
    def!(carry = m.reg(bit().of(left.shape())));
    def!(total = left + right + (carry & !marks.first).zext(8));
    def!(carries = (left & right) | ((left | right) & !total));
    carry.when(marks.sends, carries.msb());
    sum.when(marks.sends, total);
    *sum
}

#[cfg(test)]
mod tests;
