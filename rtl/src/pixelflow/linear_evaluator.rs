//! The linear evaluator: A x + B y + C at each pixel, a byte a clock, least significant byte first (PFL-NODE, facts E4).
//!
//! ```text
//!            x tree: log2 W levels                          a sum for each column
//!
//!           .--[reg]---------> left half
//! c ------->+                             ... --------------> c + a x --.
//!           '--[+ a][reg]----> right half                               v
//!                                                              for each pixel (+)[reg]--> value
//!           .--[reg]---------> upper half                               ^
//! 0 ------->+                             ... --------------> b y ------'
//!           '--[+ b][reg]----> lower half
//!            y tree: log2 H levels                          a sum for each line
//! ```
//!
//! A node of the x tree has the sum for a span of columns, at its first one. Its left child passes that on, its right child adds half the span
//! times A: A, shifted by as many places as the level is above the leaves. Those places are fewer than a byte's, so a level adds a byte of A with the
//! top bits of the byte before it. The y tree does the same with lines, and each pixel adds what its column and its line have: one adder a pixel, and
//! few others.
//!
//! All is exact modulo 2 to the number of bits that are sent, so signs and fractions are those of the integers (facts E0).
//!
//! Latency 1 clock more than the larger tree has levels; a byte of each pixel a clock, and expressions right behind one another.

use crate::prelude::*;

block! {
    /// Evaluates a linear expression at every pixel of a region.
    pub struct LinearEvaluator {
        /// Pixels in a line; a power of two, from 2 to 256.
        pub width: u32,
        /// Lines; a power of two, from 2 to 256.
        pub height: u32,
    }
    latency(self) = format!("{} clocks from a coefficient's byte to the expression's at each pixel", self.latency());
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NODE)";
    in(self) LinearEvaluatorIn {
        /// A byte of each coefficient, beginning with the least significant.
        coefficients: pub struct Coefficients {
            /// Of what is added from a column to the next.
            a: bits(8),
            /// Of what is added from a line to the next.
            b: bits(8),
            /// Of the value at column 0 of line 0.
            c: bits(8),
        },
        /// These are the first bytes of an expression.
        first: bit(),
    }
    out(self) LinearEvaluatorOut {
        /// A byte of the expression at each pixel, a row for each line.
        value: bits(8).of(grid(self.height, self.width)),
    }
}

impl LinearEvaluator {
    /// Clocks from a coefficient's byte to the expression's: a clock a level, and one for the sum.
    pub fn latency(&self) -> u32 {
        self.levels() + 1
    }

    /// Levels of the larger tree. The other one begins later, so that both end in the same clock.
    fn levels(&self) -> u32 {
        self.width.max(self.height).trailing_zeros()
    }

    fn build(&self, m: Module, i: LinearEvaluatorIn) -> LinearEvaluatorOut {
        let (width, height) = (self.width, self.height);
        let Coefficients { a, b, c } = i.coefficients;
        let first = delays(m, "first", self.levels(), i.first, true);
        let tree = |name, coefficient: Signal, start: Signal, extent: u32| {
            let begins = self.levels() - extent.trailing_zeros();
            let bytes = delays(m, name, self.levels(), coefficient, false);
            let start = delays(m, &format!("{name}_root"), begins, start, false)[begins as usize];
            let tree = Tree { name, extent, bytes: &bytes[begins as usize..], first: &first[begins as usize..] };
            tree.sums(m, start)
        };
        let columns = tree("x", a, c, width);
        let lines = tree("y", b, lit(8, 0), height);
        let first = first[self.levels() as usize].of(grid(height, width));
        let value = sum(m, "value", columns.to_rows(height), lines.to_columns(width), first);
        LinearEvaluatorOut { value }
    }
}

/// The signal, and the same some clocks later each, up to so many. What is a mark does not come before it is sent.
fn delays(m: Module, name: &str, clocks: u32, signal: Signal, is_mark: bool) -> Vec<Signal> {
    let mut delays = vec![signal];
    for clock in 1..=clocks {
        let register = m.reg(&format!("{name}{clock}"), signal.width());
        let register = if is_mark { register.reset(0) } else { register };
        register.next(delays[clock as usize - 1]);
        delays.push(*register);
    }
    delays
}

/// The sum of words that come byte by byte, a clock later.
fn sum(m: Module, name: &str, left: Signal, right: Signal, first: Signal) -> Signal {
    let carry = m.reg(&format!("{name}_carry"), bit().of(left.shape()));
    let total = left + right + (*carry & !first).zext(8);
    carry.next(((left & right) | ((left | right) & !total)).msb());
    m.pipe(&format!("{name}_sum"), total)
}

/// A tree of adders.
struct Tree<'a> {
    name: &'static str,
    /// Its leaves.
    extent: u32,
    /// The coefficient's byte at the first level, at the second, and so on, as it comes there.
    bytes: &'a [Signal],
    /// It is the first of an expression.
    first: &'a [Signal],
}

impl Tree<'_> {
    /// What its leaves have, a clock a level later.
    fn sums(&self, m: Module, root: Signal) -> Signal {
        (0..self.extent.trailing_zeros()).fold(root.of(row(1)), |sums, level| {
            let parents = sums.take(2 << level, |node| node / 2);
            let is_right = constants(bits(8).of(row(2 << level)), |node| u64::from(node % 2) * 0xff);
            let adds = is_right & self.weighted(m, level);
            let first = self.first[level as usize].of(row(2 << level));
            sum(m, &format!("{}{level}", self.name), parents, adds, first)
        })
    }

    /// The coefficient times half the span of a level's nodes: shifted, with the top bits of the byte before.
    fn weighted(&self, m: Module, level: u32) -> Signal {
        let (byte, first) = (self.bytes[level as usize], self.first[level as usize]);
        let places = self.extent.trailing_zeros() - 1 - level;
        if places == 0 {
            return byte;
        }
        let before = m.pipe(&format!("{}{level}_before", self.name), byte.slice(8 - places..8));
        concat(&[byte.slice(0..8 - places), mux(first, 0, before)])
    }
}

#[cfg(test)]
mod tests;
